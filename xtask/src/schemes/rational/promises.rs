//! What every surface of the scheme promises.

use std::collections::HashMap;

use smoothpatch::apatch::Tessellation;
use smoothpatch::apatch::rational::{RationalSurface, Side};
use smoothpatch::apatch_surface::joints;

use crate::check::Check;
use crate::schemes::Measured;

/// Steps of the grid of transversals, other than those of the construction.
const RAYS: usize = 29;

/// C1, one sheet, valid tetrahedra, and the topology of triangles with `steps` steps along each side.
pub(super) fn promises(surface: &RationalSurface, steps: usize) -> Measured {
    let topology = surface.mesh().topology();
    let joints = joints(surface);
    let (bad, _) = surface.count_bad_transversals(RAYS);
    let wedges = topology.edges().flat_map(|e| Side::BOTH.map(|side| surface.wedge(e, side)));
    let invalid = wedges.flatten().filter(|wedge| !wedge.is_valid()).count();
    let mesh = surface.tessellate(steps, steps);
    let count = |n: usize| i64::try_from(n).expect("invariant: counts fit 32 bits");
    let (euler, rim) = topology_of(&mesh);
    let open = topology.edges().filter(|&edge| topology.is_boundary_edge(edge)).count();
    let missing = mesh.missing + joints.missing;
    Measured {
        faces: topology.face_count(),
        euler,
        kink: Some(joints.normal_angle),
        checks: vec![
            Check::at_most("jump of the value", joints.value_jump, 1e-13),
            Check::at_most("jump of the gradient", joints.gradient_jump, 1e-12),
            Check::at_most("kink, rad", joints.normal_angle, 1e-10),
            Check::at_most("gap", joints.gap / surface.mesh().diagonal(), 1e-14),
            Check::exactly("bad transversals", count(bad), 0),
            Check::exactly("points without a root", count(missing), 0),
            Check::exactly("invalid edge tetrahedra", count(invalid), 0),
            Check::exactly("Euler characteristic", euler, topology.euler_characteristic()),
            Check::exactly("edges at the rim", count(rim), count(open * steps)),
            Check::exactly("folds", count(flipped(&mesh)), 0),
        ],
        ..Measured::default()
    }
}

/// Vertices minus edges plus triangles, and the number of edges with one triangle.
pub(in crate::schemes) fn topology_of(mesh: &Tessellation) -> (i64, usize) {
    let mut edges: HashMap<[usize; 2], usize> = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            *edges.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    let count = |n: usize| i64::try_from(n).expect("invariant: counts fit 32 bits");
    let euler = count(mesh.positions.len()) - count(edges.len()) + count(mesh.triangles.len());
    (euler, edges.values().filter(|n| **n != 2).count())
}

/// Triangles that face away from the normals at all their corners.
fn flipped(mesh: &Tessellation) -> usize {
    let flipped = |t: &&[usize; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions[i]);
        let normal = (b - a).cross(c - a);
        t.iter().all(|&i| normal.dot(mesh.normals[i]) < 0.0)
    };
    mesh.triangles.iter().filter(flipped).count()
}
