//! Surfaces as files have them: flat triangles with normals.

use apatch::rational::RationalSurface;
use apatch::{Element, Tessellation};
use io::{CellData, CellValues, Grid, GridCell};

use super::report::RationalFigures;

/// The triangles of a tessellation as an OBJ file has them.
#[must_use]
pub fn triangles(tessellation: &Tessellation) -> io::Tessellation {
    io::Tessellation {
        positions: tessellation.positions.clone(),
        normals: tessellation.normals.clone(),
        triangles: tessellation.triangles.clone(),
    }
}

/// The triangles of a tessellation as cells, with normals and these numbers for each cell:
/// `patch_kind` ([`apatch::PatchKind`]), `face` and `edge` (the id, or -1 if the patch is over the
/// other one), `invalid` (1 over an edge whose tetrahedra do not fit), and with `figures` `deviation`
/// over the diagonal and `normal_error_deg`.
#[must_use]
pub fn grid(
    surface: &RationalSurface,
    tessellation: &Tessellation,
    figures: Option<&RationalFigures>,
) -> Grid {
    let elements = &tessellation.elements;
    let integers =
        |value: &dyn Fn(&Element) -> i64| CellValues::Int64(elements.iter().map(value).collect());
    let id = |index: usize| i64::try_from(index).expect("invariant: ids fit 32 bits");
    let face = |element: &Element| match *element {
        Element::Face(face) => id(face.index()),
        Element::Edge(_) => -1,
    };
    let edge = |element: &Element| match *element {
        Element::Face(_) => -1,
        Element::Edge(edge) => id(edge.index()),
    };
    let invalid = |element: &Element| match *element {
        Element::Face(_) => 0,
        Element::Edge(edge) => {
            i64::from(surface.edge(edge).sides.iter().flatten().any(|s| !s.is_valid()))
        }
    };
    let kinds = tessellation.kinds.iter().map(|&kind| i64::from(kind as u8)).collect();
    let mut data = vec![
        ("patch_kind", CellValues::Int64(kinds)),
        ("face", integers(&face)),
        ("edge", integers(&edge)),
        ("invalid", integers(&invalid)),
    ];
    if let Some(figures) = figures {
        let diagonal = surface.mesh().diagonal();
        let of = |element: &Element| match *element {
            Element::Face(face) => figures.faces[face],
            Element::Edge(edge) => figures.edges[edge],
        };
        let distances = elements.iter().map(|e| of(e).max / diagonal).collect();
        let angles = elements.iter().map(|e| of(e).max_normal.to_degrees()).collect();
        data.push(("deviation", CellValues::Float64(distances)));
        data.push(("normal_error_deg", CellValues::Float64(angles)));
    }
    Grid {
        points: tessellation.positions.clone(),
        normals: tessellation.normals.clone(),
        cells: tessellation.triangles.iter().map(|&t| GridCell::Triangle(t)).collect(),
        point_data: Vec::new(),
        cell_data: data
            .into_iter()
            .map(|(name, values)| CellData { name: name.to_owned(), values })
            .collect(),
    }
}
