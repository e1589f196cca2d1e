//! What the parts of a text say, put together.

use super::lines::LineRuns;
use super::parse::{Index, NONE};
use super::reader::Part;

/// Joins parts in their order; nothing when they say something wrong together: too many elements, or corners that name
/// what there is not.
pub(super) fn join(parts: Vec<Part>, limit: usize) -> Option<Index> {
    let starts = starts(&parts);
    let total = *starts.last()?;
    let named = |of: fn(&Part) -> usize| parts.iter().map(of).max().unwrap_or(0);
    if total.vertices.max(total.textures).max(total.corners) > limit
        || named(|part| part.vertices_named) > total.vertices
        || named(|part| part.textures_named) > total.textures
    {
        return None;
    }
    let mut lines = [LineRuns::default(), LineRuns::default()];
    for (part, start) in parts.iter().zip(&starts) {
        lines[0].append(&part.index.vertex_lines, start.vertices as u32, start.lines as u64);
        lines[1].append(&part.index.face_lines, start.faces as u32, start.lines as u64);
    }
    let [vertex_lines, face_lines] = lines;
    let has_textures = parts.iter().any(|part| !part.index.corner_texture.is_empty());
    // Each array by itself: what one of them needs is freed before the next grows.
    let mut parts = parts;
    let corner_texture = if has_textures { corner_textures(&mut parts, &starts)? } else { Vec::new() };
    let corner_vertex = corner_vertices(&mut parts, &starts)?;
    let mut index = Index { vertex_lines, face_lines, corner_vertex, corner_texture, ..Index::default() };
    index.positions = concatenated(total.vertices, &mut parts, |index| &mut index.positions);
    index.texture_coordinates =
        concatenated(total.textures, &mut parts, |index| &mut index.texture_coordinates);
    index.face_start = Vec::with_capacity(total.faces + 1);
    index.face_start.push(0);
    for (part, start) in parts.iter().zip(&starts) {
        index.face_start.extend(part.index.face_start[1..].iter().map(|&end| end + start.corners as u32));
    }
    Some(index)
}

/// How much came before a part.
#[derive(Clone, Copy, Default)]
struct Start {
    vertices: usize,
    textures: usize,
    faces: usize,
    corners: usize,
    lines: usize,
}

/// Of each part, and of what would follow.
fn starts(parts: &[Part]) -> Vec<Start> {
    let mut start = Start::default();
    let mut starts = vec![start];
    for part in parts {
        start.vertices += part.index.positions.len();
        start.textures += part.index.texture_coordinates.len();
        start.faces += part.index.face_start.len() - 1;
        start.corners += part.index.corner_vertex.len();
        start.lines += part.lines;
        starts.push(start);
    }
    starts
}

fn concatenated<T: Copy>(total: usize, parts: &mut [Part], array: fn(&mut Index) -> &mut Vec<T>) -> Vec<T> {
    let mut all = Vec::with_capacity(total);
    for part in parts {
        all.append(&mut std::mem::take(array(&mut part.index)));
    }
    all
}

fn corner_vertices(parts: &mut [Part], starts: &[Start]) -> Option<Vec<u32>> {
    for (part, start) in parts.iter_mut().zip(starts) {
        resolve(&part.backward_vertices, &mut part.index.corner_vertex, start.vertices)?;
    }
    let total = starts[parts.len()].corners;
    Some(concatenated(total, parts, |index| &mut index.corner_vertex))
}

fn corner_textures(parts: &mut [Part], starts: &[Start]) -> Option<Vec<u32>> {
    for (part, start) in parts.iter_mut().zip(starts) {
        part.index.corner_texture.resize(part.index.corner_vertex.len(), NONE);
        resolve(&part.backward_textures, &mut part.index.corner_texture, start.textures)?;
    }
    let total = starts[parts.len()].corners;
    Some(concatenated(total, parts, |index| &mut index.corner_texture))
}

/// Turns what counts from the start of a part into what counts from the start of the text.
fn resolve(backward: &[u32], elements: &mut [u32], before: usize) -> Option<()> {
    for &corner in backward {
        let element = &mut elements[corner as usize];
        *element = u32::try_from(before as i64 + i64::from(*element as i32)).ok()?;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::obj::chunks::chunks;
    use crate::obj::chunks::tests::texts;
    use crate::obj::parse::{read, read_parts};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// A text says the same in parts as in one piece, and what is wrong with it is said in the same words.
        #[test]
        fn parts_say_what_the_whole_says(text in texts(), size in 0usize..120, limit in 20usize..400) {
            let whole = read(&text, usize::MAX, limit).map_err(|error| error.to_string());
            let parts = read_parts(&text, size, limit);
            prop_assert_eq!(parts.is_some(), whole.is_ok() && chunks(&text, size).len() > 1);
            // As text, for NaN is no equal of itself.
            if let Some(parts) = parts {
                prop_assert_eq!(format!("{parts:?}"), format!("{:?}", whole.as_ref().expect("a good text")));
            }
            let read = read(&text, size, limit).map_err(|error| error.to_string());
            prop_assert_eq!(format!("{read:?}"), format!("{whole:?}"));
        }
    }
}
