//! Many edges at a time, vectors component by component.

use glam::DVec3;

use crate::curvature_parameter::{Limits, bow_and_shear};

/// Vectors of each lane, component by component.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<const N: usize>([[f64; N]; 3]);

/// What became of the edge of a lane: bits, in numbers as wide as the coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flags<const N: usize>([u64; N]);

const REFUSED: u64 = 1;
const FULL_RANK: u64 = 2;

impl<const N: usize> Lanes<N> {
    pub(crate) const ZERO: Self = Self([[0.0; N]; 3]);

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: DVec3) {
        let [x, y, z] = &mut self.0;
        (x[lane], y[lane], z[lane]) = (v.x, v.y, v.z);
    }

    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> DVec3 {
        let [x, y, z] = &self.0;
        DVec3::new(x[lane], y[lane], z[lane])
    }
}

impl<const N: usize> Flags<N> {
    pub(crate) const NONE: Self = Self([0; N]);

    /// Whether the result of some lane cannot be used.
    #[inline(always)]
    pub(crate) fn any_refused(&self) -> bool {
        self.0.iter().fold(0, |all, flags| all | flags) & REFUSED != 0
    }

    /// Whether the result of this lane cannot be used.
    #[inline(always)]
    pub(crate) fn refused(&self, lane: usize) -> bool {
        self.0[lane] & REFUSED != 0
    }

    /// Whether the normals of this lane determine bow and shear.
    #[inline(always)]
    pub(crate) fn full_rank(&self, lane: usize) -> bool {
        self.0[lane] & FULL_RANK != 0
    }
}

/// The curvature parameters of edges with these chords and one normal at each end, as of
/// [`curvature_parameter`](crate::curvature_parameter) bit for bit; lanes for which terms have to be
/// dropped are refused. Sets flags and clears none.
#[inline(always)]
pub(crate) fn curvature_parameters<const N: usize>(
    chords: &Lanes<N>,
    [starts, ends]: [&Lanes<N>; 2],
    limits: &Limits,
    values: &mut Lanes<N>,
    flags: &mut Flags<N>,
) {
    for (lane, flags) in flags.0.iter_mut().enumerate() {
        let found = bow_and_shear(chords.get(lane), [starts.get(lane), ends.get(lane)], limits);
        values.set(lane, found.value);
        let refused = if found.accepted { 0 } else { REFUSED };
        *flags |= refused | if found.full_rank { FULL_RANK } else { 0 };
    }
}

/// Refuses the lanes of which an end tangent is off its normal by more than `most` chords.
#[inline(always)]
pub(crate) fn refuse_misfits<const N: usize>(
    flags: &mut Flags<N>,
    chords: &Lanes<N>,
    [starts, ends]: [&Lanes<N>; 2],
    values: &Lanes<N>,
    most: f64,
) {
    for (lane, flags) in flags.0.iter_mut().enumerate() {
        let (chord, c) = (chords.get(lane), values.get(lane));
        let most = most * chord.length();
        let missed = (starts.get(lane).dot(chord - c).abs() > most)
            | (ends.get(lane).dot(chord + c).abs() > most);
        *flags |= if missed { REFUSED } else { 0 };
    }
}
