//! What criterion leaves behind: `benchmark.json` says what was run, `estimates.json` how long it took.

use std::fs;
use std::path::Path;

use serde::Deserialize;

/// The time of one bench at one size.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Estimate {
    /// Group and function.
    pub(super) stage: String,
    pub(super) quads: usize,
    /// The slope over samples of several runs where criterion has one, else the mean.
    pub(super) nanoseconds: f64,
}

#[derive(Deserialize)]
struct Benchmark {
    group_id: String,
    function_id: Option<String>,
    value_str: Option<String>,
}

#[derive(Deserialize)]
struct Estimates {
    mean: Point,
    slope: Option<Point>,
}

#[derive(Deserialize)]
struct Point {
    point_estimate: f64,
}

/// Every estimate below a folder, in the order of stages and sizes.
pub(super) fn collect(folder: &Path) -> Result<Vec<Estimate>, String> {
    let mut found = Vec::new();
    visit(folder, &mut found)?;
    if found.is_empty() {
        return Err(format!("{}: criterion left no estimates", folder.display()));
    }
    found.sort_by(|a, b| (&a.stage, a.quads).cmp(&(&b.stage, b.quads)));
    Ok(found)
}

fn visit(folder: &Path, found: &mut Vec<Estimate>) -> Result<(), String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.join("new/estimates.json").is_file() {
        let read = |name: &str| fs::read_to_string(folder.join("new").join(name)).map_err(wrong);
        let what = read("benchmark.json")?;
        let time = read("estimates.json")?;
        found.push(parse(&what, &time).map_err(|error| format!("{}: {error}", folder.display()))?);
    }
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        if path.is_dir() {
            visit(&path, found)?;
        }
    }
    Ok(())
}

fn parse(what: &str, time: &str) -> Result<Estimate, String> {
    let what: Benchmark = serde_json::from_str(what).map_err(|error| error.to_string())?;
    let time: Estimates = serde_json::from_str(time).map_err(|error| error.to_string())?;
    let size = what.value_str.ok_or("a bench without a size")?;
    Ok(Estimate {
        stage: what
            .function_id
            .map_or_else(|| what.group_id.clone(), |name| format!("{} {name}", what.group_id)),
        quads: size.parse().map_err(|_| format!("`{size}` is no number of quads"))?,
        nanoseconds: time.slope.unwrap_or(time.mean).point_estimate,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_taken_where_there_is_one() {
        let what = r#"{"group_id":"embed","function_id":"Lscm","value_str":"1024","throughput":null}"#;
        let point =
            |x: f64| format!(r#"{{"confidence_interval":{{}},"point_estimate":{x},"standard_error":0.1}}"#);
        let time =
            |slope: &str| format!(r#"{{"mean":{},"median":{},"slope":{slope}}}"#, point(5.0), point(4.0));
        let estimate = parse(what, &time(&point(3.0))).unwrap();
        assert_eq!(estimate, Estimate { stage: "embed Lscm".into(), quads: 1024, nanoseconds: 3.0 });
        assert_eq!(parse(what, &time("null")).unwrap().nanoseconds, 5.0);
        assert!(parse(&what.replace("1024", "many"), &time("null")).is_err());
    }
}
