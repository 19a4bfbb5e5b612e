//! Objectives are chosen per element: a choice changes that element and nothing far from it.

mod common;

use common::twisted;
use g1_triangular::basemesh::{FaceId, HalfedgeId};
use g1_triangular::{
    Fill, InnerPoints, JoinError, Plan, Rows, Settings, SmoothPatches, fill, join,
};

fn changed(a: &SmoothPatches, b: &SmoothPatches) -> Vec<FaceId> {
    a.nets.iter().filter(|(face, net)| **net != b.nets[*face]).map(|(face, _)| face).collect()
}

#[test]
fn uniform_plans_have_a_choice_for_every_element() {
    let it = twisted(0.1);
    let topology = it.mesh.topology();
    let plan = Plan::uniform(topology, Settings::default());
    assert_eq!(Settings::default(), Settings::REFINED);
    assert_eq!(plan.fill.len(), topology.face_count());
    assert_eq!(plan.inner_points.len(), topology.face_count());
    assert_eq!(plan.rows.len(), topology.edge_count());
}

#[test]
fn choices_act_locally_and_stay_exact() {
    let it = twisted(0.1);
    let topology = it.mesh.topology();
    let plan = it.plan(Settings::REFINED);
    let whole = it.construct(&plan);
    let face = FaceId::new(41);
    let edge = topology.edge(face.halfedge(1));

    let mut other = plan.clone();
    other.inner_points[face] = InnerPoints::Keep;
    assert_eq!(changed(&whole, &it.construct(&other)), [face], "inner points");

    let mut other = plan.clone();
    other.rows[edge] = Rows::Nearest;
    let h = topology.canonical(edge);
    let mut faces = [h, topology.twin(h).unwrap()].map(HalfedgeId::face);
    faces.sort();
    let patches = it.construct(&other);
    assert_eq!(changed(&whole, &patches), faces, "rows");
    assert_eq!(
        whole
            .weights
            .iter()
            .filter(|(e, w)| **w != patches.weights[*e])
            .map(|(e, _)| e)
            .collect::<Vec<_>>(),
        [edge]
    );

    let mut other = plan.clone();
    other.fill[face] = Fill::Septic;
    let around: Vec<FaceId> = topology
        .faces()
        .filter(|&f| topology.corners(f).iter().any(|v| topology.corners(face).contains(v)))
        .collect();
    let patches = it.construct(&other);
    let touched = changed(&whole, &patches);
    assert!(touched.contains(&face) && touched.iter().all(|f| around.contains(f)), "{touched:?}");
    for edge in topology.edges() {
        let residual = patches.edge_residual(&it.mesh, &it.network, edge).unwrap();
        assert!(residual <= 2e-14, "{edge}: {residual:e}");
    }
}

#[test]
fn a_boundary_is_left_and_all_other_edges_are_smooth() {
    use common::UnitSphere;
    use g1_triangular::CurveNetwork;
    use g1_triangular::basemesh::{EdgeMap, TriMesh};
    use g1_triangular::bezier_core::{LocalEdge, SepticTriangle};
    let it = twisted(0.1);
    let mut faces = it.mesh.face_indices();
    // a vertex with one face only, and larger holes
    faces.truncate(faces.len() - 5);
    let open = TriMesh::new(it.mesh.positions().as_slice().to_vec(), &faces).unwrap();
    let (old, new) = (it.mesh.topology(), open.topology());
    // along a hole the canonical half-edge may run downwards
    let curve = |a, b| {
        let edge = old.edges().find(
            |&e| matches!(old.edge_vertices(e), [c, d] if [c, d] == [a, b] || [d, c] == [a, b]),
        );
        let edge = edge.unwrap();
        let curve = it.network.curves()[edge];
        if old.edge_vertices(edge) == [a, b] { curve } else { curve.reversed() }
    };
    let curves = new.edges().map(|e| new.edge_vertices(e)).map(|[a, b]| curve(a, b)).collect();
    let network = CurveNetwork::new(EdgeMap::from_vec(curves));
    for settings in [Settings::PUBLISHED, Settings::REFINED] {
        let plan = Plan::uniform(new, settings);
        let filled = fill(&open, &network, &UnitSphere, &plan);
        let before = filled.nets.clone();
        let patches = join(&open, &it.jets, &network, filled.nets, &UnitSphere, &plan).unwrap();
        let mut smooth = 0;
        for edge in new.edges() {
            let residual = patches.edge_residual(&open, &network, edge);
            assert_eq!(residual.is_none(), new.is_boundary_edge(edge), "{edge}");
            assert!(residual.is_none_or(|r| r <= 2e-14), "{edge}: {residual:?}");
            smooth += usize::from(residual.is_some());
        }
        assert!(smooth > 20 && smooth < new.edge_count(), "{smooth} edges are smooth");
        for (face, net) in patches.nets.iter() {
            for local in LocalEdge::ALL {
                let boundary = |net: &SepticTriangle| net.boundary::<8>(local);
                assert_eq!(boundary(net), boundary(&before[face]), "curves stay");
            }
        }
    }
}

#[test]
fn curves_that_do_not_fan_out_are_refused() {
    use common::UnitSphere;
    use g1_triangular::CurveNetwork;
    let it = twisted(0.1);
    // all curves leave one vertex with no tangent at all
    let vertex = it.mesh.topology().vertices().nth(9).unwrap();
    let curves = it.network.curves().map(|edge, curve| {
        let mut curve = *curve;
        let [a, b] = it.mesh.topology().edge_vertices(edge);
        if a == vertex {
            curve.points[1] = curve.points[0];
        }
        if b == vertex {
            curve.points[3] = curve.points[4];
        }
        curve
    });
    let network = CurveNetwork::new(curves);
    for settings in [Settings::PUBLISHED, Settings::REFINED] {
        let plan = it.plan(settings);
        let filled = fill(&it.mesh, &network, &UnitSphere, &plan);
        let error = join(&it.mesh, &it.jets, &network, filled.nets, &UnitSphere, &plan);
        assert_eq!(error.unwrap_err(), JoinError::DegenerateFan { vertex: vertex.index() });
    }
}
