#![doc = include_str!("../README.md")]

mod atomic;
mod in_file;
mod lattice;
mod node_order;
mod obj;
mod scene;
mod tessellate;
mod vtu;

pub use atomic::{WriteError, write_atomically};
pub use basemesh;
pub use bezier_core;
pub use glam;
pub use in_file::InFile;
pub use lattice::SharedPointError;
pub use node_order::node_order;
pub use obj::{
    ObjReadError, ObjWriteError, read_obj, read_obj_file, write_obj, write_obj_tessellation,
};
pub use scene::{Bounds, Method, Region, Scene, SceneError, SceneSurface};
pub use tessellate::{Tessellation, tessellate};
pub use vtu::{
    CellData, CellKind, CellValues, Encoding, VtuOptions, VtuReadError, VtuSurface, VtuWriteError,
    read_vtu, read_vtu_file, write_vtu,
};
