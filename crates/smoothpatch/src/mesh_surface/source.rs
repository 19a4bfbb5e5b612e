//! From a mesh to a source of feet and second-order data.

use basemesh::glam::DVec3;
use basemesh::{EdgeId, FieldTarget, Foot, SurfaceTarget, TriMesh, VertexId};
use bezier_core::SurfaceJet;
use g1_triangular::SecondOrderData;
use implicit::ProjectionSettings;
use meshfield::{JetError, JetSettings, MeshField, fit_jets, sharp_edges};
use thiserror::Error;

/// Edges that a message names.
const NAMED: usize = 5;

/// Why a mesh does not stand for a smooth closed surface. Vertices count from 0.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MeshSurfaceError {
    /// Nothing can be fitted to the neighbours of some vertex.
    #[error(transparent)]
    Jets(#[from] JetError),
    /// Edges with one face.
    #[error(
        "the mesh is open: {} edges have one face only, {}", edges.len(), named(edges)
    )]
    Open {
        /// The ends of these edges.
        edges: Vec<[usize; 2]>,
    },
    /// Edges that are sharper than the crease angle.
    #[error(
        "the mesh has creases: at {} edges the faces meet at more than {limit_deg:.0}° (the largest \
         angle is {largest_deg:.1}°), {}", edges.len(), named(edges)
    )]
    Creases {
        /// The ends of these edges.
        edges: Vec<[usize; 2]>,
        /// The angle above which an edge is a crease, in degrees.
        limit_deg: f64,
        /// The largest one, in degrees.
        largest_deg: f64,
    },
}

/// The first edges by their ends.
fn named(edges: &[[usize; 2]]) -> String {
    let mut names: Vec<String> =
        edges.iter().take(NAMED).map(|[a, b]| format!("{a}-{b}")).collect();
    if edges.len() > NAMED {
        names.push("…".to_owned());
    }
    names.join(", ")
}

/// The smooth surface that a closed mesh stands for; see [`SharpMesh`](super::SharpMesh) for others.
///
/// `crease_angle` (radians): a mesh whose faces meet at more than that somewhere is not smooth and
/// refused.
///
/// # Errors
///
/// [`MeshSurfaceError`]: an open mesh, creases, vertices without a fit.
pub fn mesh_field(
    mesh: TriMesh,
    settings: &JetSettings,
    crease_angle: f64,
) -> Result<MeshField, MeshSurfaceError> {
    let sharp = sharp_edges(&mesh, crease_angle);
    let ends = |edges: &[EdgeId]| -> Vec<[usize; 2]> {
        let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let ends = |&e: &EdgeId| sorted(mesh.topology().edge_vertices(e).map(VertexId::index));
        edges.iter().map(ends).collect()
    };
    if !sharp.boundary.is_empty() {
        return Err(MeshSurfaceError::Open { edges: ends(&sharp.boundary) });
    }
    if !sharp.creases.is_empty() {
        return Err(MeshSurfaceError::Creases {
            edges: ends(&sharp.creases),
            limit_deg: crease_angle.to_degrees(),
            largest_deg: sharp.largest_angle.to_degrees(),
        });
    }
    let jets = fit_jets(&mesh, settings)?;
    Ok(MeshField::new(mesh, jets)?)
}

/// Feet and second-order data of a mesh. Feet are on the level set; normals and forms are the means of those
/// of the jets nearby.
#[derive(Clone, Copy, Debug)]
pub struct MeshSource<'a> {
    field: &'a MeshField,
    target: FieldTarget<'a>,
}

impl<'a> MeshSource<'a> {
    /// Those of this field.
    #[must_use]
    pub fn new(field: &'a MeshField, projection: ProjectionSettings) -> Self {
        Self { field, target: FieldTarget::new(field, field.mesh().diagonal(), projection) }
    }
}

impl SurfaceTarget for MeshSource<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let point = self.target.foot(near)?.point;
        Some(Foot { point, normal: self.field.normal(point)? })
    }

    fn linear_feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        self.target.linear_feet(points, feet);
        for (foot, &near) in feet.iter_mut().zip(points) {
            *foot = foot.and_then(|Foot { point, .. }| {
                Some(Foot { point, normal: self.field.normal(near)? })
            });
        }
    }
}

impl SecondOrderData for MeshSource<'_> {
    fn surface_jet(&self, _: VertexId, position: DVec3) -> Option<SurfaceJet> {
        self.field.surface_jet(position)
    }
}
