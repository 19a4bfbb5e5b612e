//! Fast text with numbers from which the same bits are read back.

use std::io::{self, Write};

/// Bytes that are collected before they are handed on.
const BLOCK: usize = 1 << 16;

/// Collects text and hands it on in blocks.
pub(crate) struct Text<'a> {
    out: &'a mut dyn Write,
    block: Vec<u8>,
    integers: itoa::Buffer,
    reals: zmij::Buffer,
}

impl<'a> Text<'a> {
    pub(crate) fn new(out: &'a mut dyn Write) -> Self {
        let block = Vec::with_capacity(BLOCK + BLOCK / 4);
        Self { out, block, integers: itoa::Buffer::new(), reals: zmij::Buffer::new() }
    }

    /// Adds text as it is.
    pub(crate) fn push(&mut self, text: &str) -> &mut Self {
        self.block.extend_from_slice(text.as_bytes());
        self
    }

    /// Adds an integer.
    pub(crate) fn integer(&mut self, value: impl itoa::Integer) -> &mut Self {
        self.block.extend_from_slice(self.integers.format(value).as_bytes());
        self
    }

    /// Adds the shortest digits of a finite number that give it back.
    pub(crate) fn real(&mut self, value: f64) -> &mut Self {
        self.block.extend_from_slice(self.reals.format_finite(value).as_bytes());
        self
    }

    /// The same as STEP wants it: there is a point in the mantissa, and the exponent begins with E.
    pub(crate) fn step_real(&mut self, value: f64) -> &mut Self {
        let digits = self.reals.format_finite(value);
        match digits.split_once('e') {
            None => self.block.extend_from_slice(digits.as_bytes()),
            Some((mantissa, exponent)) => {
                self.block.extend_from_slice(mantissa.as_bytes());
                if !mantissa.contains('.') {
                    self.block.push(b'.');
                }
                self.block.push(b'E');
                self.block.extend_from_slice(exponent.as_bytes());
            }
        }
        self
    }

    /// Ends a line; every so often the text so far is handed on.
    pub(crate) fn line(&mut self) -> io::Result<()> {
        self.block.push(b'\n');
        if self.block.len() >= BLOCK { self.hand_on() } else { Ok(()) }
    }

    /// Hands on what is left.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.hand_on()
    }

    fn hand_on(&mut self) -> io::Result<()> {
        self.out.write_all(&self.block)?;
        self.block.clear();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(value: f64) -> String {
        let mut bytes = Vec::new();
        let mut text = Text::new(&mut bytes);
        text.step_real(value);
        text.finish().unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn reals_of_step_have_a_point_and_keep_their_bits() {
        assert_eq!(step(1e-7), "1.E-7");
        assert_eq!(step(-1.5e300), "-1.5E+300");
        assert_eq!(step(3.0), "3.0");
        let mut bits = 1_u64;
        for _ in 0..20_000 {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from_bits(bits);
            if value.is_finite() {
                let text = step(value);
                assert!(text.split('E').next().unwrap().contains('.'), "{text}");
                assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits, "{text}");
            }
        }
        for value in [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX] {
            assert_eq!(step(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn blocks_are_handed_on_in_order() {
        let mut bytes = Vec::new();
        let mut text = Text::new(&mut bytes);
        for number in 0..40_000_u32 {
            text.integer(number).push(" ").real(f64::from(number) / 8.0).line().unwrap();
        }
        text.finish().unwrap();
        let text = String::from_utf8(bytes).unwrap();
        for (number, line) in text.lines().enumerate() {
            assert_eq!(line, format!("{number} {:?}", number as f64 / 8.0));
        }
        assert_eq!(text.lines().count(), 40_000);
    }
}
