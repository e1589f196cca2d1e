//! `qparam` itself: built in release mode, or given; its methods read from its help.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::contestant::Contestant;
use super::league::Measures;
use super::places::Places;
use super::race::Account;
use super::shell;

/// The preset that minimises what SLIM and Blender's minimum stretch minimise, nearly alone: `--shape 10`.
pub(super) const LEAST_STRETCH: &str = "qparam-least-stretch";

/// The built binary.
pub(super) struct Qparam {
    pub(super) version: String,
    /// The name, in the table, of the method that ratios are taken against.
    pub(super) baseline: String,
    binary: PathBuf,
    methods: Vec<String>,
}

/// Asks a `qparam` which methods it has; builds one unless it is given.
pub(super) fn prepare(
    places: &Places,
    built: Option<&Path>,
    against: Option<&str>,
) -> Result<Qparam, String> {
    let binary = match built {
        Some(path) => std::path::absolute(path).map_err(|error| format!("{}: {error}", path.display()))?,
        None => build(places)?,
    };
    let help = shell::output(Command::new(&binary).args(["unwrap", "-h"]))?;
    let (methods, default) =
        methods(&help).ok_or("`qparam unwrap -h` does not list the values of --method")?;
    let baseline = against.map_or(default, str::to_owned);
    if !methods.contains(&baseline) {
        return Err(format!("qparam has no method {baseline}; it has {}", methods.join(", ")));
    }
    let version = shell::output(Command::new(&binary).arg("--version"))?.trim().to_owned();
    Ok(Qparam { version, baseline: named(&baseline), binary, methods })
}

fn build(places: &Places) -> Result<PathBuf, String> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let mut command = Command::new(cargo);
    command.current_dir(&places.root).args([
        "build",
        "--release",
        "--package",
        "qparam-cli",
        "--bin",
        "qparam",
    ]);
    let status = command.status().map_err(|error| format!("cargo: {error}"))?;
    if !status.success() {
        return Err("qparam did not build".to_owned());
    }
    Ok(places.target.join("release").join(format!("qparam{}", std::env::consts::EXE_SUFFIX)))
}

fn named(method: &str) -> String {
    format!("qparam-{method}")
}

/// The values of `--method` and the default among them, from the short help.
pub(super) fn methods(help: &str) -> Option<(Vec<String>, String)> {
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let about = words.split_once("--method ")?.1;
    let about = about.split(" --").next()?;
    let list = |name: &str| Some(about.split_once(&format!("[{name}: "))?.1.split_once(']')?.0);
    let values: Vec<String> = list("possible values")?.split(", ").map(str::to_owned).collect();
    Some((values, list("default")?.to_owned()))
}

impl Qparam {
    /// The baseline first.
    pub(super) fn contestants(&self) -> Vec<Contestant> {
        let methods = self.methods.iter().map(|method| self.contestant(&named(method), ["--method", method]));
        let mut contestants: Vec<Contestant> = methods.collect();
        contestants.push(self.contestant(LEAST_STRETCH, ["--preset", "least-stretch"]));
        contestants.sort_by_key(|contestant| contestant.name != self.baseline);
        contestants
    }

    fn contestant(&self, name: &str, choice: [&str; 2]) -> Contestant {
        Contestant {
            name: name.to_owned(),
            ours: true,
            input: "quads",
            program: self.binary.clone(),
            leading: ["unwrap", "--no-config", "--json"].into_iter().chain(choice).map(Into::into).collect(),
        }
    }

    /// `qparam measure`.
    pub(super) fn measure(&self, file: &Path) -> Result<Measures, String> {
        let text = shell::output(Command::new(&self.binary).args(["measure", "--json"]).arg(file))?;
        let report: Value =
            serde_json::from_str(&text).map_err(|error| format!("qparam measure: {error}"))?;
        let found = measures(&report).ok_or("qparam measure: the report has no angle_error")?;
        serde_json::from_value(found.clone()).map_err(|error| format!("qparam measure: {error}"))
    }
}

/// The object with the measures, wherever the report keeps it.
fn measures(report: &Value) -> Option<&Value> {
    if report.get("angle_error").is_some() {
        return Some(report);
    }
    match report {
        Value::Object(fields) => fields.values().find_map(measures),
        Value::Array(items) => items.iter().find_map(measures),
        _ => None,
    }
}

/// Seconds of the computation alone and the largest resident set, from the report of `qparam unwrap --json`.
pub(super) fn own_account(report: &str) -> Option<Account> {
    let report: Value = serde_json::from_str(report).ok()?;
    Some(Account {
        solve_seconds: report.get("timings_seconds")?.get("parameterize")?.as_f64()?,
        peak_memory_bytes: report.get("peak_memory_bytes").and_then(Value::as_u64),
    })
}
