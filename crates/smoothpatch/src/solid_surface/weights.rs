//! Tetrahedra with their weights as a JSON file.

use std::io::{Read, Write};

use apatch::polyhedral::{
    Hull, HullError, PointOrigin, PolyhedralSurface, Skeleton, SkeletonTriangle, TriangleOrigin,
};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The word that such a file begins with.
const FORMAT: &str = "smoothpatch tetrahedra";
const VERSION: u32 = 1;

/// Why weights are not read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WeightsError {
    /// The operating system failed, or the text is not JSON of this form.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// Another format or a later version.
    #[error("the file is '{format}' version {version}, not '{FORMAT}' version {VERSION}")]
    Format {
        /// What it says.
        format: String,
        /// Its version.
        version: u32,
    },
    /// A triangle names a point that does not exist.
    #[error("triangle {triangle} uses point {point}, but only {count} points have normals")]
    Point {
        /// The triangle.
        triangle: usize,
        /// The point.
        point: usize,
        /// Number of points of the triangulation.
        count: usize,
    },
    /// The tetrahedra are not those over the triangles.
    #[error("tetrahedron {tetrahedron} is not the one that its triangles have there")]
    Tetrahedron {
        /// The tetrahedron.
        tetrahedron: usize,
    },
    /// The triangles do not make a hull, or a weight is no number.
    #[error(transparent)]
    Hull(#[from] HullError),
}

/// What stands in the file. Numbers count from 0.
#[derive(Serialize, Deserialize)]
struct File {
    format: String,
    version: u32,
    /// 3 or 5.
    degree: usize,
    /// All points of the hull; the first ones, with normals, are those of the triangulation.
    points: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    origins: Vec<Origin>,
    triangles: Vec<Triangle>,
    tetrahedra: Vec<Tetrahedron>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Origin {
    Face(usize),
    Corner(usize),
    Fan([usize; 2]),
    Edge([usize; 2]),
}

#[derive(Serialize, Deserialize)]
struct Triangle {
    corners: [usize; 3],
    /// Numbers of the apices on the positive and negative side.
    apices: [Option<usize>; 2],
    rounds: Origin,
}

#[derive(Serialize, Deserialize)]
struct Tetrahedron {
    /// Corners on the triangulation first.
    corners: [usize; 4],
    /// By their indices `(i, j, k, l)`: `i` falls, then `j`, then `k`.
    weights: Vec<f64>,
}

impl From<PointOrigin> for Origin {
    fn from(origin: PointOrigin) -> Self {
        match origin {
            PointOrigin::Guard(face) => Self::Face(face),
            PointOrigin::Corner(vertex) => Self::Corner(vertex),
        }
    }
}

impl From<TriangleOrigin> for Origin {
    fn from(origin: TriangleOrigin) -> Self {
        match origin {
            TriangleOrigin::Corner(vertex) => Self::Corner(vertex),
            TriangleOrigin::Fan(ends) => Self::Fan(ends),
            TriangleOrigin::Edge(ends) => Self::Edge(ends),
            TriangleOrigin::Face(face) => Self::Face(face),
        }
    }
}

/// Writes all tetrahedra with their weights; [`read_weights`] returns the same surface bit for bit.
///
/// # Errors
///
/// [`WeightsError::Json`] if the operating system fails.
pub fn write_weights(out: &mut dyn Write, surface: &PolyhedralSurface) -> Result<(), WeightsError> {
    let hull = surface.hull();
    let triangle = |t: &apatch::polyhedral::HullTriangle| Triangle {
        corners: t.corners,
        apices: t.apices,
        rounds: t.origin.into(),
    };
    let tetrahedron = |cell: usize| Tetrahedron {
        corners: hull.corners(hull.cells[cell]),
        weights: surface.weights(cell).to_vec(),
    };
    let file = File {
        format: FORMAT.to_owned(),
        version: VERSION,
        degree: surface.degree(),
        points: hull.points.iter().map(DVec3::to_array).collect(),
        normals: hull.normals.iter().map(DVec3::to_array).collect(),
        origins: hull.origins.iter().map(|&o| o.into()).collect(),
        triangles: hull.triangles.iter().map(triangle).collect(),
        tetrahedra: (0..hull.cells.len()).map(tetrahedron).collect(),
    };
    Ok(serde_json::to_writer_pretty(out, &file)?)
}

/// Reads what [`write_weights`] writes. The report is made anew.
///
/// # Errors
///
/// [`WeightsError`].
pub fn read_weights(input: &mut dyn Read) -> Result<PolyhedralSurface, WeightsError> {
    let file: File = serde_json::from_reader(input)?;
    if file.format != FORMAT || file.version != VERSION {
        return Err(WeightsError::Format { format: file.format, version: file.version });
    }
    let hull = Hull::new(skeleton(&file)?)?;
    let points = hull.points.iter().map(DVec3::to_array);
    let first_other = file
        .tetrahedra
        .iter()
        .zip(&hull.cells)
        .position(|(tetrahedron, cell)| tetrahedron.corners != hull.corners(*cell));
    let count = file.tetrahedra.len().min(hull.cells.len());
    if let Some(tetrahedron) = first_other {
        return Err(WeightsError::Tetrahedron { tetrahedron });
    }
    if file.tetrahedra.len() != hull.cells.len() || !points.eq(file.points.iter().copied()) {
        return Err(WeightsError::Tetrahedron { tetrahedron: count });
    }
    let weights = file.tetrahedra.into_iter().flat_map(|t| t.weights).collect();
    Ok(PolyhedralSurface::from_weights(hull, file.degree, weights)?)
}

fn skeleton(file: &File) -> Result<Skeleton, WeightsError> {
    let count = file.normals.len().min(file.points.len());
    let mut triangles = Vec::new();
    for (triangle, t) in file.triangles.iter().enumerate() {
        if let Some(&point) = t.corners.iter().find(|&&p| p >= count) {
            return Err(WeightsError::Point { triangle, point, count });
        }
        let apex = |p: usize| {
            let point = file.points.get(p).copied().map(DVec3::from_array);
            point.ok_or(WeightsError::Point { triangle, point: p, count: file.points.len() })
        };
        let [upper, lower] = t.apices.map(|apex_of| apex_of.map(apex).transpose());
        let origin = match t.rounds {
            Origin::Face(face) => TriangleOrigin::Face(face),
            Origin::Corner(vertex) => TriangleOrigin::Corner(vertex),
            Origin::Fan(ends) => TriangleOrigin::Fan(ends),
            Origin::Edge(ends) => TriangleOrigin::Edge(ends),
        };
        triangles.push(SkeletonTriangle { corners: t.corners, apices: [upper?, lower?], origin });
    }
    let vectors = |all: &[[f64; 3]]| all.iter().map(|&p| DVec3::from_array(p)).collect();
    Ok(Skeleton {
        points: vectors(&file.points[..count]),
        normals: vectors(&file.normals),
        origins: file
            .origins
            .iter()
            .map(|origin| match origin {
                Origin::Face(face) => PointOrigin::Guard(*face),
                Origin::Corner(vertex) | Origin::Fan([vertex, _]) | Origin::Edge([vertex, _]) => {
                    PointOrigin::Corner(*vertex)
                }
            })
            .collect(),
        triangles,
    })
}
