//! GLB: glTF 2.0 in one binary file, f32.

use std::io::Write;

use super::{TrianglesError, pairs, single};
use crate::samples::CreasedTessellation;

const MAGIC: u32 = 0x4654_6C67;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;

/// Writes points, unit normals and triangles as one mesh. Coordinates are rounded to f32 and keep
/// their axes and their unit, which glTF takes as metres, y up.
///
/// # Errors
///
/// [`TrianglesError`].
pub fn write_glb(
    out: &mut dyn Write,
    tessellation: &CreasedTessellation,
) -> Result<(), TrianglesError> {
    let pairs = pairs(tessellation)?;
    if pairs.triangles.is_empty() {
        return Err(TrianglesError::Empty);
    }
    let mut points = vec![[0.0_f32; 3]; pairs.points.len()];
    for (triangle, corners) in pairs.triangles.iter().enumerate() {
        for &corner in corners {
            let [position, _] = pairs.points[corner as usize];
            points[corner as usize] = single(triangle, tessellation.positions[position])?;
        }
    }
    let normals =
        pairs.points.iter().map(|&[_, normal]| tessellation.normals[normal].as_vec3().to_array());
    let mut binary = Vec::with_capacity(24 * points.len() + 12 * pairs.triangles.len());
    let floats = points.iter().copied().chain(normals).flatten();
    floats.for_each(|value| binary.extend_from_slice(&value.to_le_bytes()));
    let indices = pairs.triangles.iter().flatten();
    indices.for_each(|index| binary.extend_from_slice(&index.to_le_bytes()));

    let mut json = description(&points, 3 * pairs.triangles.len(), binary.len()).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let size = |bytes: usize| u32::try_from(bytes).map_err(|_| TrianglesError::TooMany);
    let total = size(12 + 8 + json.len() + 8 + binary.len())?;
    for word in [MAGIC, 2, total, size(json.len())?, JSON_CHUNK] {
        out.write_all(&word.to_le_bytes())?;
    }
    out.write_all(&json)?;
    for word in [size(binary.len())?, BINARY_CHUNK] {
        out.write_all(&word.to_le_bytes())?;
    }
    Ok(out.write_all(&binary)?)
}

/// The JSON part: where in the binary part points, normals and indices are.
fn description(points: &[[f32; 3]], indices: usize, bytes: usize) -> String {
    let bound = |pick: fn(f32, f32) -> f32| {
        let fold = |axis: usize| points.iter().map(|point| point[axis]).reduce(pick);
        [0, 1, 2].map(|axis| fold(axis).unwrap_or_default())
    };
    let (low, high) = (bound(f32::min), bound(f32::max));
    let (count, size) = (points.len(), 12 * points.len());
    let generator = concat!("smoothpatch ", env!("CARGO_PKG_VERSION"));
    format!(
        r#"{{"asset":{{"version":"2.0","generator":"{generator}"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}},"indices":2}}]}}],"buffers":[{{"byteLength":{bytes}}}],"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":{size},"target":34962}},{{"buffer":0,"byteOffset":{size},"byteLength":{size},"target":34962}},{{"buffer":0,"byteOffset":{start},"byteLength":{index_bytes},"target":34963}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":{count},"type":"VEC3","min":{low:?},"max":{high:?}}},{{"bufferView":1,"componentType":5126,"count":{count},"type":"VEC3"}},{{"bufferView":2,"componentType":5125,"count":{indices},"type":"SCALAR"}}]}}"#,
        start = 2 * size,
        index_bytes = 4 * indices,
    )
}
