//! Triangle meshes of surfaces over the faces and edges of a mesh.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

/// The kind of a patch, as it is written to files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(u8)]
pub enum PatchKind {
    /// Over a convex face, one tetrahedron.
    ConvexFace = 0,
    /// Over a nonconvex face, two tetrahedra.
    NonconvexFace = 1,
    /// A face that is part of the surface.
    FlatFace = 2,
    /// Over a convex edge.
    ConvexEdge = 3,
    /// Over a nonconvex edge.
    NonconvexEdge = 4,
}

/// The face or edge of the mesh that a triangle belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    /// A face.
    Face(FaceId),
    /// An edge.
    Edge(EdgeId),
}

/// A triangle mesh of a surface, without cracks: neighbours share their points by index.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tessellation {
    /// Points on the surface, each once. The first ones are the vertices of the mesh, by id.
    pub positions: Vec<DVec3>,
    /// Unit normals; zero where the surface has none.
    pub normals: Vec<DVec3>,
    /// Points of each triangle, counter-clockwise seen from the positive side.
    pub triangles: Vec<[usize; 3]>,
    /// Face or edge of each triangle.
    pub elements: Vec<Element>,
    /// Kind of patch of each triangle.
    pub kinds: Vec<PatchKind>,
    /// Number of points that are not on the surface, because their transversals do not meet it.
    pub missing: usize,
}

impl Tessellation {
    pub(crate) fn push_point(&mut self, position: DVec3, normal: DVec3) -> usize {
        self.positions.push(position);
        self.normals.push(normal);
        self.positions.len() - 1
    }

    /// Adds a triangle unless two of its corners are the same point.
    pub(crate) fn push_triangle(
        &mut self,
        [a, b, c]: [usize; 3],
        element: Element,
        kind: PatchKind,
    ) {
        if a != b && b != c && c != a {
            self.triangles.push([a, b, c]);
            self.elements.push(element);
            self.kinds.push(kind);
        }
    }

    /// Adds the two triangles of a quadrilateral, counter-clockwise, cut along its shorter diagonal.
    pub(crate) fn push_quad(
        &mut self,
        [a, b, c, d]: [usize; 4],
        element: Element,
        kind: PatchKind,
    ) {
        let length = |i: usize, j: usize| self.positions[i].distance_squared(self.positions[j]);
        let halves = if length(a, c) <= length(b, d) {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        };
        halves.into_iter().for_each(|t| self.push_triangle(t, element, kind));
    }

    /// Volume enclosed by the triangles, if they are closed.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let corners = |t: &[usize; 3]| t.map(|i| self.positions[i]);
        self.triangles.iter().map(corners).map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum()
    }
}

/// Triangles of a lattice with `n` steps along each side, by steps from the first corner towards the
/// second and the third.
pub(crate) fn lattice_triangles(n: usize) -> impl Iterator<Item = [[usize; 2]; 3]> {
    (0..n).flat_map(move |i| {
        (0..n - i).flat_map(move |j| {
            let upright = [[i, j], [i + 1, j], [i, j + 1]];
            let inverted = [[i + 1, j], [i + 1, j + 1], [i, j + 1]];
            std::iter::once(upright).chain((i + j + 2 <= n).then_some(inverted))
        })
    })
}
