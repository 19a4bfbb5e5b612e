//! Numbers that look random and are the same everywhere.

/// A generator of numbers that is the same everywhere.
#[derive(Clone, Debug)]
pub struct Numbers(u64);

impl Numbers {
    /// Other numbers for every seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// From 0 to 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From -1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// Positive weights that add up to one.
    pub fn weights<const N: usize>(&mut self) -> [f64; N] {
        let raw: [f64; N] = std::array::from_fn(|_| 1e-3 - self.unit().max(1e-12).ln());
        let sum: f64 = raw.iter().sum();
        raw.map(|w| w / sum)
    }
}
