//! `qparam sweep`: one mesh, several q, as table, CSV and JSON.

use qoptimize::Distortion;
use qoptimize::qembed::BoundaryShape;
use serde::Serialize;
use std::fmt::Write as _;

use crate::args::SweepArgs;
use crate::boundary;
use crate::disk::require_patch;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::interrupt::Phase;
use crate::json_text;
use crate::output::Target;
use crate::progress::Watch;
use crate::report::{Head, InputReport};
use crate::streams::Streams;
use crate::sweep::{Column, Features, Knee, NoKnee, Sweep, sweep};
use crate::table::{Table, short};
use crate::threads;
use crate::translate::{Names, no_map};
use crate::unwrap::{method_line, options_json};

#[derive(Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    head: Head,
    input: InputReport,
    options: serde_json::Value,
    columns: Vec<ColumnReport<'a>>,
    features: Features,
    /// How many of the three features of Table 1 hold.
    features_held: usize,
    knee: Option<Knee>,
    no_knee: Option<NoKnee>,
}

#[derive(Serialize)]
struct ColumnReport<'a> {
    q: f64,
    valid: bool,
    sum: Option<f64>,
    distortion: Option<&'a Distortion>,
    error: Option<String>,
}

pub(crate) fn run(arguments: &SweepArgs, io: &mut Streams<'_>) -> Result<Exit, Failure> {
    let mut options = arguments.map.options(0.5)?;
    let csv = arguments.csv.as_deref().map(Target::new);
    check(arguments, csv.as_ref())?;
    if let Some(target) = &csv {
        target.probe()?;
    }
    let input = Input::read(&arguments.input, io.stdin)?;
    let mesh = input.mesh()?;
    require_patch(&mesh, &input)?;
    if let (BoundaryShape::Fixed(positions), Some(path)) = (&mut options.boundary, &arguments.map.boundary_uv)
    {
        *positions = boundary::read(path, io.stdin, &mesh, &input)?;
    }
    let watch = Watch::new(io.interrupt, io.stderr_is_terminal);
    let work = || sweep(&mesh, &options, &arguments.q, &watch);
    let result = io.interrupt.during(Phase::Watched, || threads::with(arguments.map.threads, work));
    watch.finish();
    let result = result?;
    if io.interrupt.is_requested() {
        return Err(Failure::interrupted());
    }
    let sweep = result.map_err(|error| no_map(&error, &Names::of_all(&mesh, &input)))?;
    if let Some(target) = &csv {
        let text = csv_text(&sweep);
        target.write(io.stdout, io.interrupt, |writer| writer.write_all(text.as_bytes()))?;
    }
    let input = InputReport::new(&input);
    if arguments.json {
        let mut options = options_json(&options, arguments.map.boundary_uv.as_deref());
        options["q"] = serde_json::json!(arguments.q);
        io.say(&json_text(&report(&sweep, input, options)))?;
    } else {
        let aside = csv == Some(Target::Stdout);
        let color = if aside { io.stderr_color } else { io.stdout_color };
        let head = input.line() + &method_line(&arguments.map, None) + "\n\n";
        io.report(aside, &(head + &text(&sweep, color)))?;
    }
    // What there is has been shown; scripts still learn that something is missing.
    let missing = sweep.columns.iter().any(|column| column.outcome.is_err());
    Ok(if missing { Exit::Computation } else { Exit::Done })
}

fn check(arguments: &SweepArgs, csv: Option<&Target>) -> Result<(), Failure> {
    let refuse = |what: String, help: &str| Err(Failure::new(Exit::Usage, what).help(help));
    for (i, q) in arguments.q.iter().enumerate() {
        if arguments.q[..i].contains(q) {
            return refuse(format!("--q names {q} twice"), "name each value once");
        }
    }
    let is_input =
        |target: &Target| *target != Target::Stdout && target.is_same_place(&Target::new(&arguments.input));
    if csv.is_some_and(is_input) {
        return refuse("the CSV would replace the input".to_owned(), "name another file with --csv");
    }
    if arguments.json && csv == Some(&Target::Stdout) {
        return refuse(
            "the CSV and the JSON report would both go to standard output".to_owned(),
            "name a file with --csv",
        );
    }
    let dash = |path: &std::path::Path| path.as_os_str() == "-";
    if dash(&arguments.input) && arguments.map.boundary_uv.as_deref().is_some_and(dash) {
        return refuse(
            "standard input cannot be read twice".to_owned(),
            "name a file for the mesh or for --boundary-uv",
        );
    }
    Ok(())
}

fn report(sweep: &Sweep, input: InputReport, options: serde_json::Value) -> Report<'_> {
    let column = |column: &'_ Column| -> (Option<f64>, bool) {
        (column.errors().map(|errors| errors.sum()), column.is_valid())
    };
    let columns = sweep.columns.iter().map(|c| {
        let (sum, valid) = column(c);
        let (distortion, error) = match &c.outcome {
            Ok(distortion) => (Some(distortion), None),
            Err(error) => (None, Some(error.to_string())),
        };
        ColumnReport { q: c.q, valid, sum, distortion, error }
    });
    Report {
        head: Head::new("sweep"),
        input,
        options,
        columns: columns.collect(),
        features: sweep.features,
        features_held: sweep.features.held(),
        knee: sweep.knee.ok(),
        no_knee: sweep.knee.err(),
    }
}

/// Table 1 and what it says, for people.
fn text(sweep: &Sweep, color: bool) -> String {
    let mut table = Table::new(sweep.columns.iter().map(|column| format!("q = {}", column.q)).collect());
    let mut row = |label: &str, value: &dyn Fn(&Distortion) -> String| {
        let show = |column: &Column| column.outcome.as_ref().map_or_else(|_| short(None), value);
        table.row(label, sweep.columns.iter().map(show).collect());
    };
    row("angle error (Eq. 13)", &|d| short(d.angle_error));
    row("area error (Eq. 14)", &|d| short(d.area_error));
    row("sum", &|d| short(d.angle_error + d.area_error));
    row("flipped corners", &|d| d.flipped_corners.to_string());
    row("boundary crossings", &|d| d.boundary_crossings.to_string());
    row("symmetric Dirichlet (1 for an isometry)", &|d| short(d.symmetric_dirichlet));
    let mut text = table.render(color) + "\n";
    for sentence in sweep.sentences() {
        text += &format!("{sentence}\n");
    }
    for column in &sweep.columns {
        match (&column.certificate, &column.outcome) {
            (Some(certificate), _) if !certificate.holds => {
                text += &format!("the map at q = {} is not valid. The certificate {certificate}\n", column.q);
            }
            (_, Err(error)) => text += &format!("no map at q = {}: {error}\n", column.q),
            _ => {}
        }
    }
    text
}

/// One line a q, every digit; a field is empty where there is no value.
fn csv_text(sweep: &Sweep) -> String {
    let mut text = String::from(
        "q,valid,angle_error,area_error,sum,flipped_corners,folded_faces,boundary_crossings,symmetric_dirichlet\n",
    );
    for column in &sweep.columns {
        let _ = write!(text, "{},{}", column.q, column.is_valid());
        match &column.outcome {
            Ok(d) => {
                let _ = writeln!(
                    text,
                    ",{},{},{},{},{},{},{}",
                    d.angle_error,
                    d.area_error,
                    d.angle_error + d.area_error,
                    d.flipped_corners,
                    d.folded_faces,
                    d.boundary_crossings,
                    d.symmetric_dirichlet.map_or_else(String::new, |value| value.to_string())
                );
            }
            Err(_) => text += ",,,,,,,\n",
        }
    }
    text
}
