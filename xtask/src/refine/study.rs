//! One mesh of a series, and the series as a table.

use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qoptimize::{Options, Stop, measure_faces, parameterize};

/// What there is to say of one map.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) quads: usize,
    pub(super) energy: f64,
    pub(super) angle_error: f64,
    pub(super) area_error: f64,
    pub(super) stretch: f64,
    pub(super) stretch_max: f64,
    pub(super) ratio_max: f64,
    /// The largest |log| of the area ratio of one quad over that of a neighbour: between quads inside, and where one has an edge on
    /// the boundary.
    pub(super) area_steps: [f64; 2],
    pub(super) steps: usize,
    pub(super) converged: bool,
    /// Corners that are stretched beyond the range in which the energy is elliptic.
    pub(super) beyond: usize,
    pub(super) certified: bool,
}

/// The title of a column and its figure.
type Figure = (&'static str, fn(&Level) -> f64);

/// The figures in the order of the columns.
pub(super) const FIGURES: [Figure; 6] = [
    ("energy", |level| level.energy),
    ("Eq. 13", |level| level.angle_error),
    ("Eq. 14", |level| level.area_error),
    ("symmetric Dirichlet", |level| level.stretch),
    ("its largest", |level| level.stretch_max),
    ("largest s1/s2", |level| level.ratio_max),
];
/// So many of them are means, which converge at once; the others are of single corners.
#[cfg(test)]
pub(super) const CONVERGING: usize = 4;

impl Level {
    /// Maps `mesh` and measures the map.
    pub(super) fn of(mesh: &QuadMesh, options: &Options) -> Result<Self, String> {
        let map = parameterize(mesh, options, &()).map_err(|error| error.to_string())?;
        let faces = measure_faces(mesh.view(), &map.uv).map_err(|error| error.to_string())?;
        let direct = map.record.direct.as_ref().ok_or("no energy was minimised")?;
        let none = || "the map is flipped everywhere".to_owned();
        Ok(Self {
            quads: mesh.face_count(),
            energy: direct.descent.energy,
            angle_error: map.distortion.angle_error_mean,
            area_error: map.distortion.area_error_mean,
            stretch: map.distortion.symmetric_dirichlet.ok_or_else(none)?,
            stretch_max: map.distortion.symmetric_dirichlet_max.ok_or_else(none)?,
            ratio_max: map.distortion.singular_ratio_max.ok_or_else(none)?,
            area_steps: area_steps(mesh, &faces.area_ratio),
            steps: direct.descent.steps,
            converged: direct.descent.stop == Stop::Converged,
            beyond: direct.corners_beyond_elliptic,
            certified: map.certificate.holds,
        })
    }
}

fn area_steps(mesh: &QuadMesh, ratio: &[f64]) -> [f64; 2] {
    let is_outer = |face| mesh.face_vertices(face).any(|vertex| mesh.is_boundary(vertex));
    let mut largest = [0.0, 0.0];
    for edge in mesh.edges().filter(|&edge| !mesh.is_boundary_edge(edge)) {
        let halfedge = mesh.halfedge(edge);
        let sides =
            [halfedge, mesh.twin(halfedge)].map(|side| mesh.corner(side).map(|corner| mesh.face(corner)));
        let [Some(left), Some(right)] = sides else { continue };
        let place: &mut f64 = &mut largest[usize::from(is_outer(left) || is_outer(right))];
        *place = place.max((ratio[left.index()] / ratio[right.index()]).ln().abs());
    }
    largest
}

/// One line a mesh, with the change from the line before.
pub(super) fn table(levels: &[Level]) -> String {
    let mut text = "| quads |".to_owned();
    FIGURES.iter().for_each(|(name, _)| text += &format!(" {name} |"));
    text += " step of areas inside | at the boundary | steps | converged | beyond the elliptic range | certified |\n| ---: |";
    text += &" ---: |".repeat(FIGURES.len() + 6);
    text.push('\n');
    for (index, level) in levels.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| &levels[before]);
        text += &format!("| {} |", level.quads);
        for (_, value) in FIGURES {
            let change = before.map_or_else(String::new, |before| {
                format!(" ({:+.2})", 100.0 * (value(level) / value(before) - 1.0))
            });
            text += &format!(" {:.5}{change} |", value(level));
        }
        let yes = |holds: bool| if holds { "yes" } else { "no" };
        text += &format!(
            " {:.2} % | {:.2} % | {} | {} | {} | {} |\n",
            100.0 * level.area_steps[0].exp_m1(),
            100.0 * level.area_steps[1].exp_m1(),
            level.steps,
            yes(level.converged),
            level.beyond,
            yes(level.certified)
        );
    }
    text
}
