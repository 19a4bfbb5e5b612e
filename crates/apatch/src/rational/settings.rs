//! Settings of the construction; all numbers are dimensionless.

use std::collections::BTreeMap;

use super::error::SurfaceError;

/// How the last free weight of a tetrahedron, the one at its apex, is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FreeWeightRule {
    /// So that the quadric through the face comes closest to the data of the three neighbours, but
    /// not below half the published value. Reproduces quadrics; order 3. \[ours\]
    #[default]
    Clamped,
    /// The larger of the published value \[XHB01 (4.13), (4.16)\] and the bound. Order 2; on very
    /// coarse meshes of mixed convexity often the closer one.
    Published,
}

/// Where the apices of the tetrahedra stand.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ApexSettings {
    /// Distance beyond the last plane that an apex has to pass, in units of the largest of those
    /// distances. Results hardly depend on it.
    pub clearance: f64,
    /// Least height of an apex, in the same unit. Without it (0) nearly flat faces get flat
    /// tetrahedra.
    pub floor: f64,
    /// Least value of that unit, in square roots of the face's area.
    pub least_unit: f64,
}

impl Default for ApexSettings {
    fn default() -> Self {
        Self { clearance: 0.1, floor: 0.25, least_unit: 0.02 }
    }
}

/// What may be done about invalid edge tetrahedra, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RepairSettings {
    /// Move the apices of the faces involved, by a linear program each.
    pub move_apices: bool,
    /// Replace estimated normals by those that are farthest inside the cone of visibility. Given
    /// normals are never changed.
    pub cone_normals: bool,
    /// Split every face into four by one step of Loop's scheme, which rounds the shape. Only if the
    /// normals are estimated: given normals belong to given vertices.
    pub loop_step: bool,
}

impl RepairSettings {
    /// Nothing is repaired, only reported.
    pub const NONE: Self = Self { move_apices: false, cone_normals: false, loop_step: false };
}

impl Default for RepairSettings {
    fn default() -> Self {
        Self { move_apices: true, cone_normals: true, loop_step: true }
    }
}

/// How the bounds that keep the surface a single sheet are found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SheetSettings {
    /// Steps of the grid of transversals along each side of a face, and of an edge patch.
    pub grid: usize,
    /// Whether the worst transversal of a face is refined between the grid points.
    pub refine: bool,
    /// Distance kept from a bound, in units of three times the largest weight next to the face.
    pub margin: f64,
    /// Largest number of sweeps over the edge patches.
    pub max_sweeps: usize,
}

impl Default for SheetSettings {
    fn default() -> Self {
        Self { grid: 24, refine: true, margin: 0.05, max_sweeps: 60 }
    }
}

/// Shape control: where the surface of a face lies between its apex and its triangle.
///
/// A tension of 0 is the rule's choice. Positive tension pulls the surface to the triangle, without
/// limit; negative tension, down to -1, lets it out towards the apex as far as it remains a single
/// sheet. The surface stays smooth whatever the tensions are.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct ShapeControl {
    /// Of every face that is not listed.
    pub tension: f64,
    /// Of single faces, by index in the mesh that is given. After a Loop step, see
    /// [`Report::loop_steps`](super::Report::loop_steps), the four parts of a face have its tension.
    pub faces: BTreeMap<usize, f64>,
}

impl ShapeControl {
    /// The same tension for all faces.
    #[must_use]
    pub fn uniform(tension: f64) -> Self {
        Self { tension, faces: BTreeMap::new() }
    }

    /// The tension of a face.
    #[must_use]
    pub fn of(&self, face: usize) -> f64 {
        self.faces.get(&face).copied().unwrap_or(self.tension)
    }
}

/// Settings of a surface.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Settings {
    /// How the free weights are chosen.
    pub rule: FreeWeightRule,
    /// Shape control.
    pub shape: ShapeControl,
    /// Where the apices stand.
    pub apices: ApexSettings,
    /// What may be done about invalid edge tetrahedra.
    pub repair: RepairSettings,
    /// Single-sheet bounds.
    pub sheet: SheetSettings,
    /// Heights of normals over an edge below this times the product of the lengths count as zero:
    /// the edge is straight there.
    pub straight: f64,
    /// Use the polynomial (split) form for convex faces too.
    pub always_split: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            rule: FreeWeightRule::default(),
            shape: ShapeControl::default(),
            apices: ApexSettings::default(),
            repair: RepairSettings::default(),
            sheet: SheetSettings::default(),
            straight: 1e-9,
            always_split: false,
        }
    }
}

impl Settings {
    /// Refuses numbers with which the construction makes no sense.
    pub(crate) fn check(&self) -> Result<(), SurfaceError> {
        let positive = [
            ("apices.clearance", self.apices.clearance),
            ("apices.floor", self.apices.floor),
            ("apices.least_unit", self.apices.least_unit),
            ("sheet.margin", self.sheet.margin),
            ("straight", self.straight),
        ];
        for (name, value) in positive {
            // NaN is refused as well
            if !(value >= 0.0 && value.is_finite()) {
                let expected = "finite and not negative";
                return Err(SurfaceError::Setting { name, value, expected });
            }
        }
        let grid = self.sheet.grid;
        if !(1..=1024).contains(&grid) {
            let (name, value) = ("sheet.grid", grid as f64);
            return Err(SurfaceError::Setting { name, value, expected: "from 1 to 1024" });
        }
        let tensions = self.shape.faces.values().chain([&self.shape.tension]);
        match tensions.copied().find(|&t| !(t >= -1.0 && t.is_finite())) {
            Some(value) => {
                let expected = "at least -1 and finite";
                Err(SurfaceError::Setting { name: "shape tension", value, expected })
            }
            None => Ok(()),
        }
    }
}
