//! All boundary curves, oriented once.

use basemesh::{EdgeMap, HalfedgeId, Topology};
use bezier_core::{QuarticCurve, SepticCurve};

/// A quartic curve for every edge of a mesh, in the direction of the edge's canonical half-edge.
///
/// The end points of each curve are the mesh vertices. Where the curves come from does not matter:
/// a network from another program is a legal input.
#[derive(Clone, Debug)]
pub struct CurveNetwork {
    curves: EdgeMap<QuarticCurve>,
}

impl CurveNetwork {
    /// A network from one curve per edge.
    #[must_use]
    pub const fn new(curves: EdgeMap<QuarticCurve>) -> Self {
        Self { curves }
    }

    /// The curves in canonical direction.
    #[must_use]
    pub fn curves(&self) -> &EdgeMap<QuarticCurve> {
        &self.curves
    }

    /// The curve along a half-edge, from its origin to its target.
    #[must_use]
    pub fn along(&self, topology: &Topology, h: HalfedgeId) -> QuarticCurve {
        let edge = topology.edge(h);
        if topology.canonical(edge) == h { self.curves[edge] } else { self.curves[edge].reversed() }
    }

    /// The same curve written with degree 7.
    #[must_use]
    pub fn elevated_along(&self, topology: &Topology, h: HalfedgeId) -> SepticCurve {
        let edge = topology.edge(h);
        // elevated before it is turned: reversing only permutes, so that both faces of an edge hold
        // the same bits
        let elevated = self.curves[edge].elevate_to();
        if topology.canonical(edge) == h { elevated } else { elevated.reversed() }
    }
}
