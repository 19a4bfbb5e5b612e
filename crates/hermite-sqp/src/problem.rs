//! One edge: end data, samples, and the constrained least-squares problem they pose.
//!
//! The quartic `q` interpolates both end points, has its end tangents in the given directions and
//! the given normal curvatures. With `q1 = q0 + λ t0` and `q3 = q4 + μ t1` the unknowns are
//! `x = (λ, μ, q2)`, five numbers, and the curvature conditions are two equations [TK09 (8)]:
//!
//! ```text
//! c0(x) = 4 λ² k0 - 3 (q2 - q0)·N0 = 0        c1(x) = 4 μ² k1 - 3 (q2 - q4)·N1 = 0
//! ```
//!
//! The objective is `Σ |q(t_j) - p_j|²` over the samples [TK09 (9)], a quadratic `xᵀA x - 2 bᵀx`.
//! Everything inside is in units of the chord `L = |q4 - q0|` with `q0` as the origin, so that
//! tolerances are relative and scaling by a power of two is exact.

use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, SurfaceJet, bernstein};
use nalgebra::{SMatrix, SVector, Vector3};

/// A point that the curve should pass near, and the parameter where it should.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveSample {
    /// Parameter in (0, 1).
    pub t: f64,
    /// Point on the surface.
    pub point: DVec3,
}

/// Why two end points do not pose a problem.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EdgeProblemError {
    /// The end points are equal or not finite.
    NoChord,
    /// The chord is parallel to the normal at an end, so no tangent direction follows from it.
    ChordAlongNormal {
        /// 0 at the start of the edge, 1 at its end.
        end: usize,
    },
}

impl std::fmt::Display for EdgeProblemError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoChord => write!(f, "the end points coincide or are not finite"),
            Self::ChordAlongNormal { end } => {
                let end = if *end == 0 { "start" } else { "end" };
                write!(f, "the chord runs along the surface normal at the {end} of the edge")
            }
        }
    }
}

impl std::error::Error for EdgeProblemError {}

/// One end of the edge in units of the chord.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
    /// Unit tangent pointing into the edge.
    pub(crate) tangent: DVec3,
    /// `N × tangent`.
    pub(crate) sideways: DVec3,
    /// Normal curvature in direction of the tangent, times the chord length.
    pub(crate) curvature: f64,
    /// Second fundamental form on (tangent, sideways) and on (sideways, sideways), times the chord
    /// length.
    twist: f64,
    curvature_sideways: f64,
}

impl End {
    fn new(jet: &SurfaceJet, point: DVec3, tangent: DVec3, chord: f64) -> Self {
        let sideways = jet.normal.cross(tangent);
        Self {
            point,
            normal: jet.normal,
            tangent,
            sideways,
            curvature: jet.normal_curvature(tangent) * chord,
            twist: jet.second_form(tangent, sideways) * chord,
            curvature_sideways: jet.normal_curvature(sideways) * chord,
        }
    }

    /// The second fundamental form of two vectors `(along the tangent, sideways)` in chord lengths:
    /// a length in chord lengths.
    pub(crate) fn second_form(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        a[0] * b[0] * self.curvature
            + (a[0] * b[1] + a[1] * b[0]) * self.twist
            + a[1] * b[1] * self.curvature_sideways
    }
}

/// The unknowns: `(λ, μ, q2)` in units of the chord.
pub(crate) type Unknowns = SVector<f64, 5>;

/// The curve-fitting problem of one edge.
#[derive(Clone, Debug)]
pub struct EdgeProblem {
    /// End points in world coordinates.
    corners: [DVec3; 2],
    pub(crate) chord: f64,
    pub(crate) ends: [End; 2],
    pub(crate) matrix: SMatrix<f64, 5, 5>,
    pub(crate) rhs: Unknowns,
}

pub(crate) fn to_na(v: DVec3) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

impl EdgeProblem {
    /// The problem of the edge from `start` to `end` through `samples` (at least three, with
    /// different parameters inside (0, 1)).
    ///
    /// The end tangents are the projections of the chord into the tangent planes, both pointing
    /// into the edge; the curvatures are the normal curvatures in these directions.
    ///
    /// # Errors
    ///
    /// [`EdgeProblemError`] if the end points coincide or a tangent direction is undefined.
    pub fn new(
        start: &SurfaceJet,
        end: &SurfaceJet,
        samples: &[CurveSample],
    ) -> Result<Self, EdgeProblemError> {
        let chord = start.point.distance(end.point);
        if !(chord > 0.0 && chord.is_finite()) {
            return Err(EdgeProblemError::NoChord);
        }
        let direction = (end.point - start.point) / chord;
        let make_end = |jet: &SurfaceJet, point: DVec3, into: DVec3, index| {
            let tangent = jet
                .tangential(into)
                .try_normalize()
                .ok_or(EdgeProblemError::ChordAlongNormal { end: index })?;
            Ok(End::new(jet, point, tangent, chord))
        };
        let ends =
            [make_end(start, DVec3::ZERO, direction, 0)?, make_end(end, direction, -direction, 1)?];
        let mut problem = Self {
            corners: [start.point, end.point],
            chord,
            ends,
            matrix: SMatrix::zeros(),
            rhs: SVector::zeros(),
        };
        for sample in samples {
            problem.add_sample(sample);
        }
        Ok(problem)
    }

    /// Adds `|q(t) - p|²` to the objective: `A += MᵀM`, `b += Mᵀ(p - fixed part)` with
    /// `M = [B1 t0 | B3 t1 | B2 I]`.
    fn add_sample(&mut self, sample: &CurveSample) {
        let [b0, b1, b2, b3, b4] = bernstein::<5>(sample.t);
        let [start, end] = &self.ends;
        let target = (sample.point - self.corners[0]) / self.chord
            - start.point * (b0 + b1)
            - end.point * (b3 + b4);
        let mut m = SMatrix::<f64, 3, 5>::zeros();
        m.set_column(0, &(to_na(start.tangent) * b1));
        m.set_column(1, &(to_na(end.tangent) * b3));
        for axis in 0..3 {
            m[(axis, 2 + axis)] = b2;
        }
        self.matrix += m.transpose() * m;
        self.rhs += m.transpose() * to_na(target);
    }

    /// Half the gradient of the objective, `A x - b`.
    pub(crate) fn half_gradient(&self, x: &Unknowns) -> Unknowns {
        self.matrix * x - self.rhs
    }

    /// The curvature conditions `(c0, c1)`.
    pub(crate) fn constraints(&self, x: &Unknowns) -> SVector<f64, 2> {
        let q2 = DVec3::new(x[2], x[3], x[4]);
        SVector::from_fn(|i, _| {
            let end = &self.ends[i];
            4.0 * x[i] * x[i] * end.curvature - 3.0 * (q2 - end.point).dot(end.normal)
        })
    }

    /// Gradients of the curvature conditions, one column each.
    pub(crate) fn constraint_gradients(&self, x: &Unknowns) -> SMatrix<f64, 5, 2> {
        let mut gradients = SMatrix::<f64, 5, 2>::zeros();
        for (i, end) in self.ends.iter().enumerate() {
            gradients[(i, i)] = 8.0 * x[i] * end.curvature;
            let normal = to_na(end.normal) * -3.0;
            gradients.fixed_view_mut::<3, 1>(2, i).copy_from(&normal);
        }
        gradients
    }

    /// The curve of these unknowns, in world coordinates.
    pub(crate) fn curve(&self, x: &Unknowns) -> QuarticCurve {
        let [start, end] = &self.ends;
        self.curve_with(start.tangent * x[0], DVec3::new(x[2], x[3], x[4]), end.tangent * x[1])
    }

    /// The curve with these end tangents and middle point, in chord lengths relative to the start
    /// of the edge (the last tangent relative to its end), in world coordinates.
    pub(crate) fn curve_with(&self, first: DVec3, middle: DVec3, last: DVec3) -> QuarticCurve {
        let [q0, q4] = self.corners;
        QuarticCurve::new([
            q0,
            q0 + first * self.chord,
            q0 + middle * self.chord,
            q4 + last * self.chord,
            q4,
        ])
    }
}
