//! Points of a whole patch at a regular lattice, row by row.

use glam::DVec3;

/// A quadratic polynomial along a row of the lattice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) constant: DVec3,
    pub(crate) linear: DVec3,
    pub(crate) quadratic: DVec3,
}

/// Points of the triangular lattice with this many divisions.
///
/// # Panics
///
/// If there are none.
pub(crate) fn lattice_size(divisions: usize) -> usize {
    assert!(divisions >= 1, "a lattice needs at least one division");
    (divisions + 1) * (divisions + 2) / 2
}

/// Fills row after row: row `r` has `length(r)` points and belongs to the parameter `r / divisions`.
#[inline]
pub(crate) fn fill_rows(
    points: &mut [DVec3],
    divisions: usize,
    length: impl Fn(usize) -> usize,
    row_at: impl Fn(f64) -> Row,
) {
    let step = 1.0 / divisions as f64;
    let mut rest = points;
    for row in 0..=divisions {
        let (points, following) = rest.split_at_mut(length(row));
        let Row { constant, linear, quadratic } = row_at(row as f64 * step);
        let mut k = 0.0;
        for point in points {
            let t = k * step;
            *point = constant + (linear + quadratic * t) * t;
            k += 1.0;
        }
        rest = following;
    }
}
