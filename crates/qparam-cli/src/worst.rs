//! The worst faces of a map, in the numbers of the file and in words.

use qoptimize::qmesh::{Chart, FaceId, Id, QuadMesh, VertexId};
use qoptimize::{
    Atlas, AtlasOptions, Cause, Circumstances, Exempt, FaceMeasure, MeasureError, Stop, WorstFace,
    measure_worst_faces,
};
use serde::Serialize;

use crate::input::Input;
use crate::table::short;

/// Faces below this symmetric Dirichlet energy are as good as undistorted.
const WORTH_NAMING: f64 = 1.001;

/// One of the worst faces; faces and vertices are counted from 1, as in the file.
#[derive(Debug, Serialize)]
pub(crate) struct WorstReport {
    face: usize,
    place: [f64; 3],
    /// `null` when a corner is flipped.
    symmetric_dirichlet: Option<f64>,
    angle_degrees: f64,
    area_ratio: f64,
    causes: Vec<CauseReport>,
}

#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum CauseReport {
    Exempt,
    Degenerate,
    Concave,
    NotPlanar { degrees: f64 },
    Pin { vertex: u32 },
    Boundary,
    Curvature { radians: f64, vertex: u32 },
    NotConverged,
    Surroundings,
}

/// The `count` worst faces of a map, and why they are so bad.
pub(crate) fn find(
    input: &Input,
    charts: &[Chart],
    atlas: &Atlas,
    options: &AtlasOptions,
    count: usize,
) -> Result<Vec<WorstReport>, MeasureError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let polygons = input.document.view();
    let worst = if atlas.turned_faces.is_empty() {
        measure_worst_faces(polygons, &atlas.uv, count)?
    } else {
        let (polygons, uv) = atlas.oriented(polygons);
        measure_worst_faces(polygons.view(), &uv, count)?
    };
    let explain = |(index, measure): (usize, FaceMeasure)| {
        let face = index as u32;
        let (chart, place) = charts
            .iter()
            .find_map(|chart| Some((chart, chart.faces.binary_search(&face).ok()?)))
            .map(|(chart, place)| (chart, FaceId::from_index(place)))?;
        let found = explained(chart, place, &measure, atlas, options);
        Some(WorstReport::new(index, found, &chart.mesh))
    };
    Ok(worst.into_iter().filter_map(explain).collect())
}

/// A face of a chart under the circumstances of its island.
fn explained(
    chart: &Chart,
    face: FaceId,
    measure: &FaceMeasure,
    atlas: &Atlas,
    options: &AtlasOptions,
) -> WorstFace {
    let mesh = &chart.mesh;
    // Islands that were cut further have other records, and begin elsewhere.
    let island = atlas.islands.iter().find(|island| chart.faces.first() == Some(&island.first_face));
    let direct = island.and_then(|island| island.record.direct.as_ref());
    let pinned: Vec<VertexId> = options.map.pins.iter().map(|pin| pin.0).collect();
    let exempt = Exempt::contains(mesh, face).then_some(face);
    let circumstances = Circumstances {
        exempt: exempt.as_slice(),
        pinned: &pinned,
        held_boundary: !options.map.is_boundary_free()
            || direct.is_some_and(|direct| direct.boundary_repair.is_some()),
        not_converged: direct.is_some_and(|direct| direct.descent.stop != Stop::Converged),
    };
    WorstFace::new(mesh, face, measure, &circumstances)
}

/// The lines of the report; none where nothing is worth naming.
pub(crate) fn text(faces: &[WorstReport]) -> String {
    let named =
        faces.iter().filter(|face| face.symmetric_dirichlet.is_none_or(|energy| energy > WORTH_NAMING));
    let lines: String = named.map(|face| format!("  {}\n", face.line())).collect();
    if lines.is_empty() { lines } else { format!("\nworst faces\n{lines}") }
}

impl WorstReport {
    /// The face `index` of the file, which is `found` in `mesh`.
    fn new(index: usize, found: WorstFace, mesh: &QuadMesh) -> Self {
        let causes = found.causes.into_iter().map(|cause| CauseReport::new(cause, mesh)).collect();
        Self {
            face: index + 1,
            place: found.place.into(),
            symmetric_dirichlet: found.symmetric_dirichlet,
            angle_degrees: found.angle_degrees,
            area_ratio: found.area_ratio,
            causes,
        }
    }

    fn line(&self) -> String {
        let [x, y, z] = self.place.map(short);
        let energy = match self.symmetric_dirichlet {
            Some(energy) => format!("symmetric Dirichlet {}", short(energy)),
            None => "flipped".to_owned(),
        };
        format!(
            "face {} at ({x}, {y}, {z}): {energy}, angles {}° off, area × {}; {}",
            self.face,
            short(self.angle_degrees),
            short(self.area_ratio),
            self.reasons()
        )
    }

    /// Its index, from 0.
    pub(crate) fn index(&self) -> usize {
        self.face - 1
    }

    /// What forces it, in words.
    pub(crate) fn reasons(&self) -> String {
        self.causes.iter().map(CauseReport::words).collect::<Vec<_>>().join(", ")
    }
}

impl CauseReport {
    fn new(cause: Cause, mesh: &QuadMesh) -> Self {
        let number = |vertex: VertexId| mesh.source_vertex(vertex) + 1;
        match cause {
            Cause::Exempt => Self::Exempt,
            Cause::Degenerate => Self::Degenerate,
            Cause::Concave => Self::Concave,
            Cause::NotPlanar { degrees } => Self::NotPlanar { degrees },
            Cause::Pin { vertex } => Self::Pin { vertex: number(vertex) },
            Cause::Boundary => Self::Boundary,
            Cause::Curvature { radians, vertex } => Self::Curvature { radians, vertex: number(vertex) },
            Cause::NotConverged => Self::NotConverged,
            _ => Self::Surroundings,
        }
    }

    fn words(&self) -> String {
        match self {
            Self::Exempt => "cannot be convex in any map".into(),
            Self::Degenerate => "degenerate in space".into(),
            Self::Concave => "concave in space".into(),
            Self::NotPlanar { degrees } => format!("bent by {}° in space", short(*degrees)),
            Self::Pin { vertex } => format!("near the pin of vertex {vertex}"),
            Self::Boundary => "on the boundary, which is not free here".into(),
            Self::Curvature { radians, vertex } => {
                format!("curvature of {} rad around it, most at vertex {vertex}", short(*radians))
            }
            Self::NotConverged => "the descent had not converged".into(),
            Self::Surroundings => "what lies around it, not the place itself".into(),
        }
    }
}
