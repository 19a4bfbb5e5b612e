//! The direction that makes the smallest largest angle with given directions.

use glam::DVec3;

/// More would mean that round-off lets the basis run in a circle.
const MAX_STEPS: usize = 100;

/// The unit vector `n` whose smallest product with the given unit vectors is largest; `None` without
/// vectors, or if no direction has positive products with all of them.
///
/// It is the direction of the point of their convex hull nearest to the origin, and it is fixed by at
/// most three of them. One by one, the vector that is missed most joins the basis, which is
/// reduced again; the smallest product over the basis falls in each step.
pub(crate) fn deepest_direction(vectors: &[DVec3]) -> Option<DVec3> {
    let mut basis = vec![*vectors.first()?];
    let mut direction = basis[0];
    for _ in 0..MAX_STEPS {
        let missed =
            vectors.iter().copied().min_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))?;
        if missed.dot(direction) >= least_product(direction, &basis) - 8.0 * f64::EPSILON {
            break;
        }
        basis.push(missed);
        (direction, basis) = deepest_of_few(&basis)?;
    }
    (least_product(direction, vectors) > 0.0).then_some(direction)
}

fn least_product(direction: DVec3, vectors: &[DVec3]) -> f64 {
    vectors.iter().map(|v| v.dot(direction)).fold(f64::INFINITY, f64::min)
}

/// By trying all sets of up to three of at most four vectors.
fn deepest_of_few(vectors: &[DVec3]) -> Option<(DVec3, Vec<DVec3>)> {
    let mut best: Option<(f64, DVec3, Vec<DVec3>)> = None;
    for mask in 1_u32..1 << vectors.len() {
        let subset: Vec<DVec3> =
            (0..vectors.len()).filter(|i| mask >> i & 1 == 1).map(|i| vectors[i]).collect();
        let direction = match *subset {
            [a] => Some(a),
            [a, b] => (a + b).try_normalize(),
            [a, b, c] => (b - a).cross(c - a).try_normalize().map(|n| n * n.dot(a).signum()),
            _ => None,
        };
        let Some(direction) = direction else { continue };
        let depth = least_product(direction, vectors);
        if best.as_ref().is_none_or(|(known, ..)| depth > *known) {
            best = Some((depth, direction, subset));
        }
    }
    best.map(|(_, direction, basis)| (direction, basis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_direction_is_deeper(
            points in proptest::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, 0.1..1.0_f64), 1..12),
            turns in proptest::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64), 50),
        ) {
            let vectors: Vec<_> =
                points.iter().map(|&(x, y, z)| DVec3::new(x, y, z).normalize()).collect();
            let found = deepest_direction(&vectors).expect("all vectors point upwards");
            let depth = least_product(found, &vectors);
            for (x, y, z) in turns {
                for size in [1.0, 0.1, 1e-3] {
                    let other = (found + size * DVec3::new(x, y, z)).normalize();
                    prop_assert!(least_product(other, &vectors) <= depth + 1e-14);
                }
            }
        }
    }

    #[test]
    fn opposite_vectors_have_none() {
        assert_eq!(deepest_direction(&[DVec3::X, -DVec3::X]), None);
        assert_eq!(deepest_direction(&[]), None);
    }

    #[test]
    fn a_corner_of_a_cube() {
        let n = deepest_direction(&[DVec3::X, DVec3::Y, DVec3::Z, DVec3::X]).expect("a direction");
        assert!((n - DVec3::ONE.normalize()).length() <= 4.0 * f64::EPSILON, "{n}");
    }
}
