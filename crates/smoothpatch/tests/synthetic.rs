//! Second-order data that belong to no implicit function, and edges in special position: the
//! construction needs nothing but data at the vertices to be exactly smooth.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use smoothpatch::basemesh::glam::{DMat3, DVec3};
use smoothpatch::basemesh::{EdgeId, Foot, SurfaceTarget, TriMesh, VertexId, VertexMap};
use smoothpatch::bezier_core::SurfaceJet;
use smoothpatch::g1_triangular::SecondOrderData;
use smoothpatch::implicit::Ellipsoid;
use smoothpatch::measure::{continuity, interpolation};
use smoothpatch::{G1Surface, Method, Settings, Silent, fit_base_mesh, fit_source};
use testkit::meshes::{icosphere, jittered, radially_on_surface};

const METHODS: [Method; 2] = [Method::Published, Method::Refined];

/// Data at the vertices, and the unit sphere (or nothing at all) as a rough idea of the rest.
struct Synthetic {
    jets: VertexMap<SurfaceJet>,
    has_feet: bool,
}

impl SurfaceTarget for Synthetic {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let normal = near.try_normalize()?;
        self.has_feet.then_some(Foot { point: normal, normal })
    }
}

impl SecondOrderData for Synthetic {
    fn surface_jet(&self, vertex: VertexId, position: DVec3) -> Option<SurfaceJet> {
        self.jets.surface_jet(vertex, position)
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// The symmetric form with the values `[uu, uv, vv]` in a tangent basis.
fn form([u, v]: [DVec3; 2], [uu, uv, vv]: [f64; 3]) -> DMat3 {
    outer(u, u) * uu + (outer(u, v) + outer(v, u)) * uv + outer(v, v) * vv
}

fn fit(mesh: &TriMesh, source: &Synthetic, method: Method) -> G1Surface {
    let settings = Settings::with_faces(0).with_method(method);
    fit_source(source, mesh.clone(), &settings, &mut Silent).unwrap()
}

/// Exactly smooth, and with the given data at every corner.
fn check(name: &str, surface: &G1Surface) {
    assert!(surface.max_row_residual() <= 1e-13, "{name}: {:e}", surface.max_row_residual());
    let joined = continuity(surface.mesh.topology(), &surface.patches.nets);
    assert!(joined.g1_angle_deg <= 1e-9, "{name}: {joined:?}");
    let defects = interpolation(surface);
    assert!(defects.position <= 0.0, "{name}: {defects:?}");
    assert!(defects.normal.max(defects.second_form) <= 1e-10, "{name}: {defects:?}");
}

/// Numbers in [-1, 1] without pattern.
fn spread(index: usize, which: u32) -> f64 {
    let steps = [0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_970];
    let at = steps[which as usize % 3] * (index + 1) as f64 + 0.37 * f64::from(which);
    2.0 * at.fract() - 1.0
}

/// Normals tilted by up to about six degrees, forms with curvatures of either sign.
fn arbitrary_jets(mesh: &TriMesh, curvature: f64) -> VertexMap<SurfaceJet> {
    mesh.positions().map(|vertex, &point| {
        let value = |which| spread(vertex.index(), which);
        let tilt = DVec3::new(value(0), value(1), value(2)) * 0.06;
        let normal = (point + tilt).normalize();
        let values = [value(3), value(4), value(5)].map(|x| x * curvature);
        let axes = <[DVec3; 2]>::from(normal.any_orthonormal_pair());
        SurfaceJet { point, normal, second_fundamental_form: form(axes, values) }
    })
}

#[test]
fn arbitrary_second_forms() {
    let mesh = jittered(&icosphere(2), 0.1, 5);
    for curvature in [0.0, 0.5, 2.0] {
        for method in METHODS {
            let source = Synthetic { jets: arbitrary_jets(&mesh, curvature), has_feet: true };
            let surface = fit(&mesh, &source, method);
            // where the data contradict the feet, the solver gives up: that must not matter
            println!("{method:?}, curvature {curvature}: {:?}", surface.curve_summary());
            check(&format!("{method:?}, curvature {curvature}"), &surface);
        }
    }
}

/// Nothing but the data at the vertices: every curve is a fallback, every sample missing.
#[test]
fn no_surface_between_the_vertices() {
    let mesh = jittered(&icosphere(2), 0.1, 5);
    for method in METHODS {
        let source = Synthetic { jets: arbitrary_jets(&mesh, 1.0), has_feet: false };
        let surface = fit(&mesh, &source, method);
        assert_eq!(surface.failed_feet.as_slice(), vec![55; mesh.topology().face_count()]);
        check(&format!("{method:?}"), &surface);
    }
}

/// Edges along which the normal curvature vanishes at both ends: one at nearly every vertex.
#[test]
fn asymptotic_edges() {
    let mesh = jittered(&icosphere(2), 0.1, 9);
    let t = mesh.topology();
    let mut partner = vec![None; t.vertex_count()];
    for edge in t.edges() {
        let [a, b] = t.edge_vertices(edge);
        if partner[a.index()].is_none() && partner[b.index()].is_none() {
            partner[a.index()] = Some(b);
            partner[b.index()] = Some(a);
        }
    }
    let jets = mesh.positions().map(|vertex, &point| {
        let normal = point.normalize();
        let Some(other) = partner[vertex.index()] else {
            let axes = <[DVec3; 2]>::from(normal.any_orthonormal_pair());
            return SurfaceJet {
                point,
                normal,
                second_fundamental_form: form(axes, [-1.0, 0.0, -1.0]),
            };
        };
        let chord = mesh.position(other) - point;
        let along = (chord - normal * chord.dot(normal)).normalize();
        let across = normal.cross(along);
        let values = [0.0, spread(vertex.index(), 0), 1.5 * spread(vertex.index(), 1)];
        SurfaceJet { point, normal, second_fundamental_form: form([along, across], values) }
    });
    let matched: Vec<_> = t
        .edges()
        .filter(|&e| partner[t.edge_vertices(e)[0].index()] == Some(t.edge_vertices(e)[1]))
        .collect();
    assert!(matched.len() > t.vertex_count() / 3, "{} asymptotic edges", matched.len());
    for method in METHODS {
        let surface = fit(&mesh, &Synthetic { jets: jets.clone(), has_feet: true }, method);
        check(&format!("{method:?}"), &surface);
        // zero curvature as asked for: q2 stays in the tangent plane where the tangent was kept
        let converged = |edge: &&EdgeId| !surface.curves[**edge].status.is_fallback();
        let solved: Vec<_> = matched.iter().filter(converged).collect();
        assert!(method == Method::Refined || solved.len() >= 20, "{} solved", solved.len());
        for &&edge in solved.iter().filter(|_| method == Method::Published) {
            let q = surface.network.curves()[edge].points;
            let [a, _] = t.edge_vertices(edge);
            let height = (q[2] - q[0]).dot(jets[a].normal) / q[0].distance(q[4]);
            assert!(height.abs() <= 1e-14, "{edge:?}: {height:e}");
        }
    }
}

/// On a mesh with three mirror planes, λ0 = λ1 along the edges across them. Moving one vertex a
/// little makes the difference small but not zero: the surface must change as little.
#[test]
fn equal_weights_are_not_special() {
    let field = Ellipsoid { semi_axes: DVec3::new(1.2, 1.0, 0.9) };
    let symmetric = radially_on_surface(&icosphere(1), &field, 2.0);
    let moved = |amount: f64| {
        let mesh = symmetric.clone();
        let mut positions = mesh.positions().clone();
        positions.as_mut_slice()[3] += DVec3::new(0.6, -0.3, 0.7) * amount;
        radially_on_surface(&mesh.with_positions(positions).unwrap(), &field, 2.0)
    };
    for method in METHODS {
        let settings = Settings::with_faces(0).with_method(method);
        let fit = |mesh| fit_base_mesh(&field, mesh, &settings, &mut Silent).unwrap();
        let reference = fit(symmetric.clone());
        let slopes = |surface: &G1Surface| -> Vec<f64> {
            let weights = surface.patches.weights.as_slice();
            weights.iter().map(|w| (w.lambda[1] - w.lambda[0]).abs()).collect()
        };
        let equal = slopes(&reference).iter().filter(|&&slope| slope <= 1e-13).count();
        assert!(equal >= 10, "{equal} edges with equal weights");
        for exponent in (2..=16).step_by(2) {
            let amount = 10.0_f64.powi(-exponent);
            let surface = fit(moved(amount));
            check(&format!("{method:?}, moved by {amount:e}"), &surface);
            let change = largest_distance(&reference, &surface);
            let allowed = 30.0 * amount + 1e-11;
            assert!(change <= allowed, "{method:?}: moved by {amount:e}, changed by {change:e}");
        }
    }
}

fn largest_distance(a: &G1Surface, b: &G1Surface) -> f64 {
    let points = |s: &G1Surface| -> Vec<DVec3> {
        s.patches.nets.as_slice().iter().flat_map(|net| *net.net()).collect()
    };
    points(a).iter().zip(points(b)).map(|(p, q)| p.distance(q)).fold(0.0, f64::max)
}
