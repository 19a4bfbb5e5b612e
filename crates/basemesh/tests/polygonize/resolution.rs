//! Meshes of about a wanted size, and whether two resolutions agree.

use basemesh::{PolygonizeError, cells_for_faces, polygonize_to_faces};
use implicit::{Aabb, Formula, NamedShape, Sphere};

use crate::fields::{mesh_of, noise, unbounded};

#[test]
fn wanted_number_of_faces() {
    for (name, euler_characteristic) in [("sphere", 2), ("torus", 0), ("deccube", -24)] {
        let shape = NamedShape::find(name).unwrap();
        for faces in [40_000, 100_000] {
            let result = polygonize_to_faces(&shape.field(), &shape.region, faces).unwrap();
            let ratio = result.mesh.topology().face_count() as f64 / faces as f64;
            assert!((ratio - 1.0).abs() < 0.05, "{name}: {ratio} of {faces} faces");
            assert!(result.confirmed, "{name}: {:?} and {:?}", result.found, result.compared);
            assert_eq!(result.found.euler_characteristic, euler_characteristic, "{name}");
            assert_eq!(result.found.components, 1, "{name}");
            let cells = cells_for_faces(&shape.field(), &shape.region, faces).unwrap();
            assert_eq!(result.cells, cells, "{name}");
        }
    }
}

#[test]
fn few_faces_give_the_coarsest_grid() {
    let shape = NamedShape::find("deccube").unwrap();
    let result = polygonize_to_faces(&shape.field(), &shape.region, 10).unwrap();
    assert_eq!((result.cells, result.confirmed), (48, true));
    assert_eq!(mesh_of(&shape.field(), &shape.region, 48), Ok(result.mesh));
}

#[test]
fn disagreement_refines_the_grid() {
    // a ball and a bead whose radius is 0.65 cells of the first grid: not seen with 0.7 times the cells
    let field = Formula::parse("min(x^2+y^2+z^2-1, (x-2)^2+(y-1.43)^2+(z-1.22)^2-0.0042)").unwrap();
    let result = polygonize_to_faces(&field, &Aabb::from_half_size(2.4), 100).unwrap();
    assert!(result.confirmed && result.cells > 48, "{:?}", result.found);
    assert_eq!((result.found.components, result.found.euler_characteristic), (2, 4));
    assert!(result.compared.cells < result.cells, "{:?}", result.compared);
}

#[test]
fn disagreement_to_the_end_is_reported() {
    let froth = unbounded(|p| if p.length() < 0.1 { noise(1, p) - 0.5 } else { 1.0 });
    let result = polygonize_to_faces(&froth, &Aabb::from_half_size(1.0), 100).unwrap();
    assert!(!result.confirmed, "noise has another topology at every resolution");
    assert!((185..=200).contains(&result.cells), "cells {}", result.cells);
    assert!(result.mesh.topology().is_closed());
}

#[test]
fn small_surfaces_are_looked_for_twice_as_closely() {
    let bead = Sphere { radius: 0.016, ..Sphere::default() };
    let region = Aabb::from_half_size(1.0);
    assert!(matches!(mesh_of(&bead, &region, 48), Err(PolygonizeError::NoSurface { .. })));
    let cells = cells_for_faces(&bead, &region, 2000).unwrap();
    let faces = mesh_of(&bead, &region, cells).unwrap().topology().face_count();
    assert!((1500..2500).contains(&faces), "{faces} faces");
}
