//! Smooth solids: the scheme of Bajaj, Chen & Xu (1994).

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;
mod input;
mod oracle;
mod random;
mod rays;
mod shape;
mod solids;
