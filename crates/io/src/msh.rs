//! Curved surface meshes for Gmsh (`.msh`) and the solvers that read its files.

mod error;
mod write;

pub use error::MshError;
pub use write::write_msh;

/// The largest order that Gmsh has a number for.
pub const MAX_MSH_ORDER: usize = 10;

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MshVersion {
    /// 4.1, of Gmsh 4.
    #[default]
    V4,
    /// 2.2, which most other programs read.
    V2,
}

/// What to write.
#[derive(Clone, Debug, PartialEq)]
pub struct MshOptions {
    /// The version of the format.
    pub version: MshVersion,
    /// Name of the one physical group, which holds all elements.
    pub group: String,
}

impl Default for MshOptions {
    fn default() -> Self {
        Self { version: MshVersion::default(), group: "surface".into() }
    }
}
