//! How few faces a mesh of given topology can have.

use crate::mesh::TriMesh;

/// Number of components and the smallest number of faces that keeps them all.
pub(super) fn fewest_faces(mesh: &TriMesh) -> (usize, usize) {
    let eulers = component_eulers(mesh);
    (eulers.len(), eulers.iter().map(|&euler| fewest_faces_of_closed(euler)).sum())
}

/// Smallest number of faces of a closed orientable triangle mesh: 4 for the sphere, 14 for the
/// torus, 24 for the double torus.
///
/// A mesh of `n` vertices has `2 (n - euler)` faces and at most `n (n - 1) / 2` edges. That bound is
/// attained for every genus but 2, which needs one vertex more (Jungerman and Ringel, "Minimal
/// triangulations on orientable surfaces", 1980).
fn fewest_faces_of_closed(euler: i64) -> usize {
    let edges = |n: i64| 3 * (n - euler);
    let vertices = (4_i64..).find(|&n| n * (n - 1) / 2 >= edges(n)).unwrap_or(4);
    let vertices = if euler == -2 { vertices + 1 } else { vertices };
    usize::try_from(2 * (vertices - euler)).unwrap_or(4)
}

/// Euler characteristic of every component of a closed mesh.
fn component_eulers(mesh: &TriMesh) -> Vec<i64> {
    let t = mesh.topology();
    let mut seen = vec![false; t.vertex_count()];
    let mut stack = Vec::new();
    let mut eulers = Vec::new();
    for start in t.vertices() {
        if std::mem::replace(&mut seen[start.index()], true) {
            continue;
        }
        stack.push(start);
        // six times V - E + F; a vertex of valence k has a half of k edges and a third of k faces
        let mut sixfold = 0;
        while let Some(v) = stack.pop() {
            sixfold += 6;
            for h in t.fan(v) {
                sixfold -= 1;
                let w = t.target(h);
                if !std::mem::replace(&mut seen[w.index()], true) {
                    stack.push(w);
                }
            }
        }
        eulers.push(sixfold / 6);
    }
    eulers
}

#[cfg(test)]
mod tests {
    use super::fewest_faces_of_closed;

    #[test]
    fn known_minimal_triangulations() {
        for (euler, faces) in [(2, 4), (0, 14), (-2, 24), (-4, 28)] {
            assert_eq!(fewest_faces_of_closed(euler), faces, "euler characteristic {euler}");
        }
    }
}
