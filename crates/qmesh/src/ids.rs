//! Typed indices: a [`FaceId`] is no [`VertexId`], so one cannot be used where the other is meant.
//!
//! All are `u32` inside: half the memory of `usize`, and four thousand million elements are enough.

use std::fmt;

/// An index type of one kind of mesh element.
pub trait Id: Copy + Eq + Ord + fmt::Debug + Send + Sync + 'static {
    /// The id with the given index.
    ///
    /// `index` has to be below `u32::MAX`; only debug builds check that. Meshes that large are refused when they are built.
    fn from_index(index: usize) -> Self;
    /// The position in a flat array.
    fn index(self) -> usize;
}

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(transparent))]
        #[repr(transparent)]
        pub struct $name(pub u32);

        impl Id for $name {
            #[inline]
            fn from_index(index: usize) -> Self {
                debug_assert!(index < u32::MAX as usize, concat!(stringify!($name), " out of range"));
                Self(index as u32)
            }
            #[inline]
            fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl $name {
            /// The position in a flat array.
            #[inline]
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($letter, "{}"), self.0)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{}", self.0)
            }
        }
    };
}

id!(
    /// A vertex of the mesh. Its vertex in the caller's arrays is [`QuadMesh::source_vertex`](crate::QuadMesh::source_vertex).
    VertexId, "v"
);
id!(
    /// A directed edge. The first [`QuadMesh::corner_count`](crate::QuadMesh::corner_count) lie in faces; the rest walk along the boundary.
    HalfedgeId, "h"
);
id!(
    /// An undirected edge.
    EdgeId, "e"
);
id!(
    /// A face; the same index as in the polygons that the mesh was built from.
    FaceId, "f"
);
id!(
    /// A corner of a face: the vertex as seen by that face. UVs live here.
    ///
    /// Corner `c` has the index of the halfedge that leaves it inside its face.
    CornerId, "c"
);

impl CornerId {
    /// The halfedge that leaves this corner and runs along its face.
    #[inline]
    #[must_use]
    pub fn halfedge(self) -> HalfedgeId {
        HalfedgeId(self.0)
    }
}
