//! What a plot says is where its axes say.

use super::*;

fn axis(scale: Scale, bounds: [f64; 2], marked: &[f64]) -> Axis {
    Axis { label: "x & y".to_owned(), scale, bounds, marked: marked.to_vec() }
}

/// Even steps on a linear axis, even ratios on a logarithmic one; the larger number may come first; beyond is nothing.
#[test]
fn places_on_axes() {
    let linear = axis(Scale::Linear, [1.0, 0.0], &[]);
    assert_eq!(linear.fraction(0.75), Some(0.25));
    assert_eq!(linear.fraction(1.5), None);
    let logarithmic = axis(Scale::Logarithmic, [0.01, 100.0], &[]);
    assert!((logarithmic.fraction(0.1).unwrap() - 0.25).abs() < 1e-12);
    assert_eq!(logarithmic.fraction(0.0), None);
    assert_eq!(logarithmic.fraction(f64::NAN), None);
}

#[test]
fn ticks_are_few_round_and_inside() {
    let names = |bounds| axis(Scale::Logarithmic, bounds, &[]).ticks().into_iter().map(|(_, name)| name);
    assert_eq!(names([0.02, 300.0]).collect::<Vec<_>>(), ["0.1", "1", "10", "100"]);
    assert_eq!(names([1.5, 30.0]).collect::<Vec<_>>(), ["2", "5", "10", "20"]);
    for decades in 0..40 {
        let ticks = axis(Scale::Logarithmic, [0.7, 2.0 * 10_f64.powi(decades)], &[]).ticks();
        assert!((1..=9).contains(&ticks.len()), "{decades}: {}", ticks.len());
    }
    assert_eq!(axis(Scale::Linear, [0.0, 1.0], &[0.0, 0.5]).ticks()[1], (0.5, "0.5".to_owned()));
}

#[test]
fn an_axis_holds_its_values() {
    let held = Axis::holding("error", [3.0, 0.0, f64::INFINITY, 5e4].into_iter());
    assert!(held.fraction(3.0).is_some() && held.fraction(5e4).is_some());
    assert!(Axis::holding("error", std::iter::empty()).fraction(1.0).is_some());
}

/// Three points on one spot get three labels that do not overlap.
#[test]
fn labels_keep_off_each_other() {
    let mut labels = Labels::new([0.0, 0.0], [400.0, 300.0]);
    let places: Vec<_> = (0..3).map(|_| labels.place([200.0, 150.0], "libigl-slim")).collect();
    for (i, a) in places.iter().enumerate() {
        for b in &places[..i] {
            assert!(a.1 != b.1 || (a.0[1] - b.0[1]).abs() >= 10.0, "{a:?} {b:?}");
        }
    }
}

/// Series of one name share a line of the legend, text is escaped, and what lies outside the axes is left out.
#[test]
fn a_page_of_panels() {
    let series = Series {
        name: "a < b".to_owned(),
        color: 0,
        style: Style::Line,
        points: [[0.0, 1.0], [1.0, 10.0], [0.5, 1e9]].map(Point::bare).to_vec(),
    };
    let panel = || Panel {
        title: "one".to_owned(),
        x: axis(Scale::Linear, [0.0, 1.0], &[0.0, 1.0]),
        y: axis(Scale::Logarithmic, [0.5, 20.0], &[]),
        series: vec![series.clone()],
    };
    let text = svg(&[panel(), panel()], 2, &["note".to_owned()]);
    assert_eq!(text.matches("a &lt; b").count(), 1);
    assert_eq!(text.matches("<circle").count(), 2 + 2 + 1);
    assert_eq!(text.matches("x &amp; y").count(), 4);
    assert!(text.starts_with("<svg") && text.ends_with("</svg>\n") && text.contains("note"));
    assert_eq!(text, svg(&[panel(), panel()], 2, &["note".to_owned()]));
}
