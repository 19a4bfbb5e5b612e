//! From numbers to colours.

use crate::colour::Colour;

/// A sequence of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourMap {
    /// From pale to dark, for sizes.
    Sequential,
    /// From blue over white to red, for numbers of both signs.
    Diverging,
}

impl ColourMap {
    /// The colour at `t` between 0 and 1.
    #[must_use]
    pub fn at(self, t: f64) -> Colour {
        let stops: &[[f64; 3]] = match self {
            Self::Sequential => &[
                [0.95, 0.95, 0.87],
                [0.78, 0.87, 0.73],
                [0.45, 0.73, 0.68],
                [0.20, 0.54, 0.62],
                [0.16, 0.33, 0.52],
                [0.17, 0.13, 0.33],
            ],
            Self::Diverging => &[
                [0.10, 0.25, 0.55],
                [0.26, 0.55, 0.78],
                [0.66, 0.82, 0.91],
                [0.96, 0.96, 0.94],
                [0.97, 0.77, 0.63],
                [0.86, 0.40, 0.32],
                [0.60, 0.07, 0.16],
            ],
        };
        let last = stops.len() - 1;
        let x = t.clamp(0.0, 1.0) * last as f64;
        let before = (0..last).rev().find(|&stop| stop as f64 <= x).unwrap_or(0);
        let within = x - before as f64;
        let channel = |c: usize| stops[before][c] * (1.0 - within) + stops[before + 1][c] * within;
        Colour::from_srgb([0, 1, 2].map(channel))
    }
}

/// How numbers become colours. Numbers outside have the colour of the nearer end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The number with the first colour.
    pub low: f64,
    /// The number with the last colour.
    pub high: f64,
    /// Equal ratios instead of equal differences; both ends are positive then.
    pub logarithmic: bool,
    /// The colours.
    pub map: ColourMap,
}

impl Scale {
    /// The colour of a number.
    #[must_use]
    pub fn colour(&self, value: f64) -> Colour {
        self.map.at(self.position(value))
    }

    /// 0 at the lower end and 1 at the higher one.
    pub(crate) fn position(&self, value: f64) -> f64 {
        let along = |x: f64| if self.logarithmic { x.max(0.0).ln() } else { x };
        let (low, high) = (along(self.low), along(self.high));
        if high > low { ((along(value) - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 }
    }

    /// Numbers to write beside the colours, from low to high.
    #[must_use]
    pub fn marks(&self) -> Vec<f64> {
        if self.logarithmic {
            return self.decades();
        }
        let span = self.high - self.low;
        if !(span > 0.0 && span.is_finite()) {
            return vec![self.low];
        }
        let rough = span / 5.0;
        let magnitude = 10.0_f64.powf(rough.log10().floor());
        let round = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * magnitude);
        let step = round.into_iter().find(|&step| step >= rough).unwrap_or(rough);
        let first = (self.low / step - 1e-9).ceil();
        let count = (self.high / step + 1e-9).floor() - first;
        #[allow(clippy::cast_possible_truncation, reason = "at most ten")]
        (0..=count as i32).map(|k| (first + f64::from(k)) * step).collect()
    }

    fn decades(&self) -> Vec<f64> {
        // the ends may be powers of ten, a little off
        let first = (self.low.log10() - 1e-9).ceil();
        let last = (self.high.log10() + 1e-9).floor();
        #[allow(clippy::cast_possible_truncation, reason = "exponents of numbers are small")]
        (first as i32..=last as i32).map(|exponent| 10.0_f64.powi(exponent)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round() {
        let linear = Scale { low: -3.7, high: 3.7, logarithmic: false, map: ColourMap::Diverging };
        assert_eq!(linear.marks(), [-2.0, 0.0, 2.0]);
        assert_eq!(Scale { low: 0.0, high: 1.0, ..linear }.marks().len(), 6, "steps of 0.2");
        let decades = Scale { low: 1e-9, high: 1e-5, logarithmic: true, ..linear };
        assert_eq!(decades.marks().len(), 5, "{:?}", decades.marks());
    }

    #[test]
    fn ends_and_middle_have_their_colours() {
        let scale = Scale { low: 1e-8, high: 1e-4, logarithmic: true, map: ColourMap::Sequential };
        assert_eq!(scale.colour(0.0), ColourMap::Sequential.at(0.0), "below");
        assert_eq!(scale.colour(1.0), ColourMap::Sequential.at(1.0), "above");
        assert!((scale.position(1e-6) - 0.5).abs() < 1e-12, "middle");
    }
}
