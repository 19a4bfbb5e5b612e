//! The blended jets as an implicit function.

use basemesh::{FaceId, FaceMap, TriMesh, VertexMap};
use bezier_core::SurfaceJet;
use glam::DVec3;
use implicit::{
    Aabb, BoundedField, FieldJet, ImplicitField, Interval, Jet1, Jet2, Number, TwiceDifferentiable,
    surface_point,
};

use crate::blend::{Place, corner_weights};
use crate::error::JetError;
use crate::jet::VertexJet;
use crate::tree::TriangleTree;

/// A smooth surface through the vertices of a mesh, as the zero set of a function near it.
///
/// At a point `p` over a triangle, the function is `Σ W_i(p) Q_i(p)`: the heights of `p` over the jets at
/// its corners, with the weights of a partition of unity. It is about the signed distance near the mesh,
/// negative inside; at a vertex it has the jet of that vertex to second order. Across edges it is twice
/// differentiable (but see `docs/math/mesh-surface.md` about concave edges).
///
/// Only points near the mesh have meaningful values. Nothing is known about its range over a box, so
/// nothing can be proven about it by interval arithmetic.
#[derive(Clone, Debug)]
pub struct MeshField {
    mesh: TriMesh,
    jets: VertexMap<VertexJet>,
    tree: TriangleTree,
}

impl MeshField {
    /// Blends jets over the triangles of a mesh.
    ///
    /// # Errors
    ///
    /// [`JetError::FlatFace`].
    ///
    /// # Panics
    ///
    /// If there is not one jet per vertex.
    pub fn new(mesh: TriMesh, jets: VertexMap<VertexJet>) -> Result<Self, JetError> {
        let topology = mesh.topology();
        assert_eq!(jets.len(), topology.vertex_count(), "one jet per vertex");
        let triangles = FaceMap::from_fn(topology.face_count(), |face| mesh.triangle(face));
        let flat = triangles.iter().find(|(_, [a, b, c])| {
            let square = (b - a).cross(c - a).length_squared();
            !(square > 0.0 && square.recip().is_finite())
        });
        if let Some((face, [at, ..])) = flat {
            return Err(JetError::FlatFace { face: face.index(), at: *at });
        }
        let tree = TriangleTree::new(triangles.into_vec());
        Ok(Self { mesh, jets, tree })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// The jets at its vertices.
    #[must_use]
    pub fn jets(&self) -> &VertexMap<VertexJet> {
        &self.jets
    }

    /// Its triangles, ready to be searched.
    #[must_use]
    pub fn tree(&self) -> &TriangleTree {
        &self.tree
    }

    /// Position, normal and second fundamental form at a point near the surface.
    ///
    /// Normal and form are the means of those of the jets nearby, weighted like these. That is as exact in
    /// order as normal and form of the level set, but the weights, which bend it where jets differ, do not
    /// enter. At a vertex both are equal. `None` for points that are not finite.
    #[must_use]
    pub fn surface_jet(&self, p: DVec3) -> Option<SurfaceJet> {
        let at = Jet2::variables(p.to_array());
        let mean = self.blend(p, p.to_array(), |weight, jet| jet.height(at) * weight)?;
        let found = surface_point(&Known(mean.into()), p).ok()?;
        Some(SurfaceJet {
            point: p,
            normal: found.normal,
            second_fundamental_form: found.second_fundamental_form,
        })
    }

    /// The unit normal at a point near the surface: the mean of the normals of the jets nearby, weighted
    /// like these.
    ///
    /// It has the same order as the normal of the level set, but follows no waves where jets differ. `None`
    /// for points that are not finite.
    #[must_use]
    pub fn normal(&self, p: DVec3) -> Option<DVec3> {
        let at = Jet1::variables(p.to_array());
        let mean = self.blend(p, p.to_array(), |weight, jet| jet.height(at) * weight)?;
        DVec3::from_array(mean.gradient).try_normalize()
    }

    fn eval<T: Number>(&self, at: DVec3, p: [T; 3]) -> T {
        self.blend(at, p, |weight, jet| weight * jet.height(p)).unwrap_or(T::constant(f64::NAN))
    }

    /// The sum over the corners of the triangle near `at`, from their weights and their jets; by global
    /// numbers, so that both faces of an edge add in the same order.
    fn blend<T: Number, S: Number>(
        &self,
        at: DVec3,
        p: [T; 3],
        term: impl Fn(T, &VertexJet) -> S,
    ) -> Option<S> {
        let closest = self.tree.closest(at)?;
        let face = FaceId::new(closest.triangle);
        let vertices = self.mesh.topology().corners(face);
        let corners = self.mesh.triangle(face);
        let ids = vertices.map(basemesh::VertexId::index);
        let place = Place { corners, ids, weights: closest.weights };
        let weights = corner_weights(&place, at, p);
        let mut order = [0, 1, 2];
        order.sort_unstable_by_key(|&k| ids[k]);
        order
            .into_iter()
            .filter(|&k| place.weights[k] != 0.0)
            .map(|k| term(weights[k], &self.jets[vertices[k]]))
            .reduce(|sum, term| sum + term)
    }
}

/// Derivatives that are known already.
struct Known(FieldJet);

impl ImplicitField for Known {
    fn value(&self, _: DVec3) -> f64 {
        self.0.value
    }

    fn value_gradient(&self, _: DVec3) -> (f64, DVec3) {
        (self.0.value, self.0.gradient)
    }
}

impl TwiceDifferentiable for Known {
    fn jet(&self, _: DVec3) -> FieldJet {
        self.0
    }
}

impl ImplicitField for MeshField {
    fn value(&self, p: DVec3) -> f64 {
        self.eval(p, p.to_array())
    }

    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let jet = self.eval(p, Jet1::variables(p.to_array()));
        (jet.value, DVec3::from_array(jet.gradient))
    }
}

impl TwiceDifferentiable for MeshField {
    fn jet(&self, p: DVec3) -> FieldJet {
        self.eval(p, Jet2::variables(p.to_array())).into()
    }
}

impl BoundedField for MeshField {
    fn enclosure(&self, _: &Aabb) -> Interval {
        Interval::ENTIRE
    }
}
