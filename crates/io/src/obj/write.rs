//! Writing OBJ with the shortest digits that give the same f64 back.

use std::io::{self, Write};

use basemesh::TriMesh;
use glam::DVec3;

use super::error::ObjWriteError;
use crate::samples::CreasedTessellation;
use crate::tessellate::Tessellation;

/// Writes the vertices and faces of a mesh, in id order. [`read_obj`](crate::read_obj) returns the
/// same mesh bit for bit.
///
/// # Errors
///
/// [`ObjWriteError::Io`].
pub fn write_obj(out: &mut dyn Write, mesh: &TriMesh) -> Result<(), ObjWriteError> {
    write_points(out, "v", mesh.positions().as_slice())?;
    for corners in mesh.face_indices() {
        let [a, b, c] = corners.map(|index| index + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}

/// Writes the points, unit normals and triangles of a tessellation.
///
/// # Errors
///
/// [`ObjWriteError`]; numbers that are not finite are found before anything is written.
pub fn write_obj_tessellation(
    out: &mut dyn Write,
    tessellation: &Tessellation,
) -> Result<(), ObjWriteError> {
    let Tessellation { positions, normals, triangles } = tessellation;
    if positions.len() != normals.len() {
        let (positions, normals) = (positions.len(), normals.len());
        return Err(ObjWriteError::NormalCount { positions, normals });
    }
    check_finite("position", positions)?;
    check_finite("normal", normals)?;
    write_points(out, "v", positions)?;
    write_points(out, "vn", normals)?;
    for corners in triangles {
        let [a, b, c] = corners.map(|index| index + 1);
        writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}

/// Writes the points and triangles of a tessellation, and a unit normal for each corner: creases
/// stay sharp.
///
/// # Errors
///
/// [`ObjWriteError`]; numbers that are not finite are found before anything is written.
pub fn write_obj_creased(
    out: &mut dyn Write,
    tessellation: &CreasedTessellation,
) -> Result<(), ObjWriteError> {
    let CreasedTessellation { positions, normals, triangles, triangle_normals } = tessellation;
    check_finite("position", positions)?;
    check_finite("normal", normals)?;
    write_points(out, "v", positions)?;
    write_points(out, "vn", normals)?;
    for (corners, normals) in triangles.iter().zip(triangle_normals) {
        let [a, b, c] = corners.map(|index| index + 1);
        let [na, nb, nc] = normals.map(|index| index + 1);
        writeln!(out, "f {a}//{na} {b}//{nb} {c}//{nc}")?;
    }
    Ok(())
}

fn check_finite(what: &'static str, values: &[DVec3]) -> Result<(), ObjWriteError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(point) => Err(ObjWriteError::NotFinite { point, what, value: values[point] }),
        None => Ok(()),
    }
}

fn write_points(out: &mut dyn Write, keyword: &str, points: &[DVec3]) -> io::Result<()> {
    // `{:?}` is the shortest form that rounds back, with an exponent where that is shorter
    points.iter().try_for_each(|p| writeln!(out, "{keyword} {:?} {:?} {:?}", p.x, p.y, p.z))
}
