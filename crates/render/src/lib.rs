#![doc = include_str!("../README.md")]

mod camera;
mod colour;
mod domain;
mod draw;
mod edges;
mod glyphs;
mod lattice;
mod legend;
mod patches;
mod picture;
mod scale;
mod shade;
mod threads;
mod visible;

pub use camera::{Camera, UpAxis, View};
pub use colour::Colour;
pub use domain::Domain;
pub use draw::{DrawError, Style, draw, frame};
pub use glam;
pub use legend::legend;
pub use patches::{Hit, Patches, SurfacePoint};
pub use picture::Picture;
pub use scale::{ColourMap, Scale};
pub use shade::{Shade, Value};
