//! All methods on one mesh: Markdown for people, CSV for programs.

use std::fmt::Write as _;

use qparam_cli::qoptimize::{Distortion, Options, parameterize};
use qparam_cli::sweep::{Errors, Sweep, digits, sweep};
use rayon::prelude::*;

use super::Mesh;
use super::printed::{self, Printed};
use super::reading::{BASELINES, Contender, contenders};

/// All methods on one mesh.
pub(super) struct MeshReport {
    pub(super) name: String,
    vertices: usize,
    quads: usize,
    pub(super) q: Vec<f64>,
    pub(super) printed: Option<&'static Printed>,
    /// A method and its sweep, or why there is none.
    pub(super) swept: Vec<(Contender, Result<Sweep, String>)>,
    baselines: Vec<(&'static str, &'static str, Result<Distortion, String>)>,
}

/// A label and its figure.
type Row = (&'static str, fn(&Distortion) -> String);
type PrintedRow = (&'static str, fn(&Errors) -> f64);
type Cell<'a> = &'a dyn Fn(&Distortion) -> String;

/// The rows below the paper's two.
const MORE_ROWS: &[Row] = &[
    ("flipped corners", |d| d.flipped_corners.to_string()),
    ("symmetric Dirichlet", |d| d.symmetric_dirichlet.map_or_else(|| "–".to_owned(), digits)),
];

impl MeshReport {
    pub(super) fn new(mesh: &Mesh, q: &[f64]) -> Result<Self, String> {
        let run = |contender: &Contender| {
            let options = contender.way.options(&mesh.mesh)?;
            sweep(&mesh.mesh, &options, q, &()).map_err(|error| error.to_string())
        };
        let swept =
            contenders().into_par_iter().map(|contender| (contender.clone(), run(&contender))).collect();
        let baselines = BASELINES
            .par_iter()
            .map(|&(method, name, what)| {
                let result = parameterize(&mesh.mesh, &Options { method, ..Options::default() }, &());
                (name, what, result.map(|map| map.distortion).map_err(|error| error.to_string()))
            })
            .collect();
        Ok(Self {
            name: mesh.name.clone(),
            vertices: mesh.mesh.vertex_count(),
            quads: mesh.mesh.face_count(),
            q: q.to_vec(),
            printed: printed::of(&mesh.name),
            swept,
            baselines,
        })
    }

    /// The tables, and in words what they show.
    pub(super) fn markdown(&self) -> String {
        let mut text = format!(
            "# {}\n\n{} vertices, {} faces. Written by `cargo xtask sweep`; angle error is Eq. 13, area error Eq. 14, both \
             sums over the corners.\n\n",
            self.name, self.vertices, self.quads
        );
        text += &self.table_head();
        if let Some(printed) = self.printed {
            text += &self.printed_rows(printed);
        }
        for (contender, result) in &self.swept {
            text += &self.method_rows(contender.name, result);
        }
        text += "\n";
        for (contender, result) in &self.swept {
            let _ = writeln!(text, "**{}** is {}.\n", contender.name, contender.what);
            match result {
                Ok(sweep) => {
                    for sentence in sweep.sentences() {
                        let _ = writeln!(text, "- {sentence}");
                    }
                    for (q, error) in gaps(sweep) {
                        let _ = writeln!(text, "- no map at q = {q}: {error}");
                    }
                }
                Err(error) => {
                    let _ = writeln!(text, "- no map: {error}");
                }
            }
            text += "\n";
        }
        text + &self.baseline_table()
    }

    pub(super) fn table_head(&self) -> String {
        let mut text = String::from("| method | q |");
        for q in &self.q {
            let _ = write!(text, " {q} |");
        }
        text + "\n| --- | --- |" + &" ---: |".repeat(self.q.len()) + "\n"
    }

    pub(super) fn printed_rows(&self, printed: &Printed) -> String {
        let rows: [PrintedRow; 3] =
            [("angle error", |e| e.angle), ("area error", |e| e.area), ("sum", Errors::sum)];
        let mut text = String::new();
        for (index, (label, value)) in rows.iter().enumerate() {
            let name =
                if index == 0 { format!("printed in Table 1 ({})", printed.letter) } else { String::new() };
            let cells = self.q.iter().map(|q| {
                printed.at(*q).map_or_else(|| "–".to_owned(), |errors| format!("{:.2}", value(&errors)))
            });
            text += &row(&name, label, cells);
        }
        text
    }

    /// Eqs. 13 and 14 and their sum.
    pub(super) fn error_rows(&self, name: &str, result: &Result<Sweep, String>) -> String {
        self.rows(
            name,
            result,
            &[
                ("angle error", &|d| digits(d.angle_error)),
                ("area error", &|d| digits(d.area_error)),
                ("sum", &|d| digits(d.angle_error + d.area_error)),
            ],
        )
    }

    fn method_rows(&self, name: &str, result: &Result<Sweep, String>) -> String {
        let more: Vec<(&str, Cell<'_>)> =
            MORE_ROWS.iter().map(|(label, cell)| (*label, cell as Cell<'_>)).collect();
        self.error_rows(name, result) + &self.rows("", result, &more)
    }

    fn rows(&self, name: &str, result: &Result<Sweep, String>, rows: &[(&str, Cell<'_>)]) -> String {
        let mut text = String::new();
        for (index, (label, cell)) in rows.iter().enumerate() {
            let cells = (0..self.q.len()).map(|column| {
                let outcome =
                    result.as_ref().ok().and_then(|sweep| sweep.columns[column].outcome.as_ref().ok());
                outcome.map_or_else(|| "–".to_owned(), cell)
            });
            text += &row(if index == 0 { name } else { "" }, label, cells);
        }
        text
    }

    fn baseline_table(&self) -> String {
        let mut text = String::from(
            "Methods that q does not move:\n\n| method | what it is | angle error | area error | sum | flipped corners | symmetric Dirichlet |\n\
             | --- | --- | ---: | ---: | ---: | ---: | ---: |\n",
        );
        for (name, what, result) in &self.baselines {
            let _ = match result {
                Ok(d) => writeln!(
                    text,
                    "| {name} | {what} | {} | {} | {} | {} | {} |",
                    digits(d.angle_error),
                    digits(d.area_error),
                    digits(d.angle_error + d.area_error),
                    d.flipped_corners,
                    MORE_ROWS[1].1(d)
                ),
                Err(error) => writeln!(text, "| {name} | {what}; no map: {error} | – | – | – | – | – |"),
            };
        }
        text
    }

    /// One line a map; q is empty where it has no effect.
    pub(super) fn csv(&self) -> String {
        let mut text =
            String::from("mesh,method,q,angle_error,area_error,sum,flipped_corners,symmetric_dirichlet\n");
        let mut line = |method: &str, q: String, d: &Distortion| {
            let _ = writeln!(
                text,
                "{},{},{q},{},{},{},{},{}",
                self.name,
                method.replace(", ", "-"),
                digits(d.angle_error),
                digits(d.area_error),
                digits(d.angle_error + d.area_error),
                d.flipped_corners,
                d.symmetric_dirichlet.map_or_else(String::new, digits)
            );
        };
        for (contender, result) in &self.swept {
            for column in result.iter().flat_map(|sweep| &sweep.columns) {
                if let Ok(distortion) = &column.outcome {
                    line(contender.name, column.q.to_string(), distortion);
                }
            }
        }
        for (name, _, result) in &self.baselines {
            if let Ok(distortion) = result {
                line(name, String::new(), distortion);
            }
        }
        text
    }
}

fn row(name: &str, label: &str, cells: impl Iterator<Item = String>) -> String {
    let mut text = format!("| {name} | {label} |");
    for cell in cells {
        let _ = write!(text, " {cell} |");
    }
    text + "\n"
}

/// The q without a map.
fn gaps(sweep: &Sweep) -> impl Iterator<Item = (f64, String)> + '_ {
    sweep.columns.iter().filter_map(|column| Some((column.q, column.outcome.as_ref().err()?.to_string())))
}
