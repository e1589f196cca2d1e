//! What can be wrong with a map, and where.

use std::fmt;

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum ViolationKind {
    /// A corner whose UV is not finite. With one of these, nothing but the faces is looked at.
    NotFinite,
    /// A face of fewer than three corners.
    TooFewCorners,
    /// A corner of a triangle or folded quad that turns right.
    FlippedCorner,
    /// A corner that turns right in a quad of which one diagonal still makes two positive triangles.
    ConcaveQuad,
    /// A corner of a triangle or quad that turns neither way: its triangle has no area.
    FlatCorner,
    /// A face of five corners or more whose outline crosses or touches itself, or winds round twice, like a pentagram.
    NotSimple,
    /// A face of five corners or more that is simple but runs clockwise.
    FlippedFace,
    /// An island that is mirrored as a whole.
    MirroredIsland,
    /// An edge of the map with more than two faces, or with two faces that run the same way.
    NonmanifoldEdge,
    /// A vertex inside an island around which the faces close after two full turns or more.
    BranchPoint,
    /// A point of the map that the boundary passes more than once.
    Pinch,
    /// Two boundary edges that cross.
    Crossing,
    /// Two boundary edges that touch: an end on the other edge, or both on one line with a part in common.
    Touching,
    /// An island without any boundary.
    NoBoundary,
    /// An outer boundary that runs clockwise.
    OuterClockwise,
    /// A hole that runs counter-clockwise.
    HoleCounterClockwise,
    /// A hole that is not directly inside the outer boundary of its island.
    HoleOutside,
    /// An island inside the material of another.
    IslandOnIsland,
}

impl ViolationKind {
    /// What one is called, and what several are called.
    #[must_use]
    pub fn name(self) -> [&'static str; 2] {
        match self {
            Self::NotFinite => ["corner that is not finite", "corners that are not finite"],
            Self::TooFewCorners => ["face of fewer than three corners", "faces of fewer than three corners"],
            Self::FlippedCorner => ["flipped corner", "flipped corners"],
            Self::ConcaveQuad => ["concave corner of a quad", "concave corners of quads"],
            Self::FlatCorner => ["corner without area", "corners without area"],
            Self::NotSimple => ["face that covers itself", "faces that cover themselves"],
            Self::FlippedFace => ["flipped polygon", "flipped polygons"],
            Self::MirroredIsland => ["mirrored island", "mirrored islands"],
            Self::NonmanifoldEdge => ["non-manifold edge", "non-manifold edges"],
            Self::BranchPoint => ["branch point", "branch points"],
            Self::Pinch => ["pinched vertex", "pinched vertices"],
            Self::Crossing => ["boundary crossing", "boundary crossings"],
            Self::Touching => ["boundary contact", "boundary contacts"],
            Self::NoBoundary => ["island without a boundary", "islands without a boundary"],
            Self::OuterClockwise => {
                ["outer boundary running clockwise", "outer boundaries running clockwise"]
            }
            Self::HoleCounterClockwise => {
                ["hole running counter-clockwise", "holes running counter-clockwise"]
            }
            Self::HoleOutside => ["hole outside its island", "holes outside their islands"],
            Self::IslandOnIsland => ["island on another", "islands on others"],
        }
    }

    /// Whether its places are edges.
    fn names_edges(self) -> bool {
        matches!(
            self,
            Self::NonmanifoldEdge
                | Self::Crossing
                | Self::Touching
                | Self::OuterClockwise
                | Self::HoleCounterClockwise
                | Self::HoleOutside
                | Self::IslandOnIsland
        )
    }
}

/// A corner, or the edge from it to the next corner of its face. Indices count from 0, as in the polygons.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Place {
    /// The face.
    pub face: usize,
    /// The corner, counted over all faces.
    pub corner: usize,
    /// Its vertex; 2³² − 1 for a face without corners.
    pub vertex: u32,
    /// Its UV.
    pub uv: [f64; 2],
    /// Of an edge, the vertex at its other end.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub to_vertex: Option<u32>,
    /// Of an edge, the UV of its other end.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub to_uv: Option<[f64; 2]>,
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Violation {
    /// What.
    pub kind: ViolationKind,
    /// Where: two edges for crossings and contacts; the edge of the inner boundary, then one of the outer, where something lies in a
    /// wrong place; one place otherwise.
    pub places: Vec<Place>,
    /// The islands of the places, from 0, in order of their first faces.
    pub islands: Vec<u32>,
    /// How many faces share the edge, how often the boundary passes the point or the faces go round it, how many faces are
    /// mirrored; 1 for other kinds.
    pub times: usize,
}

impl Violation {
    /// What is wrong, in words, with each place as `name` calls it and islands counted from `base`.
    #[must_use]
    pub fn describe(&self, base: u32, name: impl Fn(&Place) -> String) -> String {
        let first = self.places.first().map_or_else(String::new, &name);
        let second = self.places.get(1).map_or_else(String::new, &name);
        let times = self.times;
        let island = |i: usize| self.islands.get(i).map_or(0, |island| island + base);
        let whose = match self.islands[..] {
            [a, b] if a != b => format!(" (islands {} and {})", a + base, b + base),
            _ => String::new(),
        };
        match self.kind {
            ViolationKind::NotFinite => format!("{first}: the UV is not finite"),
            ViolationKind::TooFewCorners => format!("{first}: the face has fewer than three corners"),
            ViolationKind::FlippedCorner => {
                format!("{first}: the corner turns right, the face is flipped or folded")
            }
            ViolationKind::ConcaveQuad => {
                format!(
                    "{first}: the quad is concave here: split across the other diagonal it overlaps itself"
                )
            }
            ViolationKind::FlatCorner => format!("{first}: the corner has no area"),
            ViolationKind::NotSimple => format!("{first}: the outline of the face crosses or touches itself"),
            ViolationKind::FlippedFace => format!("{first}: the face runs clockwise"),
            ViolationKind::MirroredIsland => {
                format!("{first}: island {} is mirrored, all {times} faces of it", island(0))
            }
            ViolationKind::NonmanifoldEdge => {
                format!("{first}: the edge has {times} faces that do not pair up")
            }
            ViolationKind::BranchPoint => {
                format!("{first}: the faces around the vertex go round it {times} times")
            }
            ViolationKind::Pinch => format!("{first}: the boundary passes this vertex {times} times"),
            ViolationKind::Crossing => format!("{first} crosses {second}{whose}"),
            ViolationKind::Touching => format!("{first} touches {second}{whose}"),
            ViolationKind::NoBoundary => format!("{first}: island {} has no boundary", island(0)),
            ViolationKind::OuterClockwise => {
                format!("{first}: the outer boundary of island {} runs clockwise", island(0))
            }
            ViolationKind::HoleCounterClockwise => {
                format!("{first}: a hole of island {} runs counter-clockwise", island(0))
            }
            ViolationKind::HoleOutside => {
                format!("{first}: a hole of island {} is not directly inside its outer boundary", island(0))
            }
            ViolationKind::IslandOnIsland => {
                format!("{first}: island {} lies on island {}, inside {second}", island(0), island(1))
            }
        }
    }

    /// Whether the places are edges rather than corners.
    #[must_use]
    pub fn names_edges(&self) -> bool {
        self.kind.names_edges()
    }
}

/// A count with its noun.
pub(super) fn counted(kind: ViolationKind, count: usize) -> String {
    let [one, many] = kind.name();
    format!("{count} {}", if count == 1 { one } else { many })
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [u, v] = self.uv;
        match (self.to_vertex, self.to_uv) {
            (Some(to), Some([s, t])) => {
                write!(f, "face {}, edge {}-{to} from ({u}, {v}) to ({s}, {t})", self.face, self.vertex)
            }
            _ => write!(f, "face {}, vertex {} at ({u}, {v})", self.face, self.vertex),
        }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.describe(0, Place::to_string))
    }
}
