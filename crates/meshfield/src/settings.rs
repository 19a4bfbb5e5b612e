//! How jets are fitted.

use crate::error::JetError;
use crate::polynomial::MAX_DEGREE;

/// Settings of the fit at each vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JetSettings {
    /// Degree of the polynomials, 2 to 4; default 4. Lower where the neighbours do not suffice.
    pub degree: usize,
    /// Points used, at least, for each coefficient; default 1.25.
    pub points_per_coefficient: f64,
    /// Points count with this power of the inverse distance; default 2. Weights do not change the
    /// order of accuracy; they keep far points from spoiling near ones on coarse meshes.
    pub distance_power: i32,
    /// Neighbours along edges whose normal turns by more than this from that of the vertex are not used.
    /// Unit: radians; default 75°.
    pub max_turning: f64,
    /// The same for farther neighbours; default 50°. Where one turns by more, the degree is 2:
    /// polynomials of higher degree over wide arcs, or over parts of rings, bend between their points.
    pub max_far_turning: f64,
    /// Where the polynomial's normal at a neighbour along an edge differs by more than this from the mean
    /// normal of the faces there, the mesh does not resolve the surface, and a lower degree is taken.
    /// Unit: radians; default 20°.
    pub max_normal_error: f64,
    /// The same for polynomials of degree 2: beyond, the jet is of degree 1, with the mean normal of the
    /// faces and the curvatures that the normals along edges show. Default 35°.
    pub max_quadric_error: f64,
    /// Largest condition number of the scaled equations; a lower degree is taken beyond. Default 1e3.
    pub max_condition: f64,
}

impl Default for JetSettings {
    fn default() -> Self {
        Self {
            degree: 4,
            points_per_coefficient: 1.25,
            distance_power: 2,
            max_turning: 75_f64.to_radians(),
            max_far_turning: 50_f64.to_radians(),
            max_normal_error: 20_f64.to_radians(),
            max_quadric_error: 35_f64.to_radians(),
            max_condition: 1e3,
        }
    }
}

impl JetSettings {
    pub(crate) fn check(&self) -> Result<(), JetError> {
        if (2..=MAX_DEGREE).contains(&self.degree) {
            Ok(())
        } else {
            Err(JetError::Degree { degree: self.degree, largest: MAX_DEGREE })
        }
    }
}
