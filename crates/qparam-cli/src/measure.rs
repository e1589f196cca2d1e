//! `qparam measure`: the measures of UVs that files already have.

use qoptimize::qmesh::Vec2;
use qoptimize::{Certificate, Distortion, judge, measure};
use serde::Serialize;

use crate::args::MeasureArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::json_text;
use crate::orientation::{self, Judged};
use crate::report::{Head, LISTED, distortion_table};
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
    /// Faces that run against the orientation around them, and were turned over before measuring. Indices count from 0.
    turned_faces: Vec<u32>,
    certificate: Certificate,
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
            text += &format!("{}: certificate {}\n", file.file, file.certificate);
            if let Some(note) = orientation::note(&file.turned_faces) {
                text += &format!("  {note}\n");
            }
        }
        text
    };
    io.say(&text)?;
    Ok(if arguments.check && !valid { Exit::Invalid } else { Exit::Done })
}

fn measured(input: Input) -> Result<FileReport, Failure> {
    let uv = uv_of(&input)?;
    let unmeasured = |error| {
        Failure::new(Exit::Input, format!("{}: the UVs cannot be measured", input.name)).cause(&error)
    };
    let (distortion, certificate) = judge(input.document.view(), &uv, LISTED).map_err(unmeasured)?;
    if certificate.holds {
        let turned_faces = Vec::new();
        return Ok(FileReport { valid: true, turned_faces, certificate, file: input.name, distortion });
    }
    let (judged, certificate) = Judged::certify(input.document.view(), &uv, LISTED).map_err(unmeasured)?;
    let distortion = measure(judged.view(), judged.uv()).map_err(unmeasured)?;
    let turned_faces = judged.turned_faces();
    Ok(FileReport { valid: certificate.holds, turned_faces, certificate, file: input.name, distortion })
}

/// The UV of every corner; refused when any lacks one.
pub(crate) fn uv_of(input: &Input) -> Result<Vec<Vec2>, Failure> {
    input.document.corner_uv().ok_or_else(|| without_uv(input))
}

/// Corners that name no `vt`, or else such that name one which is no place in the plane.
pub(crate) fn without_uv(input: &Input) -> Failure {
    let document = &input.document;
    let count = document.corner_count();
    let place = |corner: usize| {
        let face = document.view().face_start.partition_point(|&start| start as usize <= corner) - 1;
        format!("face {} (line {})", face + 1, document.face_line(face))
    };
    let is_missing = |&corner: &usize| document.corner_texture(corner).is_none();
    let fail = |text: String, help: &str| {
        Failure::new(Exit::Input, format!("{}: {text}", input.name)).help(help.to_owned())
    };
    if let Some(first) = (0..count).find(is_missing) {
        let missing = (first..count).filter(is_missing).count();
        return fail(
            format!("{missing} of {count} corners have no UV, the first in {}", place(first)),
            "every corner needs a texture index (`f 1/1 2/2 …`); `qparam unwrap` computes UVs",
        );
    }
    let uvs = document.texture_coordinates();
    let is_nowhere = |&corner: &usize| {
        let texture = document.corner_texture(corner);
        texture.is_some_and(|texture| uvs[texture as usize].iter().any(|x| !x.is_finite()))
    };
    let broken = (0..count).filter(is_nowhere).count();
    let first = (0..count)
        .find(is_nowhere)
        .map_or_else(String::new, |corner| format!(", the first in {}", place(corner)));
    fail(
        format!("{broken} of {count} corners have a UV that is not finite, or beyond 1e60{first}"),
        "repair those `vt` lines; `qparam unwrap` computes new UVs",
    )
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
