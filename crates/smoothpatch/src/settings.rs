//! The union of the stages' settings.

use basemesh::SimplifySettings;
use hermite_sqp::CurveRefinement;
use implicit::ProjectionSettings;
use serde::{Deserialize, Serialize};

/// Which objectives choose among the surfaces that meet all constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Method {
    /// Our objectives: full order of approximation.
    #[default]
    Refined,
    /// The scheme of \[TK09\] with its errata mended: nearest solutions.
    Published,
}

/// Where second fundamental forms at vertices come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SecondForms {
    /// From the source alone.
    #[default]
    Given,
    /// From the source, unless they contradict positions and normals along edges by more than 5 % of the
    /// curvature: then the nearest ones that do not. For estimated data.
    AgreeAlongEdges,
}

/// Settings of [`fit`](crate::fit): every number of every stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The base mesh.
    pub base_mesh: BaseMeshSettings,
    /// Newton projection onto the surface.
    pub projection: ProjectionSettings,
    /// Second fundamental forms at the vertices.
    pub second_forms: SecondForms,
    /// Sections of a curve between its samples: `sections - 1` samples at equidistant parameters.
    pub curve_sections: usize,
    /// The curve of one edge.
    pub curves: hermite_sqp::Settings,
    /// How far curves are drawn towards the surface afterwards.
    pub curve_refinement: CurveRefinement,
    /// The patches.
    pub patches: g1_triangular::Settings,
}

/// How the base mesh is made.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseMeshSettings {
    /// Triangles of the polygonization for each face asked for.
    pub oversampling: usize,
    /// Decimation and improvement, with the number of faces asked for.
    pub simplify: SimplifySettings,
    /// Rounds of spreading the deviation evenly over the faces, each by a fit of its own.
    pub equalising_rounds: usize,
    /// Rounds of local refinement where the mesh does not resolve the surface.
    pub repair_rounds: usize,
}

impl Settings {
    /// Settings of the refined method for about this many patches.
    #[must_use]
    pub fn with_faces(faces: usize) -> Self {
        Self {
            base_mesh: BaseMeshSettings {
                oversampling: 20,
                simplify: SimplifySettings::to_faces(faces),
                equalising_rounds: 2,
                repair_rounds: 4,
            },
            projection: ProjectionSettings::default(),
            second_forms: SecondForms::Given,
            curve_sections: 10,
            curves: hermite_sqp::Settings::default(),
            curve_refinement: CurveRefinement::TangentFree,
            patches: g1_triangular::Settings::REFINED,
        }
    }

    /// These settings with the objectives of a method.
    #[must_use]
    pub fn with_method(mut self, method: Method) -> Self {
        (self.curve_refinement, self.patches) = match method {
            Method::Refined => (CurveRefinement::TangentFree, g1_triangular::Settings::REFINED),
            Method::Published => (CurveRefinement::None, g1_triangular::Settings::PUBLISHED),
        };
        self
    }

    /// The number of faces asked for.
    #[must_use]
    pub fn faces(&self) -> usize {
        self.base_mesh.simplify.faces
    }
}
