//! Meshes as Wavefront OBJ, with coordinates that survive bit for bit.

mod error;
mod faces;
mod polygons;
mod read;
mod soup;
mod statements;
mod write;

pub use error::{ObjReadError, ObjWriteError};
pub use faces::{read_faces, read_faces_file};
pub use polygons::{LargeFaces, Polygons, read_polygons, read_polygons_file};
pub(crate) use soup::read_soup;

pub use read::{read_obj, read_obj_file};
pub use write::{write_obj, write_obj_creased, write_obj_tessellation};
