//! What stays the same when some patches are made again, with other objectives or on a changed mesh.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexMap};
use bezier_core::SepticTriangle;
use g1_triangular::{Earlier, EdgeRows, Plan, PositionalPatch, SmoothPatches};
use hermite_sqp::EdgeOutcome;

use crate::pipeline::Fitted;

/// The results of an earlier fit that hold for the next one as well.
pub(crate) struct Known<'a> {
    mesh: &'a TriMesh,
    patches: &'a SmoothPatches,
    failed_feet: &'a FaceMap<usize>,
    /// The edge of the earlier mesh whose rows are those of an edge.
    rows: EdgeMap<Option<EdgeId>>,
    /// The face of the earlier mesh whose smooth patch is that of a face.
    faces: FaceMap<Option<FaceId>>,
    /// Faces whose positional patch is read once more.
    read: FaceMap<bool>,
}

impl<'a> Known<'a> {
    /// Results of an earlier fit: of `mesh`, and what they are on the mesh `now`.
    pub(crate) fn new(
        (mesh, patches, failed_feet): (&'a TriMesh, &'a SmoothPatches, &'a FaceMap<usize>),
        now: &TriMesh,
        rows: EdgeMap<Option<EdgeId>>,
        faces: FaceMap<Option<FaceId>>,
    ) -> Self {
        let topology = now.topology();
        // rows that are found anew depend on all faces around both ends, and the twists of a patch that
        // is made anew on all around its corners
        let mut around = VertexMap::from_vec(vec![false; topology.vertex_count()]);
        for (edge, _) in rows.iter().filter(|(_, known)| known.is_none()) {
            topology.edge_vertices(edge).into_iter().for_each(|vertex| around[vertex] = true);
        }
        for (face, _) in faces.iter().filter(|(_, known)| known.is_none()) {
            topology.corners(face).into_iter().for_each(|vertex| around[vertex] = true);
        }
        let read = FaceMap::from_fn(topology.face_count(), |face| {
            topology.corners(face).iter().any(|&vertex| around[vertex])
        });
        Self { mesh, patches, failed_feet, rows, faces, read }
    }
}

impl Earlier for Known<'_> {
    /// Positional patches are not kept. Those that are read once more are found again; where only
    /// known results follow, the smooth patch takes their place.
    fn positional(&self, face: FaceId) -> Option<PositionalPatch> {
        let face = self.faces[face].filter(|_| !self.read[face])?;
        Some(PositionalPatch { net: self.patches.nets[face], failed_feet: self.failed_feet[face] })
    }

    fn rows(&self, edge: EdgeId) -> Option<EdgeRows> {
        self.patches.edge_rows(self.mesh, self.rows[edge]?)
    }

    fn patch(&self, face: FaceId) -> Option<SepticTriangle> {
        self.faces[face].map(|face| self.patches.nets[face])
    }
}

/// What stays the same on the same mesh with some curves and objectives changed: those before, and
/// those from now on.
pub(crate) fn unchanged<'a>(
    mesh: &'a TriMesh,
    before: &'a Fitted,
    curves: &EdgeMap<EdgeOutcome>,
    [old_plan, plan]: [&Plan; 2],
) -> Known<'a> {
    let topology = mesh.topology();
    let new_positional = FaceMap::from_fn(topology.face_count(), |face| {
        let edges = face.halfedges().map(|h| topology.edge(h));
        plan.fill[face] != old_plan.fill[face]
            || edges.iter().any(|&edge| curves[edge].curve != before.curves[edge].curve)
    });
    // rows depend on all faces around both ends
    let near = |edge: EdgeId| {
        let ends = topology.edge_vertices(edge);
        ends.iter().any(|&v| topology.fan(v).any(|h| new_positional[h.face()]))
    };
    let rows = EdgeMap::from_fn(topology.edge_count(), |edge| {
        (plan.rows[edge] == old_plan.rows[edge] && !near(edge)).then_some(edge)
    });
    let faces = FaceMap::from_fn(topology.face_count(), |face| {
        let known = plan.inner_points[face] == old_plan.inner_points[face]
            && face.halfedges().into_iter().all(|h| rows[topology.edge(h)].is_some());
        known.then_some(face)
    });
    Known::new((mesh, &before.patches, &before.failed_feet), mesh, rows, faces)
}

#[cfg(test)]
mod tests {
    use basemesh::{PolygonizeSettings, polygonize};
    use g1_triangular::Nothing;
    use implicit::NamedShape;

    use super::*;
    use crate::curves::{fit_curves, refit_curves, vertex_jets};
    use crate::objectives::Objectives;
    use crate::pipeline::{fit_patches, retreat};
    use crate::progress::{Clock, Silent};
    use crate::{FieldSource, Settings};

    /// Patches made again beside those that stay are the same, bit for bit, as if all were made again.
    #[test]
    fn what_stays_the_same_would_be_found_again() {
        let shape = NamedShape::find("double-torus").expect("a shape");
        let field = shape.field();
        let settings = Settings::with_faces(0);
        // a marched mesh as it comes: slivers fold
        let cells = PolygonizeSettings::with_cells(24);
        let mesh = polygonize(&*field, &shape.region, &cells).expect("a mesh");
        let source = FieldSource::new(&*field, mesh.diagonal(), settings.projection);
        let mut silent = Silent;
        let mut clock = Clock::new(&mut silent);

        let jets = vertex_jets(&mesh, &source, &settings).expect("a smooth surface");
        let curves = fit_curves(&mesh, &jets, &source, &settings).expect("curves");
        let mut objectives = Objectives::uniform(mesh.topology(), &settings);
        let mut fitted =
            fit_patches(&mesh, &jets, curves, &source, &objectives, &Nothing, &mut clock)
                .expect("patches");
        let (mut rounds, mut kept) = (0, 0);
        loop {
            let before = objectives.patches.clone();
            if !retreat(&mesh, &jets, &fitted, &source, &mut objectives) {
                break;
            }
            rounds += 1;
            let old = &fitted.curves;
            let curves =
                refit_curves(&mesh, &jets, old, &source, &settings, &objectives).expect("curves");
            let known = unchanged(&mesh, &fitted, &curves, [&before, &objectives.patches]);
            kept += known.faces.iter().flat_map(|(_, face)| *face).count();
            let mut patches = |earlier: &dyn Earlier| {
                let curves = curves.clone();
                fit_patches(&mesh, &jets, curves, &source, &objectives, earlier, &mut clock)
                    .expect("patches")
            };
            let (some, all) = (patches(&known), patches(&Nothing));
            assert!(some.patches.nets == all.patches.nets, "nets");
            assert!(some.patches.weights == all.patches.weights, "weights");
            assert_eq!(some.failed_feet, all.failed_feet, "feet");
            fitted = some;
        }
        assert!(rounds > 0, "no patch folds");
        assert!(kept > 0, "no patch stays");
    }
}
