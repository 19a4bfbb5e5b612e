//! Loops compiled for the widest vector instructions of the processor.

/// A computation on many numbers; `run` should be `#[inline(always)]`, and all that its loops call.
pub(crate) trait Loops {
    type Output;

    fn run(self) -> Self::Output;
}

/// Runs it, with the feature `simd` compiled for the processor at hand. The results are the same bits:
/// products and sums are not fused.
#[inline(always)]
pub(crate) fn widest<L: Loops>(loops: L) -> L::Output {
    #[cfg(feature = "simd")]
    return pulp::Arch::new().dispatch(vector::Compiled(loops));
    #[cfg(not(feature = "simd"))]
    loops.run()
}

#[cfg(feature = "simd")]
mod vector {
    use pulp::{Simd, WithSimd};

    use super::Loops;

    pub(super) struct Compiled<L>(pub(super) L);

    impl<L: Loops> WithSimd for Compiled<L> {
        type Output = L::Output;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> L::Output {
            self.0.run()
        }
    }
}
