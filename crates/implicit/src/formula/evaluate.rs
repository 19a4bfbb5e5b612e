//! Evaluation at one point, with any number.

use super::tape::{Machine, Slot, Tape, VARIABLES};
use crate::number::Number;

impl Tape {
    /// The value at `p`; without heap allocation up to 61 operations.
    pub(super) fn evaluate<T: Number>(&self, p: [T; 3]) -> T {
        let zero = T::constant(0.0);
        // the array is filled before use, so the smallest size that fits is the fastest
        match self.slot_count() {
            0..=16 => self.evaluate_in(&mut [zero; 16], p),
            17..=32 => self.evaluate_in(&mut [zero; 32], p),
            33..=64 => self.evaluate_in(&mut [zero; 64], p),
            count => self.evaluate_in(&mut vec![zero; count], p),
        }
    }

    fn evaluate_in<T: Number>(&self, slots: &mut [T], p: [T; 3]) -> T {
        slots[..VARIABLES].copy_from_slice(&p);
        self.run(&mut Slots(slots));
        slots[self.result]
    }
}

/// One number per slot.
struct Slots<'a, T>(&'a mut [T]);

impl<T: Number> Machine for Slots<'_, T> {
    type Number = T;

    #[inline(always)]
    fn constant(&mut self, out: usize, c: f64) {
        self.0[out] = T::constant(c);
    }

    #[inline(always)]
    fn unary(&mut self, out: usize, a: Slot, f: impl Fn(T) -> T) {
        self.0[out] = f(self.0[a as usize]);
    }

    #[inline(always)]
    fn binary(&mut self, out: usize, [a, b]: [Slot; 2], f: impl Fn(T, T) -> T) {
        self.0[out] = f(self.0[a as usize], self.0[b as usize]);
    }
}
