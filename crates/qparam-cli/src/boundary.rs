//! Positions for a fixed boundary: from an OBJ with UVs, or from a list `vertex u v`.

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use qoptimize::qmesh::obj::ObjDocument;
use qoptimize::qmesh::{QuadMesh, Vec2, VertexId};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{Input, name_of, read_bytes, unparsed};

/// One position for each vertex of the outer boundary of `mesh`, in the order of the vertices.
pub(crate) fn read(
    path: &Path,
    stdin: &mut dyn Read,
    mesh: &QuadMesh,
    input: &Input,
) -> Result<Vec<(VertexId, Vec2)>, Failure> {
    let name = name_of(path);
    let bytes = read_bytes(path, stdin)?;
    let mut given = vec![None; mesh.source_vertex_count()];
    if is_obj(&bytes) {
        from_obj(&name, bytes, &mut given)?;
    } else {
        from_list(&name, &bytes, &mut given)?;
    }
    // Of the outer boundary: the rims of holes are free.
    let mut loops = mesh.boundary_loops();
    mesh.outer_first(&mut loops);
    let mut boundary = loops.first().map(|outer| mesh.loop_vertices(outer)).unwrap_or_default();
    boundary.sort_unstable();
    boundary
        .into_iter()
        .map(|vertex| {
            let source = mesh.source_vertex(vertex);
            given[source as usize].map(|uv| (vertex, uv)).ok_or_else(|| {
                let line = input.document.vertex_line(source as usize);
                let place = format!("vertex {} ({}:{line})", source + 1, input.name);
                Failure::new(Exit::Input, format!("{name}: no position for {place}"))
                    .help("every vertex on the outer boundary needs one; `qparam info` counts them")
            })
        })
        .collect()
}

/// Lists start lines with numbers, OBJ files with keywords.
fn is_obj(bytes: &[u8]) -> bool {
    bytes
        .split(|&byte| byte == b'\n')
        .map(<[u8]>::trim_ascii)
        .any(|line| line.starts_with(b"v ") || line.starts_with(b"v\t") || line.starts_with(b"f "))
}

fn from_obj(name: &str, bytes: Vec<u8>, given: &mut [Option<Vec2>]) -> Result<(), Failure> {
    let document = ObjDocument::parse(bytes).map_err(|error| unparsed(name, &error))?;
    let refuse = |why: String| Failure::new(Exit::Input, format!("{name}: {why}"));
    let uvs = document.corner_uv().ok_or_else(|| {
        refuse("has no UVs on every face".into()).help("name an OBJ whose `f` lines have texture indices")
    })?;
    let view = document.view();
    if view.positions.len() != given.len() {
        return Err(refuse(format!(
            "has {} vertices, the mesh has {}: it is not the same mesh",
            view.positions.len(),
            given.len()
        )));
    }
    for (&vertex, &uv) in view.corner_vertex.iter().zip(&uvs) {
        let slot = &mut given[vertex as usize];
        if slot.is_some_and(|known| known != uv) {
            return Err(refuse(format!("vertex {} has several UVs: a seam runs through it", vertex + 1))
                .help("a fixed boundary needs one position for each vertex"));
        }
        *slot = Some(uv);
    }
    Ok(())
}

pub(crate) fn from_list(name: &str, bytes: &[u8], given: &mut [Option<Vec2>]) -> Result<(), Failure> {
    let text = String::from_utf8_lossy(bytes);
    // Where each vertex stands, from 1.
    let mut lines: HashMap<usize, usize> = HashMap::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let refuse = |why: String| {
            Err(Failure::new(Exit::Input, format!("{name}:{}: {why}", index + 1))
                .help("write one `vertex u v` a line, vertices counted from 1"))
        };
        let fields: Vec<&str> =
            line.split([' ', '\t', ',', '\r']).filter(|field| !field.is_empty()).collect();
        let [vertex, u, v] = fields[..] else {
            if fields.is_empty() {
                continue;
            }
            return refuse(format!("expected three values, found {}", fields.len()));
        };
        let number = vertex.parse::<usize>().ok().filter(|number| (1..=given.len()).contains(number));
        let Some(number) = number else {
            return refuse(format!("`{vertex}` is no vertex of the mesh, which has {}", given.len()));
        };
        if let Some(before) = lines.insert(number, index + 1) {
            return refuse(format!("vertex {number} has a position already, from line {before}"));
        }
        match (u.parse::<f64>(), v.parse::<f64>()) {
            (Ok(u), Ok(v)) if u.is_finite() && v.is_finite() => given[number - 1] = Some(Vec2::new(u, v)),
            _ => return refuse(format!("`{u} {v}` is no position")),
        }
    }
    Ok(())
}
