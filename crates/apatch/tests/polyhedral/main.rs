//! Smooth solids: the scheme of Bajaj, Chen & Xu (1994).

mod common;
#[path = "../common/mod.rs"]
mod numbers;
mod oracle;
mod random;
mod rays;
mod solids;
