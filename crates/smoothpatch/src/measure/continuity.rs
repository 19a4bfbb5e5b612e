//! How patches meet along edges.

use basemesh::{EdgeId, EdgeMap, FaceMap, Topology};
use bezier_core::{Corner, LocalEdge, Seam, SepticTriangle};
use serde::{Deserialize, Serialize};

/// Parameters per edge at which normals are compared, ends included.
pub const SEAM_SAMPLES: usize = 22;

/// Topology of a patch surface and how its patches meet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Continuity {
    /// Number of patches.
    pub faces: usize,
    /// Vertices minus edges plus faces.
    pub euler_characteristic: i64,
    /// Number of connected components.
    pub components: usize,
    /// Whether every edge has two patches.
    pub closed: bool,
    /// Largest distance of corresponding boundary control points; zero bit for bit for a surface
    /// of ours. Unit: length.
    pub position_gap: f64,
    /// Largest angle between the normals of neighbouring patches, in degrees, at
    /// [`SEAM_SAMPLES`] points of every edge; infinite where a patch has no normal.
    pub g1_angle_deg: f64,
    /// Edges that are known to be sharp, which do not count in `g1_angle_deg`.
    #[serde(default)]
    pub sharp_edges: usize,
    /// Largest angle along them, in degrees.
    #[serde(default)]
    pub sharp_angle_deg: f64,
    /// The edge with the largest angle of the others: its two vertices.
    pub worst_edge: Option<[usize; 2]>,
    /// Largest Bernstein coefficient of the tangent-plane determinant along an edge, scaled to
    /// unit chords: bounds the mismatch between the samples too.
    pub coplanarity: f64,
}

/// Two patches seen from their common edge; `None` on a boundary.
#[must_use]
pub fn seam<'a>(
    topology: &Topology,
    nets: &'a FaceMap<SepticTriangle>,
    edge: EdgeId,
) -> Option<Seam<'a, 36>> {
    let h = topology.canonical(edge);
    let w = topology.twin(h)?;
    let local = |corner: usize| LocalEdge::starting_at(Corner::ALL[corner]);
    Some(Seam {
        left: &nets[h.face()],
        left_edge: local(h.corner()),
        right: &nets[w.face()],
        right_edge: local(w.corner()),
    })
}

/// Measures topology, gaps and normal angles of a patch surface.
#[must_use]
pub fn continuity(topology: &Topology, nets: &FaceMap<SepticTriangle>) -> Continuity {
    continuity_beside(topology, nets, &|_, _| false)
}

/// [`continuity`] with the angles along some edges apart: those that `is_sharp` by themselves or by their
/// largest angle, in radians.
#[must_use]
pub fn continuity_beside(
    topology: &Topology,
    nets: &FaceMap<SepticTriangle>,
    is_sharp: &dyn Fn(EdgeId, f64) -> bool,
) -> Continuity {
    struct EdgeMeasure {
        gap: f64,
        angle: f64,
        coplanarity: f64,
    }
    let edges = EdgeMap::from_fn(topology.edge_count(), |edge| {
        seam(topology, nets, edge).map(|seam| EdgeMeasure {
            gap: seam.position_gap::<8>(),
            angle: seam.max_normal_angle(SEAM_SAMPLES).unwrap_or(f64::INFINITY),
            coplanarity: seam.coplanarity_residual::<7>(),
        })
    });
    let mut result = Continuity {
        faces: topology.face_count(),
        euler_characteristic: topology.euler_characteristic(),
        components: topology.component_count(),
        closed: topology.is_closed(),
        position_gap: 0.0,
        g1_angle_deg: 0.0,
        sharp_edges: 0,
        sharp_angle_deg: 0.0,
        worst_edge: None,
        coplanarity: 0.0,
    };
    for (edge, measure) in edges.iter() {
        let Some(measure) = measure else { continue };
        result.position_gap = result.position_gap.max(measure.gap);
        let degrees = measure.angle.to_degrees();
        if is_sharp(edge, measure.angle) {
            result.sharp_edges += 1;
            result.sharp_angle_deg = result.sharp_angle_deg.max(degrees);
            continue;
        }
        result.coplanarity = result.coplanarity.max(measure.coplanarity);
        if result.worst_edge.is_none() || degrees > result.g1_angle_deg {
            result.g1_angle_deg = degrees;
            result.worst_edge = Some(topology.edge_vertices(edge).map(basemesh::VertexId::index));
        }
    }
    result
}
