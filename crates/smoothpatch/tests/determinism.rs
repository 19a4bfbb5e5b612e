//! The same bits whatever the number of threads, and without threads.
//!
//! A checksum written down in the repository would not do: the linear algebra and the functions of
//! the C library may round differently on another machine. So every comparison is made on one
//! machine, between two runs or, for the build without threads, between two builds.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use smoothpatch::apatch::rational::{Normals, RationalSurface, Side};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{EdgeMap, VertexId, VertexMap};
use smoothpatch::implicit::NamedShape;
use smoothpatch::{G1Surface, Method, Settings, Silent, fit};

fn surface(method: Method) -> G1Surface {
    let shape = NamedShape::find("double-torus").unwrap();
    let settings = Settings::with_faces(400).with_method(method);
    fit(&*shape.field(), &shape.region, &settings, &mut Silent).unwrap()
}

/// FNV-1a over the bits of numbers.
fn hash(numbers: impl Iterator<Item = f64>) -> u64 {
    numbers.flat_map(|x| x.to_bits().to_le_bytes()).fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// Of all control points and weights.
fn checksum(surface: &G1Surface) -> u64 {
    let points = surface.patches.nets.as_slice().iter().flat_map(|net| *net.net());
    let coordinates = points.flat_map(|p| p.to_array());
    let weights = surface.patches.weights.as_slice().iter();
    hash(coordinates.chain(weights.flat_map(|w| w.lambda.into_iter().chain(w.mu))))
}

/// Of the free weights, points and normals of A-patches over a rough mesh, with all repairs.
fn apatch_checksum() -> u64 {
    let mesh = testkit::meshes::noisy_sphere(0.3, 1);
    let surface = RationalSurface::new(mesh, Normals::Estimated, &Default::default()).unwrap();
    let faces = surface.mesh().topology().faces();
    let free = faces.flat_map(|face| Side::BOTH.map(|side| surface.free_weight(face, side)));
    let points = surface.tessellate(2, 2);
    let coordinates = points.positions.iter().chain(&points.normals).flat_map(DVec3::to_array);
    hash(free.flatten().chain(coordinates))
}

fn checksums() -> [u64; 3] {
    let [published, refined] =
        [Method::Published, Method::Refined].map(|method| checksum(&surface(method)));
    [published, refined, apatch_checksum()]
}

#[test]
fn the_checksum_sees_one_bit() {
    let mut changed = surface(Method::Published);
    let before = checksum(&changed);
    let x = &mut changed.patches.nets.as_mut_slice()[7].net_mut()[11].x;
    *x = x.next_up();
    assert_ne!(checksum(&changed), before);
}

#[cfg(feature = "rayon")]
#[test]
fn any_number_of_threads() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(checksums)
    };
    let one = with(1);
    assert_eq!(with(2), one, "2 threads");
    assert_eq!(with(5), one, "5 threads");
}

/// Nagata surfaces as well.
#[cfg(feature = "rayon")]
#[test]
fn nagata_surfaces_with_any_number_of_threads() {
    use smoothpatch::nagata::{CornerNormals, NagataSurface, PolygonMesh, Settings};
    let shape = NamedShape::find("double-torus").unwrap();
    let base = surface(Method::Published);
    let mesh = PolygonMesh::from(&base.mesh);
    let field = shape.field();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            [Settings::position(), Settings::tangent_plane()].map(|settings| {
                let normals = CornerNormals::from_fn(&mesh, |p| Some(field.value_gradient(p).1));
                let surface = NagataSurface::new(mesh.clone(), normals, settings).unwrap();
                let curves = surface.mesh().edges().map(|edge| surface.edge_curve(edge));
                let numbers = curves.flat_map(|c| [c.curvature, c.skew]).flat_map(|v| v.to_array());
                numbers.map(f64::to_bits).collect::<Vec<_>>()
            })
        })
    };
    let one = with(1);
    assert_eq!(with(2), one, "2 threads");
    assert_eq!(with(5), one, "5 threads");
}

/// Element maps are filled as a loop over the ids would fill them, with either feature.
#[test]
fn maps_are_filled_in_order() {
    let value = |i: usize| (i as f64).sqrt().sin();
    let expected: Vec<u64> = (0..10_000).map(|i| value(i).to_bits()).collect();
    let map = VertexMap::from_fn(10_000, |v| value(v.index()).to_bits());
    assert_eq!(map.as_slice(), expected);
    let failed = EdgeMap::<()>::try_from_fn(10_000, |e| {
        if e.index() % 977 == 976 { Err(e.index()) } else { Ok(()) }
    });
    assert_eq!(failed, Err(976), "the first error, whichever thread comes first");
    assert_eq!(map[VertexId::new(5)], expected[5]);
}

/// Prints the checksums for [`without_threads`], which runs this test of another build.
#[test]
fn print_checksums() {
    println!("checksums {:016x?}", checksums());
}

/// Builds the tests a second time without the feature `rayon` and compares: a few minutes, so
/// only on request (`cargo test -p smoothpatch --test determinism -- --ignored`).
#[cfg(feature = "rayon")]
#[test]
#[ignore = "builds the workspace a second time"]
fn without_threads() {
    let output = std::process::Command::new(env!("CARGO"))
        .args(["test", "-p", "smoothpatch", "--no-default-features", "--test", "determinism"])
        .args(["--target-dir", concat!(env!("CARGO_TARGET_TMPDIR"), "/without-threads")])
        .args(["--", "--exact", "--nocapture", "print_checksums"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().find(|line| line.contains("checksums "));
    let line = line.unwrap_or_else(|| panic!("{text}{}", String::from_utf8_lossy(&output.stderr)));
    assert!(line.ends_with(&format!("checksums {:016x?}", checksums())), "{line}");
}
