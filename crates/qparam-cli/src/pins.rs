//! Pins: vertices that are to go to certain places, from the command line and from a file.

use std::io::Read;
use std::path::Path;

use qoptimize::qmesh::{QuadMesh, Vec2, VertexId};

use crate::boundary;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{Input, name_of, read_bytes};

/// A vertex of the file, from 0, and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PinArg {
    vertex: usize,
    place: Vec2,
}

/// `V=u,v`, the vertex counted from 1.
pub(crate) fn parse(text: &str) -> Result<PinArg, String> {
    let parsed = || {
        let (vertex, place) = text.split_once('=')?;
        let (u, v) = place.split_once(',')?;
        let vertex = vertex.trim().parse::<usize>().ok()?.checked_sub(1)?;
        let place = Vec2::new(u.trim().parse().ok()?, v.trim().parse().ok()?);
        place.iter().all(|x: &f64| x.is_finite()).then_some(PinArg { vertex, place })
    };
    parsed().ok_or_else(|| "expected a vertex, counted from 1, and its place, for example 17=0.25,0.5".into())
}

/// All pins, those of the command line first, in vertices of `mesh`.
pub(crate) fn read(
    arguments: &[PinArg],
    file: Option<&Path>,
    stdin: &mut dyn Read,
    mesh: &QuadMesh,
    input: &Input,
) -> Result<Vec<(VertexId, Vec2)>, Failure> {
    if arguments.is_empty() && file.is_none() {
        return Ok(Vec::new());
    }
    let count = mesh.source_vertex_count();
    let mut pins = arguments.to_vec();
    if let Some(path) = file {
        let mut given = vec![None; count];
        boundary::from_list(&name_of(path), &read_bytes(path, stdin)?, &mut given)?;
        let listed = given.into_iter().enumerate();
        pins.extend(listed.filter_map(|(vertex, place)| Some(PinArg { vertex, place: place? })));
    }
    let mut of_source = vec![None; count];
    let mut on_seam = vec![false; count];
    for vertex in mesh.vertices() {
        let source = mesh.source_vertex(vertex) as usize;
        on_seam[source] = of_source[source].replace(vertex).is_some();
    }
    let refuse = |vertex: usize, why: &str| {
        Failure::new(Exit::Input, format!("{}: vertex {} cannot be pinned: {why}", input.name, vertex + 1))
    };
    pins.into_iter()
        .map(|PinArg { vertex, place }| match of_source.get(vertex) {
            Some(Some(_)) if on_seam[vertex] => Err(refuse(vertex, "a seam runs through it")),
            Some(Some(found)) => Ok((*found, place)),
            Some(None) => Err(refuse(vertex, "no face uses it")),
            None => Err(refuse(vertex, &format!("there are only {count} vertices"))),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_are_read_as_people_write_them() {
        let pin = |vertex, u, v| Ok(PinArg { vertex, place: Vec2::new(u, v) });
        assert_eq!(parse("17=0.25,0.5"), pin(16, 0.25, 0.5));
        assert_eq!(parse("1 = -1e-3, +2"), pin(0, -1e-3, 2.0));
        for wrong in ["0=1,2", "=1,2", "3=1", "3=1,x", "3=1,nan", "-1=1,2", "3:1,2", ""] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
