//! Colours.

/// Red, green and blue in linear light, 0 to 1: what can be averaged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Colour(pub [f64; 3]);

impl Colour {
    /// The colour with these values in the usual encoding of screens (sRGB), 0 to 1.
    #[must_use]
    pub fn from_srgb(encoded: [f64; 3]) -> Self {
        Self(
            encoded
                .map(|x| if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }),
        )
    }

    /// A grey with this value in sRGB.
    #[must_use]
    pub fn grey(encoded: f64) -> Self {
        Self::from_srgb([encoded; 3])
    }

    /// Values in sRGB, 0 to 1.
    #[must_use]
    pub fn to_srgb(self) -> [f64; 3] {
        self.0.map(|x| {
            let x = x.clamp(0.0, 1.0);
            if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
        })
    }

    /// Bytes in sRGB.
    #[must_use]
    pub fn bytes(self) -> [u8; 3] {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
        self.to_srgb().map(|x| (255.0 * x).round() as u8)
    }

    /// Sum.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self(std::array::from_fn(|c| self.0[c] + other.0[c]))
    }

    /// Brighter or darker.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self(self.0.map(|x| x * factor))
    }

    /// This colour at `t = 0`, the other at `t = 1`.
    #[must_use]
    pub fn mix(self, other: Self, t: f64) -> Self {
        self.times(1.0 - t).plus(other.times(t))
    }

    /// Largest difference of a channel.
    pub(crate) fn difference(self, other: Self) -> f64 {
        (0..3).map(|c| (self.0[c] - other.0[c]).abs()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_goes_both_ways() {
        for byte in 0..=255_u8 {
            let x = f64::from(byte) / 255.0;
            assert_eq!(Colour::grey(x).bytes(), [byte; 3], "{byte}");
        }
    }
}
