//! How the curve of an edge was found, in one byte.

use crate::curvature_parameter::{EdgeStatus, Lowering};

/// An [`EdgeStatus`]: two bits each for the rank and why it was lowered, one for cubic curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StatusByte(u8);

const LOWERED: u8 = 2;
const CUBIC: u8 = 4;

impl StatusByte {
    /// Rank zero.
    pub(crate) const STRAIGHT: Self = Self(0);

    #[inline]
    pub(crate) fn new(status: EdgeStatus) -> Self {
        let lowered = match status.lowered {
            None => 0,
            Some(Lowering::Length) => 1,
            Some(Lowering::Shear) => 2,
            Some(Lowering::Advance) => 3,
        };
        Self(status.rank | lowered << LOWERED | u8::from(status.cubic) << CUBIC)
    }

    /// Of an edge with one normal at each end of which all terms are used.
    #[inline(always)]
    pub(crate) fn quadratic(full_rank: bool) -> Self {
        Self(if full_rank { 2 } else { 1 })
    }

    #[inline]
    pub(crate) fn get(self) -> EdgeStatus {
        let lowered = match self.0 >> LOWERED & 3 {
            0 => None,
            1 => Some(Lowering::Length),
            2 => Some(Lowering::Shear),
            _ => Some(Lowering::Advance),
        };
        EdgeStatus { rank: self.0 & 3, lowered, cubic: self.is_cubic() }
    }

    #[inline]
    pub(crate) fn is_cubic(self) -> bool {
        self.0 >> CUBIC != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_status_survives() {
        let reasons =
            [None, Some(Lowering::Length), Some(Lowering::Shear), Some(Lowering::Advance)];
        for rank in 0..=3 {
            for lowered in reasons {
                for cubic in [false, true] {
                    let status = EdgeStatus { rank, lowered, cubic };
                    assert_eq!(StatusByte::new(status).get(), status, "one byte");
                }
            }
        }
        for full_rank in [false, true] {
            let status = EdgeStatus::quadratic(full_rank);
            assert_eq!(StatusByte::quadratic(full_rank).get(), status, "{full_rank}");
        }
    }
}
