//! What pictures show: reflection lines across the edges of patches, and the same bytes with any number
//! of threads.

use basemesh::glam::DVec2;
use basemesh::{FaceId, FaceMap, Topology};
use bezier_core::SepticTriangle;
use implicit::NamedShape;
use render::{Camera, Hit, Patches, Picture, Shade, Style, UpAxis, View, draw, frame};
use smoothpatch::pictures::NetPatches;
use smoothpatch::{FieldSource, G1Surface, Method, Settings, Silent, fit};

/// A coarse torus: the kinks before the patches are joined are large.
fn torus() -> (G1Surface, FaceMap<SepticTriangle>) {
    let shape = NamedShape::find("torus").expect("a named shape");
    let field = shape.field();
    let settings = Settings::with_faces(100).with_method(Method::Published);
    let surface = fit(&*field, &shape.region, &settings, &mut Silent).expect("a torus");
    let source = FieldSource::new(&*field, surface.mesh.diagonal(), settings.projection);
    let nets = surface.before_join(&source, &settings);
    (surface, nets)
}

/// The largest jump of the reflection lines across an edge, in stripes.
fn largest_jump(topology: &Topology, nets: &FaceMap<SepticTriangle>) -> f64 {
    let (patches, shade) = (NetPatches(nets), Shade::Zebra(12.0));
    let axes = View::new(20.0, 50.0).axes(UpAxis::Z);
    let corners = [DVec2::X, DVec2::Y, DVec2::ZERO];
    let phase = |face: FaceId, at: DVec2| {
        let patch = face.index();
        let point = patches.surface_point(patch, at);
        let hit = Hit { patch, at, point: point.point, normal: point.normal.normalize() };
        // stripes of what is seen from its side say nothing
        (hit.normal.dot(axes[2]) > 0.1).then(|| shade.phase(&hit, axes)).flatten()
    };
    let mut largest: f64 = 0.0;
    for edge in topology.edges() {
        let h = topology.canonical(edge);
        let w = topology.twin(h).expect("closed");
        for step in 1..16 {
            let t = f64::from(step) / 16.0;
            let along = |corner: usize, t: f64| corners[corner].lerp(corners[(corner + 1) % 3], t);
            let sides = [(h.face(), along(h.corner(), t)), (w.face(), along(w.corner(), 1.0 - t))];
            if let [Some(left), Some(right)] = sides.map(|(face, at)| phase(face, at)) {
                largest = largest.max((left - right).abs());
            }
        }
    }
    largest
}

#[test]
fn reflection_lines_break_before_the_join_and_are_mended_by_it() {
    let (surface, before) = torus();
    let topology = surface.mesh.topology();
    let broken = largest_jump(topology, &before);
    let mended = largest_jump(topology, &surface.patches.nets);
    assert!(broken > 0.05, "a jump that can be seen: {broken} stripes");
    // rounding of normals, times 24 stripes per turn, near the ends of the room's axis
    assert!(mended < 1e-8, "unbroken: {mended} stripes");
}

const SIZE: [usize; 2] = [160, 120];

fn picture(nets: &FaceMap<SepticTriangle>, shade: Shade<'_>) -> Picture {
    let patches = NetPatches(nets);
    let camera: Camera =
        frame(&[&patches], View::new(20.0, 50.0).axes(UpAxis::Z), SIZE).expect("a torus");
    draw(&patches, &camera, SIZE, &Style { edges: true, ..Style::new(shade) }).expect("finite")
}

#[cfg(feature = "rayon")]
#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let (surface, _) = torus();
    let nets = &surface.patches.nets;
    let with_threads = |count| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("threads");
        pool.install(|| picture(nets, Shade::Zebra(12.0)).bytes())
    };
    let alone = with_threads(1);
    assert!([2, 3, 7].into_iter().all(|count| with_threads(count) == alone));
}

#[test]
fn the_picture_shows_the_torus() {
    let (surface, before) = torus();
    let after = picture(&surface.patches.nets, Shade::Zebra(12.0));
    let white = after.pixel(0, 0);
    // the hole is seen through
    assert_eq!(after.pixel(SIZE[0] / 2, SIZE[1] / 2), white, "the hole");
    let painted = |picture: &Picture| {
        let all = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| (column, row)));
        all.filter(|&(column, row)| picture.pixel(column, row) != white).count()
    };
    let part = painted(&after) as f64 / (SIZE[0] * SIZE[1]) as f64;
    assert!((0.2..0.9).contains(&part), "the torus fills a good part: {part}");
    assert_ne!(picture(&before, Shade::Zebra(12.0)), after, "other normals");
}
