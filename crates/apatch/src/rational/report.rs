//! What the construction says about a surface.

use super::kinds::{Convexity, Side};

/// Which normals the surface was built with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum NormalsUsed {
    /// Those that were given.
    #[default]
    Given,
    /// Of the limit surface of Loop's scheme.
    LoopLimit,
    /// Those farthest inside the cones of visibility.
    Cone,
}

/// Numbers of edges or faces by their convexity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KindCounts {
    /// Convex towards the positive side.
    pub positive: usize,
    /// Convex towards the negative side.
    pub negative: usize,
    /// On both sides.
    pub nonconvex: usize,
    /// Straight edges or flat faces.
    pub zero: usize,
}

impl KindCounts {
    pub(crate) fn of(kinds: impl Iterator<Item = Convexity>) -> Self {
        kinds.fold(Self::default(), |mut counts, kind| {
            *match kind {
                Convexity::Positive => &mut counts.positive,
                Convexity::Negative => &mut counts.negative,
                Convexity::Nonconvex => &mut counts.nonconvex,
                Convexity::Zero => &mut counts.zero,
            } += 1;
            counts
        })
    }
}

/// An edge tetrahedron that does not fit between its faces: the surface folds back there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InvalidEdge {
    /// The edge.
    pub edge: usize,
    /// Its vertices.
    pub vertices: [usize; 2],
    /// The side of the tetrahedron.
    pub side: Side,
    /// Its angle in radians: not between 0 and π.
    pub angle: f64,
}

/// The whole surface. Indices are those of the mesh that the surface is built over.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Faces by convexity.
    pub faces: KindCounts,
    /// Edges by convexity.
    pub edges: KindCounts,
    /// Number of tetrahedra over faces.
    pub face_tetrahedra: usize,
    /// Number of tetrahedra over edges.
    pub edge_tetrahedra: usize,
    /// Which normals were used.
    pub normals: NormalsUsed,
    /// Steps of Loop's scheme applied to the mesh, 0 or 1.
    pub loop_steps: usize,
    /// Number of faces whose apices were moved.
    pub moved_apices: usize,
    /// Edge tetrahedra that remain invalid.
    pub invalid_edges: Vec<InvalidEdge>,
    /// Faces that the normal at one of their corners sees from behind.
    pub behind: Vec<usize>,
    /// Convex faces that got both tetrahedra.
    pub promoted: Vec<usize>,
    /// Number of face tetrahedra whose free weight the bound of the face raised.
    pub bounded_faces: usize,
    /// Number of edge tetrahedra that raised the free weights of their faces.
    pub raised_edges: usize,
    /// Sweeps over the edges until nothing had to be raised.
    pub sweeps: usize,
    /// Edges with transversals on which the surface is not a single sheet.
    pub not_single: Vec<usize>,
}

impl Report {
    /// Whether nothing is wrong: the surface is a single sheet over the mesh without folds.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.invalid_edges.is_empty() && self.behind.is_empty() && self.not_single.is_empty()
    }
}
