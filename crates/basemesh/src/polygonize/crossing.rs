//! Where the surface crosses a grid edge, as a fraction of the edge.

/// Crossings keep this distance from both ends of their edge, in units of the edge.
const NODE_DISTANCE: f64 = 1.0 / (1 << 16) as f64;

/// The crossing by linear interpolation between the values at both ends, which differ in sign.
pub(super) fn linear(start: f64, end: f64) -> f64 {
    // halved, so that the difference of finite values is finite
    let (start, end) = (0.5 * start, 0.5 * end);
    let t = start / (start - end);
    // both halves can vanish if one value is zero and the other the smallest negative number
    if t.is_finite() { keep_off_nodes(t) } else { 0.5 }
}

/// A better crossing: the zero of the parabola through the values at both ends and the value
/// `middle` at the linear estimate `t`.
///
/// The error is of fourth order in the length of the edge where the edge passes through the surface
/// at an angle, and of third order where it is almost tangent. Where the parabola is useless (the value
/// is not finite, or the function turns around between `t` and the zero) the linear estimate stays.
pub(super) fn refined(t: f64, start: f64, end: f64, middle: f64) -> f64 {
    // all values divided by the difference of the ends: they become -t, 1 - t and g
    let g = 0.5 * middle / (0.5 * end - 0.5 * start);
    let spread = t * (1.0 - t);
    // g + slope x + curvature x^2 = 0 for the shift x, where the function rises from -t to 1 - t
    let slope = 1.0 + g * (1.0 - 2.0 * t) / spread;
    let curvature = -g / spread;
    let discriminant = slope * slope - 4.0 * curvature * g;
    let shift = -2.0 * g / (slope + discriminant.sqrt());
    let (lowest, highest) = if g > 0.0 { (-t, 0.0) } else { (0.0, 1.0 - t) };
    if slope > 0.0 && shift >= lowest && shift <= highest { keep_off_nodes(t + shift) } else { t }
}

fn keep_off_nodes(t: f64) -> f64 {
    t.clamp(NODE_DISTANCE, 1.0 - NODE_DISTANCE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The crossing of `f` on the edge from `start` to `start + step`, and its error.
    fn error(f: impl Fn(f64) -> f64, root: f64, start: f64, step: f64) -> f64 {
        let (a, b) = (f(start), f(start + step));
        let t = linear(a, b);
        (start + step * refined(t, a, b, f(start + step * t)) - root).abs()
    }

    #[test]
    fn parabola_is_exact() {
        for (start, step) in [(0.3, 0.9), (0.999, 0.5), (0.2, 0.81), (0.999_9, 0.001)] {
            let found = error(|x| (x - 1.0) * (x + 0.7), 1.0, start, step);
            assert!(found <= 8.0 * f64::EPSILON, "[{start}, +{step}]: off by {found}");
        }
    }

    #[test]
    fn error_is_of_fourth_order() {
        let f = |x: f64| x.exp() - 2.0;
        let root = std::f64::consts::LN_2;
        let errors = [0.2, 0.1, 0.05].map(|step| error(f, root, root - 0.4 * step, step));
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 3.8, "errors {errors:?}");
        }
    }

    #[test]
    fn useless_middle_values_keep_the_linear_estimate() {
        let t = linear(-1.0, 3.0);
        assert!((t - 0.25).abs() <= f64::EPSILON, "t = {t}");
        for middle in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
            let refined = refined(t, -1.0, 3.0, middle);
            assert!(refined > 0.0 && refined < 1.0, "{middle} gives {refined}");
        }
    }

    #[test]
    fn crossings_stay_off_the_nodes() {
        assert!(linear(0.0, -1.0) > 0.0 && linear(-1.0, 0.0) < 1.0, "zero at a node");
        for extreme in [f64::MAX, -f64::from_bits(1)] {
            let t = linear(0.0_f64.min(-extreme), 0.0_f64.max(extreme));
            assert!(t > 0.0 && t < 1.0, "values of size {extreme} give {t}");
        }
    }
}
