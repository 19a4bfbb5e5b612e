//! Facets that look the wrong way, turned by flipping edges.

use std::collections::HashMap;

use glam::DVec3;

use crate::tessellate::Tessellation;

/// Passes over the mesh; three or four are enough in practice.
const MAX_PASSES: usize = 20;

impl Tessellation {
    /// Number of facets whose normal points against the sum of the normals at their corners. A facet
    /// without area is not counted, nor is one with a corner that has no normal.
    #[must_use]
    pub fn flipped_facets(&self) -> usize {
        self.flipped().count()
    }

    /// Those facets, by index.
    pub fn flipped(&self) -> impl Iterator<Item = usize> {
        (0..self.triangles.len()).filter(|&t| self.facing(self.triangles[t]) < 0.0)
    }

    /// Cosine of the angle between a facet and the mean of its normals; 0 without area.
    fn facing(&self, triangle: [usize; 3]) -> f64 {
        let [a, b, c] = triangle.map(|i| self.positions[i]);
        let facet = (b - a).cross(c - a).normalize_or_zero();
        let mean: DVec3 = triangle.iter().map(|&i| self.normals[i]).sum();
        facet.dot(mean.normalize_or_zero())
    }

    /// Flips edges of facets that look the wrong way, where that makes the worse of the two facets at
    /// the edge better. The points stay where they are.
    ///
    /// Near points where tetrahedra touch the surface with a corner only, patches are thin slivers
    /// whose chords say nothing about the surface.
    pub(crate) fn unfold(&mut self) {
        for _ in 0..MAX_PASSES {
            let bad: Vec<usize> = (0..self.triangles.len()).filter(|&t| self.is_bad(t)).collect();
            if bad.is_empty() {
                return;
            }
            let mut by_side = self.sides_around(&bad);
            let mut changed = false;
            for t in bad {
                if self.is_bad(t) {
                    changed |= self.flip_best(t, &mut by_side);
                }
            }
            if !changed {
                return;
            }
        }
    }

    fn is_bad(&self, t: usize) -> bool {
        // facets that are nearly on edge are as thin as those that are turned
        self.facing(self.triangles[t]) < 0.2
    }

    /// The sides of all facets that share a corner with one of these.
    fn sides_around(&self, bad: &[usize]) -> HashMap<[usize; 2], usize> {
        let mut near = vec![false; self.positions.len()];
        bad.iter().flat_map(|&t| self.triangles[t]).for_each(|p| near[p] = true);
        let sides =
            |(t, &[a, b, c]): (usize, &[usize; 3])| [[a, b], [b, c], [c, a]].map(|side| (side, t));
        let triangles = self.triangles.iter().enumerate();
        triangles.filter(|(_, t)| t.iter().any(|&p| near[p])).flat_map(sides).collect()
    }

    /// Flips the edge of a facet that gains most; `false` if none gains.
    fn flip_best(&mut self, t: usize, by_side: &mut HashMap<[usize; 2], usize>) -> bool {
        let mut best: Option<(f64, usize, [[usize; 3]; 2])> = None;
        for k in 0..3 {
            let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|i| self.triangles[t][i]);
            let Some(&other) = by_side.get(&[b, a]) else { continue };
            let Some(d) = self.triangles[other].into_iter().find(|p| *p != a && *p != b) else {
                continue;
            };
            if d == c || by_side.contains_key(&[c, d]) || by_side.contains_key(&[d, c]) {
                continue;
            }
            let old = self.facing([a, b, c]).min(self.facing([b, a, d]));
            let pair = [[a, d, c], [d, b, c]];
            let gain = self.facing(pair[0]).min(self.facing(pair[1])) - old;
            if gain > 1e-6 && best.as_ref().is_none_or(|(known, ..)| gain > *known) {
                best = Some((gain, other, pair));
            }
        }
        let Some((_, other, pair)) = best else { return false };
        for triangle in [t, other] {
            let [a, b, c] = self.triangles[triangle];
            for side in [[a, b], [b, c], [c, a]] {
                by_side.remove(&side);
            }
        }
        for (triangle, corners) in [t, other].into_iter().zip(pair) {
            self.triangles[triangle] = corners;
            let [a, b, c] = corners;
            for side in [[a, b], [b, c], [c, a]] {
                by_side.insert(side, triangle);
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tessellate::{Element, PatchKind};
    use basemesh::FaceId;

    #[test]
    fn a_folded_pair() {
        let mut mesh = Tessellation::default();
        // a quadrilateral with a reflex corner, cut along the wrong diagonal
        for p in [[0.0, 0.0], [2.0, 2.0], [0.5, 0.6], [2.0, 3.0]] {
            mesh.push_point(DVec3::new(p[0], p[1], 0.0), DVec3::Z);
        }
        let element = Element::Face(FaceId::new(0));
        mesh.push_triangle([0, 1, 3], element, PatchKind::ConvexFace);
        mesh.push_triangle([0, 3, 2], element, PatchKind::ConvexFace);
        let flipped = mesh.flipped_facets();
        mesh.unfold();
        assert!(mesh.flipped_facets() <= flipped, "never worse");
        mesh.triangles = vec![[0, 1, 2], [1, 3, 2]];
        assert_eq!(mesh.flipped_facets(), 0, "counter-clockwise");
        mesh.triangles = vec![[0, 2, 1], [2, 3, 1]];
        assert_eq!(mesh.flipped_facets(), 2, "clockwise");
    }
}
