//! From polygons to a mesh, or a refusal that names the elements.
//!
//! Twins are found without hashing: all halfedges between two vertices leave one of the two, so it is enough to
//! look through the shorter of their lists. Even adversarial poles keep that at `O(E^1.5)`.

use crate::data::ElementData;
use crate::error::BuildError;
use crate::ids::{CornerId, EdgeId, FaceId, HalfedgeId, VertexId};
use crate::mesh::QuadMesh;
use crate::polygons::{PolygonView, Polygons};
use crate::{COORDINATE_LIMIT, Vec3};

const NONE: u32 = u32::MAX;

impl QuadMesh {
    /// Builds a mesh from polygons, in their order. Vertices that no face uses are left out
    /// ([`source_vertex`](Self::source_vertex) leads back); nothing else is changed or repaired.
    ///
    /// # Errors
    /// [`BuildError`] when the polygons are no oriented manifold, with the elements that say so.
    pub fn build(polygons: Polygons) -> Result<Self, BuildError> {
        check_polygons(polygons.view())?;
        let source_vertex_count = polygons.positions.len();
        let Polygons { positions, face_start, mut corner_vertex } = polygons;
        let (positions, source_vertex) = drop_unused_vertices(positions, &mut corner_vertex);
        let source = |vertex: u32| source_vertex.as_ref().map_or(vertex, |map| map[vertex as usize]);

        let corner_face = corner_faces(&face_start, corner_vertex.len());
        let fans = Outgoing::new(positions.len(), &corner_vertex);
        let links =
            Links { face_start: &face_start, corner_vertex: &corner_vertex, corner_face: &corner_face };
        let twin = links.twins(&fans).map_err(|error| error.with_vertices(&source))?;
        let vertex_halfedge =
            links.vertex_halfedges(&fans, &twin).map_err(|error| error.with_vertices(&source))?;
        let edges = Edges::new(&links, twin, &vertex_halfedge);
        Ok(Self {
            positions: ElementData::from_vec(positions),
            face_start,
            corner_vertex,
            corner_face,
            twin: edges.twin,
            halfedge_edge: edges.halfedge_edge,
            edge_halfedge: edges.edge_halfedge,
            boundary_next: edges.boundary_next,
            vertex_halfedge,
            source_vertex,
            source_vertex_count,
        })
    }

    /// Builds a mesh from slices: positions, and faces as lists of vertex indices from 0.
    ///
    /// ```
    /// let mesh = qmesh::QuadMesh::from_slices(
    ///     &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ///     [[0, 1, 2, 3]],
    /// )?;
    /// assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (4, 4, 1));
    /// # Ok::<(), qmesh::BuildError>(())
    /// ```
    ///
    /// # Errors
    /// As [`QuadMesh::build`].
    pub fn from_slices<F: AsRef<[u32]>>(
        positions: &[[f64; 3]],
        faces: impl IntoIterator<Item = F>,
    ) -> Result<Self, BuildError> {
        Self::build(Polygons::new(positions, faces))
    }
}

fn check_polygons(polygons: PolygonView<'_>) -> Result<(), BuildError> {
    check_sizes(polygons)?;
    let count = polygons.positions.len();
    let mut sorted = Vec::new();
    for face in 0..polygons.face_count() {
        let vertices = polygons.face(face);
        let face = face as u32;
        if vertices.len() < 3 {
            return Err(BuildError::TooFewCorners { face, corners: vertices.len() });
        }
        if let Some(&vertex) = vertices.iter().find(|&&v| v as usize >= count) {
            return Err(BuildError::IndexOutOfRange { face, vertex, count });
        }
        if let Some(vertex) = repeated(vertices, &mut sorted) {
            return Err(BuildError::RepeatedVertex { face, vertex });
        }
    }
    let beyond = |p: &Vec3| !p.iter().all(|x| x.abs() <= COORDINATE_LIMIT);
    match polygons.positions.iter().position(beyond) {
        Some(vertex) => Err(BuildError::NonFiniteCoordinate { vertex: vertex as u32 }),
        None => Ok(()),
    }
}

fn check_sizes(polygons: PolygonView<'_>) -> Result<(), BuildError> {
    let limit = (u32::MAX / 2) as usize;
    for (what, count) in [("corners", polygons.corner_count()), ("vertices", polygons.positions.len())] {
        if count > limit {
            return Err(BuildError::TooLarge { what, count });
        }
    }
    if polygons.face_count() == 0 {
        return Err(BuildError::NoFaces);
    }
    let starts = polygons.face_start;
    if starts[0] != 0 {
        return Err(BuildError::BadFaceStart { entry: 0 });
    }
    if let Some(before) = starts.windows(2).position(|pair| pair[0] > pair[1]) {
        return Err(BuildError::BadFaceStart { entry: before + 1 });
    }
    if starts[starts.len() - 1] as usize != polygons.corner_count() {
        return Err(BuildError::BadFaceStart { entry: starts.len() - 1 });
    }
    Ok(())
}

fn repeated(vertices: &[u32], sorted: &mut Vec<u32>) -> Option<u32> {
    if vertices.len() <= 8 {
        return (1..vertices.len()).find(|&i| vertices[..i].contains(&vertices[i])).map(|i| vertices[i]);
    }
    sorted.clear();
    sorted.extend_from_slice(vertices);
    sorted.sort_unstable();
    sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

/// Renumbers the corners to the vertices in use and returns their positions, with the way back if any was dropped.
fn drop_unused_vertices(positions: Vec<Vec3>, corner_vertex: &mut [u32]) -> (Vec<Vec3>, Option<Vec<u32>>) {
    let mut used = vec![false; positions.len()];
    for &vertex in corner_vertex.iter() {
        used[vertex as usize] = true;
    }
    if used.iter().all(|&used| used) {
        return (positions, None);
    }
    let mut renumbered = vec![NONE; positions.len()];
    let mut source = Vec::new();
    for (old, _) in used.iter().enumerate().filter(|(_, used)| **used) {
        renumbered[old] = source.len() as u32;
        source.push(old as u32);
    }
    for vertex in corner_vertex.iter_mut() {
        *vertex = renumbered[*vertex as usize];
    }
    (source.iter().map(|&old| positions[old as usize]).collect(), Some(source))
}

fn corner_faces(face_start: &[u32], corner_count: usize) -> Vec<FaceId> {
    let mut faces = Vec::with_capacity(corner_count);
    for (face, pair) in face_start.windows(2).enumerate() {
        faces.resize(pair[1] as usize, FaceId(face as u32));
    }
    faces
}

/// The halfedges that leave each vertex, in the order of their indices.
struct Outgoing {
    start: Vec<u32>,
    halfedges: Vec<u32>,
}

impl Outgoing {
    fn new(vertex_count: usize, corner_vertex: &[u32]) -> Self {
        let mut start = vec![0u32; vertex_count + 1];
        for &vertex in corner_vertex {
            start[vertex as usize + 1] += 1;
        }
        for i in 0..vertex_count {
            start[i + 1] += start[i];
        }
        let mut cursor = start.clone();
        let mut halfedges = vec![0u32; corner_vertex.len()];
        for (corner, &vertex) in corner_vertex.iter().enumerate() {
            let place = &mut cursor[vertex as usize];
            halfedges[*place as usize] = corner as u32;
            *place += 1;
        }
        Self { start, halfedges }
    }

    fn of(&self, vertex: u32) -> &[u32] {
        &self.halfedges[self.start[vertex as usize] as usize..self.start[vertex as usize + 1] as usize]
    }
}

/// What is known of the connectivity before twins are.
struct Links<'a> {
    face_start: &'a [u32],
    corner_vertex: &'a [u32],
    corner_face: &'a [FaceId],
}

impl Links<'_> {
    fn next(&self, halfedge: u32) -> u32 {
        let face = self.corner_face[halfedge as usize].index();
        if halfedge + 1 == self.face_start[face + 1] { self.face_start[face] } else { halfedge + 1 }
    }

    fn previous(&self, halfedge: u32) -> u32 {
        let face = self.corner_face[halfedge as usize].index();
        if halfedge == self.face_start[face] { self.face_start[face + 1] - 1 } else { halfedge - 1 }
    }

    fn ends(&self, halfedge: u32) -> [u32; 2] {
        [self.corner_vertex[halfedge as usize], self.corner_vertex[self.next(halfedge) as usize]]
    }

    /// All halfedges between the ends of `halfedge`: how many run its way, how many the other, and one of those.
    fn between(&self, halfedge: u32, fans: &Outgoing) -> (u32, u32, u32) {
        let [origin, target] = self.ends(halfedge);
        // Every halfedge between the two either leaves the vertex at hand or arrives there.
        let at_origin = fans.of(origin).len() <= fans.of(target).len();
        let (here, there) = if at_origin { (origin, target) } else { (target, origin) };
        let (mut leaving, mut arriving) = ((0, NONE), (0, NONE));
        for &candidate in fans.of(here) {
            if self.corner_vertex[self.next(candidate) as usize] == there {
                leaving = (leaving.0 + 1, candidate);
            }
            let before = self.previous(candidate);
            if self.corner_vertex[before as usize] == there {
                arriving = (arriving.0 + 1, before);
            }
        }
        if at_origin { (leaving.0, arriving.0, arriving.1) } else { (arriving.0, leaving.0, leaving.1) }
    }

    /// The twin of every halfedge, `NONE` at the boundary.
    fn twins(&self, fans: &Outgoing) -> Result<Vec<u32>, BuildError> {
        let mut twin = vec![NONE; self.corner_vertex.len()];
        for halfedge in 0..self.corner_vertex.len() as u32 {
            if twin[halfedge as usize] != NONE {
                continue;
            }
            match self.between(halfedge, fans) {
                (1, 0, _) => {}
                (1, 1, other) => {
                    twin[halfedge as usize] = other;
                    twin[other as usize] = halfedge;
                }
                _ => return Err(self.bad_edge(halfedge, fans)),
            }
        }
        Ok(twin)
    }

    fn bad_edge(&self, halfedge: u32, fans: &Outgoing) -> BuildError {
        let [origin, target] = self.ends(halfedge);
        let leaving = |from: u32, to: u32| {
            fans.of(from)
                .iter()
                .filter(move |&&h| self.ends(h)[1] == to)
                .map(|&h| self.corner_face[h as usize].0)
        };
        let mut faces: Vec<u32> = leaving(origin, target).chain(leaving(target, origin)).collect();
        faces.sort_unstable();
        match faces[..] {
            [a, b] => BuildError::InconsistentOrientation { vertices: [origin, target], faces: [a, b] },
            _ => BuildError::NonManifoldEdge { vertices: [origin, target], faces },
        }
    }

    /// A halfedge out of each vertex, from which turning counter-clockwise reaches all others.
    fn vertex_halfedges(&self, fans: &Outgoing, twin: &[u32]) -> Result<Vec<HalfedgeId>, BuildError> {
        let mut firsts = Vec::with_capacity(fans.start.len() - 1);
        let mut seen = Vec::new();
        for vertex in 0..fans.start.len() as u32 - 1 {
            let fan = fans.of(vertex);
            let first = fan.iter().copied().find(|&h| twin[h as usize] == NONE).unwrap_or(fan[0]);
            seen.clear();
            let mut current = first;
            loop {
                seen.push(current);
                current = twin[self.previous(current) as usize];
                if current == NONE || current == first {
                    break;
                }
            }
            if seen.len() < fan.len() {
                seen.sort_unstable();
                let missed = fan.iter().find(|h| seen.binary_search(h).is_err()).unwrap_or(&fan[0]);
                let faces = [first, *missed].map(|h| self.corner_face[h as usize].0);
                return Err(BuildError::NonManifoldVertex { vertex, faces });
            }
            firsts.push(HalfedgeId(first));
        }
        Ok(firsts)
    }
}

/// Edges, and the halfedges along the boundary.
struct Edges {
    twin: Vec<HalfedgeId>,
    halfedge_edge: Vec<EdgeId>,
    edge_halfedge: Vec<HalfedgeId>,
    boundary_next: Vec<HalfedgeId>,
}

impl Edges {
    fn new(links: &Links<'_>, twin: Vec<u32>, vertex_halfedge: &[HalfedgeId]) -> Self {
        let inner = twin.len();
        let boundary = twin.iter().filter(|&&t| t == NONE).count();
        let edge_count = (inner - boundary) / 2 + boundary;
        let mut edges = Self {
            twin: Vec::with_capacity(inner + boundary),
            halfedge_edge: vec![EdgeId(NONE); inner + boundary],
            edge_halfedge: Vec::with_capacity(edge_count),
            boundary_next: Vec::new(),
        };
        let mut outside = Vec::with_capacity(boundary);
        for (halfedge, other) in twin.into_iter().enumerate() {
            let halfedge = halfedge as u32;
            let other = if other == NONE {
                outside.push(halfedge);
                (inner + outside.len() - 1) as u32
            } else {
                other
            };
            edges.twin.push(HalfedgeId(other));
            if halfedge < other {
                let edge = EdgeId(edges.edge_halfedge.len() as u32);
                edges.edge_halfedge.push(HalfedgeId(halfedge));
                edges.halfedge_edge[halfedge as usize] = edge;
                edges.halfedge_edge[other as usize] = edge;
            }
        }
        edges.twin.extend(outside.iter().map(|&h| HalfedgeId(h)));
        edges.boundary_next =
            outside.iter().map(|&inside| edges.boundary_after(links, inside, vertex_halfedge)).collect();
        edges
    }

    /// The boundary halfedge after the twin of `inside`: it leaves the origin of `inside`, as the last of its fan.
    fn boundary_after(&self, links: &Links<'_>, inside: u32, vertex_halfedge: &[HalfedgeId]) -> HalfedgeId {
        let vertex = VertexId(links.corner_vertex[inside as usize]);
        let mut current = vertex_halfedge[vertex.index()].0;
        loop {
            let following = self.twin[links.previous(current) as usize];
            if following.index() >= links.corner_vertex.len() {
                return following;
            }
            current = CornerId(following.0).0;
        }
    }
}

impl BuildError {
    /// Translates the vertices of connectivity errors back to the caller's.
    fn with_vertices(self, source: &impl Fn(u32) -> u32) -> Self {
        match self {
            Self::NonManifoldEdge { vertices, faces } => {
                Self::NonManifoldEdge { vertices: vertices.map(source), faces }
            }
            Self::InconsistentOrientation { vertices, faces } => {
                Self::InconsistentOrientation { vertices: vertices.map(source), faces }
            }
            Self::NonManifoldVertex { vertex, faces } => {
                Self::NonManifoldVertex { vertex: source(vertex), faces }
            }
            other => other,
        }
    }
}
