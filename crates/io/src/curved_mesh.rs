//! Meshes of curved elements through points of a surface.

use basemesh::{FaceMap, Topology};
use bezier_core::{BezierTriangle, MultiIndex};
use glam::DVec3;

use crate::lattice::Lattice;

/// A mesh of Lagrange triangles and quadrilaterals of one order: polynomials of that degree through
/// their nodes, which lie at equal steps of the parameters. Shared nodes are stored once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurvedMesh {
    /// Polynomial degree, at least one.
    pub order: usize,
    /// Positions of the nodes.
    pub points: Vec<DVec3>,
    /// The nodes of each triangle in the order of [`MultiIndex::rank`], one triangle after the
    /// other.
    pub triangles: Vec<usize>,
    /// The nodes of each quadrilateral, in rows of `order + 1` from its first side to the opposite
    /// one.
    pub quads: Vec<usize>,
}

impl CurvedMesh {
    /// The triangles through points on patches.
    ///
    /// A patch of degree `order` or less is held exactly, up to the rounding of the points. Shared
    /// points are taken from one of the patches, so neighbours use the same bits.
    ///
    /// # Panics
    ///
    /// If `order` is zero or there is not one patch per face.
    #[must_use]
    pub fn from_patches<const P: usize>(
        topology: &Topology,
        nets: &FaceMap<BezierTriangle<DVec3, P>>,
        order: usize,
    ) -> Self {
        assert_eq!(nets.len(), topology.face_count(), "one patch per face");
        let lattice = Lattice::new(topology, order);
        let ranks = 0..MultiIndex::count(order);
        let of_face = |face| ranks.clone().map(move |rank| (face, rank));
        let nodes = topology.faces().flat_map(of_face);
        let triangles = nodes.map(|(face, rank)| lattice.locate(face, rank).0).collect();
        Self { order, points: lattice.sample(nets), triangles, quads: Vec::new() }
    }

    /// Nodes of a triangle and of a quadrilateral.
    #[must_use]
    pub fn nodes_each(&self) -> [usize; 2] {
        [MultiIndex::count(self.order), (self.order + 1) * (self.order + 1)]
    }

    /// Number of triangles and of quadrilaterals.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        let [triangle, quad] = self.nodes_each();
        [self.triangles.len() / triangle, self.quads.len() / quad]
    }
}
