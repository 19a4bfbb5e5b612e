//! The unknowns seen from the gradients of the two conditions.

use nalgebra::SVector;

pub(crate) type Vector = SVector<f64, 7>;

/// Conditions whose gradients are closer to parallel than this count as one.
const DEPENDENT: f64 = 1e-12;

/// The smallest vector that changes the conditions with gradients `a` and `b` by `defect`; where
/// they depend on each other, the smallest that meets the first.
pub(crate) fn smallest_solution([a, b]: &[Vector; 2], defect: [f64; 2]) -> Vector {
    let square = a.norm_squared();
    if square <= f64::MIN_POSITIVE {
        return Vector::zeros();
    }
    let share = a.dot(b) / square;
    let across = b - a * share;
    let across_square = across.norm_squared();
    let along = a * (defect[0] / square);
    if across_square > DEPENDENT * DEPENDENT * square {
        along + across * ((defect[1] - share * defect[0]) / across_square)
    } else {
        along
    }
}

/// Directions that keep both conditions, orthonormal: what is left of the axes by two Householder
/// reflections that move the gradients onto the first two.
pub(crate) struct NullSpace([Reflection; 2]);

impl NullSpace {
    /// The directions orthogonal to two gradients.
    pub(crate) fn of([a, b]: &[Vector; 2]) -> Self {
        let first = Reflection::onto_axis(*a, 0);
        let second = Reflection::onto_axis(first.apply(b), 1);
        Self([first, second])
    }

    /// One of the directions 0 to 4.
    ///
    /// A component in which both gradients vanish stays a direction of its own, in its place.
    pub(crate) fn direction(&self, index: usize) -> Vector {
        let [first, second] = &self.0;
        first.apply(&second.apply_to_axis(2 + index))
    }
}

/// `x -> x - scale (v·x) v`.
struct Reflection {
    v: Vector,
    scale: f64,
}

impl Reflection {
    /// Moves a vector, without its components before `pivot`, onto the axis `pivot`.
    fn onto_axis(mut v: Vector, pivot: usize) -> Self {
        v.rows_mut(0, pivot).fill(0.0);
        let norm = v.norm();
        v[pivot] += norm.copysign(v[pivot]);
        let square = v.norm_squared();
        Self { v, scale: if square > 0.0 { 2.0 / square } else { 0.0 } }
    }

    fn apply(&self, x: &Vector) -> Vector {
        x - self.v * (self.scale * self.v.dot(x))
    }

    fn apply_to_axis(&self, axis: usize) -> Vector {
        let mut image = self.v * (-self.scale * self.v[axis]);
        image[axis] += 1.0;
        image
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gradients() -> [Vector; 2] {
        [[0.3, 0.0, -1.0, 2.0, 0.5, 0.1, 0.0], [0.0, -0.2, -1.1, 1.9, 0.6, 0.0, 0.4]]
            .map(Vector::from)
    }

    #[test]
    fn directions_are_orthonormal_and_keep_the_conditions() {
        let gradients = gradients();
        let null_space = NullSpace::of(&gradients);
        let directions: [Vector; 5] = std::array::from_fn(|i| null_space.direction(i));
        for (i, a) in directions.iter().enumerate() {
            for gradient in &gradients {
                assert!(gradient.dot(a).abs() <= 1e-15, "direction {i} changes a condition");
            }
            for (j, b) in directions.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((a.dot(b) - expected).abs() <= 1e-15, "directions {i} and {j}");
            }
        }
    }

    #[test]
    fn smallest_solutions() {
        let [a, b] = gradients();
        let x = smallest_solution(&[a, b], [0.5, -2.0]);
        assert!((a.dot(&x) - 0.5).abs() <= 1e-13 && (b.dot(&x) + 2.0).abs() <= 1e-13, "{x}");
        let null_space = NullSpace::of(&[a, b]);
        for i in 0..5 {
            let beside = null_space.direction(i).dot(&x);
            assert!(beside.abs() <= 1e-13, "not the smallest: {beside:e} along {i}");
        }
        // of two conditions that are one, the first is met
        let x = smallest_solution(&[a, a * 2.0], [0.5, 7.0]);
        assert!((x - a * (0.5 / a.norm_squared())).norm() <= 1e-15, "{x}");
        assert_eq!(smallest_solution(&[Vector::zeros(); 2], [1.0, 1.0]), Vector::zeros());
    }
}
