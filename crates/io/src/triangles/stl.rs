//! STL: binary, f32.

use std::io::Write;

use super::{TrianglesError, check, single};
use crate::samples::CreasedTessellation;

/// Writes triangles with their flat normals. Coordinates are rounded to f32; triangles that share a
/// point have the same bits there.
///
/// # Errors
///
/// [`TrianglesError`]; a coordinate beyond f32 is found before anything is written.
pub fn write_stl(
    out: &mut dyn Write,
    tessellation: &CreasedTessellation,
) -> Result<(), TrianglesError> {
    check(tessellation)?;
    let count = u32::try_from(tessellation.triangles.len()).map_err(|_| TrianglesError::TooMany)?;
    let corners =
        |triangle: usize| tessellation.triangles[triangle].map(|id| tessellation.positions[id]);
    for triangle in 0..tessellation.triangles.len() {
        corners(triangle).into_iter().try_for_each(|at| single(triangle, at).map(drop))?;
    }
    let mut title = [b' '; 80];
    let program = concat!("smoothpatch ", env!("CARGO_PKG_VERSION")).as_bytes();
    title[..program.len()].copy_from_slice(program);
    out.write_all(&title)?;
    out.write_all(&count.to_le_bytes())?;
    for triangle in 0..tessellation.triangles.len() {
        let corners = corners(triangle);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3().to_array();
        out.write_all(&bytes(normal))?;
        for corner in corners {
            out.write_all(&bytes(single(triangle, corner)?))?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

fn bytes(point: [f32; 3]) -> [u8; 12] {
    let mut bytes = [0; 12];
    for (slot, coordinate) in bytes.chunks_exact_mut(4).zip(point) {
        slot.copy_from_slice(&coordinate.to_le_bytes());
    }
    bytes
}
