//! VTU files that were cut off or damaged: an error, never a panic, never half a surface.

#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use common::{ENCODINGS, Random, nets_from, octahedron};
use io::basemesh::FaceMap;
use io::bezier_core::BezierTriangle;
use io::glam::DVec3;
use io::{CellData, CellKind, CellValues, Encoding, VtuOptions, VtuSurface, read_vtu, write_vtu};
use proptest::prelude::*;

/// Whatever is accepted is a whole surface: it can be written and read again.
fn check_accepted(surface: &VtuSurface<10>) {
    assert_eq!(surface.nets.len(), surface.topology.face_count());
    let mut file = Vec::new();
    write_vtu(&mut file, &surface.topology, &surface.nets, &VtuOptions::default()).unwrap();
    let back = read_vtu::<10>(&mut file.as_slice()).unwrap();
    assert_eq!((back.topology, back.nets), (surface.topology.clone(), surface.nets.clone()));
}

fn valid(encoding: Encoding, cells: CellKind) -> Vec<u8> {
    let mut random = Random(77);
    let topology = octahedron();
    let nets: FaceMap<BezierTriangle<DVec3, 10>> = nets_from(&topology, || random.point());
    let values = CellValues::Int64((0..8).collect());
    let cell_data = vec![CellData { name: "id".into(), values }];
    let mut file = Vec::new();
    write_vtu(&mut file, &topology, &nets, &VtuOptions { cells, encoding, cell_data }).unwrap();
    file
}

#[test]
fn every_truncation_is_refused() {
    for encoding in ENCODINGS {
        let file = valid(encoding, CellKind::Bezier);
        // the last byte is a line end
        for at in 0..file.len() - 1 {
            assert!(read_vtu::<10>(&mut &file[..at]).is_err(), "{encoding:?}: {at}");
        }
        assert!(read_vtu::<10>(&mut file.as_slice()).is_ok(), "{encoding:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn damaged_files_never_panic(
        encoding in prop::sample::select(ENCODINGS.to_vec()),
        lagrange in any::<bool>(),
        edits in prop::collection::vec(
            (any::<prop::sample::Index>(), 0_usize..20, edit_bytes()),
            1..4,
        ),
    ) {
        let cells = if lagrange { CellKind::Lagrange } else { CellKind::Bezier };
        let mut file = valid(encoding, cells);
        for (at, removed, inserted) in edits {
            let start = at.index(file.len());
            let end = (start + removed).min(file.len());
            file.splice(start..end, inserted);
        }
        if let Ok(surface) = read_vtu::<10>(&mut file.as_slice()) {
            check_accepted(&surface);
        }
    }

    #[test]
    fn noise_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(read_vtu::<10>(&mut bytes.as_slice()).is_err());
    }
}

/// Random bytes, or something that means something in such a file.
fn edit_bytes() -> impl Strategy<Value = Vec<u8>> {
    let words = ["<", ">", "</Points>", "\"", "&#0;", "999999999999", "-1", "nan", "=", "69", " "];
    prop_oneof![
        prop::collection::vec(any::<u8>(), 0..8),
        prop::sample::select(words.to_vec()).prop_map(|word| word.as_bytes().to_vec()),
    ]
}
