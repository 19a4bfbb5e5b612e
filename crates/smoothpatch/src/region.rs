//! A box around a surface whose whereabouts are unknown.

use basemesh::{PolygonizeError, PolygonizeSettings, polygonize};
use implicit::{Aabb, ImplicitSurface};

/// Cells along the side of each box that is tried.
const CELLS: usize = 32;
/// The boxes that are tried: half sizes `2^-4 ..= 2^10`.
const SMALLEST: i32 = -4;
const LARGEST: i32 = 10;
/// Room left around the surface that was found, as a factor of its box.
const MARGIN: f64 = 1.25;

/// The smallest of a sequence of boxes around the origin, each twice as large as the one before,
/// that contains a closed surface and nothing that leaves it; shrunk to that surface with a margin.
///
/// # Errors
///
/// What was wrong with the largest box if none fits: no surface, a surface that leaves it, or
/// values that are not finite.
pub fn find_region(field: &dyn ImplicitSurface) -> Result<Aabb, PolygonizeError> {
    let mut last = None;
    for exponent in SMALLEST..=LARGEST {
        let candidate = Aabb::from_half_size(2.0_f64.powi(exponent));
        match polygonize(field, &candidate, &PolygonizeSettings::with_cells(CELLS)) {
            Ok(mesh) => {
                let [min, max] = mesh.bounding_box();
                let room = Aabb { min, max }.expanded(MARGIN);
                return Ok(room.intersection(&candidate).unwrap_or(candidate));
            }
            Err(error) => {
                // a surface that leaves a box tells more than an empty box
                let empty =
                    |error: &PolygonizeError| matches!(error, PolygonizeError::NoSurface { .. });
                if !empty(&error) || last.as_ref().is_none_or(empty) {
                    last = Some(error);
                }
            }
        }
    }
    Err(last.expect("invariant: at least one box was tried"))
}
