//! The part of a text file that a task writes, between two marks that name the task.

use std::fs;
use std::path::Path;

/// The marks of a task.
struct Marks {
    start: String,
    end: String,
}

impl Marks {
    fn of(task: &str) -> Self {
        Self {
            start: format!("<!-- {task}: written by `cargo xtask {task}` -->\n"),
            end: format!("<!-- end of {task} -->\n"),
        }
    }

    /// Before, between and after the marks.
    fn sections<'a>(&self, whole: &'a str) -> Option<(&'a str, &'a str, &'a str)> {
        let (before, rest) = whole.split_once(&self.start)?;
        let (between, after) = rest.split_once(&self.end)?;
        Some((before, between, after))
    }

    fn missing(&self, path: &Path) -> String {
        format!(
            "{}: the lines `{}` and `{}` are missing",
            path.display(),
            self.start.trim_end(),
            self.end.trim_end()
        )
    }
}

/// Puts `text` between the marks of `task`.
pub(crate) fn write(path: &Path, task: &str, text: &str) -> Result<(), String> {
    let whole = read(path)?;
    let marks = Marks::of(task);
    let (before, _, after) = marks.sections(&whole).ok_or_else(|| marks.missing(path))?;
    fs::write(path, format!("{before}{}{text}{}{after}", marks.start, marks.end))
        .map_err(|error| format!("{}: {error}", path.display()))
}

/// Compares what stands between the marks of `task` with what it would write.
pub(crate) fn compare(path: &Path, task: &str, expected: &str) -> Result<(), String> {
    let whole = read(path)?;
    let marks = Marks::of(task);
    let (_, found, _) = marks.sections(&whole).ok_or_else(|| marks.missing(path))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    first_difference(found, expected).map_or(Ok(()), |difference| {
        Err(format!("{name}, section of `{task}`, {difference}\n`cargo xtask {task}` writes the tables anew"))
    })
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The first line that differs, in words.
pub(crate) fn first_difference(found: &str, expected: &str) -> Option<String> {
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
    fn only_what_is_between_the_marks_changes() {
        let marks = Marks::of("sweep");
        let whole = format!("head\n{}old\n{}tail\n", marks.start, marks.end);
        assert_eq!(marks.sections(&whole), Some(("head\n", "old\n", "tail\n")));
        assert_eq!(marks.sections("no marks"), None);
        assert_eq!(Marks::of("compare").sections(&whole), None);
    }
}
