//! `qparam info`: what a mesh is, also when no mesh can be built from it.

pub(crate) mod connectivity;
mod labels;
mod shape;

use qoptimize::qmesh::charts::cut;
use qoptimize::qmesh::{Seams, Topology};
use serde::Serialize;

use crate::args::InfoArgs;
use crate::disk::describe;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::info::connectivity::Connectivity;
pub(crate) use crate::info::labels::Labels;
use crate::info::shape::{Shape, Spread};
use crate::input::Input;
use crate::islands::repair_lines;
use crate::json_text;
use crate::report::Head;
use crate::streams::Streams;
use crate::table::{counted, grouped, short};
use crate::translate::refused;

#[derive(Serialize)]
struct Report {
    #[serde(flatten)]
    head: Head,
    file: String,
    vertices: usize,
    faces: usize,
    triangles: usize,
    quads: usize,
    polygons: usize,
    has_uv: bool,
    #[serde(flatten)]
    connectivity: Connectivity,
    /// `null` when no mesh can be built.
    topology: Option<Topology>,
    is_disk: bool,
    /// Why `unwrap` would refuse the mesh.
    refusal: Option<Failure>,
    /// What `unwrap` would mend.
    repairs: Vec<String>,
    #[serde(flatten)]
    shape: Shape,
    labels: Labels,
}

pub(crate) fn run(arguments: &InfoArgs, io: &mut Streams<'_>) -> Result<Exit, Failure> {
    let report = inspect(&Input::read(&arguments.file, io.stdin)?);
    let text = if arguments.json { json_text(&report) } else { report.text() };
    io.say(&text).map(|()| Exit::Done)
}

fn inspect(input: &Input) -> Report {
    let view = input.document.view();
    let degrees = |accept: fn(usize) -> bool| {
        (0..view.face_count()).filter(|&face| accept(view.face(face).len())).count()
    };
    let mesh = input.mesh();
    let topology = mesh.as_ref().ok().map(qoptimize::qmesh::QuadMesh::topology);
    let cut = cut(view, &Seams::default());
    let refusal = cut.as_ref().err().map(|error| refused(error, input));
    let repairs = cut.map(|cut| repair_lines(&cut.repairs)).unwrap_or_default();
    Report {
        head: Head::new("info"),
        file: input.name.clone(),
        vertices: view.positions.len(),
        faces: view.face_count(),
        triangles: degrees(|n| n == 3),
        quads: degrees(|n| n == 4),
        polygons: degrees(|n| n > 4),
        has_uv: input.document.corner_uv().is_some(),
        connectivity: Connectivity::new(view),
        topology,
        is_disk: topology.is_some_and(|topology| topology.is_disk()),
        refusal,
        repairs,
        shape: Shape::new(view),
        labels: Labels::new(input.document.bytes()),
    }
}

impl Report {
    fn text(&self) -> String {
        let mut text = format!("{}\n", self.file);
        let mut line = |label: &str, value: String| text += &format!("  {label:<12} {value}\n");
        line("vertices", grouped(self.vertices));
        line("faces", self.faces_text());
        let edges = &self.connectivity;
        line(
            "edges",
            format!("{}, {} of them on the boundary", grouped(edges.edges), grouped(edges.boundary_edges)),
        );
        line("topology", self.topology_text());
        line("valences", edges.valences_text());
        line("UVs", if self.has_uv { "on every corner" } else { "none, or not on every corner" }.into());
        line("box", self.shape.bounding_box.map(short).join(" × "));
        line("edge length", spread_text(&self.shape.edge_length));
        line("face area", spread_text(&self.shape.face_area));
        for (label, names) in self.labels.lists() {
            line(label, names);
        }
        let odd = self.odd();
        text += if odd.is_empty() { "nothing odd\n" } else { "odd\n" };
        for oddity in odd {
            text += &format!("  {oddity}\n");
        }
        match &self.refusal {
            None => {
                text += "`qparam unwrap` maps it\n";
                for repair in &self.repairs {
                    text += &format!("  {repair}\n");
                }
            }
            Some(failure) => {
                text += &format!("`qparam unwrap` refuses it\n  {}\n", failure.message);
                for more in failure.causes.iter().chain(&failure.help) {
                    text += &format!("  {more}\n");
                }
            }
        }
        text
    }

    fn faces_text(&self) -> String {
        let kinds = [(self.quads, "quad"), (self.triangles, "triangle"), (self.polygons, "polygon")];
        let kinds = kinds.iter().filter(|kind| kind.0 > 0).map(|&(count, noun)| counted(count, noun));
        format!("{}: {}", grouped(self.faces), kinds.collect::<Vec<_>>().join(", "))
    }

    fn topology_text(&self) -> String {
        match &self.topology {
            None => "not a mesh (see below)".into(),
            Some(topology) => {
                format!("{} (Euler characteristic {})", describe(topology), topology.euler_characteristic)
            }
        }
    }

    /// What is unusual, in words.
    fn odd(&self) -> Vec<String> {
        let (edges, shape) = (&self.connectivity, &self.shape);
        let odd = [
            (edges.unused_vertices, "vertex", "used by no face"),
            (shape.repeated_positions, "vertex", "at the position of another vertex"),
            (edges.repeated_faces, "face", "on the same vertices as another face"),
            (edges.nonmanifold_edges, "edge", "shared by more than two faces"),
            (edges.doublets, "doublet", "(two quads around one vertex of valence 2)"),
            (edges.shared_diagonals, "pair", "of opposite vertices shared by several quads"),
            (shape.zero_area_faces, "face", "of no area"),
            (shape.concave_quads, "quad", "with a concave corner"),
            (shape.nonplanar_quads, "quad", "far from planar (diagonals apart by over 10 % of their length)"),
            (self.triangles, "triangle", ""),
            (self.polygons, "polygon", "of five corners or more"),
        ];
        odd.into_iter()
            .filter(|&(count, ..)| count > 0)
            .map(|(count, noun, what)| format!("{} {what}", counted(count, noun)).trim_end().to_owned())
            .collect()
    }
}

fn spread_text(spread: &Spread) -> String {
    format!("{} to {}, median {}", short(spread.smallest), short(spread.largest), short(spread.median))
}
