//! Order of the blocks along a Z-shaped curve, so that neighbours have close numbers.

/// The bits of the three indices interleaved, x lowest; indices below 2²¹.
pub(super) fn code(index: [u32; 3]) -> u64 {
    spread(index[0]) | spread(index[1]) << 1 | spread(index[2]) << 2
}

/// Moves bit i to bit 3 i.
fn spread(index: u32) -> u64 {
    let mut bits = u64::from(index);
    bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_interleaved() {
        for bit in 0..21 {
            assert_eq!(code([1 << bit, 0, 0]), 1 << (3 * bit));
            assert_eq!(code([0, 1 << bit, 0]), 2 << (3 * bit));
            assert_eq!(code([0, 0, 1 << bit]), 4 << (3 * bit));
        }
        assert_eq!(code([0b11, 0b01, 0b10]), 0b101_011);
    }
}
