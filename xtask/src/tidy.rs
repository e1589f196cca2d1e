//! House rules that no compiler checks.
//!
//! The chain of crates holds, every module says what it is for, files stay short, every equation of the paper is
//! cited in the crate that computes it, and links between files lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

/// Each crate names exactly its predecessor.
const CHAIN: &[&str] = &["qmesh", "qcurv", "qsimplify", "qsolve", "qembed", "qoptimize", "qparam-cli"];
/// Which equations of the paper each crate computes.
const EQUATIONS: &[(&str, std::ops::RangeInclusive<u32>)] =
    &[("qcurv", 1..=4), ("qembed", 5..=10), ("qoptimize", 11..=14)];
/// The longest file, in lines.
const LINE_LIMIT: usize = 500;

/// Runs the task on the workspace that this program was built in.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    if let Some(unknown) = arguments.first() {
        return Err(format!("`{unknown}` is unknown: tidy takes no arguments"));
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")?;
    let faults = check(root)?;
    if faults.is_empty() {
        println!("tidy: the chain of {} crates holds, and every file is in order", CHAIN.len());
        return Ok(());
    }
    Err(format!("{} to mend\n  {}", faults.len(), faults.join("\n  ")))
}

/// Everything that is wrong in the workspace at `root`.
fn check(root: &Path) -> Result<Vec<String>, String> {
    let mut faults = Vec::new();
    check_folder(&root.join("crates"), &mut faults)?;
    for (index, name) in CHAIN.iter().enumerate() {
        let folder = root.join("crates").join(name);
        let library = read(&folder.join("src/lib.rs"))?;
        let predecessor = index.checked_sub(1).map(|before| CHAIN[before]);
        faults.extend(manifest_faults(name, predecessor, &read(&folder.join("Cargo.toml"))?)?);
        faults.extend(library_faults(name, predecessor, &library));
    }
    for folder in ["crates", "xtask/src", "benches"] {
        for path in rust_files(&root.join(folder))? {
            let shown = path.strip_prefix(root).unwrap_or(&path).display().to_string();
            faults.extend(file_faults(&shown, &read(&path)?));
        }
    }
    faults.extend(crate::links::faults(root)?);
    for (name, equations) in EQUATIONS {
        let mut text = String::new();
        for path in rust_files(&root.join("crates").join(name).join("src"))? {
            text += &read(&path)?;
        }
        let cited = cited_equations(&text);
        for equation in equations.clone().filter(|equation| !cited.contains(equation)) {
            faults.push(format!(
                "crates/{name}: Eq. {equation} is cited nowhere; name it beside the code that computes it"
            ));
        }
    }
    Ok(faults)
}

/// `crates/` holds the chain and nothing else.
fn check_folder(crates: &Path, faults: &mut Vec<String>) -> Result<(), String> {
    for path in entries(crates)? {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if path.is_dir() && !CHAIN.contains(&name.as_str()) {
            faults.push(format!("crates/{name} is not in the chain {}", CHAIN.join(" → ")));
        }
    }
    Ok(())
}

/// A crate depends on its predecessor and on no other crate of the chain, in any table of its manifest.
fn manifest_faults(name: &str, predecessor: Option<&str>, text: &str) -> Result<Vec<String>, String> {
    let manifest: toml::Table =
        text.parse().map_err(|error| format!("crates/{name}/Cargo.toml is no valid TOML: {error}"))?;
    let table = |key: &str| manifest.get(key).and_then(toml::Value::as_table);
    let mut faults = Vec::new();
    let mut found = |table: &toml::Table, title: &str, allowed: Option<&str>| {
        for (key, value) in table {
            let package = value.get("package").and_then(toml::Value::as_str).unwrap_or(key);
            if CHAIN.contains(&package) && Some(package) != allowed {
                faults.push(match allowed {
                    Some(allowed) => format!(
                        "crates/{name}/Cargo.toml: [{title}] names {package}; use what {allowed} re-exports"
                    ),
                    None => format!("crates/{name}/Cargo.toml: [{title}] names {package}, but no crate of the chain may stand there"),
                });
            }
        }
    };
    for title in ["dependencies", "build-dependencies"] {
        if let Some(table) = table(title) {
            found(table, title, if title == "dependencies" { predecessor } else { None });
        }
    }
    // Tests may look back along the chain, never ahead.
    let position = CHAIN.iter().position(|known| *known == name).unwrap_or(CHAIN.len());
    for key in table("dev-dependencies").into_iter().flat_map(toml::Table::keys) {
        if CHAIN.iter().skip(position).any(|later| later == key) {
            faults.push(format!(
                "crates/{name}/Cargo.toml: [dev-dependencies] names {key}, which comes later in the chain"
            ));
        }
    }
    if let Some(before) = predecessor
        && !table("dependencies").is_some_and(|table| table.contains_key(before))
    {
        faults.push(format!("crates/{name}/Cargo.toml: [dependencies] lacks {before}, its predecessor"));
    }
    let lints = table("lints").and_then(|table| table.get("workspace")).and_then(toml::Value::as_bool);
    if lints != Some(true) {
        faults.push(format!("crates/{name}/Cargo.toml: add `[lints] workspace = true`"));
    }
    Ok(faults)
}

/// A crate re-exports its predecessor, so that users need no second dependency.
fn library_faults(name: &str, predecessor: Option<&str>, library: &str) -> Option<String> {
    let before = predecessor?.replace('-', "_");
    let exported = library.split(';').any(|item| {
        item.lines()
            .map(str::trim)
            .filter(|line| !line.starts_with("//"))
            .collect::<String>()
            .split_once("pub use")
            .is_some_and(|(_, path)| {
                let mut words =
                    path.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty());
                words.next() == Some(&before) && (path.trim() == before || path.contains("self"))
            })
    });
    (!exported).then(|| format!("crates/{name}/src/lib.rs: add `pub use {before};`"))
}

/// Every file opens with what it is for, and is short.
fn file_faults(path: &str, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let header = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    if header.strip_prefix("//!").is_none_or(|words| words.trim().is_empty()) {
        faults.push(format!("{path}:1: open with a `//!` line that says what the file is for"));
    }
    let lines = text.lines().count();
    if lines > LINE_LIMIT {
        faults.push(format!("{path}: {lines} lines, at most {LINE_LIMIT}; split it by concept"));
    }
    for (index, line) in text.lines().enumerate() {
        if let Some(folder) = ["/home/", "/Users/", "C:\\Users"].iter().find(|folder| line.contains(*folder))
            && !path.ends_with("tidy.rs")
        {
            faults.push(format!("{path}:{}: `{folder}` is a folder of one machine", index + 1));
        }
        if line.contains("TODO") && !path.ends_with("tidy.rs") {
            faults.push(format!("{path}:{}: finish what TODO announces", index + 1));
        }
    }
    faults
}

/// The equations cited as `Eq. 5`, `Eqs. 6-10`, `Eqs. 3 and 4`, `Eqs. 6, 7 and 9`.
fn cited_equations(text: &str) -> Vec<u32> {
    let mut cited = Vec::new();
    for marker in ["Eq. ", "Eqs. "] {
        for (start, _) in text.match_indices(marker) {
            cited.extend(equation_list(&text[start + marker.len()..]));
        }
    }
    cited.sort_unstable();
    cited.dedup();
    cited
}

/// Numbers joined by `-`, `–`, `,`, `and`, `or` at the start of `text`.
fn equation_list(text: &str) -> Vec<u32> {
    let mut list: Vec<u32> = Vec::new();
    let mut rest = text;
    let mut range = false;
    loop {
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        let Ok(number) = rest[..digits].parse::<u32>() else { return list };
        match list.last() {
            Some(&first) if range && first < number && number - first < 100 => {
                list.extend(first + 1..=number);
            }
            _ => list.push(number),
        }
        rest = &rest[digits..];
        const JOINTS: &[(&str, bool)] =
            &[("-", true), ("–", true), (" to ", true), (" and ", false), (" or ", false), (", ", false)];
        let Some((joint, is_range)) = JOINTS.iter().find(|(joint, _)| rest.starts_with(joint)) else {
            return list;
        };
        range = *is_range;
        rest = &rest[joint.len()..];
    }
}

fn rust_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    for path in entries(folder)? {
        if path.is_dir() && path.file_name().is_some_and(|name| name != "target") {
            files.extend(rust_files(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let list = || fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>();
    let mut paths = list().map_err(|error| format!("{}: {error}", folder.display()))?;
    paths.sort();
    Ok(paths)
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(dependencies: &str) -> String {
        format!("[dependencies]\n{dependencies}\n[lints]\nworkspace = true\n")
    }

    fn manifest_message(dependencies: &str) -> String {
        manifest_faults("qsolve", Some("qsimplify"), &manifest(dependencies)).unwrap().join("\n")
    }

    #[test]
    fn a_crate_names_its_predecessor_and_no_other() {
        assert_eq!(manifest_message("qsimplify.workspace = true\nrayon = '1'"), "");
        assert!(manifest_message("rayon = '1'").contains("lacks qsimplify"));
        let message = manifest_message("qsimplify.workspace = true\nqcurv.workspace = true");
        assert!(message.contains("names qcurv; use what qsimplify re-exports"), "{message}");
        let renamed =
            manifest_message("qsimplify.workspace = true\nmesh = { package = 'qmesh', version = '1' }");
        assert!(renamed.contains("names qmesh"), "{renamed}");
    }

    #[test]
    fn tests_look_back_never_ahead() {
        let text = |key: &str| manifest("qsimplify = '1'") + &format!("[dev-dependencies]\n{key} = '1'\n");
        let faults = |key: &str| manifest_faults("qsolve", Some("qsimplify"), &text(key)).unwrap();
        assert!(faults("qmesh").is_empty());
        assert_eq!(faults("qembed").len(), 1);
    }

    #[test]
    fn the_predecessor_is_re_exported() {
        let faults = |library: &str| library_faults("qsimplify", Some("qcurv"), library);
        assert_eq!(faults("//! Doc; text.\nuse std::fmt;\npub use qcurv::{self, qmesh};"), None);
        assert_eq!(faults("pub use qcurv;"), None);
        assert!(faults("// pub use qcurv;\nuse qcurv::qmesh;").is_some());
        assert!(faults("pub use qcurv::qmesh;").is_some());
    }

    #[test]
    fn files_have_headers_and_are_short() {
        assert!(file_faults("a.rs", "//! What it is.\nfn f() {}\n").is_empty());
        assert!(file_faults("a.rs", "fn f() {}\n")[0].contains("a.rs:1"));
        assert!(file_faults("a.rs", &("//! x\n".to_owned() + &"\n".repeat(600)))[0].contains("601 lines"));
        assert!(file_faults("a.rs", "//! x\n// see /home/me/x\n")[0].contains("a.rs:2"));
    }

    #[test]
    fn citations_are_read_as_people_write_them() {
        let cited = cited_equations("Eq. 5; Eqs. 6-8 and 10, Eqs. 1 and 2; Eqs. 11–12 (Eq. 14). seq. 99");
        assert_eq!(cited, [1, 2, 5, 6, 7, 8, 10, 11, 12, 14]);
    }
}
