//! What can go wrong on the way from a field to a mesh.

use glam::DVec3;
use implicit::Aabb;
use thiserror::Error;

use crate::mesh::MeshError;

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PolygonizeError {
    /// The region is not a box of positive, finite size.
    #[error("the region from {} to {} is no box of positive and finite size", .region.min, .region.max)]
    InvalidRegion {
        /// The region as given.
        region: Aabb,
    },
    /// The number of cells is zero, or so large that the grid would not be exact.
    #[error("{cells} cells along the longest side of the region: use 1 to {max}")]
    InvalidCells {
        /// The number as given.
        cells: usize,
        /// The largest number of cells, limited by 2²⁰ and by the precision of the coordinates.
        max: usize,
    },
    /// Both signs are needed for a surface, and only one was seen.
    #[error(
        "no surface in the region from {} to {}: the values seen lie between {min} and {max}; \
         choose another region or level, or use more cells",
        .region.min, .region.max
    )]
    NoSurface {
        /// The region as given.
        region: Aabb,
        /// A lower bound of the values: the smallest sample or lower end of an enclosure.
        min: f64,
        /// An upper bound of the values: the largest sample or upper end of an enclosure.
        max: f64,
    },
    /// The surface passes through the boundary of the region.
    #[error(
        "the surface leaves the region at {at}; use the region from {} to {} ({})",
        .suggested.min, .suggested.max, describe_suggestion(*.closes)
    )]
    LeavesRegion {
        /// A place on the boundary where it does.
        at: DVec3,
        /// A box that contains the region and is larger.
        suggested: Aabb,
        /// Whether the surface was seen to be closed in the suggested box, on a coarse grid;
        /// otherwise the suggestion is a guess and the surface may be unbounded.
        closes: bool,
    },
    /// The field has no finite value at a grid node.
    #[error("the value of the field at {at} is {value}; every value in the region must be finite")]
    NotFinite {
        /// The node.
        at: DVec3,
        /// The value there.
        value: f64,
    },
    /// More triangles than 32-bit ids can number.
    #[error(
        "the mesh would have about {faces} triangles; at most {max} are supported, use fewer cells"
    )]
    TooLarge {
        /// Estimated number of triangles.
        faces: usize,
        /// Largest number of triangles.
        max: usize,
    },
    /// Two evaluations of the field at one point had different signs.
    #[error(
        "the field has different values when it is evaluated twice near {at}; it must be a pure function"
    )]
    Inconsistent {
        /// A grid node next to the contradiction.
        at: DVec3,
    },
    /// The triangles do not form a mesh; impossible for a field that is a pure function.
    #[error("the triangles do not form a mesh: {0}")]
    Mesh(#[from] MeshError),
}

fn describe_suggestion(closes: bool) -> &'static str {
    if closes { "on a coarse grid the surface is closed there" } else { "a guess" }
}
