//! Planar triangles between the guards of one face.

use std::collections::BTreeMap;

use glam::DVec2;

/// Triangles that close what the walks along the loops of a face leave open.
///
/// Two guards that are joined in both directions need nothing. What remains must be polygons without
/// common points, counter-clockwise, and is cut into triangles; `None` if it is not.
pub(crate) fn fill(
    points: &[DVec2],
    steps: &BTreeMap<[usize; 2], usize>,
) -> Option<Vec<[usize; 3]>> {
    let mut next: BTreeMap<usize, usize> = BTreeMap::new();
    for (&[a, b], &count) in steps {
        let back = steps.get(&[b, a]).copied().unwrap_or(0);
        match count.checked_sub(back) {
            // twice the same step, or two ways onwards from one guard
            Some(2..) => return None,
            Some(1) if next.insert(a, b).is_some() => return None,
            // more than one pair would be an edge of more than two triangles
            Some(0) if count > 1 => return None,
            _ => {}
        }
    }
    let mut triangles = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let mut polygon = Vec::new();
        let mut at = start;
        while let Some(onwards) = next.remove(&at) {
            polygon.push(at);
            at = onwards;
        }
        if at != start {
            return None;
        }
        triangles.extend(cut(points, polygon)?);
    }
    Some(triangles)
}

/// Cuts ears off a polygon, the fattest first.
fn cut(points: &[DVec2], mut polygon: Vec<usize>) -> Option<Vec<[usize; 3]>> {
    let mut triangles = Vec::new();
    while polygon.len() > 2 {
        let n = polygon.len();
        let corners = |i: usize| [(i + n - 1) % n, i, (i + 1) % n].map(|c| polygon[c]);
        let fatness = |t: [usize; 3]| {
            let [a, b, c] = t.map(|i| points[i]);
            let longest = [a - b, b - c, c - a].map(DVec2::length_squared);
            (b - a).perp_dot(c - a) / longest.into_iter().fold(0.0, f64::max)
        };
        let is_ear = |&i: &usize| {
            let [a, b, c] = corners(i).map(|k| points[k]);
            let left = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p) >= 0.0;
            let inside = |p: DVec2| left(a, b, p) && left(b, c, p) && left(c, a, p);
            let others = polygon.iter().filter(|k| !corners(i).contains(k));
            // a thin ear would be a triangle without a plane
            fatness(corners(i)) > 1e-6 && !others.into_iter().any(|&k| inside(points[k]))
        };
        let ear = (0..n)
            .filter(is_ear)
            .max_by(|&i, &j| fatness(corners(i)).total_cmp(&fatness(corners(j))).then(j.cmp(&i)))?;
        triangles.push(corners(ear));
        polygon.remove(ear);
    }
    Some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [DVec2; 4] =
        [DVec2::ZERO, DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0), DVec2::new(0.0, 1.0)];

    #[test]
    fn a_square_and_a_pair() {
        let ring = |steps: &[[usize; 2]]| steps.iter().map(|&s| (s, 1)).collect();
        let square = fill(&SQUARE, &ring(&[[0, 1], [1, 2], [2, 3], [3, 0]]));
        assert_eq!(square.expect("a polygon").len(), 2);
        assert_eq!(fill(&SQUARE, &ring(&[[0, 1], [1, 0]])), Some(Vec::new()));
        assert_eq!(fill(&SQUARE, &ring(&[[1, 0], [2, 1], [3, 2], [0, 3]])), None, "clockwise");
    }
}
