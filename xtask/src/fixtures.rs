//! Writes the fixtures that are generated rather than copied.

use anyhow::{Context, Result};
use smoothpatch::io::write_obj;
use testkit::meshes::torus_grid;

/// The torus of the paper: radii of the circle of centres and of the tube.
const RADII: [f64; 2] = [5.0, 1.0];
/// Quadrilaterals around the axis and around the tube, each cut in two.
const CELLS: [usize; 2] = [20, 10];

/// Writes `fixtures/meshes/torus_20x10.obj`.
pub(crate) fn run() -> Result<()> {
    let mesh = torus_grid(RADII, CELLS[0], CELLS[1]);
    let path = crate::root().join("fixtures/meshes/torus_20x10.obj");
    let mut contents = Vec::new();
    write_obj(&mut contents, &mesh)?;
    std::fs::write(&path, contents).with_context(|| path.display().to_string())?;
    println!("{}: {} triangles", path.display(), mesh.topology().face_count());
    Ok(())
}
