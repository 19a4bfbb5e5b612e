//! Flat triangles in the formats of viewers and printers: PLY, STL, GLB.

mod error;
mod glb;
mod ply;
mod stl;

use std::collections::HashMap;

use glam::DVec3;

use crate::samples::CreasedTessellation;
use crate::tessellate::Tessellation;

pub use error::TrianglesError;
pub use glb::write_glb;
pub use ply::write_ply;
pub use stl::write_stl;

impl From<Tessellation> for CreasedTessellation {
    fn from(Tessellation { positions, normals, triangles }: Tessellation) -> Self {
        Self { positions, normals, triangle_normals: triangles.clone(), triangles }
    }
}

/// Points that have one position and one normal each, as most formats want them. Along creases there
/// are several with the same position.
struct Pairs {
    /// Indices of position and normal, in the order in which triangles use them.
    points: Vec<[usize; 2]>,
    triangles: Vec<[u32; 3]>,
}

/// Pairs of position and normal, each once.
fn pairs(tessellation: &CreasedTessellation) -> Result<Pairs, TrianglesError> {
    check(tessellation)?;
    let mut points = Vec::new();
    let mut known: HashMap<[usize; 2], u32> = HashMap::new();
    let mut triangles = Vec::with_capacity(tessellation.triangles.len());
    for (corners, normals) in tessellation.triangles.iter().zip(&tessellation.triangle_normals) {
        let mut triangle = [0; 3];
        for (slot, (&position, &normal)) in triangle.iter_mut().zip(corners.iter().zip(normals)) {
            let next = u32::try_from(points.len()).map_err(|_| TrianglesError::TooMany)?;
            *slot = *known.entry([position, normal]).or_insert_with(|| {
                points.push([position, normal]);
                next
            });
        }
        triangles.push(triangle);
    }
    Ok(Pairs { points, triangles })
}

/// Every triangle must have corners and normals that exist and are finite.
fn check(tessellation: &CreasedTessellation) -> Result<(), TrianglesError> {
    let CreasedTessellation { positions, normals, triangles, triangle_normals } = tessellation;
    if triangles.len() != triangle_normals.len() {
        let (triangles, normals) = (triangles.len(), triangle_normals.len());
        return Err(TrianglesError::NormalCount { triangles, normals });
    }
    for (triangle, (corners, of_corners)) in triangles.iter().zip(triangle_normals).enumerate() {
        for (what, ids, values) in
            [("position", corners, positions), ("normal", of_corners, normals)]
        {
            for &id in ids {
                match values.get(id) {
                    None => return Err(TrianglesError::Missing { triangle, what, id }),
                    Some(value) if !value.is_finite() => {
                        return Err(TrianglesError::NotFinite { triangle, what, value: *value });
                    }
                    Some(_) => {}
                }
            }
        }
    }
    Ok(())
}

/// Coordinates as f32, which is all that a format has.
#[allow(clippy::cast_possible_truncation, reason = "rounding is what is wanted; overflow is found")]
fn single(triangle: usize, value: DVec3) -> Result<[f32; 3], TrianglesError> {
    let rounded = value.as_vec3();
    if rounded.is_finite() {
        Ok(rounded.to_array())
    } else {
        Err(TrianglesError::TooLarge { triangle, value })
    }
}
