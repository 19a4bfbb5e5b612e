//! Typed element ids: a face id cannot be used where a vertex id is meant.

use std::fmt;

macro_rules! element_id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[repr(transparent)]
        pub struct $name(u32);

        impl $name {
            /// The id with this index.
            ///
            /// # Panics
            ///
            /// If `index` does not fit 32 bits; meshes of that size are refused when they are built.
            #[inline]
            #[must_use]
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("invariant: element counts fit 32 bits"))
            }

            /// Position of the element in every map over its kind.
            #[inline]
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

element_id! {
    /// A vertex.
    VertexId
}
element_id! {
    /// A triangle.
    FaceId
}
element_id! {
    /// An undirected edge. Edges are numbered by their sorted pair of vertex ids.
    EdgeId
}
element_id! {
    /// A directed edge of a face: half-edge `3 f + c` runs from corner `c` of face `f` to corner
    /// `c + 1`, with the face on its left.
    HalfedgeId
}

impl FaceId {
    /// The half-edge that starts at corner `corner` (0, 1 or 2) of this face.
    #[inline]
    #[must_use]
    pub fn halfedge(self, corner: usize) -> HalfedgeId {
        debug_assert!(corner < 3, "a triangle has corners 0, 1, 2, not {corner}");
        HalfedgeId::new(3 * self.index() + corner)
    }

    /// The three half-edges of this face, from corners 0, 1 and 2.
    #[inline]
    #[must_use]
    pub fn halfedges(self) -> [HalfedgeId; 3] {
        [self.halfedge(0), self.halfedge(1), self.halfedge(2)]
    }
}

impl HalfedgeId {
    /// The face on the left.
    #[inline]
    #[must_use]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The corner (0, 1 or 2) of [`face`](Self::face) where this half-edge starts.
    #[inline]
    #[must_use]
    pub fn corner(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The next half-edge around the face, counter-clockwise.
    #[inline]
    #[must_use]
    pub fn next(self) -> Self {
        if self.0 % 3 == 2 { Self(self.0 - 2) } else { Self(self.0 + 1) }
    }

    /// The previous half-edge around the face.
    #[inline]
    #[must_use]
    pub fn previous(self) -> Self {
        if self.0.is_multiple_of(3) { Self(self.0 + 2) } else { Self(self.0 - 1) }
    }
}
