//! The solution of an edge system whose tangent planes come closest to those of the surface.
//!
//! The nearest solution keeps tangential motion small at the price of a large `ν`, and
//! `D6(r - p) = ν D4(q)` then forces a normal error of order 4 into the rows. Here the normal error
//! itself is minimised, over the seven directions that the equations leave free: two of the 4×6
//! system for each coordinate, and `ν`. What is left undetermined is settled by asking for rows of
//! low degree along the edge and, last, for small motion. All weights against the normal residual
//! are proportional to the turning `θ` of the normals along the edge, because that is how strongly
//! tangential motion acts on it; with fixed weights they would win as the edge shrinks.

mod basis;

use basemesh::{Foot, SurfaceTarget};
use bezier_core::glam::DVec3;
use bezier_core::{Turning, damped_least_squares};
use nalgebra::{SMatrix, SVector};

use basis::{CUBICS, LEGENDRE, SAMPLES, SEXTICS, parameter};

use crate::edge_system::{EdgeRows, EdgeSystem};

/// Parameters between which the turning of the normals is taken: quarters.
const QUARTERS: usize = 5;
/// Weights of the Legendre coefficients of the high degrees of the rows, over `θ`.
const HIGH_DEGREE_WEIGHTS: [f64; 2] = [0.1, 0.3];
/// Weight of tangential motion away from the start, over `θ`.
const MOTION: f64 = 1e-3;
/// Weight that determines what nothing else does.
const FLOOR: f64 = 1e-7;
/// Smallest turning that counts, in radians.
const MIN_TURNING: f64 = 1e-3;

/// Free directions: two null vectors for each axis, and `ν`.
const UNKNOWNS: usize = 7;
const NU: usize = 6;
/// Normal residuals of the samples and high degrees in two tangent directions, for both sides; motion
/// by `ν`.
const EQUATIONS: usize = 2 * (SAMPLES + 4) + 1;

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

/// Six points, one a row.
type SixPoints = SMatrix<f64, 6, 3>;

/// One edge in units of its chord, with its start as the origin.
struct Fit<'a> {
    system: &'a EdgeSystem,
    length: f64,
    start: SixPoints,
    particular: SixPoints,
    /// Motion of the six points per unit of `ν`.
    response: SixPoints,
    null_space: [SVector<f64, 6>; 2],
    theta: f64,
    /// Two tangent directions of the mean normal, and that normal.
    axes: [DVec3; 3],
    /// Normals of the surface at the samples.
    normals: [DVec3; SAMPLES],
}

impl<'a> Fit<'a> {
    fn new(system: &'a EdgeSystem, target: &dyn SurfaceTarget, length: f64) -> Option<Self> {
        let (normals, Turning { angle, mean }) = normals(system, target)?;
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
            normals,
        })
    }

    /// The seven points of the row of one side at the particular solution.
    fn row(&self, side: usize) -> [DVec3; 7] {
        let known = if side == 0 { &self.system.left } else { &self.system.right };
        let origin = self.system.curve.points[0];
        let mut row = known.map(|p| (p - origin) / self.length);
        for (i, &place) in SIDES[side].iter().enumerate() {
            row[2 + i] = point(&self.particular, place);
        }
        row
    }

    fn least_squares(&self) -> Option<[f64; UNKNOWNS]> {
        let mut equations = Equations::default();
        for side in [0, 1] {
            let row = self.row(side);
            self.normal_residuals(side, &row, &mut equations);
            self.high_degrees(side, &row, &mut equations);
        }
        let damping = self.motion(&mut equations);
        debug_assert_eq!(equations.count, EQUATIONS, "every equation is collected");
        damped_least_squares(&mut equations.columns, &mut equations.rhs, &damping)
    }

    /// Motion of a weighted sum of the three points of one side when the unknowns grow by one: along
    /// each axis for the two null vectors, and for `ν`.
    fn side_motion(&self, side: usize, weights: [f64; 3]) -> ([f64; 2], DVec3) {
        let places = SIDES[side];
        let sum =
            |values: [f64; 3]| -> f64 { values.iter().zip(weights).map(|(x, w)| x * w).sum() };
        let along = [0, 1].map(|k| sum(places.map(|place| self.null_space[k][place])));
        let by_nu = [0, 1, 2].map(|axis| sum(places.map(|place| self.response[(place, axis)])));
        (along, DVec3::from_array(by_nu))
    }

    /// `(row(t) - (q_b(t) + q_t(t)) / 2)·n(t) = 0` at the samples.
    ///
    /// `q_b` and `q_t` differ by the derivative of the curve, which is tangential as far as the curve
    /// is on the surface; their mean does not depend on the direction of the edge.
    fn normal_residuals(&self, side: usize, row: &[DVec3; 7], equations: &mut Equations) {
        let origin = self.system.curve.points[0];
        let q = self.system.curve.points.map(|q| (q - origin) / self.length);
        let middles: [DVec3; 4] = std::array::from_fn(|i| (q[i] + q[i + 1]) * 0.5);
        let weight = 1.0 / (SAMPLES as f64).sqrt();
        for (j, normal) in self.normals.iter().enumerate() {
            let sextic = SEXTICS[j];
            let residual = combined(row, &sextic) - combined(&middles, &CUBICS[j]);
            let (along, by_nu) = self.side_motion(side, [sextic[2], sextic[3], sextic[4]]);
            let leans = self.axes.map(|axis| weight * axis.dot(*normal));
            let mut equation = [0.0; UNKNOWNS];
            for (unknown, entry) in equation[..NU].iter_mut().enumerate() {
                *entry = leans[unknown % 3] * along[unknown / 3];
            }
            equation[NU] = weight * by_nu.dot(*normal);
            equations.push(equation, -weight * residual.dot(*normal));
        }
    }

    /// Tangential Legendre coefficients of degree 5 and 6 of the row to zero.
    fn high_degrees(&self, side: usize, row: &[DVec3; 7], equations: &mut Equations) {
        for (weight, coefficients) in HIGH_DEGREE_WEIGHTS.iter().zip(LEGENDRE.iter()) {
            let weight = weight * self.theta;
            let value = combined(row, coefficients);
            let (along, by_nu) =
                self.side_motion(side, [coefficients[2], coefficients[3], coefficients[4]]);
            for (axis, tangent) in self.axes[..2].iter().enumerate() {
                let mut equation = [0.0; UNKNOWNS];
                equation[axis] = weight * along[0];
                equation[3 + axis] = weight * along[1];
                equation[NU] = weight * by_nu.dot(*tangent);
                equations.push(equation, -weight * value.dot(*tangent));
            }
        }
    }

    /// Tangential motion of the six points, and the unknowns themselves, to zero.
    ///
    /// The null vectors are orthonormal, and both the motion by `ν` and that from the start to the
    /// particular solution are orthogonal to them: the twelve equations of the motion come down to a
    /// damping of each tangential unknown and one equation for `ν`.
    fn motion(&self, equations: &mut Equations) -> [f64; UNKNOWNS] {
        let weight = MOTION * self.theta;
        let moved = self.particular - self.start;
        let (mut square, mut product) = (0.0, 0.0);
        for place in 0..6 {
            let [by_nu, moved] = [&self.response, &moved].map(|motion| point(motion, place));
            for tangent in &self.axes[..2] {
                square += by_nu.dot(*tangent).powi(2);
                product += by_nu.dot(*tangent) * moved.dot(*tangent);
            }
        }
        let size = square.sqrt();
        let mut equation = [0.0; UNKNOWNS];
        equation[NU] = weight * size;
        equations.push(equation, if size > 0.0 { -weight * product / size } else { 0.0 });

        let tangential = weight.hypot(FLOOR);
        [tangential, tangential, FLOOR, tangential, tangential, FLOOR, FLOOR]
    }

    fn solution(&self, coordinates: &[f64; UNKNOWNS]) -> (SixPoints, f64) {
        let nu = coordinates[NU];
        let [first, second] = [0, 3].map(|c| {
            let [u, v, n] = self.axes;
            u * coordinates[c] + v * coordinates[c + 1] + n * coordinates[c + 2]
        });
        let x = SixPoints::from_fn(|place, axis| {
            self.particular[(place, axis)]
                + self.response[(place, axis)] * nu
                + self.null_space[0][place] * first[axis]
                + self.null_space[1][place] * second[axis]
        });
        (x, nu)
    }
}

/// Normals of the surface at the samples of the boundary curve, and their turning along it.
fn normals(system: &EdgeSystem, target: &dyn SurfaceTarget) -> Option<([DVec3; SAMPLES], Turning)> {
    let points: [DVec3; SAMPLES + QUARTERS] = std::array::from_fn(|j| {
        let quarter = |j: usize| j as f64 / (QUARTERS - 1) as f64;
        system.curve.eval(if j < SAMPLES { parameter(j) } else { quarter(j - SAMPLES) })
    });
    let mut feet: [Option<Foot>; SAMPLES + QUARTERS] = [None; SAMPLES + QUARTERS];
    target.feet(&points, &mut feet);
    let mut normals = [DVec3::ZERO; SAMPLES + QUARTERS];
    for (slot, foot) in normals.iter_mut().zip(feet) {
        *slot = foot?.normal;
    }
    let turning = Turning::of(&normals[SAMPLES..])?;
    Some((std::array::from_fn(|j| normals[j]), turning))
}

fn combined<const P: usize>(points: &[DVec3; P], weights: &[f64; P]) -> DVec3 {
    points.iter().zip(weights).fold(DVec3::ZERO, |sum, (&point, &weight)| sum + point * weight)
}

fn point(points: &SixPoints, index: usize) -> DVec3 {
    DVec3::new(points[(index, 0)], points[(index, 1)], points[(index, 2)])
}

/// Two orthonormal vectors that a 4×6 matrix of full rank maps to zero: the last two axes, taken
/// back through the reflections of its QR decomposition.
fn null_space(a: &SMatrix<f64, 4, 6>) -> [SVector<f64, 6>; 2] {
    let mut rows = a.transpose();
    let mut reflections = [(SVector::zeros(), 0.0); 4];
    for k in 0..4 {
        let mut v: SVector<f64, 6> = rows.column(k).into_owned();
        v.rows_mut(0, k).fill(0.0);
        v[k] += v.norm().copysign(v[k]);
        let scale = 2.0 / v.norm_squared();
        for later in k + 1..4 {
            let share = scale * v.dot(&rows.column(later));
            rows.column_mut(later).axpy(-share, &v, 1.0);
        }
        reflections[k] = (v, scale);
    }
    [4, 5].map(|axis| {
        let mut x = SVector::zeros();
        x[axis] = 1.0;
        for (v, scale) in reflections.iter().rev() {
            x -= v * (scale * v.dot(&x));
        }
        x
    })
}

/// A least-squares problem collected row by row.
struct Equations {
    columns: [[f64; EQUATIONS]; UNKNOWNS],
    rhs: [f64; EQUATIONS],
    count: usize,
}

impl Default for Equations {
    fn default() -> Self {
        Self { columns: [[0.0; EQUATIONS]; UNKNOWNS], rhs: [0.0; EQUATIONS], count: 0 }
    }
}

impl Equations {
    fn push(&mut self, row: [f64; UNKNOWNS], value: f64) {
        for (column, entry) in self.columns.iter_mut().zip(row) {
            column[self.count] = entry;
        }
        self.rhs[self.count] = value;
        self.count += 1;
    }
}
