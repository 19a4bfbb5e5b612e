//! Bounds that keep the surface a single sheet.

use super::base::BaseLayer;
use super::edge::EdgeSide;
use super::face::{FaceSide, dot};
use super::kinds::Side;
use super::settings::SheetSettings;
use crate::cubic_root::RayCubic;

/// Halvings of the step when the worst transversal is refined between grid points.
const HALVINGS: usize = 8;
/// Where on a transversal is looked, in units of where the largest threshold so far was found.
const LOOKS: [f64; 3] = [1.0, 0.8, 0.6];

/// The smallest value that the free weight times the sign must exceed, over all transversals of the
/// face that go to this side; minus infinity if there are none.
pub(crate) fn face_bound(
    base: &BaseLayer,
    face: &FaceSide,
    side: Side,
    settings: &SheetSettings,
) -> f64 {
    let n = settings.grid;
    let sign = side.sign();
    // where the largest threshold so far was found on its transversal
    let mut place = 1.0;
    // the threshold of a transversal, or minus infinity if it is certainly not above one that is known
    let mut bound = |x: [f64; 3], known: f64| {
        let start = sign * base.value(x);
        if start >= 0.0 {
            return f64::NEG_INFINITY;
        }
        let two = 2.0 / 3.0 * dot(x, face.fitted);
        let cubic = RayCubic([start, sign * face.layer1(x), sign * two, 0.0]);
        if LOOKS.iter().any(|look| cubic.is_threshold_at_most(known, look * place)) {
            return f64::NEG_INFINITY;
        }
        let (threshold, t) = cubic.threshold_and_place();
        if threshold > known {
            place = t;
        }
        threshold
    };
    let middle = [1.0 / 3.0; 3];
    let (step, mut best, mut at) = (1.0 / n as f64, bound(middle, f64::NEG_INFINITY), middle);
    for i in 0..=n {
        for j in 0..=n - i {
            let x = [i as f64 * step, j as f64 * step, (n - i - j) as f64 * step];
            let here = bound(x, best);
            if here > best {
                (best, at) = (here, x);
            }
        }
    }
    if settings.refine && best.is_finite() {
        best = refined(bound, at, best, 0.5 * step);
    }
    best
}

/// The largest value that a compass search from a grid point finds.
fn refined(
    mut value: impl FnMut([f64; 3], f64) -> f64,
    mut at: [f64; 3],
    mut best: f64,
    mut step: f64,
) -> f64 {
    const WAYS: [[usize; 2]; 6] = [[0, 1], [1, 0], [0, 2], [2, 0], [1, 2], [2, 1]];
    for _ in 0..HALVINGS {
        for [from, to] in WAYS {
            let mut x = at;
            let moved = step.min(x[from]);
            x[from] -= moved;
            x[to] += moved;
            let here = value(x, best);
            if here > best {
                (best, at) = (here, x);
            }
        }
        step *= 0.5;
    }
    best
}

/// Whether the function has the wrong sign at a grid point of a convex face.
pub(crate) fn has_wrong_sign(base: &BaseLayer, scale: f64, side: Side, grid: usize) -> bool {
    let step = 1.0 / grid as f64;
    (1..grid).any(|i| {
        (1..grid - i).any(|j| {
            let x = [i as f64 * step, j as f64 * step, (grid - i - j) as f64 * step];
            side.sign() * base.value(x) > super::face::ON_SURFACE * scale
        })
    })
}

/// What the transversals of an edge tetrahedron ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Raise {
    /// Nothing: each crosses the surface once.
    Nothing,
    /// The free weights of both faces raised by this, times the sign.
    By(f64),
    /// Some of them cannot be helped by raising.
    Impossible,
}

/// By how much the free weights must be raised, over a grid of transversals; the grid is half as wide
/// at both ends of the edge, where the weights become small.
pub(crate) fn edge_raise(
    edge: &EdgeSide,
    weights: [f64; 2],
    side: Side,
    settings: &SheetSettings,
) -> Raise {
    let (n, sign) = (settings.grid, side.sign());
    let step = 1.0 / n as f64;
    // the raise that a transversal asks for; minus infinity if it is single for certain, and plus
    // infinity if it cannot be helped
    let ask = |at: [f64; 2]| {
        let cubic = edge.ray(weights, at).0.map(|b| sign * b);
        if cubic[0] >= 0.0 || RayCubic(cubic).is_single_by_signs() {
            return f64::NEG_INFINITY;
        }
        let (threshold, factor) = (RayCubic(cubic).threshold(), edge.raise_factor(at[1]));
        match (threshold > 0.0, factor > 0.0) {
            (_, true) => threshold / factor,
            (true, false) => f64::INFINITY,
            (false, false) => f64::NEG_INFINITY,
        }
    };
    let (mut best, mut at) = (f64::NEG_INFINITY, [0.0; 2]);
    let columns = (1..n).map(|i| i as f64 * step).chain([0.5 * step, 1.0 - 0.5 * step]);
    for x in columns {
        if edge.is_single_along(weights, x, sign) {
            continue;
        }
        for j in 0..=n {
            let here = ask([x, j as f64 * step]);
            if here > best {
                (best, at) = (here, [x, j as f64 * step]);
            }
        }
    }
    if settings.refine && best.is_finite() {
        best = refined_on_edge(ask, at, best, 0.5 * step);
    }
    if best == f64::INFINITY {
        Raise::Impossible
    } else if best > 0.0 {
        Raise::By(best)
    } else {
        Raise::Nothing
    }
}

/// The largest value that a compass search from a grid point finds.
fn refined_on_edge(
    value: impl Fn([f64; 2]) -> f64,
    mut at: [f64; 2],
    mut best: f64,
    mut step: f64,
) -> f64 {
    for _ in 0..HALVINGS {
        for way in [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]] {
            let x = [0, 1].map(|i| (at[i] + step * way[i]).clamp(0.0, 1.0));
            let here = value(x);
            if here > best {
                (best, at) = (here, x);
            }
        }
        step *= 0.5;
    }
    best
}
