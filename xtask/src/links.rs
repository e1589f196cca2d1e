//! Links between the project's own files: every relative one in a Markdown file leads somewhere.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders whose Markdown files are checked, files in folders below included.
const FOLDERS: &[&str] = &["docs", "crates", "fixtures"];

/// What is wrong with the links of the Markdown files at `root` and in [`FOLDERS`].
pub(crate) fn faults(root: &Path) -> Result<Vec<String>, String> {
    let mut files = Vec::new();
    collect(root, false, &mut files)?;
    for folder in FOLDERS.iter().map(|name| root.join(name)).filter(|folder| folder.is_dir()) {
        collect(&folder, true, &mut files)?;
    }
    let mut faults = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let shown = file.strip_prefix(root).unwrap_or(&file).display().to_string();
        for (line, target) in targets(&text) {
            if let Some(reason) = broken(&file, target) {
                faults.push(format!("{shown}:{line}: the link to {target} {reason}"));
            }
        }
    }
    Ok(faults)
}

fn collect(folder: &Path, deep: bool, files: &mut Vec<PathBuf>) -> Result<(), String> {
    let fault = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(fault)? {
        paths.push(entry.map_err(fault)?.path());
    }
    paths.sort();
    for path in paths {
        if path.is_dir() {
            if deep && path.file_name().is_some_and(|name| name != "target") {
                collect(&path, true, files)?;
            }
        } else if path.extension().is_some_and(|extension| extension == "md") {
            files.push(path);
        }
    }
    Ok(())
}

/// The targets of inline links with the numbers of their lines; code is left out.
fn targets(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut in_code = false;
    for (number, line) in (1..).zip(text.lines()) {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        if in_code {
            continue;
        }
        let mut rest = line;
        while let Some((_, after)) = rest.split_once("](") {
            let Some((target, behind)) = after.split_once(')') else { break };
            found.push((number, target.split_whitespace().next().unwrap_or_default()));
            rest = behind;
        }
    }
    found
}

/// Why `target` leads nowhere. Links out of the project are not followed.
fn broken(file: &Path, target: &str) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = target.split_once('#').map_or((target, None), |(path, anchor)| (path, Some(anchor)));
    let linked = if path.is_empty() { file.to_owned() } else { file.parent()?.join(path) };
    if !linked.exists() {
        return Some("leads to no file".to_owned());
    }
    let anchor = anchor?;
    let is_markdown = linked.extension().is_some_and(|extension| extension == "md");
    let text = is_markdown.then(|| fs::read_to_string(&linked).ok()).flatten()?;
    let found = text.lines().filter(|line| line.starts_with('#')).any(|line| slug(line) == anchor);
    (!found).then(|| "leads to no heading".to_owned())
}

/// The anchor of a heading, as the usual hosts make it: lower case, punctuation gone, hyphens for spaces.
fn slug(heading: &str) -> String {
    let title = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = title.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_found_outside_of_code() {
        let text = "a [b](c.md) [d](e/f.rs#g)\n```\n[x](y)\n```\n[h](<i> \"title\")";
        assert_eq!(targets(text), [(1, "c.md"), (1, "e/f.rs#g"), (5, "<i>")]);
    }

    #[test]
    fn what_is_not_there_is_named() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        assert_eq!(broken(&here, "src/main.rs"), None);
        assert_eq!(broken(&here, "../README.md#the-command"), None);
        assert_eq!(broken(&here, "https://example.org/nothing"), None);
        assert!(broken(&here, "src/nothing.rs").is_some());
        assert!(broken(&here, "../README.md#nothing").is_some());
    }

    #[test]
    fn headings_have_anchors() {
        assert_eq!(slug("## Sweeps over q (Table 1)"), "sweeps-over-q-table-1");
    }
}
