//! What the construction says about a surface.

use super::checks::{Finding, Margins};
use crate::rational::Convexity;

use super::hull::{Cell, Hull};

/// How the quadratic program ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FairnessReport {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Number of smoothness conditions.
    pub conditions: usize,
    /// Solutions of programs with conditions on signs; 0 if the fairest function needed none.
    pub programs: usize,
    /// Conditions on signs that were added for rays.
    pub cuts: usize,
    /// Whether the last solution has all the signs that were asked for.
    pub accurate: bool,
    /// Largest violation of a smoothness condition that is left, in sizes of the solid.
    pub residual: f64,
}

/// The whole surface.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Number of tetrahedra over triangles.
    pub face_tetrahedra: usize,
    /// Number of tetrahedra over edges.
    pub edge_tetrahedra: usize,
    /// Edges that are convex outwards, inwards, and straight.
    pub edges: [usize; 3],
    /// Triangles with tetrahedra on both sides.
    pub two_sided: usize,
    /// Number of points at corners of more than three edges.
    pub cut_corners: usize,
    /// Number of hulls built until one had no findings, or of all tried.
    pub hulls: usize,
    /// What is wrong with the hull; empty for a valid one.
    pub findings: Vec<Finding>,
    /// The smallest margins of the hull.
    pub margins: Margins,
    /// Rays that do not meet the surface exactly once, and the number of all; they are tried where the
    /// signs of the weights do not decide.
    pub bad_rays: [usize; 2],
    /// Rays for which the middle weights of a cubic were changed.
    pub repaired_rays: usize,
    /// The quadratic program of a quintic.
    pub fairness: Option<FairnessReport>,
}

impl Report {
    pub(crate) fn of(hull: &Hull, findings: Vec<Finding>, margins: Margins, hulls: usize) -> Self {
        let faces = hull.cells.iter().filter(|c| matches!(c, Cell::Face(..))).count();
        let of = |kind| hull.edges.iter().filter(|e| e.convexity == kind).count();
        let two_sided = |t: &&super::hull::HullTriangle| t.apices.iter().all(Option::is_some);
        let corner = |o: &&super::PointOrigin| matches!(o, super::PointOrigin::Corner(_));
        Self {
            face_tetrahedra: faces,
            edge_tetrahedra: hull.cells.len() - faces,
            edges: [Convexity::Positive, Convexity::Negative, Convexity::Zero].map(of),
            two_sided: hull.triangles.iter().filter(two_sided).count(),
            cut_corners: hull.origins.iter().filter(corner).count(),
            hulls,
            findings,
            margins,
            bad_rays: [0, 0],
            repaired_rays: 0,
            fairness: None,
        }
    }

    /// Whether nothing is wrong: the tetrahedra fit together and every ray that was tried meets the
    /// surface once.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        let smooth = self.fairness.is_none_or(|f| f.is_smooth());
        self.findings.is_empty() && self.bad_rays[0] == 0 && smooth
    }
}

impl FairnessReport {
    /// Whether the smoothness conditions hold to round-off, which second derivatives over flat
    /// tetrahedra magnify a thousand times and more.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        self.residual <= ROUND_OFF
    }
}

/// Residuals above are no round-off: those of solved programs are at most some 1e-15.
const ROUND_OFF: f64 = 1e-13;
