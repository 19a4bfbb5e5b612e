//! The surface: a hull with the weights of all its tetrahedra.

use glam::DVec3;

use super::checks::{self, Finding, Margins};
use super::cubic::cubic;
use super::error::HullError;
use super::guards::{Guards, guards};
use super::hull::{Cell, Hull};
use super::polyhedron::Polyhedron;
use super::quintic::quintic;
use super::report::Report;
use super::settings::{Scheme, Settings};
use super::single_sheet::repair;
use super::skeleton::{Trial, skeleton};
use crate::bernstein;
use crate::tetrahedron::gradient;

/// A smooth surface that rounds off a solid: the zero set of a piecewise polynomial function on
/// tetrahedra along its edges and corners \[BCX94\].
///
/// It touches the faces at their guards, where the function has the face normal as its gradient. The
/// function is negative inside.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedralSurface {
    pub(crate) hull: Hull,
    pub(crate) degree: usize,
    /// The weights of the cells, one after the other.
    pub(crate) weights: Vec<f64>,
    pub(crate) report: Report,
}

/// Value and derivatives of the function at a point of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellJet {
    /// The point.
    pub point: DVec3,
    /// The value.
    pub value: f64,
    /// The gradient.
    pub gradient: DVec3,
    /// The second derivatives, by columns.
    pub hessian: glam::DMat3,
}

/// Curvatures of the surface through a point, positive where it is round as seen from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Curvatures {
    /// The mean of the principal curvatures. Unit: one over length.
    pub mean: f64,
    /// Their product. Unit: one over area.
    pub gauss: f64,
}

impl CellJet {
    /// Curvatures of the level set through the point; zero where the gradient vanishes.
    #[must_use]
    pub fn curvatures(&self) -> Curvatures {
        let slope = self.gradient.length();
        let Some(normal) = self.gradient.try_normalize() else { return Curvatures::default() };
        let (u, v) = normal.any_orthonormal_pair();
        let form = |a: DVec3, b: DVec3| a.dot(self.hessian * b) / slope;
        let (e, f, g) = (form(u, u), form(u, v), form(v, v));
        Curvatures { mean: 0.5 * (e + g), gauss: e * g - f * f }
    }
}

/// Values tried where the tetrahedra do not fit; `None` is the balanced rule.
const ALPHAS: [Option<f64>; 5] = [None, Some(0.3), Some(0.5), Some(0.7), Some(0.85)];
const TAUS: [f64; 2] = [0.45, 0.3];
const CLEARANCES: [f64; 2] = [0.15, 0.03];

impl PolyhedralSurface {
    /// The surface over a solid.
    ///
    /// Where the tetrahedra do not fit together, other places of the corner points and apices are
    /// tried, as [`HullSettings::retry`](super::HullSettings::retry) allows; what remains is in the
    /// [`report`](Self::report), and the surface is made all the same.
    ///
    /// # Errors
    ///
    /// [`HullError`] for corners that no direction sees from above, faces without guards, shape
    /// control for what does not exist and settings out of range.
    pub fn new(solid: &Polyhedron, settings: &Settings) -> Result<Self, HullError> {
        settings.check(solid)?;
        let (hull, mut report) = hull(solid, settings)?;
        let (degree, weights) = match settings.scheme {
            Scheme::C1Cubic => (3, cubic(&hull, &settings.shape)),
            Scheme::C2Quintic => {
                let (weights, fairness) = quintic(&hull, &report, &settings.fairness);
                report.fairness = Some(fairness);
                (5, weights)
            }
        };
        let mut surface = Self { hull, degree, weights, report };
        surface.report.bad_rays = surface.count_bad_rays(RAYS);
        if settings.scheme == Scheme::C1Cubic && surface.report.bad_rays[0] > 0 {
            surface.report.repaired_rays = repair(&mut surface, &settings.shape, RAYS);
            surface.report.bad_rays = surface.count_bad_rays(RAYS);
        }
        Ok(surface)
    }

    /// From a hull and weights, as of a file; the report is that of the hull's checks and rays.
    ///
    /// # Errors
    ///
    /// [`HullError::Setting`] for a wrong number of weights, or weights that are not finite.
    pub fn from_weights(hull: Hull, degree: usize, weights: Vec<f64>) -> Result<Self, HullError> {
        let wanted = hull.cells.len() * bernstein::count(degree);
        if !matches!(degree, 3 | 5) || weights.len() != wanted {
            let (name, value) = ("number of weights", weights.len() as f64);
            return Err(HullError::Setting { name, value, expected: "20 or 56 a tetrahedron" });
        }
        if let Some(&value) = weights.iter().find(|w| !w.is_finite()) {
            return Err(HullError::Setting { name: "weight", value, expected: "finite" });
        }
        let size = hull.size();
        let (findings, margins) = checks::check(&hull, hull.euler_characteristic, size);
        let report = Report::of(&hull, findings, margins, 0);
        let mut surface = Self { hull, degree, weights, report };
        surface.report.bad_rays = surface.count_bad_rays(RAYS);
        Ok(surface)
    }

    /// The tetrahedra.
    #[must_use]
    pub fn hull(&self) -> &Hull {
        &self.hull
    }

    /// Degree of the function, 3 or 5.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// What was done and what is wrong.
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The weights of a cell by its place in [`Hull::cells`].
    ///
    /// Ordered by their indices: that of the first corner falling, then that of the second, then that
    /// of the third.
    #[inline]
    #[must_use]
    pub fn weights(&self, cell: usize) -> &[f64] {
        let count = bernstein::count(self.degree);
        &self.weights[cell * count..(cell + 1) * count]
    }

    /// Value and derivatives of the function of a cell at barycentric coordinates, also outside of it.
    #[must_use]
    pub fn jet(&self, cell: usize, at: [f64; 4]) -> CellJet {
        let tetrahedron = self.hull.tetrahedron(self.hull.cells[cell]);
        let jet = bernstein::jet(self.degree, self.weights(cell), at);
        let gradients = tetrahedron.gradients();
        let columns = jet.second.map(|row| gradient(row, &gradients));
        let hessian =
            [0, 1, 2].map(|axis| gradient([0, 1, 2, 3].map(|c| columns[c][axis]), &gradients));
        CellJet {
            point: tetrahedron.point(at),
            value: jet.value,
            gradient: gradient(jet.first, &gradients),
            hessian: glam::DMat3::from_cols(hessian[0], hessian[1], hessian[2]),
        }
    }
}

/// Steps of the grid of rays in a cell.
const RAYS: usize = 16;

/// The first hull without findings, or that with the fewest.
pub(crate) fn hull(solid: &Polyhedron, settings: &Settings) -> Result<(Hull, Report), HullError> {
    let guards = guards(solid, &settings.shape)?;
    let own = settings.hull;
    let first = Trial { alpha: own.alpha, tau: own.tau, clearance: own.clearance };
    let retries = ALPHAS.into_iter().flat_map(|alpha| {
        TAUS.into_iter().flat_map(move |tau| {
            CLEARANCES.into_iter().map(move |clearance| Trial { alpha, tau, clearance })
        })
    });
    let allowed = if own.retry { usize::MAX } else { 0 };
    let mut best: Option<(Hull, Vec<Finding>, Margins)> = None;
    let mut hulls = 0;
    for trial in std::iter::once(first).chain(retries.filter(|t| *t != first).take(allowed)) {
        let (hull, findings, margins) = attempt(solid, &guards, trial, settings)?;
        hulls += 1;
        if best.as_ref().is_none_or(|(_, known, _)| findings.len() < known.len()) {
            let done = findings.is_empty();
            best = Some((hull, findings, margins));
            if done {
                break;
            }
        }
    }
    let (hull, findings, margins) = best.expect("invariant: one hull is always tried");
    let report = Report::of(&hull, findings, margins, hulls);
    Ok((hull, report))
}

fn attempt(
    solid: &Polyhedron,
    guards: &Guards,
    trial: Trial,
    settings: &Settings,
) -> Result<(Hull, Vec<Finding>, Margins), HullError> {
    let hull = Hull::new(skeleton(solid, guards, trial, &settings.shape)?)?;
    let characteristic = i64::try_from(solid.euler_characteristic()).unwrap_or(i64::MAX);
    let (findings, margins) = checks::check(&hull, characteristic, solid.size());
    Ok((hull, findings, margins))
}

impl Hull {
    /// Longest side of the bounding box.
    #[must_use]
    pub fn size(&self) -> f64 {
        let grow = |[low, high]: [DVec3; 2], p: &DVec3| [low.min(*p), high.max(*p)];
        let [low, high] = self.points.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], grow);
        (high - low).max_element()
    }
}

impl PolyhedralSurface {
    /// Kind of a cell by its place.
    #[must_use]
    pub fn cell(&self, cell: usize) -> Cell {
        self.hull.cells[cell]
    }
}
