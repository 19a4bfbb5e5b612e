//! Areas, by adaptive quadrature.

use basemesh::FaceId;
use bezier_core::Barycentric;
use glam::{DVec2, DVec3};

use crate::surface::{NagataSurface, Patch};

/// Most halvings of a patch in each direction. Smooth patches need three or four for 1e-12; where a
/// patch folds over, the area element is not smooth and the accuracy may not be reached.
const MAX_DEPTH: u32 = 6;

/// An area and a bound for its error, estimated from the last refinement; unit: length squared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Area {
    /// The area.
    pub value: f64,
    /// Estimated error; for smooth patches far larger than the real one.
    pub error: f64,
}

impl Patch {
    /// The area to this relative accuracy, 1e-9 for example; values below 1e-14 are raised to that.
    ///
    /// The patch is cut in four until formulas of degree five for the whole and for the parts agree,
    /// at most six times. If that is not enough, as it may be where a patch folds over, the error
    /// says so.
    #[must_use]
    pub fn area(&self, accuracy: f64) -> Area {
        match self {
            Self::Triangle(p) => over_triangle(|at| p.area_normal(at), accuracy),
            Self::TangentPlane(p) => over_triangle(|at| p.area_normal(at), accuracy),
            Self::Quad(p) => {
                let halves =
                    [[DVec2::ZERO, DVec2::X, DVec2::ONE], [DVec2::ZERO, DVec2::ONE, DVec2::Y]];
                integrate(&|at| p.area_normal(at.to_array()).length(), &halves, accuracy)
            }
        }
    }
}

impl NagataSurface {
    /// The area of all patches, each to this relative accuracy; see [`Patch::area`].
    #[must_use]
    pub fn area(&self, accuracy: f64) -> Area {
        let areas = basemesh::FaceMap::from_fn(self.mesh().face_count(), |face: FaceId| {
            self.patch(face).area(accuracy)
        });
        areas.as_slice().iter().fold(Area::default(), |sum, area| Area {
            value: sum.value + area.value,
            error: sum.error + area.error,
        })
    }
}

fn over_triangle(area_normal: impl Fn(Barycentric) -> DVec3, accuracy: f64) -> Area {
    let element = |at: DVec2| area_normal(Barycentric::new(at.x, at.y)).length();
    integrate(&element, &[[DVec2::X, DVec2::Y, DVec2::ZERO]], accuracy)
}

/// The integral over triangles of the parameter plane.
fn integrate(element: &impl Fn(DVec2) -> f64, triangles: &[[DVec2; 3]], accuracy: f64) -> Area {
    let coarse: Vec<f64> = triangles.iter().map(|t| estimate(element, t)).collect();
    let allowed = accuracy.max(1e-14) * coarse.iter().sum::<f64>();
    let mut area = Area::default();
    for (triangle, coarse) in triangles.iter().zip(coarse) {
        let allowed = allowed / triangles.len() as f64;
        refine(element, triangle, coarse, allowed, MAX_DEPTH, &mut area);
    }
    area
}

fn refine(
    element: &impl Fn(DVec2) -> f64,
    triangle: &[DVec2; 3],
    coarse: f64,
    allowed: f64,
    depth: u32,
    area: &mut Area,
) {
    let parts = quarters(triangle);
    let fine = parts.map(|part| estimate(element, &part));
    let sum: f64 = fine.iter().sum();
    let error = (sum - coarse).abs();
    if error <= allowed || depth == 0 {
        area.value += sum;
        area.error += error;
        return;
    }
    for (part, fine) in parts.iter().zip(fine) {
        refine(element, part, fine, 0.25 * allowed, depth - 1, area);
    }
}

fn quarters([a, b, c]: &[DVec2; 3]) -> [[DVec2; 3]; 4] {
    let [ab, bc, ca] = [(*a + *b) * 0.5, (*b + *c) * 0.5, (*c + *a) * 0.5];
    [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
}

/// Radon's formula with seven points, exact for polynomials of degree five.
fn estimate(element: &impl Fn(DVec2) -> f64, [a, b, c]: &[DVec2; 3]) -> f64 {
    let root = 15.0_f64.sqrt();
    let centre = (*a + *b + *c) / 3.0;
    let ring = |weight: f64| {
        // the three points `weight · corner + …` on the lines from the centre to the corners
        [a, b, c].map(|corner| element(centre + (*corner - centre) * weight)).iter().sum::<f64>()
    };
    let near = ring((1.0 + root) / 7.0);
    let far = ring((1.0 - root) / 7.0);
    let sum = element(centre) * (9.0 / 40.0)
        + near * ((155.0 - root) / 1200.0)
        + far * ((155.0 + root) / 1200.0);
    sum * 0.5 * (*b - *a).perp_dot(*c - *a).abs()
}
