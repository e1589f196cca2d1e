//! Arguments of a task that has several.

use clap::Parser;

/// Runs `task` with its arguments; prints the help text where that is asked for.
pub(crate) fn parsed<A: Parser>(
    name: &str,
    arguments: &[String],
    task: impl Fn(&A) -> Result<(), String>,
) -> Result<(), String> {
    match A::try_parse_from(std::iter::once(name).chain(arguments.iter().map(String::as_str))) {
        Ok(arguments) => task(&arguments),
        Err(error) if error.use_stderr() => Err(error.to_string()),
        Err(help) => {
            print!("{help}");
            Ok(())
        }
    }
}
