//! tidy.

/// Runs the task.
pub(crate) fn run(_arguments: &[String]) -> Result<(), String> {
    Ok(())
}
