//! How exactly the patches interpolate at the vertices.

use basemesh::{FaceMap, VertexMap};
use bezier_core::{Barycentric, Corner, ParametricPatch, SurfaceJet};
use serde::{Deserialize, Serialize};

use crate::surface::G1Surface;

/// Largest defects at the corners of all patches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interpolation {
    /// Distance of corner and vertex over the diagonal.
    pub position: f64,
    /// Angle between patch normal and given normal, in radians.
    pub normal: f64,
    /// Difference of the second fundamental forms (largest entry) times the shortest edge of the
    /// face.
    pub second_form: f64,
}

/// Compares every patch corner with the second-order data at its vertex.
#[must_use]
pub fn interpolation(surface: &G1Surface) -> Interpolation {
    let diagonal = surface.mesh.diagonal();
    let topology = surface.mesh.topology();
    let corners = FaceMap::from_fn(topology.face_count(), |face| {
        let size = face
            .halfedges()
            .map(|h| surface.mesh.edge_length(topology.edge(h)))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        Corner::ALL.map(|corner| {
            let vertex = topology.corners(face)[corner.index()];
            let jet = surface.patches.nets[face].jet(Barycentric::at(corner));
            defect(jet.surface_jet(), &surface.jets, vertex, size)
        })
    });
    let mut worst = Interpolation { position: 0.0, normal: 0.0, second_form: 0.0 };
    for defect in corners.as_slice().iter().flatten() {
        worst.position = worst.position.max(defect.position / diagonal);
        worst.normal = worst.normal.max(defect.normal);
        worst.second_form = worst.second_form.max(defect.second_form);
    }
    worst
}

fn defect(
    corner: Option<SurfaceJet>,
    jets: &VertexMap<SurfaceJet>,
    vertex: basemesh::VertexId,
    size: f64,
) -> Interpolation {
    let given = &jets[vertex];
    let Some(corner) = corner else {
        let none = f64::INFINITY;
        return Interpolation { position: none, normal: none, second_form: none };
    };
    let difference = corner.second_fundamental_form - given.second_fundamental_form;
    let entry = difference.to_cols_array().iter().fold(0.0_f64, |max, x| max.max(x.abs()));
    Interpolation {
        position: corner.point.distance(given.point),
        normal: corner.normal.cross(given.normal).length().atan2(corner.normal.dot(given.normal)),
        second_form: entry * size,
    }
}
