//! Which patch is seen where: rows of pixels with several samples each.

use glam::{DVec2, DVec3};

use crate::lattice::ScreenPatch;

/// Samples along each side of a pixel.
const SIDE: usize = 4;
/// Samples of a pixel.
pub(crate) const SAMPLES: usize = SIDE * SIDE;
/// Samples near the corners of a pixel.
pub(crate) const OUTER: [usize; 4] = [0, SIDE - 1, SAMPLES - SIDE, SAMPLES - 1];
/// Points this far outside a triangle, as a part of its height, count as inside, so that rounding
/// opens no cracks.
const ROUNDING: f64 = 1e-9;

/// What is seen at a sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) patch: usize,
    pub(crate) at: DVec2,
}

/// Rows of pixels.
pub(crate) struct Band {
    width: usize,
    first_row: usize,
    rows: usize,
    /// Of each sample: what is seen and how near it is.
    samples: Vec<Option<(Seen, f64)>>,
}

impl Band {
    pub(crate) fn new(width: usize, first_row: usize, rows: usize) -> Self {
        Self { width, first_row, rows, samples: vec![None; width * rows * SAMPLES] }
    }

    /// The samples of a pixel, the row counted from the first of the band.
    pub(crate) fn pixel(&self, row: usize, column: usize) -> [Option<Seen>; SAMPLES] {
        let start = (row * self.width + column) * SAMPLES;
        std::array::from_fn(|sample| self.samples[start + sample].map(|(seen, _)| seen))
    }

    /// Adds a patch; `middle` is the middle of the picture in pixels from its upper left corner.
    ///
    /// Of points equally near, the first stays.
    pub(crate) fn add(&mut self, id: usize, patch: &ScreenPatch, middle: DVec2) {
        let top = self.first_row as f64;
        let [low, high] = patch.rows.map(|y| y + middle.y);
        if high < top || low > top + self.rows as f64 {
            return;
        }
        patch.for_each_triangle(|corners, at| {
            let corners = corners.map(|c| patch.points[c] + middle.extend(0.0));
            self.add_triangle(id, corners, at);
        });
    }

    fn add_triangle(&mut self, patch: usize, corners: [DVec3; 3], at: [DVec2; 3]) {
        let [a, b, c] = corners.map(DVec3::truncate);
        let twice_area = (b - a).perp_dot(c - a);
        let low = a.min(b).min(c) - DVec2::Y * self.first_row as f64;
        let high = a.max(b).max(c) - DVec2::Y * self.first_row as f64;
        let columns = pixels(low.x, high.x, self.width);
        let rows = pixels(low.y, high.y, self.rows);
        // a triangle that is seen from its side covers nothing
        if columns.is_empty() || rows.is_empty() || twice_area == 0.0 {
            return;
        }
        // weight of a corner: zero on the opposite side, one at the corner
        let weight = |from: DVec2, to: DVec2| Linear::zero_on(from, to, 1.0 / twice_area);
        let weights = [weight(b, c), weight(c, a), weight(a, b)];
        let offsets = sample_offsets();
        for row in rows {
            for column in columns.clone() {
                let origin = DVec2::new(column as f64, (self.first_row + row) as f64);
                let start = (row * self.width + column) * SAMPLES;
                let slots = &mut self.samples[start..start + SAMPLES];
                for (slot, offset) in slots.iter_mut().zip(&offsets) {
                    let w = weights.map(|weight| weight.at(origin + *offset));
                    if w.iter().any(|&w| w < -ROUNDING) {
                        continue;
                    }
                    let nearness = (0..3).map(|k| w[k] * corners[k].z).sum();
                    if slot.is_none_or(|(_, nearest)| nearness > nearest) {
                        let at = at[0] * w[0] + at[1] * w[1] + at[2] * w[2];
                        *slot = Some((Seen { patch, at }, nearness));
                    }
                }
            }
        }
    }
}

/// Pixels that an interval touches, from 0 to `count`.
fn pixels(low: f64, high: f64, count: usize) -> std::ops::Range<usize> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to count")]
    let whole = |x: f64| x.clamp(0.0, count as f64) as usize;
    whole(low.floor())..whole(high.floor() + 1.0)
}

/// A linear function on the plane.
#[derive(Clone, Copy)]
struct Linear {
    origin: DVec2,
    gradient: DVec2,
}

impl Linear {
    /// Zero on a line, growing to its left.
    fn zero_on(from: DVec2, to: DVec2, factor: f64) -> Self {
        Self { origin: from, gradient: (to - from).perp() * factor }
    }

    #[inline]
    fn at(self, p: DVec2) -> f64 {
        self.gradient.dot(p - self.origin)
    }
}

/// Places of the samples in a pixel: a grid turned a little, so that each has a row and a column of its
/// own and lines along the axes are smooth too.
fn sample_offsets() -> [DVec2; SAMPLES] {
    std::array::from_fn(|sample| {
        let (i, j) = ((sample % SIDE) as f64, (sample / SIDE) as f64);
        let side = SIDE as f64;
        let within = |step: f64| (step + 0.5) / side;
        DVec2::new((i + within(j)) / side, (j + within(side - 1.0 - i)) / side)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_rows_and_columns_of_their_own() {
        let offsets = sample_offsets();
        for coordinate in [|p: DVec2| p.x, |p: DVec2| p.y] {
            let mut steps: Vec<f64> = offsets.iter().map(|&p| coordinate(p) * 16.0 - 0.5).collect();
            steps.sort_by(f64::total_cmp);
            let expected: Vec<f64> = (0..16).map(f64::from).collect();
            assert_eq!(steps, expected, "sixteen different steps");
        }
    }

    #[test]
    fn a_triangle_covers_its_area() {
        let mut band = Band::new(40, 10, 20);
        // half in the band
        let corners =
            [DVec3::new(5.0, 2.0, 1.0), DVec3::new(35.0, 2.0, 1.0), DVec3::new(5.0, 18.0, 1.0)];
        band.add_triangle(7, corners, [DVec2::ZERO, DVec2::X, DVec2::Y]);
        let seen = band.samples.iter().flatten().count() as f64 / SAMPLES as f64;
        let area = 0.5 * 8.0 * 15.0;
        assert!((seen - area).abs() < 0.01 * area, "{seen} instead of {area} pixels");
    }

    #[test]
    fn neighbours_leave_no_gap_and_the_nearer_is_seen() {
        let mut band = Band::new(30, 0, 30);
        let at = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let (a, b) = (DVec3::new(0.1, 0.2, 0.0), DVec3::new(29.3, 28.9, 0.0));
        let (c, d) = (DVec3::new(28.7, -0.1, 0.0), DVec3::new(0.3, 29.9, 0.0));
        band.add_triangle(0, [a, b, c], at);
        band.add_triangle(1, [b, a, d], at);
        let inner = (2..27).flat_map(|row| (2..27).map(move |column| (row, column)));
        for (row, column) in inner {
            assert!(band.pixel(row, column).iter().all(Option::is_some), "{row}, {column}");
        }
        let nearer = [a, b, c].map(|p| p + DVec3::Z);
        band.add_triangle(2, nearer, at);
        band.add_triangle(3, nearer, at);
        let patches = band.samples.iter().flatten().map(|(seen, _)| seen.patch);
        assert!(patches.clone().all(|patch| patch == 1 || patch == 2), "the first of the nearest");
        assert!(patches.clone().any(|patch| patch == 1) && patches.clone().any(|patch| patch == 2));
    }
}
