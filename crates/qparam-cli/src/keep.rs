//! `--keep-uv`: the UVs of the file that stay.

use qoptimize::qmesh::Vec2;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::info::Labels;
use crate::input::Input;
use crate::table::counted;

/// For each corner the UV that it keeps, those of the faces in groups, objects and materials of these names; empty without names.
pub(crate) fn collect(names: &[String], input: &Input) -> Result<Vec<Option<Vec2>>, Failure> {
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let document = &input.document;
    let mut is_kept = vec![false; document.face_count()];
    for name in names {
        let named = document.faces_named(name.as_bytes());
        if !named.contains(&true) {
            let labels = Labels::new(document.bytes());
            let lists: Vec<String> = labels.lists().map(|(kind, list)| format!("{kind}: {list}")).collect();
            let known = if lists.is_empty() { "the file names none".to_owned() } else { lists.join("; ") };
            return Err(Failure::new(
                Exit::Input,
                format!("{}: --keep-uv: no face is in a group, object or material `{name}`", input.name),
            )
            .help(known));
        }
        is_kept.iter_mut().zip(named).for_each(|(is_kept, named)| *is_kept |= named);
    }
    let uv = document.texture_coordinates();
    let of_corner = |corner: usize| {
        let place = uv[document.corner_texture(corner)? as usize];
        place.iter().all(|x| x.is_finite()).then_some(place)
    };
    let mut kept = vec![None; document.corner_count()];
    let mut bare = Vec::new();
    for face in (0..is_kept.len()).filter(|&face| is_kept[face]) {
        for corner in document.view().corners(face) {
            kept[corner] = of_corner(corner);
            if kept[corner].is_none() && bare.last() != Some(&face) {
                bare.push(face);
            }
        }
    }
    match bare.first() {
        None => Ok(kept),
        Some(&face) => Err(Failure::new(
            Exit::Input,
            format!(
                "{}: --keep-uv: {} of the faces to keep without UVs, first face {} (line {})",
                input.name,
                counted(bare.len(), "face"),
                face + 1,
                document.face_line(face)
            ),
        )
        .help("only UVs that are there can be kept; leave these faces out of the group")),
    }
}
