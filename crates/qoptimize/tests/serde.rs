//! What goes into reports and comes out of configuration files.

#![cfg(feature = "serde")]

use qoptimize::qmesh::{Polygons, Vec2, shapes};
use qoptimize::{Distortion, Method, MoveOrder, Options, measure, parameterize};

/// Options survive a round trip; what is not named keeps its default.
#[test]
fn options_round_trip() {
    let options = Options { method: Method::MeanValue, q: 0.25, overlaps: None, ..Options::default() };
    let text = serde_json::to_string(&options).unwrap();
    assert!(text.contains(r#""method":"mean-value""#), "{text}");
    assert_eq!(serde_json::from_str::<Options>(&text).unwrap(), options);
    let part = r#"{ "q": 0.75, "overlaps": { "order": "first-come" } }"#;
    let part: Options = serde_json::from_str(part).unwrap();
    assert_eq!((part.q, part.method), (0.75, Method::Direct));
    assert_eq!(part.overlaps.unwrap().order, MoveOrder::FirstCome);
}

/// An ordinary map has all measures. One that is flipped all over, or flat, has nulls where there is no value, and
/// numbers elsewhere: JSON has no others.
#[test]
fn measures_as_json() {
    let mesh = shapes::bump(6, 0.5);
    let options = Options { method: Method::Paper, ..Options::default() };
    let map = parameterize(&mesh, &options, &()).unwrap();
    let text = serde_json::to_string(&map.distortion).unwrap();
    assert!(!text.contains("null"), "{text}");
    assert!(text.contains(r#""angle_error":"#) && text.contains(r#""boundary_crossings":0"#));
    let record = serde_json::to_value(&map.record).unwrap();
    assert_eq!(record["overlaps"]["after"], 0);
    // Both fan triangles of this quad collapse in the plane, two other corner triangles do not.
    let quad =
        Polygons::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2, 3]]);
    let fold = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]].map(Vec2::from);
    let value = serde_json::to_value(measure(quad.view(), &fold).unwrap()).unwrap();
    assert!(value["benchmark"]["max_area_distortion"].is_null());
    assert_eq!(value["benchmark"]["average_area_discrepancy"], 1.0);
    assert!(value["angle_error"].is_f64() && value["stretch_l2"].is_f64());
    let found: Distortion = serde_json::from_value(value).unwrap();
    assert_eq!(found.benchmark.max_area_distortion, None);
}
