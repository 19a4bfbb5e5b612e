//! Smooth solids: the scheme of Bajaj, Chen & Xu (1994).

mod common;
mod oracle;
mod solids;
