//! What the implementors of the workspace's traits promise, as checks for any of them.

pub mod field;
