//! The tetrahedra: kinds of edges and faces, apices, and their repair.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexMap};
use glam::DVec3;

use super::apex::{Apices, FaceFrame, apices, blocks_of, corner_normals};
use super::error::SurfaceError;
use super::kinds::{self, Convexity, EdgeData, Side};
use super::settings::Settings;
use super::validity::invalid;

/// Everything that is known before the weights.
#[derive(Clone, Debug)]
pub(crate) struct Hull {
    pub(crate) mesh: TriMesh,
    pub(crate) normals: VertexMap<DVec3>,
    pub(crate) edges: EdgeMap<EdgeData>,
    pub(crate) faces: FaceMap<HullFace>,
    /// Edge tetrahedra that are inverted or folded, with their angles.
    pub(crate) invalid: Vec<(EdgeId, Side, f64)>,
    /// Faces that a normal at a corner sees from behind.
    pub(crate) behind: Vec<FaceId>,
    /// Faces whose apices were moved.
    pub(crate) moved: usize,
}

/// A face before its weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HullFace {
    pub(crate) kind: Convexity,
    /// Whether it has no area.
    flat: bool,
    /// Whether a normal at a corner sees it from behind.
    behind: bool,
    pub(crate) apices: Apices,
}

impl HullFace {
    fn new(
        mesh: &TriMesh,
        normals: &VertexMap<DVec3>,
        edges: &EdgeMap<EdgeData>,
        face: FaceId,
        settings: &Settings,
    ) -> Self {
        let frame = FaceFrame::new(mesh.triangle(face));
        let kind = kinds::of_face(mesh, edges, face);
        let normals = corner_normals(mesh, normals, face);
        Self {
            kind,
            flat: !frame.has_area(),
            behind: normals.iter().any(|n| n.dot(frame.normal) <= 0.0),
            apices: apices(&frame, kind, normals, blocks_of(mesh, edges, face), &settings.apices),
        }
    }
}

impl Hull {
    /// Kinds and apices, nothing repaired.
    pub(crate) fn new(
        mesh: TriMesh,
        normals: VertexMap<DVec3>,
        settings: &Settings,
    ) -> Result<Self, SurfaceError> {
        let edges = kinds::edges(&mesh, &normals, settings.straight);
        let faces = FaceMap::from_fn(mesh.topology().face_count(), |face| {
            HullFace::new(&mesh, &normals, &edges, face, settings)
        });
        if let Some((face, _)) = faces.iter().find(|(_, f)| f.flat) {
            return Err(SurfaceError::FlatFace { face: face.index() });
        }
        let invalid = invalid(&mesh, &edges, &faces);
        let behind = faces.iter().filter(|(_, f)| f.behind).map(|(face, _)| face).collect();
        Ok(Self { mesh, normals, edges, faces, invalid, behind, moved: 0 })
    }

    /// Plane and size of a face.
    #[inline]
    pub(crate) fn frame(&self, face: FaceId) -> FaceFrame {
        FaceFrame::new(self.mesh.triangle(face))
    }

    /// Number of things wrong.
    pub(crate) fn defects(&self) -> usize {
        self.invalid.len() + self.behind.len()
    }
}
