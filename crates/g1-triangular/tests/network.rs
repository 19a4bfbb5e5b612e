//! Curves are oriented once: both faces of an edge see the same bits.

mod common;

use common::twisted;

#[test]
fn both_directions_hold_the_same_bits() {
    let it = twisted(0.2);
    let topology = it.mesh.topology();
    for h in topology.halfedges() {
        let twin = topology.twin(h).unwrap();
        let along = it.network.along(topology, h);
        assert_eq!(along.reversed(), it.network.along(topology, twin));
        let elevated = it.network.elevated_along(topology, h);
        assert_eq!(elevated.reversed(), it.network.elevated_along(topology, twin));
        let ends = [topology.origin(h), topology.target(h)].map(|v| it.mesh.position(v));
        assert_eq!([along.points[0], along.points[4]], ends);
        assert_eq!([elevated.points[0], elevated.points[7]], ends);
        for t in [0.0, 0.3, 0.5, 0.9, 1.0] {
            let distance = along.eval(t).distance(elevated.eval(t));
            assert!(distance <= 8.0 * f64::EPSILON, "{h} at {t}: {distance:e}");
        }
    }
}

#[test]
fn canonical_curves_run_from_the_lower_vertex() {
    let it = twisted(0.2);
    for (edge, curve) in it.network.curves().iter() {
        let [a, b] = it.mesh.topology().edge_vertices(edge);
        assert!(a < b);
        assert_eq!(curve.points[0], it.mesh.position(a));
        assert_eq!(curve.points[4], it.mesh.position(b));
    }
}
