//! `qparam measure`: the measures of UVs that files already have.

use qoptimize::{Distortion, measure};
use serde::Serialize;

use crate::args::MeasureArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::json_text;
use crate::report::{Head, distortion_table, is_valid, verdict};
use crate::streams::Streams;

#[derive(Serialize)]
struct Report {
    #[serde(flatten)]
    head: Head,
    files: Vec<FileReport>,
}

#[derive(Serialize)]
struct FileReport {
    file: String,
    valid: bool,
    distortion: Distortion,
}

pub(crate) fn run(arguments: &MeasureArgs, io: &mut Streams<'_>) -> Result<Exit, Failure> {
    if arguments.files.iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        return Err(Failure::new(Exit::Usage, "standard input cannot be read twice").help("name `-` once"));
    }
    let mut files = Vec::new();
    for path in &arguments.files {
        files.push(measured(Input::read(path, io.stdin)?)?);
    }
    let valid = files.iter().all(|file| file.valid);
    let text = if arguments.json {
        json_text(&Report { head: Head::new("measure"), files })
    } else {
        let columns: Vec<_> =
            short_names(&files).into_iter().zip(files.iter().map(|f| &f.distortion)).collect();
        let mut text = distortion_table(&columns).render(io.stdout_color) + "\n";
        for file in &files {
            text += &format!("{}: {}\n", file.file, verdict(&file.distortion));
        }
        text
    };
    io.say(&text)?;
    Ok(if arguments.check && !valid { Exit::Invalid } else { Exit::Done })
}

fn measured(input: Input) -> Result<FileReport, Failure> {
    let uv = input.document.corner_uv().ok_or_else(|| {
        let corners = input.document.corner_count();
        let missing = corners - input.document.corners_with_uv();
        Failure::new(Exit::Input, format!("{}: {missing} of {corners} corners have no UV", input.name))
            .help("every corner needs a texture index (`f 1/1 2/2 …`); `qparam unwrap` computes UVs")
    })?;
    let distortion = measure(input.document.view(), &uv).map_err(|error| {
        Failure::new(Exit::Input, format!("{}: the UVs cannot be measured", input.name)).cause(&error)
    })?;
    Ok(FileReport { valid: is_valid(&distortion), file: input.name, distortion })
}

/// File names without their folders where that leaves them different.
fn short_names(files: &[FileReport]) -> Vec<String> {
    let short = |file: &FileReport| file.file.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
    let names: Vec<_> = files.iter().map(short).collect();
    let mut sorted = names.clone();
    sorted.sort_unstable();
    sorted.dedup();
    if sorted.len() == names.len() { names } else { files.iter().map(|file| file.file.clone()).collect() }
}
