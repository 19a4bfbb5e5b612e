//! The solution of an edge system whose tangent planes come closest to those of the surface.
//!
//! The nearest solution keeps tangential motion small at the price of a large `ν`, and
//! `D6(r - p) = ν D4(q)` then forces a normal error of order 4 into the rows. Here the normal error
//! itself is minimised, over the seven directions that the equations leave free: two of the 4×6
//! system for each coordinate, and `ν`. What is left undetermined is settled by asking for rows of
//! low degree along the edge and, last, for small motion. All weights against the normal residual
//! are proportional to the turning `θ` of the normals along the edge, because that is how strongly
//! tangential motion acts on it; with fixed weights they would win as the edge shrinks.

use basemesh::{Foot, SurfaceTarget};
use bezier_core::glam::DVec3;
use bezier_core::{Turning, bernstein, binomial};
use nalgebra::{SMatrix, SVector};

use crate::edge_system::{EdgeRows, EdgeSystem};

/// Parameters at which rows and surface are compared: midpoints of nine sections.
const SAMPLES: usize = 9;
/// Weights of the Legendre coefficients of degree 5 and 6 of the rows, over `θ`.
const DEGREE_FIVE: f64 = 0.1;
const DEGREE_SIX: f64 = 0.3;
/// Weight of tangential motion away from the start, over `θ`.
const MOTION: f64 = 1e-3;
/// Weight that determines what nothing else does.
const FLOOR: f64 = 1e-7;
/// Smallest turning that counts, in radians.
const MIN_TURNING: f64 = 1e-3;

/// Free directions: two null vectors for each axis, and `ν`.
const UNKNOWNS: usize = 7;
/// Two normal residuals a sample; two degrees, sides and tangents; six points and two tangents; one
/// for each unknown.
const EQUATIONS: usize = 2 * SAMPLES + 8 + 12 + UNKNOWNS;

/// The two rows of an edge, as `(point index, place among the six unknown points)` per side.
const SIDES: [[usize; 3]; 2] = [[0, 2, 4], [1, 3, 5]];

/// Finds the rows along one edge; `None` if a foot is missing or the solution is not finite.
pub(crate) fn solve(system: &EdgeSystem, target: &dyn SurfaceTarget) -> Option<EdgeRows> {
    let length = system.chord();
    let fit = Fit::new(system, target, length)?;
    let coordinates = fit.least_squares()?;
    let (x, nu) = fit.solution(&coordinates);
    (nu.is_finite() && x.iter().all(|v| v.is_finite())).then(|| system.solution(&(x * length), nu))
}

/// One edge in units of its chord, with its start as the origin.
struct Fit<'a> {
    system: &'a EdgeSystem,
    length: f64,
    start: SMatrix<f64, 6, 3>,
    particular: SMatrix<f64, 6, 3>,
    /// Motion of the six points per unit of `ν`.
    response: SMatrix<f64, 6, 3>,
    null_space: SMatrix<f64, 6, 2>,
    theta: f64,
    /// Two tangent directions of the mean normal, and that normal.
    axes: [DVec3; 3],
    /// Normals of the surface at the samples.
    normals: [DVec3; SAMPLES],
}

impl<'a> Fit<'a> {
    fn new(system: &'a EdgeSystem, target: &dyn SurfaceTarget, length: f64) -> Option<Self> {
        let at = |t: f64| system.curve.eval(t);
        let points: [DVec3; SAMPLES + 5] = std::array::from_fn(|j| {
            at(if j < SAMPLES { parameter(j) } else { (j - SAMPLES) as f64 / 4.0 })
        });
        let mut feet: [Option<Foot>; SAMPLES + 5] = [None; SAMPLES + 5];
        target.feet(&points, &mut feet);
        let mut normals = [DVec3::ZERO; SAMPLES + 5];
        for (slot, foot) in normals.iter_mut().zip(feet) {
            *slot = foot?.normal;
        }
        let Turning { angle, mean } = Turning::of(&normals[SAMPLES..])?;
        let (u, v) = mean.any_orthonormal_pair();

        let a = system.matrix();
        let [constant, linear] = system.right_hand_sides();
        let start = system.start();
        let gram = (a * a.transpose()).cholesky()?;
        let particular = start + a.transpose() * gram.solve(&(constant - a * start));
        let response = a.transpose() * gram.solve(&linear);
        Some(Self {
            system,
            length,
            start: start / length,
            particular: particular / length,
            response: response / length,
            null_space: null_space(&a),
            theta: angle.max(MIN_TURNING),
            axes: [u, v, mean],
            normals: std::array::from_fn(|j| normals[j]),
        })
    }

    /// Motion of one of the six points when one of the unknowns grows by one.
    fn direction(&self, point: usize, unknown: usize) -> DVec3 {
        if unknown == UNKNOWNS - 1 {
            DVec3::from_array(std::array::from_fn(|axis| self.response[(point, axis)]))
        } else {
            self.axes[unknown % 3] * self.null_space[(point, unknown / 3)]
        }
    }

    fn point(points: &SMatrix<f64, 6, 3>, index: usize) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|axis| points[(index, axis)]))
    }

    /// The seven points of the row of one side at the particular solution.
    fn row(&self, side: usize) -> [DVec3; 7] {
        let known = if side == 0 { &self.system.left } else { &self.system.right };
        let origin = self.system.curve.points[0];
        let mut row = known.map(|p| (p - origin) / self.length);
        for (i, &place) in SIDES[side].iter().enumerate() {
            row[2 + i] = Self::point(&self.particular, place);
        }
        row
    }

    fn least_squares(&self) -> Option<SVector<f64, UNKNOWNS>> {
        let mut equations = Equations::default();
        for side in [0, 1] {
            let row = self.row(side);
            self.normal_residuals(side, &row, &mut equations);
            self.high_degrees(side, &row, &mut equations);
        }
        for place in 0..6 {
            let moved = Self::point(&self.particular, place) - Self::point(&self.start, place);
            for tangent in &self.axes[..2] {
                let weight = MOTION * self.theta;
                equations.push(
                    std::array::from_fn(|c| weight * self.direction(place, c).dot(*tangent)),
                    -weight * moved.dot(*tangent),
                );
            }
        }
        for unknown in 0..UNKNOWNS {
            equations.push(std::array::from_fn(|c| if c == unknown { FLOOR } else { 0.0 }), 0.0);
        }
        equations.solve()
    }

    /// `(row(t) - (q_b(t) + q_t(t)) / 2)·n(t) = 0` at the samples.
    ///
    /// `q_b` and `q_t` differ by the derivative of the curve, which is tangential as far as the curve
    /// is on the surface; their mean does not depend on the direction of the edge.
    fn normal_residuals(&self, side: usize, row: &[DVec3; 7], equations: &mut Equations) {
        let origin = self.system.curve.points[0];
        let q = self.system.curve.points.map(|q| (q - origin) / self.length);
        let weight = 1.0 / (SAMPLES as f64).sqrt();
        for (j, normal) in self.normals.iter().enumerate() {
            let sextic = bernstein::<7>(parameter(j));
            let cubic = bernstein::<4>(parameter(j));
            let on_row: DVec3 = row.iter().zip(sextic).map(|(p, b)| *p * b).sum();
            let on_curve: DVec3 =
                q.windows(2).zip(cubic).map(|(q, b)| (q[0] + q[1]) * (0.5 * b)).sum();
            equations.push(
                std::array::from_fn(|c| {
                    let motion = |i: usize| self.direction(SIDES[side][i], c) * sextic[2 + i];
                    weight * (motion(0) + motion(1) + motion(2)).dot(*normal)
                }),
                -weight * (on_row - on_curve).dot(*normal),
            );
        }
    }

    /// Tangential Legendre coefficients of degree 5 and 6 of the row to zero.
    fn high_degrees(&self, side: usize, row: &[DVec3; 7], equations: &mut Equations) {
        for (degree, weight) in [(5, DEGREE_FIVE), (6, DEGREE_SIX)] {
            let coefficients = legendre_coefficients(degree);
            let weight = weight * self.theta;
            for tangent in &self.axes[..2] {
                let value: f64 =
                    row.iter().zip(coefficients).map(|(p, c)| p.dot(*tangent) * c).sum();
                equations.push(
                    std::array::from_fn(|c| {
                        let motion = |i: usize| {
                            self.direction(SIDES[side][i], c).dot(*tangent) * coefficients[2 + i]
                        };
                        weight * (motion(0) + motion(1) + motion(2))
                    }),
                    -weight * value,
                );
            }
        }
    }

    fn solution(&self, coordinates: &SVector<f64, UNKNOWNS>) -> (SMatrix<f64, 6, 3>, f64) {
        let x = SMatrix::<f64, 6, 3>::from_fn(|place, axis| {
            let moved: DVec3 =
                (0..UNKNOWNS).map(|c| self.direction(place, c) * coordinates[c]).sum();
            self.particular[(place, axis)] + moved[axis]
        });
        (x, coordinates[UNKNOWNS - 1])
    }
}

fn parameter(j: usize) -> f64 {
    (j as f64 + 0.5) / SAMPLES as f64
}

/// Weights that turn the Bernstein coefficients of a sextic into its coefficient of degree `l` in
/// the orthonormal Legendre polynomials of [0, 1]:
/// `√(2l+1) Σ_i (-1)^(l+i) C(l,i)² C(6,j) / (C(l+6, i+j) (l+7))`.
fn legendre_coefficients(l: usize) -> [f64; 7] {
    let scale = ((2 * l + 1) as f64).sqrt() / (l + 7) as f64;
    std::array::from_fn(|j| {
        let sum: f64 = (0..=l)
            .map(|i| {
                let sign = if (l + i).is_multiple_of(2) { 1.0 } else { -1.0 };
                sign * binomial(l, i).powi(2) * binomial(6, j) / binomial(l + 6, i + j)
            })
            .sum();
        scale * sum
    })
}

/// Two orthonormal vectors that a 4×6 matrix of full rank maps to zero.
fn null_space(a: &SMatrix<f64, 4, 6>) -> SMatrix<f64, 6, 2> {
    let mut padded = SMatrix::<f64, 6, 6>::zeros();
    padded.fixed_columns_mut::<4>(0).copy_from(&a.transpose());
    padded.qr().q().fixed_columns::<2>(4).into_owned()
}

/// A least-squares problem collected row by row.
struct Equations {
    matrix: SMatrix<f64, EQUATIONS, UNKNOWNS>,
    rhs: SVector<f64, EQUATIONS>,
    count: usize,
}

impl Default for Equations {
    fn default() -> Self {
        Self { matrix: SMatrix::zeros(), rhs: SVector::zeros(), count: 0 }
    }
}

impl Equations {
    fn push(&mut self, row: [f64; UNKNOWNS], value: f64) {
        for (c, entry) in row.into_iter().enumerate() {
            self.matrix[(self.count, c)] = entry;
        }
        self.rhs[self.count] = value;
        self.count += 1;
    }

    fn solve(mut self) -> Option<SVector<f64, UNKNOWNS>> {
        debug_assert_eq!(self.count, EQUATIONS, "every equation is collected");
        let qr = self.matrix.qr();
        qr.q_tr_mul(&mut self.rhs);
        let rhs = self.rhs.fixed_rows::<UNKNOWNS>(0).into_owned();
        qr.r().solve_upper_triangular(&rhs).filter(|x| x.iter().all(|v| v.is_finite()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legendre_coefficients_see_only_their_degree() {
        // t^k in Bernstein form of degree 6 has the coefficients C(i, k) / C(6, k)
        let power =
            |k: usize| -> [f64; 7] { std::array::from_fn(|i| binomial(i, k) / binomial(6, k)) };
        let apply = |l: usize, k: usize| -> f64 {
            legendre_coefficients(l).iter().zip(power(k)).map(|(c, b)| c * b).sum()
        };
        for (l, k) in [(5, 0), (5, 3), (5, 4), (6, 0), (6, 4), (6, 5)] {
            assert!(apply(l, k).abs() <= 1e-15, "degree {l} of t^{k}: {:e}", apply(l, k));
        }
        // leading coefficients of the shifted Legendre polynomials: C(2l, l)
        for (l, leading) in [(5, 252.0), (6, 924.0)] {
            let expected = 1.0 / (leading * ((2 * l + 1) as f64).sqrt());
            assert!((apply(l, l) / expected - 1.0).abs() <= 1e-10, "degree {l}");
        }
    }
}
