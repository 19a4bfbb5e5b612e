//! Work on independent blocks, in parallel with the feature `rayon`.

/// The results in the order of the items, whatever the number of threads.
#[cfg(feature = "rayon")]
pub(super) fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Send + Sync) -> Vec<R> {
    use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
    items.par_iter().map(f).collect()
}

/// The results in the order of the items.
#[cfg(not(feature = "rayon"))]
pub(super) fn map<T, R>(items: &[T], f: impl Fn(&T) -> R) -> Vec<R> {
    items.iter().map(f).collect()
}
