//! Evaluation of a block of points at a time.
//!
//! A block holds each component of a number for eight or sixteen points side by side, so that the
//! loop over the points, whose body is the operation on a single number, becomes vector
//! instructions. Being the same operations, they give the same bits.

use std::array::from_fn;

use glam::DVec3;

use super::tape::{Machine, Slot, Tape};
use crate::jet1::Jet1;
use crate::jet2::Jet2;
use crate::number::Number;

/// The points in a block of jets.
const LANES: usize = 8;

/// The points in a block of plain values: twice as many, because the work per point is small
/// beside the cost of going from one operation to the next.
const VALUE_LANES: usize = 16;

/// A number that can be stored component by component, many points side by side.
pub(super) trait Laned: Number {
    /// One array per component.
    type Block: Copy;

    /// The number of points in a block.
    const LANES: usize;

    const ZERO: Self::Block;

    /// The number of one point.
    fn get(block: &Self::Block, lane: usize) -> Self;

    /// Replaces the number of one point.
    fn set(self, block: &mut Self::Block, lane: usize);

    /// The independent variables at a point.
    fn variables(p: [f64; 3]) -> [Self; 3];
}

impl Laned for f64 {
    type Block = [f64; VALUE_LANES];

    const LANES: usize = VALUE_LANES;
    const ZERO: Self::Block = [0.0; VALUE_LANES];

    #[inline(always)]
    fn get(block: &Self::Block, lane: usize) -> Self {
        block[lane]
    }

    #[inline(always)]
    fn set(self, block: &mut Self::Block, lane: usize) {
        block[lane] = self;
    }

    #[inline(always)]
    fn variables(p: [f64; 3]) -> [Self; 3] {
        p
    }
}

impl Laned for Jet1 {
    type Block = [[f64; LANES]; 4];

    const LANES: usize = LANES;
    const ZERO: Self::Block = [[0.0; LANES]; 4];

    #[inline(always)]
    fn get(block: &Self::Block, lane: usize) -> Self {
        Self { value: block[0][lane], gradient: from_fn(|i| block[1 + i][lane]) }
    }

    #[inline(always)]
    fn set(self, block: &mut Self::Block, lane: usize) {
        block[0][lane] = self.value;
        for i in 0..3 {
            block[1 + i][lane] = self.gradient[i];
        }
    }

    #[inline(always)]
    fn variables(p: [f64; 3]) -> [Self; 3] {
        Self::variables(p)
    }
}

impl Laned for Jet2 {
    type Block = [[f64; LANES]; 10];

    const LANES: usize = LANES;
    const ZERO: Self::Block = [[0.0; LANES]; 10];

    #[inline(always)]
    fn get(block: &Self::Block, lane: usize) -> Self {
        Self {
            value: block[0][lane],
            gradient: from_fn(|i| block[1 + i][lane]),
            hessian: from_fn(|k| block[4 + k][lane]),
        }
    }

    #[inline(always)]
    fn set(self, block: &mut Self::Block, lane: usize) {
        block[0][lane] = self.value;
        for i in 0..3 {
            block[1 + i][lane] = self.gradient[i];
        }
        for k in 0..6 {
            block[4 + k][lane] = self.hessian[k];
        }
    }

    #[inline(always)]
    fn variables(p: [f64; 3]) -> [Self; 3] {
        Self::variables(p)
    }
}

impl From<Jet1> for (f64, DVec3) {
    #[inline]
    fn from(u: Jet1) -> Self {
        (u.value, DVec3::from_array(u.gradient))
    }
}

impl Tape {
    /// Fills `out` with the numbers at the points; the lengths agree.
    pub(super) fn evaluate_batch<T: Laned + Into<R>, R>(&self, points: &[DVec3], out: &mut [R]) {
        // a quarter of a block: below, the idle lanes cost more than the dispatch saves
        if points.len() <= T::LANES / 4 {
            for (out, p) in out.iter_mut().zip(points) {
                *out = self.evaluate(T::variables(p.to_array())).into();
            }
            return;
        }
        let mut blocks = vec![T::ZERO; self.slot_count()];
        for (points, out) in points.chunks(T::LANES).zip(out.chunks_mut(T::LANES)) {
            // in the last chunk the lanes without a point keep the numbers of the chunk before
            for (lane, p) in points.iter().enumerate() {
                for (block, variable) in blocks.iter_mut().zip(T::variables(p.to_array())) {
                    variable.set(block, lane);
                }
            }
            self.run(&mut Blocks::<T>(&mut blocks));
            for (lane, out) in out.iter_mut().enumerate() {
                *out = T::get(&blocks[self.result], lane).into();
            }
        }
    }
}

/// One block per slot.
struct Blocks<'a, T: Laned>(&'a mut [T::Block]);

impl<T: Laned> Machine for Blocks<'_, T> {
    type Number = T;

    #[inline(always)]
    fn constant(&mut self, out: usize, c: f64) {
        for lane in 0..T::LANES {
            T::constant(c).set(&mut self.0[out], lane);
        }
    }

    #[inline(always)]
    fn unary(&mut self, out: usize, a: Slot, f: impl Fn(T) -> T) {
        let (operands, results) = self.0.split_at_mut(out);
        map(&mut results[0], &operands[a as usize], f);
    }

    #[inline(always)]
    fn binary(&mut self, out: usize, [a, b]: [Slot; 2], f: impl Fn(T, T) -> T) {
        let (operands, results) = self.0.split_at_mut(out);
        zip(&mut results[0], &operands[a as usize], &operands[b as usize], f);
    }
}

/// Not inlined: as arguments of a function the blocks are known to be disjoint, without which the
/// loop does not become vector instructions.
#[inline(never)]
fn map<T: Laned>(out: &mut T::Block, a: &T::Block, f: impl Fn(T) -> T) {
    for lane in 0..T::LANES {
        f(T::get(a, lane)).set(out, lane);
    }
}

/// As [`map`], for two operands.
#[inline(never)]
fn zip<T: Laned>(out: &mut T::Block, a: &T::Block, b: &T::Block, f: impl Fn(T, T) -> T) {
    for lane in 0..T::LANES {
        f(T::get(a, lane), T::get(b, lane)).set(out, lane);
    }
}
