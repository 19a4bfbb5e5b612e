//! From a mesh to a G1 spline.

use basemesh::TriMesh;
use meshfield::{MeshField, subdivided};

use super::source::MeshSource;
use crate::adapt::{Tolerance, fit_dense_mesh_to_tolerance};
use crate::error::FitError;
use crate::pipeline::{fit_dense_mesh, fit_source};
use crate::progress::Progress;
use crate::settings::{SecondForms, Settings};
use crate::surface::G1Surface;

/// Which triangles become patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshBase {
    /// Those of the mesh, with all its vertices.
    Keep,
    /// About as many as the settings say: the mesh is simplified.
    Faces,
    /// As few as an accuracy takes. It is measured against the smooth surface of the mesh.
    Tolerance(Tolerance),
}

/// Triangles of the mesh to start from for each patch asked for: fewer would leave no choice.
const DENSE: usize = 4;
/// The same for an accuracy.
const DENSE_FOR_TOLERANCE: usize = 4000;

/// The G1 spline near the smooth surface of a mesh; second fundamental forms that contradict the normals are
/// changed, see [`SecondForms::AgreeAlongEdges`].
///
/// # Errors
///
/// [`FitError`], as for [`fit_dense_mesh`] and [`fit_source`].
pub fn fit_mesh_field(
    field: &MeshField,
    base: MeshBase,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    let source = MeshSource::new(field, settings.projection);
    let mesh = field.mesh();
    let settings = &Settings { second_forms: SecondForms::AgreeAlongEdges, ..settings.clone() };
    match base {
        MeshBase::Keep => fit_source(&source, mesh.clone(), settings, progress),
        MeshBase::Faces => {
            let dense = with_at_least(mesh, DENSE * settings.faces());
            fit_dense_mesh(dense, &source, settings, progress)
        }
        MeshBase::Tolerance(tolerance) => {
            let dense = with_at_least(mesh, DENSE_FOR_TOLERANCE);
            fit_dense_mesh_to_tolerance(dense, &source, &tolerance, settings, progress)
        }
    }
}

/// The mesh with its triangles cut in four until there are so many.
fn with_at_least(mesh: &TriMesh, faces: usize) -> TriMesh {
    let mut dense = mesh.clone();
    while dense.topology().face_count() < faces {
        dense = subdivided(&dense);
    }
    dense
}
