//! Fields for tests: random smooth closed surfaces, and any field moved or scaled.

mod random;
mod transformed;

pub use random::{Blend, Blob, Wave};
pub use transformed::{Moved, Scaled};
