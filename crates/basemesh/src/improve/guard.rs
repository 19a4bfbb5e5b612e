//! The tests that every change of a base mesh has to pass.

use glam::DVec3;

use crate::quality::triangle_quality;

/// Limits for a change, all dimensionless.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guard {
    /// Cosine of the largest turning of the surface normal along an edge.
    pub(crate) turning_cos: f64,
    /// Triangles better than this may get worse down to it.
    pub(crate) min_quality: f64,
    /// Triangles worse than `min_quality` may lose this share of their quality.
    pub(crate) quality_keep: f64,
    /// Cosine of the largest turn of a face.
    pub(crate) flip_cos: f64,
    /// Cosine of the largest angle between a face and the surface at its corners.
    pub(crate) lean_cos: f64,
    /// Smallest valence that a change may leave.
    pub(crate) min_valence: usize,
}

/// Why a change was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    /// The surface would stop being a manifold.
    Link,
    /// A vertex would have too few edges.
    Valence,
    /// No surface point near the new vertex.
    Foot,
    /// A face would lean away from the surface at one of its corners.
    Orientation,
    /// A face would turn over.
    Flip,
    /// A triangle would become a sliver.
    Quality,
    /// The surface would turn too far along an edge.
    Turning,
}

/// What a face was before a change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OldFace {
    /// Area vector, any length.
    pub(crate) area: DVec3,
    pub(crate) quality: f64,
    /// Cosine between the face and the surface normal, smallest over the corners.
    pub(crate) lean: f64,
}

impl OldFace {
    pub(crate) fn new(triangle: [DVec3; 3], normals: [DVec3; 3]) -> Self {
        let area = area_vector(triangle);
        Self { area, quality: triangle_quality(triangle), lean: lean(area, normals) }
    }

    /// What two faces were together: the worse of both.
    pub(crate) fn worse(a: Self, b: Self) -> Self {
        Self { area: a.area + b.area, quality: a.quality.min(b.quality), lean: a.lean.min(b.lean) }
    }
}

impl Guard {
    /// Tests a new face against the surface normals at its corners and what it was before.
    pub(crate) fn check_face(
        &self,
        old: &OldFace,
        new: [DVec3; 3],
        normals: [DVec3; 3],
    ) -> Result<(), Refusal> {
        let area = area_vector(new);
        let lean = lean(area, normals);
        // a face that leans too much already must stand up
        if lean <= self.lean_cos.min(old.lean) {
            return Err(Refusal::Orientation);
        }
        if old.area.dot(area) <= self.flip_cos * old.area.length() * area.length() {
            return Err(Refusal::Flip);
        }
        if triangle_quality(new) < self.min_quality.min(self.quality_keep * old.quality) {
            return Err(Refusal::Quality);
        }
        Ok(())
    }

    /// Tests the turning of the surface normal along a new edge; `old_cos` is the worst cosine that
    /// it replaces.
    pub(crate) fn check_turning(&self, n: DVec3, m: DVec3, old_cos: f64) -> Result<(), Refusal> {
        if n.dot(m) < self.turning_cos.min(old_cos) { Err(Refusal::Turning) } else { Ok(()) }
    }

    /// Tests a vertex whose valence falls to `valence`.
    pub(crate) fn check_valence(&self, valence: usize) -> Result<(), Refusal> {
        if valence < self.min_valence { Err(Refusal::Valence) } else { Ok(()) }
    }
}

/// Twice the area times the unit normal.
pub(crate) fn area_vector([p, q, r]: [DVec3; 3]) -> DVec3 {
    (q - p).cross(r - p)
}

/// Smallest cosine between a face and the normals at its corners; zero for a face without area.
fn lean(area: DVec3, normals: [DVec3; 3]) -> f64 {
    let length = area.length();
    if length > 0.0 {
        normals.iter().map(|n| n.dot(area)).fold(f64::INFINITY, f64::min) / length
    } else {
        0.0
    }
}
