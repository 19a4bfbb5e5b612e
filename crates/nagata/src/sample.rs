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

/// Fills row after row, of `N` patches together: row `r` has `length(r)` points and belongs to the
/// parameter `r / divisions`.
#[inline(always)]
pub(crate) fn fill_rows<const N: usize>(
    mut points: [&mut [DVec3]; N],
    divisions: usize,
    length: impl Fn(usize) -> usize,
    row_at: impl Fn(f64) -> [Row; N],
) {
    let step = 1.0 / divisions as f64;
    let mut first = 0;
    for row in 0..=divisions {
        let rows = row_at(row as f64 * step);
        let end = first + length(row);
        let mut points = points.each_mut().map(|points| &mut points[first..end]);
        let mut k = 0.0;
        for at in 0..end - first {
            let t = k * step;
            for (points, Row { constant, linear, quadratic }) in points.iter_mut().zip(&rows) {
                points[at] = *constant + (*linear + *quadratic * t) * t;
            }
            k += 1.0;
        }
        first = end;
    }
}
