//! The shapes of [TK09] at the numbers of faces of the paper.

use basemesh::{
    MeshQuality, PolygonizeSettings, SimplifySettings, TriMesh, cells_for_faces, polygonize,
    simplify,
};
use implicit::{ImplicitSurface, NamedShape};

use crate::support::FieldTarget;

/// Name, faces of the paper, Euler characteristic.
const SHAPES: [(&str, usize, i64); 6] = [
    ("torus", 600, 0),
    ("dodecahedron", 1200, 2),
    ("double-torus", 1800, -2),
    ("mcmullen", 2000, 2),
    ("chair", 4000, -4),
    ("deccube", 5000, -24),
];

/// Median deviation of a patch over its edge length by the turning of its edges in degrees
/// (measured with the published construction).
fn expected_deviation(turning_deg: f64) -> f64 {
    const TABLE: [(f64, f64); 8] = [
        (5.0, 1.5e-5),
        (15.0, 2.9e-5),
        (25.0, 9.5e-5),
        (35.0, 2.0e-4),
        (45.0, 4.4e-4),
        (55.0, 1.4e-3),
        (67.0, 4.4e-3),
        (82.0, 1.1e-2),
    ];
    let k = TABLE.iter().skip(1).position(|row| turning_deg < row.0).unwrap_or(6);
    let (lo, hi) = (TABLE[k], TABLE[k + 1]);
    let part = (turning_deg - lo.0) / (hi.0 - lo.0);
    (lo.1.ln() * (1.0 - part) + hi.1.ln() * part).exp()
}

#[test]
#[ignore = "a table for humans"]
fn table() {
    println!(
        "{:>14} {:>7} {:>6} {:>4} {:>7} {:>6} {:>6} {:>7} {:>6} {:>6} {:>5} {:>5} {:>5}  max/rms deviation",
        "shape", "input", "faces", "chi", "turning", "p99", "p90", "angle", "qual", "share", ">50", "bad", "sec"
    );
    let variants: Vec<(String, Box<dyn Fn(&mut SimplifySettings)>)> = vec![
        ("default".into(), Box::new(|_| {})),
        ("isotropy 0".into(), Box::new(|s| s.isotropy = 0.0)),
        ("isotropy 1e-4".into(), Box::new(|s| s.isotropy = 1e-4)),
        ("isotropy 3e-3".into(), Box::new(|s| s.isotropy = 3e-3)),
        ("density 0.7".into(), Box::new(|s| s.density_exponent = 0.7)),
        ("density 1".into(), Box::new(|s| s.density_exponent = 1.0)),
        ("turning 45".into(), Box::new(|s| s.max_turning_deg = 45.0)),
        ("turning 40".into(), Box::new(|s| s.max_turning_deg = 40.0)),
        ("plain 8".into(), Box::new(|s| s.plain_factor = 8)),
        ("plain 2".into(), Box::new(|s| s.plain_factor = 2)),
    ];
    let count = std::env::args().filter(|a| a == "--nocapture").count();
    for (variant, change) in variants.iter().take(if count > 1 { 1 } else { 99 }) {
        println!("{variant}");
        for (name, faces, _) in SHAPES {
            row(name, faces, change);
        }
    }
}

fn row(name: &str, faces: usize, change: &dyn Fn(&mut SimplifySettings)) {
    let (input, mesh, shape_field) = dense(name, faces, 20);
    let target = FieldTarget { field: &*shape_field, length: mesh.diagonal() };
    let start = std::time::Instant::now();
    let mut settings = SimplifySettings::to_faces(faces);
    change(&mut settings);
    let s = simplify(mesh, &target, &settings).unwrap();
    let sec = start.elapsed().as_secs_f64();
    let q = MeshQuality::measure(&s.mesh, &s.normals);
    let t = s.mesh.topology();
    let angle = |e| basemesh::edge_turning(&s.mesh, &s.normals, e).to_degrees();
    let over = t.edges().filter(|&e| angle(e) > 50.1).count();
    let mut sorted: Vec<f64> = t.edges().map(angle).collect();
    sorted.sort_by(f64::total_cmp);
    let (mut worst, mut sum, mut area) = (0.0_f64, 0.0, 0.0);
    for f in t.faces() {
        let [p, q, r] = s.mesh.triangle(f);
        let turn = f.halfedges().map(|h| angle(t.edge(h))).into_iter().fold(0.0, f64::max);
        let length = p.distance(q).max(q.distance(r)).max(r.distance(p));
        let deviation = length * expected_deviation(turn) / s.mesh.diagonal();
        let a = (q - p).cross(r - p).length();
        worst = worst.max(deviation);
        sum += a * deviation * deviation;
        area += a;
    }
    println!(
        "{name:>14} {input:>7} {:>6} {:>4} {:>7.2} {:>6.2} {:>6.2} {:>7.2} {:>6.3} {:>6.3} {over:>5} {:>5} {sec:>5.2}  {worst:.2e} {:.2e} {:?} {} {:?}",
        t.face_count(),
        t.euler_characteristic(),
        q.max_turning_deg,
        sorted[sorted.len() * 99 / 100],
        sorted[sorted.len() * 9 / 10],
        q.min_angle_deg,
        q.min_quality,
        q.min_fan_share,
        s.report.invalid_fans.len(),
        (sum / area).sqrt(),
        s.report.relaxation,
        s.report.exchanges,
        q.valences,
    );
}

fn dense(name: &str, faces: usize, factor: usize) -> (usize, TriMesh, Box<dyn ImplicitSurface>) {
    let shape = NamedShape::find(name).unwrap();
    let field = shape.field();
    let cells = cells_for_faces(&*field, &shape.region, faces * factor).unwrap();
    let mesh = polygonize(&*field, &shape.region, &PolygonizeSettings::with_cells(cells)).unwrap();
    (mesh.topology().face_count(), mesh, field)
}

#[test]
#[ignore = "timings for humans"]
fn speed() {
    for count in [10_000, 100_000, 1_000_000] {
        let shape = NamedShape::find("deccube").unwrap();
        let field = shape.field();
        let cells = cells_for_faces(&*field, &shape.region, count).unwrap();
        let start = std::time::Instant::now();
        let mesh =
            polygonize(&*field, &shape.region, &PolygonizeSettings::with_cells(cells)).unwrap();
        let (input, meshed) = (mesh.topology().face_count(), start.elapsed().as_secs_f64());
        let target = FieldTarget { field: &*field, length: mesh.diagonal() };
        let start = std::time::Instant::now();
        let s = simplify(mesh, &target, &SimplifySettings::to_faces(input / 40 * 2)).unwrap();
        let sec = start.elapsed().as_secs_f64();
        println!("{input} ({meshed:.2} s): {sec:.2} s, {:.2} Mtri/s {:?}", input as f64 / sec * 1e-6, s.report);
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    println!("{}", status.lines().find(|l| l.starts_with("VmHWM")).unwrap());
}
