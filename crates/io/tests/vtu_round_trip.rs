//! Surfaces through files and back.

#![allow(clippy::float_cmp, reason = "files keep every bit")]
#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use common::{ENCODINGS, OCTAHEDRON_CORNERS, Random, bulged, nets_from, octahedron, strip, torus};
use io::basemesh::{FaceMap, Topology};
use io::bezier_core::{Barycentric, BezierTriangle, LocalEdge, MultiIndex};
use io::glam::DVec3;
use io::{
    CellData, CellKind, CellValues, Encoding, SharedPointError, VtuOptions, VtuReadError,
    VtuWriteError, read_vtu, write_vtu,
};
use proptest::prelude::*;

fn written<const P: usize>(
    topology: &Topology,
    nets: &FaceMap<BezierTriangle<DVec3, P>>,
    options: &VtuOptions,
) -> Vec<u8> {
    let mut file = Vec::new();
    write_vtu(&mut file, topology, nets, options).unwrap();
    file
}

fn bits<const P: usize>(nets: &FaceMap<BezierTriangle<DVec3, P>>) -> Vec<[u64; 3]> {
    let points = nets.as_slice().iter().flat_map(BezierTriangle::net);
    points.map(|p| p.to_array().map(f64::to_bits)).collect()
}

fn check_round_trip<const P: usize>(topology: &Topology, seed: u64) {
    let mut random = Random(seed);
    let nets: FaceMap<BezierTriangle<DVec3, P>> = nets_from(topology, || {
        DVec3::new(random.any_finite(), random.any_finite(), random.any_finite())
    });
    let count = topology.face_count();
    let floats = CellValues::Float64((0..count).map(|_| random.any_finite()).collect());
    let ints = CellValues::Int64((0..count).map(|_| random.bits().cast_signed()).collect());
    let cell_data = vec![
        CellData { name: "a <b> & \"c\"".into(), values: floats },
        CellData { name: "α".into(), values: ints },
    ];
    for encoding in ENCODINGS {
        let options =
            VtuOptions { encoding, cell_data: cell_data.clone(), cells: CellKind::Bezier };
        let file = written(topology, &nets, &options);
        let back = read_vtu::<P>(&mut file.as_slice()).unwrap();
        assert_eq!(back.topology, *topology);
        assert_eq!(bits(&back.nets), bits(&nets));
        assert_eq!(back.cell_data, cell_data);
        assert_eq!(back.skipped, [""; 0]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_bit_comes_back(seed in any::<u64>()) {
        for topology in [octahedron(), strip(), torus(3)] {
            check_round_trip::<3>(&topology, seed);
            check_round_trip::<6>(&topology, seed);
            check_round_trip::<10>(&topology, seed);
            check_round_trip::<36>(&topology, seed);
        }
    }
}

#[test]
fn high_degrees() {
    check_round_trip::<66>(&octahedron(), 1);
    check_round_trip::<91>(&strip(), 2);
}

#[test]
fn shared_points_are_written_once() {
    fn check<const P: usize>(topology: &Topology) {
        let mut random = Random(5);
        let nets: FaceMap<BezierTriangle<DVec3, P>> = nets_from(topology, || random.point());
        for cells in [CellKind::Bezier, CellKind::Lagrange] {
            let options = VtuOptions { cells, ..VtuOptions::default() };
            let text = String::from_utf8(written(topology, &nets, &options)).unwrap();
            let degree = BezierTriangle::<DVec3, P>::DEGREE;
            let [v, e, f] = [topology.vertex_count(), topology.edge_count(), topology.face_count()];
            let interior = MultiIndex::all(degree).filter(|m| m.i * m.j * m.k > 0).count();
            let points = v + (degree - 1) * e + interior * f;
            let piece = format!(r#"<Piece NumberOfPoints="{points}" NumberOfCells="{f}">"#);
            assert!(text.contains(&piece), "degree {degree}: {piece}");
        }
    }
    for topology in [octahedron(), strip(), torus(4)] {
        check::<3>(&topology);
        check::<6>(&topology);
        check::<15>(&topology);
        check::<36>(&topology);
    }
}

#[test]
fn point_ids_are_vertices_then_edges_then_interiors() {
    let topology = Topology::from_faces(3, &[[2, 0, 1]]).unwrap();
    let net =
        BezierTriangle::<DVec3, 10>::from_fn(|m| DVec3::new(m.i as f64, m.j as f64, m.k as f64));
    let options = VtuOptions { encoding: Encoding::Ascii, ..VtuOptions::default() };
    let text =
        String::from_utf8(written(&topology, &FaceMap::from_vec(vec![net]), &options)).unwrap();
    // corner 0 of the face is vertex 2; edges 0-1, 0-2, 1-2; the boundary has no other direction
    // than that of the face
    let points = "0.0 3.0 0.0\n0.0 0.0 3.0\n3.0 0.0 0.0\n\
        0.0 2.0 1.0\n0.0 1.0 2.0\n\
        2.0 1.0 0.0\n1.0 2.0 0.0\n\
        1.0 0.0 2.0\n2.0 0.0 1.0\n\
        1.0 1.0 1.0\n";
    assert!(text.contains(points), "{text}");
    assert!(text.contains("\n2 0 1 5 6 3 4 7 8 9\n"), "{text}");
}

/// The largest row sum of the inverse of the matrix of Bernstein values at the lattice, found by
/// converting unit samples: what rounding of the samples is amplified by.
fn amplification<const P: usize>() -> f64 {
    let topology = Topology::from_faces(3, &[[0, 1, 2]]).unwrap();
    let mut sums = [0.0; P];
    for rank in 0..P {
        let unit = BezierTriangle::<DVec3, P>::from_fn(|m| {
            if m.rank() == rank { DVec3::X } else { DVec3::ZERO }
        });
        // a file of Bézier cells declared as Lagrange has the unit vectors as samples
        let options = VtuOptions { encoding: Encoding::Ascii, ..VtuOptions::default() };
        let text = String::from_utf8(written(&topology, &FaceMap::from_vec(vec![unit]), &options));
        let text = text.unwrap().replace("\n76\n", "\n69\n");
        let back = read_vtu::<P>(&mut text.as_bytes()).unwrap();
        for (sum, point) in sums.iter_mut().zip(back.nets.as_slice()[0].net()) {
            *sum += point.x.abs();
        }
    }
    sums.into_iter().fold(0.0, f64::max)
}

/// Control points -> samples -> control points. A sample is a sum of `P` products, each with a
/// relative error of about `2 degree + 1` roundings (powers, binomials, the sum); the positive
/// weights add up to one. The way back amplifies that by the norm of the inverse and adds as many
/// roundings of its own sum of `P` products.
fn check_lagrange<const P: usize>(expected_amplification: f64) {
    let mut random = Random(11);
    let topology = torus(3);
    let nets: FaceMap<BezierTriangle<DVec3, P>> = nets_from(&topology, || random.point());
    let amplification = amplification::<P>();
    assert!(
        (amplification / expected_amplification - 1.0).abs() < 0.01,
        "degree {}: {amplification}",
        BezierTriangle::<DVec3, P>::DEGREE
    );
    let roundings = (2 * BezierTriangle::<DVec3, P>::DEGREE + 1 + P) as f64;
    let bound = 2.0 * amplification * roundings * f64::EPSILON;
    for encoding in ENCODINGS {
        let options = VtuOptions { cells: CellKind::Lagrange, encoding, ..VtuOptions::default() };
        let file = written(&topology, &nets, &options);
        let back = read_vtu::<P>(&mut file.as_slice()).unwrap();
        assert_eq!(back.topology, topology);
        let points = nets.as_slice().iter().flat_map(BezierTriangle::net);
        let others = back.nets.as_slice().iter().flat_map(BezierTriangle::net);
        let error = points.zip(others).map(|(p, q)| (*p - *q).abs().max_element());
        let error = error.fold(0.0, f64::max);
        assert!(error <= bound, "{error:e} > {bound:e}");
        // neighbours agree exactly, or this would be refused
        written(&topology, &back.nets, &VtuOptions::default());
    }
}

// the factors were computed independently from the matrix
#[test]
fn lagrange_cells_convert_back_within_rounding() {
    check_lagrange::<3>(1.0);
    check_lagrange::<6>(3.0);
    check_lagrange::<10>(10.0);
    check_lagrange::<36>(412.0);
    check_lagrange::<66>(7508.0);
}

#[test]
fn lagrange_points_lie_on_the_patches() {
    let topology = octahedron();
    let nets: FaceMap<BezierTriangle<DVec3, 15>> =
        bulged(&topology, &OCTAHEDRON_CORNERS, |p| p.normalize());
    let options = VtuOptions {
        cells: CellKind::Lagrange,
        encoding: Encoding::Ascii,
        ..VtuOptions::default()
    };
    // read as if they were control points
    let text = String::from_utf8(written(&topology, &nets, &options)).unwrap();
    let text = text.replace("69 69 69 69 69 69 69 69", "76 76 76 76 76 76 76 76");
    let samples = read_vtu::<15>(&mut text.as_bytes()).unwrap().nets;
    for (face, patch) in nets.iter() {
        for (at, sample) in Barycentric::lattice(4).zip(samples[face].net()) {
            let distance = patch.eval_de_casteljau(at).distance(*sample);
            assert!(distance <= 16.0 * f64::EPSILON, "face {face} at {at:?}: {distance:e}");
        }
    }
}

#[test]
fn disagreeing_neighbours_are_refused() {
    let topology = octahedron();
    let mut random = Random(3);
    let nets: FaceMap<BezierTriangle<DVec3, 36>> = nets_from(&topology, || random.point());
    let mut file = Vec::new();
    let refused = |nets: &FaceMap<_>, file: &mut Vec<u8>| match write_vtu(
        file,
        &topology,
        nets,
        &VtuOptions::default(),
    ) {
        Err(VtuWriteError::SharedPoint(cause)) => cause,
        other => panic!("{other:?}"),
    };

    let face = topology.faces().nth(5).unwrap();
    for edge in LocalEdge::ALL {
        let mut bent = nets.clone();
        let point = &mut bent[face][MultiIndex::along(edge, 5, 2, 0)];
        point.y = f64::from_bits(point.y.to_bits() ^ 1);
        let id = topology.edge(face.halfedge(edge.start().index()));
        let cause = refused(&bent, &mut file);
        assert!(matches!(cause, SharedPointError::Edge { edge, .. } if edge == id), "{cause:?}");
        assert!(cause.to_string().contains(&format!("of their edge {id}:")), "{cause}");
    }

    let mut bent = nets.clone();
    bent[face][MultiIndex::new(0, 7, 0)].x += 1.0;
    let cause = refused(&bent, &mut file);
    let vertex = topology.corners(face)[1];
    assert!(cause.to_string().contains(&format!("disagree about their vertex {vertex}:")));
    assert!(file.is_empty(), "nothing is written");
}

#[test]
fn zeros_of_different_sign_disagree() {
    let topology = Topology::from_faces(4, &[[0, 1, 2], [2, 1, 3]]).unwrap();
    let mut nets: FaceMap<BezierTriangle<DVec3, 6>> = nets_from(&topology, || DVec3::ZERO);
    nets.as_mut_slice()[1].net_mut()[0] = DVec3::new(0.0, -0.0, 0.0);
    let error = write_vtu(&mut Vec::new(), &topology, &nets, &VtuOptions::default()).unwrap_err();
    assert!(matches!(error, VtuWriteError::SharedPoint(_)), "{error}");
}

#[test]
fn refusals_of_the_writer() {
    let topology = octahedron();
    let mut random = Random(3);
    let nets: FaceMap<BezierTriangle<DVec3, 10>> = nets_from(&topology, || random.point());
    let message = |nets: &FaceMap<_>, cell_data: Vec<CellData>, encoding| {
        let mut file = Vec::new();
        let options = VtuOptions { cell_data, encoding, ..VtuOptions::default() };
        let error = write_vtu(&mut file, &topology, nets, &options).unwrap_err();
        assert!(file.is_empty(), "{error}");
        error.to_string()
    };
    let data = |name: &str, values| CellData { name: name.into(), values };
    let eight = || CellValues::Int64(vec![0; 8]);

    let mut broken = nets.clone();
    broken.as_mut_slice()[6][MultiIndex::new(1, 1, 1)].z = f64::NAN;
    assert_eq!(
        message(&broken, vec![], Encoding::Binary).split(" is [").next(),
        Some("point (1, 1, 1) of face 6")
    );
    let few = FaceMap::from_vec(nets.as_slice()[..7].to_vec());
    assert_eq!(message(&few, vec![], Encoding::Binary), "there are 7 patches for 8 faces");
    assert_eq!(
        message(&nets, vec![data("q", CellValues::Int64(vec![1]))], Encoding::Binary),
        "the data 'q' has 1 values for 8 patches"
    );
    assert_eq!(
        message(&nets, vec![data("q", eight()), data("q", eight())], Encoding::Binary),
        "there are two cell data with the name 'q'"
    );
    for name in ["", " q", "q\n"] {
        let refused = message(&nets, vec![data(name, eight())], Encoding::Binary);
        assert!(refused.contains("cannot be the name"), "{refused}");
    }
    let mut values = vec![0.0; 8];
    values[3] = f64::NAN;
    let nan = || vec![data("q", CellValues::Float64(values.clone()))];
    assert_eq!(
        message(&nets, nan(), Encoding::Ascii),
        "the data 'q' is NaN at element 3; use the binary encoding"
    );
    for encoding in [Encoding::Binary, Encoding::Appended] {
        let options = VtuOptions { cell_data: nan(), encoding, ..VtuOptions::default() };
        let back = read_vtu::<10>(&mut written(&topology, &nets, &options).as_slice()).unwrap();
        assert!(matches!(&back.cell_data[0].values, CellValues::Float64(v) if v[3].is_nan()));
    }
}

#[test]
fn another_degree_is_named() {
    let topology = octahedron();
    let nets: FaceMap<BezierTriangle<DVec3, 10>> = nets_from(&topology, || DVec3::ONE);
    let file = written(&topology, &nets, &VtuOptions::default());
    let error = read_vtu::<36>(&mut file.as_slice()).unwrap_err();
    assert!(
        matches!(error, VtuReadError::PointsPerCell { cell: 0, points: 10, expected: 36, .. }),
        "{error}"
    );
}
