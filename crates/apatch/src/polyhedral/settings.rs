//! Settings of the construction; all numbers are dimensionless.

use std::collections::BTreeMap;

use glam::DVec3;

use super::error::HullError;
use super::polyhedron::Polyhedron;

/// Smoothness and degree of the function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Scheme {
    /// Continuous gradient, degree 3, in closed form \[BCX94 section 4\].
    #[default]
    C1Cubic,
    /// Continuous second derivatives, degree 5, the fairest by a quadratic program.
    C2Quintic,
}

/// Where the points at corners and the apices stand.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct HullSettings {
    /// How far the surface goes into corners of more than three edges, from 0 (cut off down to the
    /// nearest guard) to 1 (the vertex itself); `None` takes the point at which the tangent planes of
    /// a quadric would meet.
    pub alpha: Option<f64>,
    /// Where along an edge the apices of the two corners stand, in lengths of the edge, below 1/2.
    pub tau: f64,
    /// Least height of an apex over its triangle, in square roots of the area.
    pub clearance: f64,
    /// Whether other values are tried where the tetrahedra overlap.
    pub retry: bool,
}

impl Default for HullSettings {
    fn default() -> Self {
        Self { alpha: None, tau: 0.45, clearance: 0.15, retry: true }
    }
}

/// Shape control.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct ShapeControl {
    /// How strongly the surface is pulled inwards, from the apices to the triangles: 0 is the
    /// neutral value, each unit doubles the upper weights. C1 only.
    pub tension: f64,
    /// The same for the triangles at single faces, by index; triangles lie at up to three faces, and
    /// the mean of their tensions counts.
    pub faces: BTreeMap<usize, f64>,
    /// How far the surface goes into single corners of more than three edges, by vertex: see
    /// [`HullSettings::alpha`]. Retries leave it as it is.
    pub corners: BTreeMap<usize, f64>,
    /// Added to the middle weight of every triangle, in units of its longest edge: negative values
    /// cut corners off. C1 only.
    pub cut: f64,
    /// The same for the triangle at single vertices with three edges, by vertex. C1 only.
    pub cuts: BTreeMap<usize, f64>,
    /// Points of single faces where the surface touches them, by face, instead of the centroid or
    /// what is found for the face.
    pub guards: BTreeMap<usize, DVec3>,
}

impl ShapeControl {
    pub(crate) fn tension_of(&self, face: usize) -> f64 {
        self.faces.get(&face).copied().unwrap_or(self.tension)
    }
}

/// The quadratic program of the quintic.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct FairnessSettings {
    /// Largest number of rounds in which rays that meet the surface several times add conditions.
    pub rounds: usize,
    /// Least value of upper weights, in units of the size of the solid.
    pub margin: f64,
}

impl Default for FairnessSettings {
    fn default() -> Self {
        Self { rounds: 20, margin: 1e-6 }
    }
}

/// Settings of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Settings {
    /// Smoothness and degree.
    pub scheme: Scheme,
    /// Where the points at corners and the apices stand.
    pub hull: HullSettings,
    /// Shape control.
    pub shape: ShapeControl,
    /// The quadratic program of the quintic.
    pub fairness: FairnessSettings,
}

impl Settings {
    /// Refuses numbers with which the construction makes no sense, and ids that do not exist.
    pub(crate) fn check(&self, solid: &Polyhedron) -> Result<(), HullError> {
        let HullSettings { alpha, tau, clearance, .. } = self.hull;
        let (shape, fairness) = (&self.shape, &self.fairness);
        let alphas = shape.corners.values().chain(&alpha).copied();
        for value in alphas {
            within("hull.alpha", value, value > 0.0 && value < 1.0, "between 0 and 1")?;
        }
        within("hull.tau", tau, tau > 0.0 && tau < 0.5, "between 0 and 1/2")?;
        within("hull.clearance", clearance, clearance > 0.0, "positive and finite")?;
        let tensions = shape.faces.values().chain([&shape.tension]).copied();
        for value in tensions {
            within("shape tension", value, value.abs() <= 50.0, "from -50 to 50")?;
        }
        for value in shape.cuts.values().chain([&shape.cut]).copied() {
            within("shape cut", value, true, "finite")?;
        }
        within("fairness.margin", fairness.margin, fairness.margin >= 0.0, "finite, not negative")?;
        let faces = shape.faces.keys().chain(shape.guards.keys());
        exist("face", faces, solid.facets().len())?;
        exist("vertex", shape.corners.keys().chain(shape.cuts.keys()), solid.vertices().len())
    }
}

fn within(
    name: &'static str,
    value: f64,
    valid: bool,
    expected: &'static str,
) -> Result<(), HullError> {
    // NaN is refused as well
    if valid && value.is_finite() {
        Ok(())
    } else {
        Err(HullError::Setting { name, value, expected })
    }
}

fn exist<'a>(
    what: &'static str,
    mut ids: impl Iterator<Item = &'a usize>,
    count: usize,
) -> Result<(), HullError> {
    match ids.find(|&&id| id >= count) {
        Some(&index) => Err(HullError::Missing { what, index, count }),
        None => Ok(()),
    }
}
