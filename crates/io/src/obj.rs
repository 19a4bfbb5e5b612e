//! Triangle meshes as Wavefront OBJ, with coordinates that survive bit for bit.

mod error;
mod read;
mod write;

pub use error::{ObjReadError, ObjWriteError};
pub use read::{read_obj, read_obj_file};
pub use write::{write_obj, write_obj_tessellation};
