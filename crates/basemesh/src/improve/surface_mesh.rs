//! An editable mesh whose vertices lie on the target surface.

use glam::DVec3;

use super::edit_mesh::EditMesh;
use crate::ids::{EdgeId, HalfedgeId, VertexId};
use crate::maps::{FaceMap, VertexMap};
use crate::mesh::TriMesh;
use crate::target::{Foot, SurfaceTarget};

/// Points that are projected together; only a granularity of the parallel loop.
const POINTS_PER_BLOCK: usize = 1024;

/// A foot farther away than this many times the longest edge at its vertex lies on another sheet.
const FOOT_REACH: f64 = 1.0;

/// A closed mesh together with the surface it stands for.
#[derive(Clone)]
pub(crate) struct SurfaceMesh<'a> {
    pub(crate) mesh: EditMesh,
    /// Unit surface normals per vertex slot.
    pub(crate) normals: Vec<DVec3>,
    /// Vertices that are not on the surface, because no foot was found near them. They keep their
    /// position and take their normal from their faces.
    pub(crate) off_surface: Vec<bool>,
    /// Vertices that improvements leave where they are.
    pub(crate) resting: Vec<bool>,
    pub(crate) target: &'a dyn SurfaceTarget,
}

impl<'a> SurfaceMesh<'a> {
    /// A copy of `mesh` with all vertices moved onto the surface.
    ///
    /// # Errors
    ///
    /// The first edge that has one face only.
    pub(crate) fn new(mesh: &TriMesh, target: &'a dyn SurfaceTarget) -> Result<Self, EdgeId> {
        let mesh = EditMesh::from_mesh(mesh)?;
        let resting = vec![false; mesh.vertex_slots()];
        let mut result =
            Self { mesh, normals: Vec::new(), off_surface: Vec::new(), resting, target };
        result.project_all();
        Ok(result)
    }

    /// Moves every vertex onto the surface and takes the normals there.
    ///
    /// The mesh must be compact.
    pub(crate) fn project_all(&mut self) {
        let feet = feet(self.mesh.positions(), self.target);
        let mesh = &self.mesh;
        let projected = VertexMap::from_fn(feet.len(), |v| {
            let near = |foot: &Foot| is_near(foot, mesh.position(v), mesh.longest_edge(v));
            feet[v.index()].filter(near)
        });
        let fallback: Vec<DVec3> = projected
            .iter()
            .map(|(v, foot)| foot.map_or_else(|| self.face_normal(v), |f| f.normal))
            .collect();
        self.normals = fallback;
        self.off_surface = projected.as_slice().iter().map(Option::is_none).collect();
        for (v, foot) in projected.iter() {
            if let Some(foot) = foot {
                self.mesh.set_position(v, foot.point);
            }
        }
    }

    /// The surface point near a vertex to be moved to `near`; `reach` is the size of the mesh there.
    pub(crate) fn foot(&self, near: DVec3, reach: f64) -> Option<Foot> {
        self.target.foot(near).filter(|foot| is_near(foot, near, reach))
    }

    /// Surface points near several points, `None` where there is none.
    pub(crate) fn feet(&self, points: &[DVec3]) -> Vec<Option<Foot>> {
        feet(points, self.target)
    }

    /// Puts a vertex on a surface point; it rests no longer.
    pub(crate) fn put(&mut self, v: VertexId, foot: Foot) {
        self.mesh.set_position(v, foot.point);
        self.normals[v.index()] = foot.normal;
        self.off_surface[v.index()] = false;
        self.resting[v.index()] = false;
    }

    /// Whether a vertex is alive and does not rest.
    #[inline]
    pub(crate) fn is_movable(&self, v: VertexId) -> bool {
        self.mesh.is_live_vertex(v) && !self.resting[v.index()]
    }

    /// Whether both ends of an edge rest.
    #[inline]
    pub(crate) fn is_resting_edge(&self, h: HalfedgeId) -> bool {
        self.resting[self.mesh.origin(h).index()] && self.resting[self.mesh.target(h).index()]
    }

    /// Wakes the vertices that have an edge to one that does not rest.
    pub(crate) fn wake_neighbours(&mut self) {
        let before = self.resting.clone();
        let awake = |h: &HalfedgeId| !before[self.mesh.origin(*h).index()];
        let halfedges = (0..3 * self.mesh.face_slots()).map(HalfedgeId::new);
        let live = halfedges.filter(|&h| self.mesh.is_live_halfedge(h));
        for h in live.filter(awake) {
            self.resting[self.mesh.target(h).index()] = false;
        }
    }

    /// Splits the edge of `h` at a surface point.
    pub(crate) fn split(&mut self, h: HalfedgeId, foot: Foot) {
        self.mesh.split(h, foot.point);
        self.normals.push(foot.normal);
        self.off_surface.push(false);
        self.resting.push(false);
    }

    #[inline]
    pub(crate) fn normal(&self, v: VertexId) -> DVec3 {
        self.normals[v.index()]
    }

    /// Area-weighted unit normal of the faces around a vertex.
    fn face_normal(&self, v: VertexId) -> DVec3 {
        let sum = self.mesh.fan(v).fold(DVec3::ZERO, |sum, h| {
            let [p, q, r] = self.mesh.triangle(h.face());
            sum + (q - p).cross(r - p)
        });
        sum.normalize_or(DVec3::Z)
    }

    /// Removes dead slots.
    pub(crate) fn compact(&mut self) -> Vec<VertexId> {
        let kept = self.mesh.compact();
        keep(&mut self.normals, &kept);
        keep(&mut self.off_surface, &kept);
        keep(&mut self.resting, &kept);
        kept
    }

    /// The mesh, its normals and the vertices off the surface, after a last projection.
    pub(crate) fn finish(mut self) -> (TriMesh, VertexMap<DVec3>, Vec<VertexId>) {
        self.compact();
        self.project_all();
        let off = self.mesh.vertices().filter(|v| self.off_surface[v.index()]).collect();
        (self.mesh.into_mesh(), VertexMap::from_vec(self.normals), off)
    }
}

/// Keeps the values of the vertices in `kept`, in that order.
pub(crate) fn keep<T: Copy>(values: &mut Vec<T>, kept: &[VertexId]) {
    for (new, old) in kept.iter().enumerate() {
        values[new] = values[old.index()];
    }
    values.truncate(kept.len());
}

/// Whether a foot is finite and belongs to a mesh with edges of the length `edge`.
fn is_near(foot: &Foot, from: DVec3, edge: f64) -> bool {
    let reach = FOOT_REACH * edge;
    foot.point.distance_squared(from) <= reach * reach && foot.normal.is_finite()
}

fn feet(points: &[DVec3], target: &dyn SurfaceTarget) -> Vec<Option<Foot>> {
    let blocks = FaceMap::from_fn(points.len().div_ceil(POINTS_PER_BLOCK), |block| {
        let first = block.index() * POINTS_PER_BLOCK;
        let points = &points[first..(first + POINTS_PER_BLOCK).min(points.len())];
        let mut feet = vec![None; points.len()];
        target.feet(points, &mut feet);
        feet
    });
    blocks.into_vec().concat()
}
