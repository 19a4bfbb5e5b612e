//! Polygons cut into triangles.

use glam::DVec3;

/// The corners of the triangles of a polygon, by index; the ear with the shortest cut first, so that a
/// convex quadrilateral is cut along its shorter diagonal. `None` if the outline crosses itself or has no
/// area.
pub(super) fn triangulate(corners: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    if corners.len() == 3 {
        return Some(vec![[0, 1, 2]]);
    }
    let normal = area_normal(corners);
    if normal.length_squared() <= 0.0 {
        return None;
    }
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut triangles = Vec::with_capacity(corners.len() - 2);
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n)
            .filter(|&k| is_ear(corners, &left, k, normal))
            .min_by(|&i, &j| cut(corners, &left, i).total_cmp(&cut(corners, &left, j)))?;
        triangles.push([left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]]);
        left.remove(ear);
    }
    triangles.push([left[0], left[1], left[2]]);
    Some(triangles)
}

/// Twice the area vector of a polygon.
fn area_normal(corners: &[DVec3]) -> DVec3 {
    let first = corners[0];
    corners.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum()
}

/// Squared length of the cut that takes corner `k` away.
fn cut(corners: &[DVec3], left: &[usize], k: usize) -> f64 {
    let n = left.len();
    corners[left[(k + n - 1) % n]].distance_squared(corners[left[(k + 1) % n]])
}

/// Whether corner `k` is convex and its triangle contains no other corner.
fn is_ear(corners: &[DVec3], left: &[usize], k: usize, normal: DVec3) -> bool {
    let n = left.len();
    let [a, b, c] = [(k + n - 1) % n, k, (k + 1) % n].map(|i| corners[left[i]]);
    let turn = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal);
    if turn(a, b, c) <= 0.0 {
        return false;
    }
    left.iter().map(|&i| corners[i]).filter(|&p| p != a && p != b && p != c).all(|p| {
        let inside = turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        !inside
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec3], triangles: &[[usize; 3]]) -> f64 {
        triangles.iter().map(|t| area_normal(&t.map(|i| corners[i])).z / 2.0).sum()
    }

    #[test]
    fn shorter_diagonal_of_a_convex_quadrilateral() {
        let corners =
            [[0.0, 0.0], [3.0, -1.0], [4.0, 3.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let triangles = triangulate(&corners).expect("convex");
        assert!(triangles.iter().all(|t| t.contains(&1) && t.contains(&3)), "{triangles:?}");
    }

    #[test]
    fn a_letter_of_eight_corners() {
        let outline = [
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 3.0],
            [2.0, 3.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ];
        let corners = outline.map(|[x, y]| DVec3::new(x, y, 0.0));
        let triangles = triangulate(&corners).expect("simple");
        assert_eq!(triangles.len(), 6);
        assert!((area(&corners, &triangles) - 7.0).abs() < 1e-12, "nothing is covered twice");
        let ears = triangles.iter().map(|t| area_normal(&t.map(|i| corners[i])).z);
        assert!(ears.into_iter().all(|z| z > 0.0), "all turn the same way");
    }

    #[test]
    fn nothing_from_a_line() {
        let corners = [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::new(x, 0.0, 0.0));
        assert_eq!(triangulate(&corners), None);
    }
}
