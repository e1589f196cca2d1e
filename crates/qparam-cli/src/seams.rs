//! The seams that were asked for, as pairs of vertices.

use std::collections::HashSet;
use std::path::Path;

use qoptimize::qcurv::seams::creases;
use qoptimize::qmesh::{PolygonView, Seams, charts};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{Input, name_of, read_bytes};
use crate::layout_args::SeamSource;
use crate::streams::Streams;
use crate::translate::refused;

/// The union of all sources.
pub(crate) fn collect(sources: &[SeamSource], input: &Input, io: &mut Streams<'_>) -> Result<Seams, Failure> {
    let mut seams = Seams::default();
    for source in sources {
        match source {
            SeamSource::Auto | SeamSource::None => {}
            SeamSource::Uv => seams.extend(of_uvs(input)?.iter()),
            SeamSource::Group => seams.extend(of_labels(input, &["o", "g"]).iter()),
            SeamSource::Material => seams.extend(of_labels(input, &["usemtl"]).iter()),
            SeamSource::Angle(degrees) => seams.extend(of_creases(input, *degrees)?.iter()),
            SeamSource::File(path) => seams.extend(of_file(path, input, io)?),
        }
    }
    Ok(seams)
}

/// The edges whose faces have different UVs at an end.
fn of_uvs(input: &Input) -> Result<Seams, Failure> {
    let uv = input.document.corner_uv().ok_or_else(|| {
        Failure::new(Exit::Input, format!("{}: --seams uv, but not every corner has a UV", input.name))
            .help("`--seams auto` finds seams; `qparam measure` says which corners lack UVs")
    })?;
    Ok(Seams::between(input.document.view(), |a, b| (0..2).any(|end| uv[a[end]] != uv[b[end]])))
}

/// The edges between faces under different names.
fn of_labels(input: &Input, keywords: &[&str]) -> Seams {
    let labels = input.document.face_labels(keywords);
    let view = input.document.view();
    let mut of_corner = Vec::with_capacity(view.corner_count());
    for (face, &label) in labels.iter().enumerate() {
        of_corner.resize(view.corners(face).end, label);
    }
    Seams::between(view, |a, b| of_corner[a[0]] != of_corner[b[0]])
}

fn of_creases(input: &Input, degrees: f64) -> Result<Seams, Failure> {
    let cut =
        charts::cut(input.document.view(), &Seams::default()).map_err(|error| refused(&error, input))?;
    Ok(cut.charts.iter().flat_map(|chart| creases(&chart.mesh, degrees).iter().collect::<Vec<_>>()).collect())
}

/// Lines of vertex numbers, each joined with the one before it.
fn of_file(path: &Path, input: &Input, io: &mut Streams<'_>) -> Result<Vec<[u32; 2]>, Failure> {
    let name = name_of(path);
    let bytes = read_bytes(path, io.stdin).map_err(|failure| {
        failure.help("--seams takes auto, none, uv, angle:DEG, group, material, or a file of vertex numbers")
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let (view, edges) = (input.document.view(), edges(input.document.view()));
    let mut pairs = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let walk = vertices(line, view.positions.len()).and_then(|walk| along(&walk, &edges));
        pairs.extend(walk.map_err(|why| {
            Failure::new(Exit::Input, format!("{name}:{}: {why}", index + 1))
                .help("write the numbers of neighbouring vertices on a line, counted from 1")
        })?);
    }
    Ok(pairs)
}

/// The vertices of a line, from 0, of `count` that there are.
fn vertices(line: &str, count: usize) -> Result<Vec<u32>, String> {
    let line = line.split('#').next().unwrap_or_default();
    let fields = line.split([' ', '\t', ',', '\r']).filter(|field| !field.is_empty());
    fields
        .map(|field| {
            let number = field.parse::<usize>().ok().filter(|number| (1..=count).contains(number));
            let number =
                number.ok_or_else(|| format!("`{field}` is no vertex of the mesh, which has {count}"))?;
            Ok((number - 1) as u32)
        })
        .collect()
}

/// The edges from each vertex to the next; none for no vertices.
fn along(walk: &[u32], edges: &HashSet<[u32; 2]>) -> Result<Vec<[u32; 2]>, String> {
    if walk.len() == 1 {
        return Err("a seam needs two vertices at least".to_owned());
    }
    let edge = |ends: &[u32]| {
        let edge = [ends[0], ends[1]];
        let is_edge = edges.contains(&sorted(edge));
        is_edge.then_some(edge).ok_or_else(|| {
            format!("no edge of the mesh joins the vertices {} and {}", edge[0] + 1, edge[1] + 1)
        })
    };
    walk.windows(2).map(edge).collect()
}

/// The edges of all faces, the smaller vertex first.
fn edges(view: PolygonView<'_>) -> HashSet<[u32; 2]> {
    let around = |face: usize| {
        let corners = view.face(face);
        corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| sorted([a, b]))
    };
    (0..view.face_count()).flat_map(around).collect()
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
