//! Smooth solids from files, and files of their weights.
#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use smoothpatch::apatch::polyhedral::{Planarity, PolyhedralSurface, Polyhedron, Scheme, Settings};
use smoothpatch::io::CellValues;
use smoothpatch::solid_surface::{curvature_grid, read_weights, solid, write_weights};

#[test]
fn weights_come_back_bit_for_bit() {
    for (name, scheme) in
        [("u-prism", Scheme::C1Cubic), ("frame", Scheme::C1Cubic), ("cube", Scheme::C2Quintic)]
    {
        let solid = Polyhedron::named(name).unwrap();
        let settings = Settings { scheme, ..Settings::default() };
        let surface = PolyhedralSurface::new(&solid, &settings).unwrap();
        let mut bytes = Vec::new();
        write_weights(&mut bytes, &surface).unwrap();
        let read = read_weights(&mut bytes.as_slice()).unwrap();
        assert_eq!(read.hull(), surface.hull(), "{name}");
        assert_eq!(read.tessellate(3, 2), surface.tessellate(3, 2), "{name}");
        assert!(read.report().is_clean(), "{name}");
        let text = String::from_utf8(bytes).unwrap();
        for (from, to, message) in [
            ("\"version\": 1", "\"version\": 2", "version 2, not"),
            ("\"degree\": ", "\"degree\": 1", "number of weights"),
            ("\"rounds\": ", "\"round\": ", "missing field `rounds`"),
        ] {
            let damaged = text.replacen(from, to, 1);
            let error = read_weights(&mut damaged.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(message), "{name}: {error}");
        }
    }
}

#[test]
fn solids_from_files_and_by_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/solids");
    let planarity = Planarity::default();
    let from_off = solid(&folder.join("frame.off"), &planarity).unwrap();
    assert_eq!((from_off.facets().len(), from_off.euler_characteristic()), (10, 0));
    let named = solid(Path::new("cube"), &planarity).unwrap();
    assert_eq!(named.facets().len(), 6);
    let error = solid(Path::new("sphere"), &planarity).unwrap_err().to_string();
    assert!(error.contains("neither an .off or .obj file nor one of the solids"), "{error}");
}

#[test]
fn curvatures_of_a_sphere() {
    let solid = Polyhedron::named("cube").unwrap();
    let settings = Settings { scheme: Scheme::C2Quintic, ..Settings::default() };
    let surface = PolyhedralSurface::new(&solid, &settings).unwrap();
    let grid = curvature_grid(&surface, &surface.sample(5, 3));
    for data in &grid.point_data {
        let CellValues::Float64(values) = &data.values else { panic!("{}", data.name) };
        assert_eq!(values.len(), grid.points.len());
        let worst = values.iter().map(|k| (k - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst <= 1e-9, "{}: {worst}", data.name);
    }
}
