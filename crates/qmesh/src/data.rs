//! One value per mesh element: a flat array that only its own kind of id can index.

use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut};

use crate::ids::{CornerId, EdgeId, FaceId, HalfedgeId, Id, VertexId};

/// Values of type `T`, one for each element with an id of type `I`.
///
/// Derefs to a slice for everything that goes over all values in order.
#[derive(Clone, PartialEq)]
pub struct ElementData<I, T> {
    values: Vec<T>,
    id: PhantomData<fn(I)>,
}

/// One value per vertex.
pub type VertexData<T> = ElementData<VertexId, T>;
/// One value per halfedge, those along the boundary included.
pub type HalfedgeData<T> = ElementData<HalfedgeId, T>;
/// One value per undirected edge.
pub type EdgeData<T> = ElementData<EdgeId, T>;
/// One value per face.
pub type FaceData<T> = ElementData<FaceId, T>;
/// One value per face corner.
pub type CornerData<T> = ElementData<CornerId, T>;

impl<I: Id, T> ElementData<I, T> {
    /// Wraps values that are already in the order of the ids.
    #[must_use]
    pub fn from_vec(values: Vec<T>) -> Self {
        Self { values, id: PhantomData }
    }

    /// The same value for `count` elements.
    #[must_use]
    pub fn filled(count: usize, value: T) -> Self
    where
        T: Clone,
    {
        Self::from_vec(vec![value; count])
    }

    /// The bare values, in the order of the ids.
    #[must_use]
    pub fn into_vec(self) -> Vec<T> {
        self.values
    }

    /// Every id with its value, in order.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = (I, &T)> {
        self.values.iter().enumerate().map(|(i, value)| (I::from_index(i), value))
    }
}

impl<I: Id, T> Index<I> for ElementData<I, T> {
    type Output = T;
    #[inline]
    fn index(&self, id: I) -> &T {
        &self.values[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for ElementData<I, T> {
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.values[id.index()]
    }
}

impl<I, T> Deref for ElementData<I, T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.values
    }
}

impl<I, T> DerefMut for ElementData<I, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values
    }
}

impl<I, T: std::fmt::Debug> std::fmt::Debug for ElementData<I, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.values.fmt(f)
    }
}

#[cfg(feature = "serde")]
impl<I, T: serde::Serialize> serde::Serialize for ElementData<I, T> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.values.serialize(serializer)
    }
}

#[cfg(feature = "serde")]
impl<'de, I: Id, T: serde::Deserialize<'de>> serde::Deserialize<'de> for ElementData<I, T> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Self::from_vec)
    }
}
