//! Where second-order data come from.

use basemesh::{EdgeId, VertexId, VertexMap};
use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, SurfaceJet};

/// Position, unit normal and second fundamental form at the vertices of a mesh.
///
/// An implicit function is one source; data given with a mesh are another (see the implementation
/// for [`VertexMap<SurfaceJet>`]).
pub trait SecondOrderData: Sync {
    /// Data at a vertex of the mesh; `None` where there are none (a singular point).
    ///
    /// The returned position must be `position`.
    fn surface_jet(&self, vertex: VertexId, position: DVec3) -> Option<SurfaceJet>;

    /// The curve of an edge along its canonical half-edge, where that is given: on a boundary that
    /// another surface shares. Its end tangents must be across the normals.
    fn given_curve(&self, edge: EdgeId) -> Option<QuarticCurve> {
        let _ = edge;
        None
    }
}

impl SecondOrderData for VertexMap<SurfaceJet> {
    fn surface_jet(&self, vertex: VertexId, position: DVec3) -> Option<SurfaceJet> {
        self.as_slice()
            .get(vertex.index())
            .map(|jet| SurfaceJet { point: position, ..*jet })
            .filter(|jet| jet.normal.is_finite() && jet.second_fundamental_form.is_finite())
    }
}
