//! Ids of this crate; vertices, edges and faces have those of `basemesh`.

use basemesh::FaceId;

/// A side of a face: it runs from corner `corner` to the next one, the face on its left.
///
/// A face has as many sides as corners; all faces at an edge have a side there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Side {
    /// The face.
    pub face: FaceId,
    /// The corner where the side starts, counted from 0.
    pub corner: usize,
}

/// A normal. Corners at one vertex that share it belong to one smooth piece of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalId(u32);

impl NormalId {
    /// The id with this index.
    ///
    /// # Panics
    ///
    /// If `index` does not fit 32 bits; so many normals are refused when they are given.
    #[inline]
    #[must_use]
    pub fn new(index: usize) -> Self {
        Self(u32::try_from(index).expect("invariant: normal counts fit 32 bits"))
    }

    /// Position in the list of normals.
    #[inline]
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
