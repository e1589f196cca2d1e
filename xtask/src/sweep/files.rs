//! Writing the tables, or comparing them with what is there.

use std::fs;
use std::path::Path;

use crate::section::first_difference;

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
