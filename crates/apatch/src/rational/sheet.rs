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

/// Points of the grid that are looked at together.
const LANES: usize = 8;

/// Eight points of a triangle, and the functions that make layer 0 of its weights.
#[derive(Debug)]
struct GridPart {
    x: [[f64; LANES]; 3],
    /// Of the rational form: of the weights on the edges, by corner, and the middle ones.
    rational: [[f64; LANES]; 9],
    /// Of the split form.
    split: [[f64; LANES]; 9],
}

/// A grid of points of a triangle with all that does not depend on the face. Coarser grids come
/// first, so that a large threshold is found early.
#[derive(Debug)]
pub(crate) struct FaceGrid {
    parts: Vec<GridPart>,
}

impl FaceGrid {
    pub(crate) fn new(n: usize) -> Self {
        let mut points: Vec<[usize; 3]> =
            (0..=n).flat_map(|i| (0..=n - i).map(move |j| [i, j, n - i - j])).collect();
        // at the corners the function is zero, which bounds nothing
        points.retain(|p| !p.contains(&n));
        // common powers of two in the three numbers, most first
        let even = |p: &[usize; 3]| (p[0] | p[1] | p[2]).trailing_zeros().min(3);
        points.sort_by_key(|p| std::cmp::Reverse(even(p)));
        let at: Vec<[f64; 3]> =
            points.iter().map(|p| p.map(|steps| steps as f64 / n as f64)).collect();
        Self { parts: at.chunks(LANES).map(GridPart::new).collect() }
    }
}

impl GridPart {
    /// For at most eight points; the last one is repeated.
    fn new(points: &[[f64; 3]]) -> Self {
        let at: [[f64; 3]; LANES] = std::array::from_fn(|i| points[i.min(points.len() - 1)]);
        let unit = |which: usize, split: bool| {
            let (mut e, mut g) = ([[0.0; 2]; 3], [0.0; 3]);
            if which < 6 {
                e[which / 2][which % 2] = 1.0;
            } else {
                g[which - 6] = 1.0;
            }
            at.map(|x| BaseLayer::new(e, g, split).value(x))
        };
        Self {
            x: std::array::from_fn(|a| at.map(|x| x[a])),
            rational: std::array::from_fn(|which| unit(which, false)),
            split: std::array::from_fn(|which| unit(which, true)),
        }
    }
}

/// Layers 0, 1 and 2 of one face on one side, times the sign, the free weight left out.
struct Layers {
    split: bool,
    base: [f64; 9],
    l1v: [f64; 3],
    /// Twice the weights.
    l1e: [f64; 3],
    l2: [f64; 3],
}

impl Layers {
    fn new(base: &BaseLayer, face: &FaceSide, sign: f64) -> Self {
        let (e, g) = (base.edge_weights(), base.middle_weights());
        let base_weights = [e[0][0], e[0][1], e[1][0], e[1][1], e[2][0], e[2][1], g[0], g[1], g[2]];
        Self {
            split: base.is_split(),
            base: base_weights.map(|w| sign * w),
            l1v: face.l1v.map(|w| sign * w),
            l1e: face.l1e.map(|w| 2.0 * sign * w),
            l2: face.fitted.map(|q| 2.0 / 3.0 * sign * q),
        }
    }

    /// The cubics of eight transversals.
    #[inline]
    fn cubics(&self, part: &GridPart) -> [[f64; LANES]; 3] {
        let basis = if self.split { &part.split } else { &part.rational };
        let (v, e, q) = (&self.l1v, &self.l1e, &self.l2);
        let mut cubics = [[0.0; LANES]; 3];
        for i in 0..LANES {
            let x = [part.x[0][i], part.x[1][i], part.x[2][i]];
            let mut value = 0.0;
            for (weight, basis) in self.base.iter().zip(basis) {
                value += weight * basis[i];
            }
            cubics[0][i] = value;
            cubics[1][i] = x[0] * (x[0] * v[0] + x[1] * e[2])
                + x[1] * (x[1] * v[1] + x[2] * e[0])
                + x[2] * (x[2] * v[2] + x[0] * e[1]);
            cubics[2][i] = x[0] * q[0] + x[1] * q[1] + x[2] * q[2];
        }
        cubics
    }

    /// The cubic of any transversal.
    fn cubic(&self, base: &BaseLayer, sign: f64, x: [f64; 3]) -> RayCubic {
        let (v, e) = (&self.l1v, &self.l1e);
        let one = x[0] * (x[0] * v[0] + x[1] * e[2])
            + x[1] * (x[1] * v[1] + x[2] * e[0])
            + x[2] * (x[2] * v[2] + x[0] * e[1]);
        RayCubic([sign * base.value(x), one, dot(x, self.l2), 0.0])
    }
}

/// The largest threshold so far.
struct Largest {
    threshold: f64,
    /// Where it is on its transversal.
    place: f64,
}

impl Largest {
    /// Takes over the threshold of a transversal if it is larger.
    #[inline]
    fn take(&mut self, cubic: &RayCubic) -> bool {
        if self.is_certain(cubic) {
            return false;
        }
        let (threshold, place) = cubic.threshold_and_place();
        let larger = threshold > self.threshold;
        if larger {
            *self = Self { threshold, place };
        }
        larger
    }

    /// Whether the threshold of a transversal is certainly not larger.
    #[inline]
    fn is_certain(&self, cubic: &RayCubic) -> bool {
        let at_most = |look: &f64| cubic.is_threshold_at_most(self.threshold, look * self.place);
        cubic.0[0] >= 0.0 || LOOKS.iter().any(at_most)
    }
}

/// The smallest value that the free weight times the sign must exceed, over all transversals of the
/// face that go to this side; minus infinity if there are none.
pub(crate) fn face_bound(
    base: &BaseLayer,
    face: &FaceSide,
    side: Side,
    grid: &FaceGrid,
    settings: &SheetSettings,
) -> f64 {
    let layers = Layers::new(base, face, side.sign());
    let mut largest = Largest { threshold: f64::NEG_INFINITY, place: 1.0 };
    let mut at = [1.0 / 3.0; 3];
    largest.take(&layers.cubic(base, side.sign(), at));
    for part in &grid.parts {
        let cubics = layers.cubics(part);
        let cubic = |i: usize| RayCubic([cubics[0][i], cubics[1][i], cubics[2][i], 0.0]);
        let mut certain = true;
        for i in 0..LANES {
            let here = cubic(i);
            certain &= (here.0[0] >= 0.0)
                | here.is_threshold_at_most(largest.threshold, LOOKS[0] * largest.place);
        }
        if certain {
            continue;
        }
        for i in 0..LANES {
            if largest.take(&cubic(i)) {
                at = [part.x[0][i], part.x[1][i], part.x[2][i]];
            }
        }
    }
    if settings.refine && largest.threshold.is_finite() {
        let step = 0.5 / settings.grid as f64;
        let cubic = |x: [f64; 3]| layers.cubic(base, side.sign(), x);
        refine(cubic, at, &mut largest, step);
    }
    largest.threshold
}

/// A compass search from a grid point.
fn refine(
    cubic: impl Fn([f64; 3]) -> RayCubic,
    mut at: [f64; 3],
    largest: &mut Largest,
    mut step: f64,
) {
    const WAYS: [[usize; 2]; 6] = [[0, 1], [1, 0], [0, 2], [2, 0], [1, 2], [2, 1]];
    for _ in 0..HALVINGS {
        for [from, to] in WAYS {
            let mut x = at;
            let moved = step.min(x[from]);
            x[from] -= moved;
            x[to] += moved;
            if largest.take(&cubic(x)) {
                at = x;
            }
        }
        step *= 0.5;
    }
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
