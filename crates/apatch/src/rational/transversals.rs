//! Whether the surface is a single sheet, on a grid of transversals.

use super::edge::EdgePatch;
use super::face::{FacePatch, FaceSide};
use super::kinds::Convexity;
use super::surface::RationalSurface;
use crate::cubic_root::RayCubic;

/// Values on a face below this times their size there need no side to go to.
const NEARLY_ON_SURFACE: f64 = 1e-12;

/// Transversals that do not cross the surface exactly once, and all.
#[derive(Default)]
struct Count {
    bad: usize,
    all: usize,
}

impl Count {
    fn add(&mut self, missing: bool, cubic: Option<RayCubic>) {
        self.all += 1;
        self.bad += usize::from(missing || cubic.is_some_and(|c| c.threshold() > 0.0));
    }

    fn face(&mut self, face: &FacePatch, n: usize) {
        let step = 1.0 / n as f64;
        let scale = face.sides.iter().flatten().map(FaceSide::scale).fold(0.0, f64::max);
        for i in 0..=n {
            for j in 0..=n - i {
                let x = [i as f64 * step, j as f64 * step, (n - i - j) as f64 * step];
                let base = face.base.value(x);
                let missing = face.side_at(base).is_none()
                    && face.convexity != Convexity::Zero
                    && base.abs() > NEARLY_ON_SURFACE * scale;
                self.add(missing, face.transversal(x));
            }
        }
    }

    fn edge(&mut self, edge: &EdgePatch, n: usize) {
        let step = 1.0 / n as f64;
        for i in 1..n {
            for j in 0..=n {
                let at = [i as f64 * step, j as f64 * step];
                self.add(edge.side_at(edge.base(at[0])).is_none(), edge.transversal(at));
            }
        }
    }
}

impl RationalSurface {
    /// Whether every transversal of a grid with `n` steps crosses the surface exactly once, face by
    /// face and edge by edge; returns the number of those that do not, and of all.
    #[must_use]
    pub fn count_bad_transversals(&self, n: usize) -> (usize, usize) {
        let mut count = Count::default();
        for (face, _) in self.faces.iter() {
            count.face(&self.face(face), n);
        }
        for (edge, record) in self.edges.iter() {
            if record.apices.iter().any(Option::is_some) {
                count.edge(&self.edge(edge), n);
            }
        }
        (count.bad, count.all)
    }
}
