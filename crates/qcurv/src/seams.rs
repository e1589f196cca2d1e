//! Where a surface wants to be cut open: along mesh edges, through creases and places of high curvature.
//!
//! Only planar patches (disks, perhaps with holes) can be flattened. [`opening`] finds edges that make one of any
//! connected mesh:
//!
//! - handles are cut open by a system of short loops, two for each: tree and cotree of [Eppstein 2003, "Dynamic generators of
//!   topologically embedded graphs"], made short as [Erickson and Whittlesey 2005, "Greedy optimal homotopy and homology
//!   generators"] do, from the best of several base points;
//! - closed surfaces are cut from tip to tip: the ends of limbs, which are maxima of the mean geodesic distance to the whole
//!   (Hilaga et al. 2001, "Topology matching"), as far as they stand out; on a surface without limbs, between the two vertices
//!   that are farthest apart. The paths form a tree that grows to the nearest tip not yet reached.
//!
//! A path costs its length, less along creases and least along concave ones, and more where it turns: at a vertex with
//! four edges going straight on is free, so seams follow edge loops instead of zigzagging across them ([`SeamCost`]).
//! Nothing depends on the unit of length; ties are broken by index.

mod cost;
mod distances;
mod handles;
mod interrupted;
mod paths;
mod tips;

pub use cost::SeamCost;
pub use interrupted::Interrupted;
pub use paths::{SeamPaths, cheapest_path};
pub use tips::tips;

use interrupted::look;
use qmesh::{Chart, CornerId, EdgeId, FaceId, Id, Observer, QuadMesh, Seams, Topology, VertexId};

/// The edges along which to cut the connected `mesh` so that one planar patch is left: none when it is one already.
///
/// Holes stay holes. A closed surface becomes a disk; a handle is opened by two loops. Takes `O((n + genus) log n)` for `n` edges, however many
/// of them meet in a vertex.
///
/// When the observer [is late](Observer::is_late), the seams are any that open the surface, found at once. It hears of `"seams"`.
///
/// # Errors
/// [`Interrupted::Cancelled`] when the observer says so.
///
/// ```
/// use qcurv::qmesh::{Chart, shapes};
///
/// for mesh in [shapes::sphere(6), shapes::torus(12, 8)] {
///     let cut = Chart::whole(mesh.clone()).cut(&qcurv::seams::opening(&mesh, &())?);
///     assert!(cut.len() == 1 && cut[0].mesh.topology().is_disk());
/// }
/// # Ok::<(), qcurv::seams::Interrupted>(())
/// ```
pub fn opening(mesh: &QuadMesh, observer: &dyn Observer) -> Result<Vec<EdgeId>, Interrupted> {
    let topology = mesh.topology();
    let closed = topology.boundary_loops == 0;
    if topology.components != 1 || (!closed && topology.genus == 0) {
        return Ok(Vec::new());
    }
    match good_opening(mesh, &topology, observer) {
        Ok(seams) if is_opened(mesh, &seams) => Ok(seams),
        Err(Interrupted::Cancelled) => Err(Interrupted::Cancelled),
        Ok(_) | Err(Interrupted::OutOfTime) => Ok(any_opening(mesh)),
    }
}

/// Loops that open handles, and paths to the tips.
fn good_opening(
    mesh: &QuadMesh,
    topology: &Topology,
    observer: &dyn Observer,
) -> Result<Vec<EdgeId>, Interrupted> {
    look(observer, 0.0)?;
    let cost = SeamCost::new(mesh);
    let mut seams = if topology.genus > 0 { handles::open(mesh, &cost, observer)? } else { Vec::new() };
    if topology.boundary_loops == 0 {
        grow(mesh, &cost, &mut seams, observer)?;
    }
    look(observer, 1.0)?;
    Ok(seams)
}

/// Adds paths to the tips of a closed surface.
fn grow(
    mesh: &QuadMesh,
    cost: &SeamCost,
    seams: &mut Vec<EdgeId>,
    observer: &dyn Observer,
) -> Result<(), Interrupted> {
    let mut wanted = tips(mesh, observer)?;
    if seams.is_empty() {
        // The first two, and any more.
        if wanted.len() < 2 {
            wanted = distances::farthest_pair(mesh).to_vec();
        }
        let first = wanted.remove(0);
        seams.extend(cheapest_path(mesh, cost, &[first], |vertex| wanted.contains(&vertex)));
    }
    let mut reached = mesh.vertex_data(|_| false);
    let mark = |reached: &mut qmesh::VertexData<bool>, edges: &[EdgeId]| {
        edges.iter().flat_map(|&edge| mesh.edge_vertices(edge)).for_each(|vertex| reached[vertex] = true);
    };
    mark(&mut reached, seams);
    for _ in 0..wanted.len() {
        look(observer, 0.9)?;
        let left: Vec<VertexId> = wanted.iter().copied().filter(|&tip| !reached[tip]).collect();
        if left.is_empty() {
            break;
        }
        let sources: Vec<VertexId> = mesh.vertices().filter(|&vertex| reached[vertex]).collect();
        let path = cheapest_path(mesh, cost, &sources, |vertex| left.contains(&vertex));
        mark(&mut reached, &path);
        seams.extend(path);
    }
    seams.sort_unstable();
    seams.dedup();
    Ok(())
}

/// Whether cutting along `seams` leaves one planar patch.
fn is_opened(mesh: &QuadMesh, seams: &[EdgeId]) -> bool {
    patch(mesh, seams).is_some()
}

/// The planar patch that cutting along `seams` leaves, if it does.
fn patch(mesh: &QuadMesh, seams: &[EdgeId]) -> Option<Topology> {
    let cut = Chart::whole(mesh.clone()).cut(seams);
    let [chart] = &cut[..] else { return None };
    Some(chart.mesh.topology()).filter(|topology| topology.genus == 0 && topology.boundary_loops > 0)
}

/// All edges but those of a spanning tree of the faces, less what hangs loose: a planar patch, whatever the surface was; of a closed sphere
/// two edges.
fn any_opening(mesh: &QuadMesh) -> Vec<EdgeId> {
    let mut is_cut = mesh.edge_data(|edge| !mesh.is_boundary_edge(edge));
    let mut seen = mesh.face_data(|_| false);
    let mut queue = std::collections::VecDeque::from([FaceId::from_index(0)]);
    seen[FaceId(0)] = true;
    while let Some(face) = queue.pop_front() {
        for corner in mesh.face_corners(face) {
            let halfedge = corner.halfedge();
            let Some(across) = mesh.corner(mesh.twin(halfedge)).map(|corner| mesh.face(corner)) else {
                continue;
            };
            if !std::mem::replace(&mut seen[across], true) {
                is_cut[mesh.edge(halfedge)] = false;
                queue.push_back(across);
            }
        }
    }
    let all: Vec<EdgeId> = mesh.edges().filter(|&edge| is_cut[edge]).collect();
    let pruned = prune(mesh, all.clone());
    // Of a closed sphere nothing is left: any two edges in a row open it.
    let opening = if pruned.is_empty() { slit(mesh) } else { pruned };
    if is_opened(mesh, &opening) { opening } else { all }
}

/// The first two edges in a row between three vertices: opened together they are a slit, where one alone opens nothing and a loop of two cuts
/// a piece out. None where all faces go to and fro between two vertices.
fn slit(mesh: &QuadMesh) -> Vec<EdgeId> {
    let in_a_row = mesh.corners().map(CornerId::halfedge).find_map(|first| {
        let second = mesh.next(first);
        let [start, middle, end] = [mesh.origin(first), mesh.target(first), mesh.target(second)];
        (start != middle && middle != end && start != end).then(|| vec![mesh.edge(first), mesh.edge(second)])
    });
    let mut edges = in_a_row.unwrap_or_default();
    edges.sort_unstable();
    edges
}

/// Takes away edges that end at a vertex without another one, again and again.
fn prune(mesh: &QuadMesh, mut edges: Vec<EdgeId>) -> Vec<EdgeId> {
    let mut degree = mesh.vertex_data(|_| 0u32);
    let mut at: Vec<(VertexId, EdgeId)> = Vec::with_capacity(2 * edges.len());
    for &edge in &edges {
        for vertex in mesh.edge_vertices(edge) {
            degree[vertex] += 1;
            at.push((vertex, edge));
        }
    }
    at.sort_unstable();
    let mut gone = std::collections::HashSet::new();
    let mut loose: Vec<VertexId> = at.iter().map(|&(vertex, _)| vertex).filter(|&v| degree[v] == 1).collect();
    while let Some(vertex) = loose.pop() {
        let from = at.partition_point(|&(v, _)| v < vertex);
        let here = at[from..].iter().take_while(|&&(v, _)| v == vertex).map(|&(_, edge)| edge);
        let Some(edge) = here.into_iter().find(|edge| !gone.contains(edge)) else { continue };
        gone.insert(edge);
        for end in mesh.edge_vertices(edge) {
            degree[end] -= 1;
            if degree[end] == 1 {
                loose.push(end);
            }
        }
    }
    edges.retain(|edge| !gone.contains(edge));
    edges
}

/// The edges at which the faces bend by more than `degrees`, as seams in the numbers of the caller's polygons. Faces bend by
/// the angle between their mean normals; edges on the boundary are none.
#[must_use]
pub fn creases(mesh: &QuadMesh, degrees: f64) -> Seams {
    let bends = cost::bends(mesh);
    let sharp = mesh.edges().filter(|&edge| bends[edge].abs().to_degrees() > degrees);
    sharp.map(|edge| mesh.edge_vertices(edge).map(|vertex| mesh.source_vertex(vertex))).collect()
}
