//! Any surface of second degree.

use glam::{DMat3, DVec3};

use crate::expression::Expression;
use crate::number::Number;

/// The quadric f = pᵀ A p + b·p + c.
///
/// Of A only the symmetric part (A + Aᵀ)/2 matters.
/// [`Default`] is the ellipsoid with squared semi-axes 2, 1/2, 1/4 whose axes are (1, 1, 0),
/// (1, −1, 0) and z: f = 5/4 (x² + y²) − 3/2 xy + 4 z² − 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quadric {
    /// The quadratic part A.
    pub quadratic: DMat3,
    /// The linear part b.
    pub linear: DVec3,
    /// The constant part c.
    pub constant: f64,
}

impl Default for Quadric {
    fn default() -> Self {
        Self {
            quadratic: DMat3::from_cols_array(&[
                1.25, -0.75, 0.0, //
                -0.75, 1.25, 0.0, //
                0.0, 0.0, 4.0,
            ]),
            linear: DVec3::ZERO,
            constant: -1.0,
        }
    }
}

impl Expression for Quadric {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let a = self.quadratic;
        let (xy, yz, zx) = (
            a.x_axis.y + a.y_axis.x, //
            a.y_axis.z + a.z_axis.y,
            a.z_axis.x + a.x_axis.z,
        );
        let squares = x.square() * a.x_axis.x + y.square() * a.y_axis.y + z.square() * a.z_axis.z;
        let products = x * y * xy + y * z * yz + z * x * zx;
        let b = self.linear;
        squares + products + (x * b.x + y * b.y + z * b.z) + self.constant
    }
}

crate::field_from_expression!(Quadric);
