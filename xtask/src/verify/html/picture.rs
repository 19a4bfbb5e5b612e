//! A picture of a scene.

use anyhow::{Context, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use smoothpatch::io::write_png;
use smoothpatch::pictures::NetPatches;
use smoothpatch::render::{Shade, Style, UpAxis, View, draw, frame};
use smoothpatch::scene;

use crate::verify::cases::Case;
use crate::verify::measures::fit_case;

const SIZE: [usize; 2] = [640, 480];
const STRIPES: f64 = 12.0;

/// Reflection lines on the surface of a case, as an address that holds the picture itself.
pub(super) fn zebra(case: &Case) -> Result<String> {
    let field = scene::field_of(&case.scene.surface)?;
    let surface = fit_case(case, &*field)?;
    let patches = NetPatches(&surface.patches.nets);
    let axes = View::new(-35.0, 28.0).axes(UpAxis::Z);
    let camera = frame(&[&patches], axes, SIZE).context("the surface has no extent")?;
    let picture = draw(&patches, &camera, SIZE, &Style::new(Shade::Zebra(STRIPES)))?;
    let mut file = Vec::new();
    write_png(&mut file, picture.size(), &picture.bytes())?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(&file)))
}
