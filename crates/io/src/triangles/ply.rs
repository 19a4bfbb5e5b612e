//! PLY: binary, little-endian, f64.

use std::io::Write;

use super::{TrianglesError, pairs};
use crate::samples::CreasedTessellation;

/// Writes points, unit normals and triangles; numbers keep all their bits. Along creases points are
/// written once for each normal.
///
/// # Errors
///
/// [`TrianglesError`].
pub fn write_ply(
    out: &mut dyn Write,
    tessellation: &CreasedTessellation,
) -> Result<(), TrianglesError> {
    let pairs = pairs(tessellation)?;
    if i32::try_from(pairs.points.len()).is_err() {
        // readers take the indices as signed numbers
        return Err(TrianglesError::TooMany);
    }
    let (points, triangles) = (pairs.points.len(), pairs.triangles.len());
    let program = concat!("smoothpatch ", env!("CARGO_PKG_VERSION"));
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment {program}\nelement vertex {points}\n\
         property double x\nproperty double y\nproperty double z\n\
         property double nx\nproperty double ny\nproperty double nz\n\
         element face {triangles}\nproperty list uchar int vertex_indices\nend_header\n"
    )?;
    for [position, normal] in pairs.points {
        for value in [tessellation.positions[position], tessellation.normals[normal]] {
            for coordinate in value.to_array() {
                out.write_all(&coordinate.to_le_bytes())?;
            }
        }
    }
    for triangle in pairs.triangles {
        out.write_all(&[3])?;
        for corner in triangle {
            out.write_all(&corner.to_le_bytes())?;
        }
    }
    Ok(())
}
