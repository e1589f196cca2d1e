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

/// The one line that says what went wrong: a Python traceback ends with it, other tools begin with it.
pub(super) fn complaint(stderr: &str) -> Option<String> {
    let mut lines = stderr.lines().map(str::trim).filter(|line| !line.is_empty());
    let line = if stderr.contains("Traceback (most recent call last)") {
        // Chained lines may follow, such as Blender's own epilogue; the exception is the last one not indented.
        let start = stderr.find("Traceback").unwrap_or(0);
        stderr[start..].lines().skip(1).find(|line| !line.starts_with(' ') && !line.trim().is_empty())
    } else {
        lines
            .find(|line| line.to_lowercase().contains("error"))
            .or_else(|| stderr.lines().map(str::trim).find(|line| !line.is_empty()))
    };
    line.map(|line| line.trim().to_owned())
}
