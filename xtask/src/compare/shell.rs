//! Running commands and reading what they say.

use std::process::Command;

/// Standard output of a command that has to succeed; else what it complained about.
pub(super) fn output(command: &mut Command) -> Result<String, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{program}: {error}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(complaint(&String::from_utf8_lossy(&output.stderr))
        .unwrap_or_else(|| format!("{program}: {}", output.status)))
}

/// The one line that says what went wrong: where tools put it, or else the first.
pub(super) fn complaint(stderr: &str) -> Option<String> {
    let lines: Vec<&str> = stderr.lines().filter(|line| !line.trim().is_empty()).collect();
    let after = |mark: &str| lines.iter().position(|line| line.contains(mark)).map(|at| &lines[at + 1..]);
    // A Python traceback ends with its message, the first line that is not indented; a Rust panic begins with the place.
    let traceback = after("Traceback (most recent call last)");
    let exception = traceback.and_then(|rest| rest.iter().find(|line| !line.starts_with(' ')));
    let panic = || after("' panicked at ").or(after(") panicked at ")).and_then(<[&str]>::first);
    let named = || lines.iter().find(|line| line.to_lowercase().contains("error"));
    let line = exception.or_else(panic).or_else(named).or(lines.first())?;
    Some(line.trim().to_owned())
}
