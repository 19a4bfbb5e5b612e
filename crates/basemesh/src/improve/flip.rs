//! Edge flips towards even valences or the Delaunay condition.

use super::guard::{Guard, OldFace, Refusal};
use super::metric::Metric;
use super::surface_mesh::SurfaceMesh;
use crate::ids::{HalfedgeId, VertexId};

/// What flips are for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FlipGoal {
    /// Valences near 6: the sum of squared differences falls with every flip.
    Valence,
    /// Opposite angles that sum to at most 180°, measured with the lengths of a metric.
    Delaunay(Metric),
}

/// Cap on the sweeps over all edges; observed are up to eight, most flips happen in the first two.
const MAX_SWEEPS: usize = 10;

/// Sines of the sum of opposite angles above this count as Delaunay: four points on a circle would
/// flip for ever otherwise.
const DELAUNAY_SINE: f64 = 1e-9;

/// Flips edges until a sweep over all of them changes nothing; returns the number of flips.
pub(crate) fn flip_edges(surface: &mut SurfaceMesh<'_>, guard: &Guard, goal: FlipGoal) -> usize {
    let mut flips = 0;
    for _ in 0..MAX_SWEEPS {
        let before = flips;
        for h in (0..3 * surface.mesh.face_slots()).map(HalfedgeId::new) {
            let candidate = surface.mesh.is_live_halfedge(h)
                && h < surface.mesh.twin(h)
                && !surface.is_resting_edge(h);
            if candidate && helps(surface, h, goal) && check_flip(surface, guard, h).is_ok() {
                surface.mesh.flip(h);
                flips += 1;
            }
        }
        if flips == before {
            break;
        }
    }
    flips
}

/// The corners of both faces of an edge: its ends, then the opposite corners left and right.
fn quadrilateral(surface: &SurfaceMesh<'_>, h: HalfedgeId) -> [VertexId; 4] {
    let mesh = &surface.mesh;
    [mesh.origin(h), mesh.target(h), mesh.apex(h), mesh.apex(mesh.twin(h))]
}

fn helps(surface: &SurfaceMesh<'_>, h: HalfedgeId, goal: FlipGoal) -> bool {
    let corners = quadrilateral(surface, h);
    match goal {
        FlipGoal::Valence => valence_gain(corners.map(|v| surface.mesh.valence(v))) > 0,
        FlipGoal::Delaunay(metric) => {
            let [a, b, c, d] = corners;
            let squared = |v, w| metric.squared(surface, v, w);
            let left = [squared(b, c), squared(c, a)];
            !is_delaunay(squared(a, b), left, [squared(b, d), squared(d, a)])
        }
    }
}

/// Fall of the sum of squared differences to valence 6, halved.
fn valence_gain([a, b, c, d]: [usize; 4]) -> i64 {
    let valence = |v: usize| i64::try_from(v).unwrap_or(i64::MAX);
    // (v-6)² falls by 2v-13 when v loses an edge and rises by 2v-11 when it gains one
    valence(a) + valence(b) - valence(c) - valence(d) - 2
}

/// Whether the two angles opposite an edge sum to at most a straight angle; all lengths are squared,
/// those of the other sides left and right of the edge.
fn is_delaunay(edge: f64, left: [f64; 2], right: [f64; 2]) -> bool {
    let angle = |[u, v]: [f64; 2]| {
        let cos = (u + v - edge) / (2.0 * (u * v).sqrt());
        ((1.0 - cos * cos).max(0.0).sqrt(), cos)
    };
    let ((sin_l, cos_l), (sin_r, cos_r)) = (angle(left), angle(right));
    sin_l * cos_r + cos_l * sin_r >= -DELAUNAY_SINE
}

/// Tests the two faces and the edge that a flip would make.
fn check_flip(surface: &SurfaceMesh<'_>, guard: &Guard, h: HalfedgeId) -> Result<(), Refusal> {
    let ids @ [a, b, c, d] = quadrilateral(surface, h);
    let mesh = &surface.mesh;
    for end in [a, b] {
        guard.check_valence(mesh.valence(end) - 1)?;
    }
    let [pa, pb, pc, pd] = ids.map(|v| mesh.position(v));
    let [na, nb, nc, nd] = ids.map(|v| surface.normal(v));
    guard.check_turning(nc, nd, na.dot(nb))?;
    let old = OldFace::worse(
        OldFace::new([pa, pb, pc], [na, nb, nc]),
        OldFace::new([pb, pa, pd], [nb, na, nd]),
    );
    guard.check_face(&old, [pa, pd, pc], [na, nd, nc])?;
    guard.check_face(&old, [pb, pc, pd], [nb, nc, nd])?;
    if mesh.are_adjacent(c, d) { Err(Refusal::Link) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn valence_gain_is_the_fall_of_the_squares() {
        let squares = |v: [usize; 4]| -> i64 {
            v.iter().map(|&v| (i64::try_from(v).unwrap() - 6).pow(2)).sum()
        };
        for case in [[7, 7, 5, 5], [6, 6, 6, 6], [4, 9, 3, 8], [5, 5, 7, 7]] {
            let [a, b, c, d] = case;
            let fall = squares(case) - squares([a - 1, b - 1, c + 1, d + 1]);
            assert_eq!(2 * valence_gain(case), fall, "{case:?}");
        }
    }

    #[test]
    fn four_points_on_a_circle_are_delaunay_both_ways() {
        let points = [0.1_f64, 2.2, 1.0, 4.0].map(|t| 3.0 * DVec3::new(t.cos(), t.sin(), 0.0));
        let delaunay = |[a, b, c, d]: [DVec3; 4]| {
            let squared = |p: DVec3, q: DVec3| p.distance_squared(q);
            let left = [squared(b, c), squared(c, a)];
            is_delaunay(squared(a, b), left, [squared(b, d), squared(d, a)])
        };
        let [a, b, c, d] = points;
        assert!(delaunay([a, b, c, d]), "the edge as it is");
        assert!(delaunay([c, d, b, a]), "the edge after a flip");
        assert!(delaunay([a, b, c, 1.1 * d]), "a corner outside the circle");
        assert!(!delaunay([a, b, c, 0.9 * d]), "a corner inside the circle");
    }
}
