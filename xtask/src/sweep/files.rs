//! Writing the tables, or comparing them with what is there.

use std::fs;
use std::path::Path;

const START: &str = "<!-- sweep: written by `cargo xtask sweep` -->\n";
const END: &str = "<!-- end of sweep -->\n";

/// Writes files into a folder, which need not exist.
pub(super) fn write(folder: &Path, files: &[(String, String)]) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for (name, text) in files {
        let path = folder.join(name);
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let names: Vec<&str> =
        files.iter().map(|(name, _)| name.as_str()).filter(|n| n.ends_with(".md")).collect();
    println!("{}: {}", folder.display(), names.join(", "));
    Ok(())
}

/// Every file as it would be written, and no others but `known`; otherwise the first difference.
pub(super) fn compare(folder: &Path, files: &[(String, String)], known: &[&str]) -> Result<(), String> {
    let anew = "`cargo xtask sweep` writes the tables anew";
    for (name, expected) in files {
        let found =
            fs::read_to_string(folder.join(name)).map_err(|error| format!("{name}: {error}; {anew}"))?;
        if let Some(difference) = first_difference(&found, expected) {
            return Err(format!("fixtures/tables/{name}, {difference}\n{anew}"));
        }
    }
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name().to_string_lossy().into_owned();
        if !known.contains(&name.as_str()) && !files.iter().any(|(file, _)| *file == name) {
            return Err(format!("fixtures/tables/{name} belongs to no mesh; remove it"));
        }
    }
    println!("fixtures/tables: all {} tables are what the code gives", files.len());
    Ok(())
}

/// Puts `text` between the markers.
pub(super) fn write_section(path: &Path, text: &str) -> Result<(), String> {
    let whole = read(path)?;
    let (before, _, after) = sections(&whole).ok_or_else(|| no_markers(path))?;
    fs::write(path, format!("{before}{START}{text}{END}{after}"))
        .map_err(|error| format!("{}: {error}", path.display()))
}

/// Compares what stands between the markers.
pub(super) fn compare_section(path: &Path, expected: &str) -> Result<(), String> {
    let whole = read(path)?;
    let (_, found, _) = sections(&whole).ok_or_else(|| no_markers(path))?;
    match first_difference(found, expected) {
        None => Ok(()),
        Some(difference) => Err(format!(
            "README.md, table of the sweep, {difference}\n`cargo xtask sweep` writes the tables anew"
        )),
    }
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn no_markers(path: &Path) -> String {
    format!("{}: the lines `{}` and `{}` are missing", path.display(), START.trim_end(), END.trim_end())
}

/// Before, between and after the markers.
fn sections(whole: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = whole.split_once(START)?;
    let (between, after) = rest.split_once(END)?;
    Some((before, between, after))
}

/// The first line that differs, in words.
fn first_difference(found: &str, expected: &str) -> Option<String> {
    if found == expected {
        return None;
    }
    let (mut found, mut expected) = (found.lines(), expected.lines());
    for number in 1.. {
        match (found.next(), expected.next()) {
            (None, None) => break,
            (a, b) if a == b => {}
            (a, b) => {
                let show = |line: Option<&str>| line.map_or("the end".to_owned(), |line| format!("`{line}`"));
                return Some(format!("line {number} is\n  {}\nbut the code gives\n  {}", show(a), show(b)));
            }
        }
    }
    Some("the line ends differ".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_difference_is_named() {
        assert_eq!(first_difference("a\nb\n", "a\nb\n"), None);
        assert_eq!(
            first_difference("a\nb\nc\n", "a\nx\ny\n").unwrap(),
            "line 2 is\n  `b`\nbut the code gives\n  `x`"
        );
        assert_eq!(
            first_difference("a\n", "a\nb\n").unwrap(),
            "line 2 is\n  the end\nbut the code gives\n  `b`"
        );
        assert_eq!(first_difference("a", "a\n").unwrap(), "the line ends differ");
    }

    #[test]
    fn only_what_is_between_the_markers_changes() {
        let whole = format!("head\n{START}old\n{END}tail\n");
        assert_eq!(sections(&whole), Some(("head\n", "old\n", "tail\n")));
        assert_eq!(sections("no markers"), None);
    }
}
