//! Faces turned so that neighbours agree.

use std::collections::HashMap;

use glam::DVec3;

use super::error::MeshFileError;

/// A triangle with the number of the face of the file that it comes from.
pub(super) struct Origin<'a> {
    pub(super) faces: &'a [usize],
    /// Numbers in the file of the vertices.
    pub(super) vertices: &'a [usize],
    pub(super) positions: &'a [DVec3],
}

/// Half-edges by edge: the triangle, and whether it runs from the lower vertex to the higher.
type Edges = HashMap<[usize; 2], Vec<(usize, bool)>>;

/// Turns triangles so that all neighbours agree: in each part those that are in the minority; then all of
/// a closed mesh if its volume is negative. Returns how many were turned, and whether all of them.
pub(super) fn orient(
    triangles: &mut [[usize; 3]],
    turned: &mut [bool],
    origin: &Origin<'_>,
) -> Result<bool, MeshFileError> {
    let edges = edges(triangles, origin)?;
    let mut seen = vec![false; triangles.len()];
    for start in 0..triangles.len() {
        if seen[start] {
            continue;
        }
        let part = spread(start, triangles, &edges, &mut seen, turned, origin)?;
        let minority = part.iter().filter(|&&t| turned[t]).count();
        if 2 * minority > part.len() {
            part.iter().for_each(|&t| turned[t] = !turned[t]);
        }
    }
    for (triangle, _) in triangles.iter_mut().zip(&*turned).filter(|(_, turned)| **turned) {
        triangle.swap(1, 2);
    }
    let is_closed = edges.values().all(|faces| faces.len() == 2);
    let inside_out = is_closed && volume(triangles, origin.positions) < 0.0;
    if inside_out {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        turned.iter_mut().for_each(|turned| *turned = !*turned);
    }
    Ok(inside_out)
}

fn edges(triangles: &[[usize; 3]], origin: &Origin<'_>) -> Result<Edges, MeshFileError> {
    let mut edges = Edges::with_capacity(triangles.len() * 3 / 2);
    for (t, corners) in triangles.iter().enumerate() {
        for [a, b] in sides(corners) {
            edges.entry([a.min(b), a.max(b)]).or_default().push((t, a < b));
        }
    }
    let crowded = edges.iter().filter(|(_, faces)| faces.len() > 2).min_by_key(|(ends, _)| **ends);
    match crowded {
        None => Ok(edges),
        Some((&[a, b], faces)) => Err(MeshFileError::NonManifoldEdge {
            a: origin.vertices[a],
            b: origin.vertices[b],
            at: (origin.positions[a] + origin.positions[b]) * 0.5,
            faces: faces.iter().map(|&(t, _)| origin.faces[t]).collect(),
        }),
    }
}

fn sides(&[a, b, c]: &[usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Marks in `turned` what must be turned to agree with `start`; returns all that can be reached.
fn spread(
    start: usize,
    triangles: &[[usize; 3]],
    edges: &Edges,
    seen: &mut [bool],
    turned: &mut [bool],
    origin: &Origin<'_>,
) -> Result<Vec<usize>, MeshFileError> {
    seen[start] = true;
    let mut part = vec![start];
    let mut next = 0;
    while let Some(&t) = part.get(next) {
        next += 1;
        for [a, b] in sides(&triangles[t]) {
            let Some(&[first, second]) =
                edges.get(&[a.min(b), a.max(b)]).and_then(|faces| faces.first_chunk())
            else {
                continue;
            };
            let other = if first.0 == t { second.0 } else { first.0 };
            let agree = first.1 != second.1;
            let wanted = turned[t] == agree;
            if !seen[other] {
                seen[other] = true;
                turned[other] = wanted;
                part.push(other);
            } else if turned[other] != wanted {
                let [first, second] = [t, other].map(|t| origin.faces[t]);
                let [a, b] = [a, b].map(|v| origin.vertices[v]);
                return Err(MeshFileError::OneSided { a, b, first, second });
            }
        }
    }
    Ok(part)
}

/// Six times the enclosed volume.
fn volume(triangles: &[[usize; 3]], positions: &[DVec3]) -> f64 {
    // from a point of the surface, so that a shift does not lose digits
    let base = triangles.first().map_or(DVec3::ZERO, |t| positions[t[0]]);
    triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| positions[v] - base);
            a.dot(b.cross(c))
        })
        .sum()
}
