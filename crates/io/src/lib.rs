#![doc = include_str!("../README.md")]

mod atomic;
mod chord;
mod curved_mesh;
mod gap;
mod in_file;
mod lattice;
mod mesh_file;
mod msh;
mod node_order;
mod obj;
mod off;
mod patch_surface;
mod patterns;
mod png;
mod polygon;
mod samples;
mod scene;
mod shared_points;
mod step;
mod tessellate;
mod text;
mod triangles;
mod vtu;

pub use atomic::{WriteError, write_atomically};
pub use basemesh;
pub use bezier_core;
pub use chord::{ChordError, ChordTessellation, tessellate_patches_within, tessellate_within};
pub use curved_mesh::CurvedMesh;
pub use glam;
pub use in_file::InFile;
pub use lattice::SharedPointError;
pub use mesh_file::{
    MeshFile, MeshFileError, MeshFormat, PolygonSoup, Repairs, read_mesh, read_mesh_file, repair,
};
pub use msh::{MAX_MSH_ORDER, MshError, MshOptions, MshVersion, write_msh};
pub use node_order::{node_order, quad_node_order};
pub use obj::{
    LargeFaces, ObjReadError, ObjWriteError, Polygons, read_faces, read_faces_file, read_obj,
    read_obj_file, read_polygons, read_polygons_file, write_obj, write_obj_creased,
    write_obj_tessellation,
};
pub use off::{Faces, OffReadError, read_off, read_off_file};
pub use patch_surface::{PatchNet, PatchSurface, PatchSurfaceError};
pub use png::{PngError, write_png};
pub use polygon::Polygon;
pub use samples::{CreasedTessellation, FacePoint, Samples};
pub use scene::{Bounds, Method, Region, Scene, SceneError, SceneSurface};
pub use step::{
    LengthUnit, StepCounts, StepError, StepFaces, StepOptions, StepSchema, StepSize, step_size,
    write_step,
};
pub use tessellate::{Tessellation, tessellate, tessellation_gap};
pub use triangles::{TrianglesError, write_glb, write_ply, write_stl};
pub use vtu::{
    CellData, CellKind, CellValues, Encoding, Grid, GridCell, JoinError, VtuOptions, VtuPiece,
    VtuReadError, VtuSurface, VtuWriteError, read_grid, read_grid_file, read_piece_file, read_vtu,
    read_vtu_file, write_grid, write_pvtu, write_vtu,
};
