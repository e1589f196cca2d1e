//! `qparam check`: the proof that the UVs of a file overlap nowhere, or where they do.

use std::collections::HashMap;

use qoptimize::certificate::Place;
use qoptimize::{Certificate, Violation, ViolationKind};
use serde::Serialize;

use crate::args::CheckArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::json_text;
use crate::measure::uv_of;
use crate::orientation::{self, Judged};
use crate::report::Head;
use crate::streams::Streams;
use crate::table::counted;

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
    /// Faces that run against the orientation around them, and were turned over before the check. Indices count from 0.
    turned_faces: Vec<u32>,
    /// Indices count from 0.
    certificate: Certificate,
    /// One for each violation listed, in words, in the numbers of the file.
    messages: Vec<String>,
}

pub(crate) fn run(arguments: &CheckArgs, io: &mut Streams<'_>) -> Result<Exit, Failure> {
    if arguments.files.iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        return Err(Failure::new(Exit::Usage, "standard input cannot be read twice").help("name `-` once"));
    }
    let mut files = Vec::new();
    for path in &arguments.files {
        files.push(checked(&Input::read(path, io.stdin)?, arguments.limit)?);
    }
    let valid = files.iter().all(|file| file.valid);
    let text = if arguments.json {
        json_text(&Report { head: Head::new("check"), files })
    } else {
        files.iter().map(FileReport::text).collect()
    };
    io.say(&text)?;
    Ok(if valid { Exit::Done } else { Exit::Invalid })
}

fn checked(input: &Input, limit: usize) -> Result<FileReport, Failure> {
    let uv = uv_of(input)?;
    let (judged, certificate) = Judged::certify(input.document.view(), &uv, limit).map_err(|error| {
        Failure::new(Exit::Input, format!("{}: the UVs cannot be checked", input.name)).cause(&error)
    })?;
    let turned_faces = judged.turned_faces();
    let lines = Lines::of(input, &certificate);
    let messages = certificate.violations.iter().map(|violation| lines.describe(violation)).collect();
    Ok(FileReport { file: input.name.clone(), valid: certificate.holds, turned_faces, certificate, messages })
}

impl FileReport {
    /// The verdict, then the violations by kind; of what is not listed, how many there are.
    fn text(&self) -> String {
        let found = &self.certificate;
        let mut text = format!("{}: certificate {found}\n", self.file);
        if let Some(note) = orientation::note(&self.turned_faces) {
            text += &format!("  {note}\n");
        }
        if found.holds {
            text += &format!(
                "  {} on {} with {}",
                counted(found.faces, "face"),
                counted(found.islands, "island"),
                counted(found.boundary_loops, "boundary loop")
            );
            if !found.exempt_faces.is_empty() {
                text += &format!(
                    "; {} that cannot be convex in any map hold by one diagonal",
                    counted(found.exempt_faces.len(), "quad")
                );
            }
            text += "\n";
        }
        for (&kind, &count) in &found.counts {
            let of_kind = found.violations.iter().zip(&self.messages).filter(|(v, _)| v.kind == kind);
            let messages: Vec<&String> = of_kind.map(|(_, message)| message).collect();
            for message in &messages {
                text += &format!("  {message}\n");
            }
            if count > messages.len() {
                text += &format!("  {}\n", unlisted(kind, count - messages.len()));
            }
        }
        text
    }
}

fn unlisted(kind: ViolationKind, count: usize) -> String {
    let [one, many] = kind.name();
    format!("and {count} more {} (--limit names more)", if count == 1 { one } else { many })
}

/// Where faces and vertices stand in the file.
struct Lines<'a> {
    input: &'a Input,
    /// Looking a line up is a search: each face is looked up once.
    of_face: HashMap<usize, usize>,
}

impl<'a> Lines<'a> {
    fn of(input: &'a Input, certificate: &Certificate) -> Self {
        let places = certificate.violations.iter().flat_map(|violation| &violation.places);
        let of_face = places.map(|place| (place.face, input.document.face_line(place.face))).collect();
        Self { input, of_face }
    }

    fn describe(&self, violation: &Violation) -> String {
        violation.describe(1, |place| self.name(place))
    }

    /// In the numbers of the file, from 1.
    fn name(&self, place: &Place) -> String {
        let line = self.of_face.get(&place.face).copied();
        let line = line.unwrap_or_else(|| self.input.document.face_line(place.face));
        let face = format!("face {} (line {line})", place.face + 1);
        let vertex = u64::from(place.vertex) + 1;
        let [u, v] = place.uv;
        match (place.to_vertex, place.to_uv) {
            (Some(to), Some([s, t])) => {
                format!("{face}, edge {vertex}-{} from ({u}, {v}) to ({s}, {t})", u64::from(to) + 1)
            }
            _ => format!("{face}, vertex {vertex} at ({u}, {v})"),
        }
    }
}
