//! Every number of an independent implementation.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use apatch::basemesh::{EdgeId, FaceId, TriMesh, VertexId, VertexMap};
use apatch::glam::DVec3;
use apatch::rational::{
    Convexity, FaceShare, FreeWeightRule, Normals, RationalSurface, RepairSettings, Settings,
    SheetSettings, Side, Split,
};
use serde_json::Value;

const TOLERANCE: f64 = 1e-10;

fn oracle() -> Value {
    let path = "/../../fixtures/oracle/rational-a-patch/reference.json";
    let path = format!("{}{path}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn list(v: &Value) -> &Vec<Value> {
    v.as_array().unwrap()
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap()
}

fn index(v: &Value) -> usize {
    usize::try_from(v.as_u64().unwrap()).unwrap()
}

fn numbers<const N: usize>(v: &Value) -> [f64; N] {
    list(v).iter().map(number).collect::<Vec<_>>().try_into().unwrap()
}

fn vectors(v: &Value) -> Vec<DVec3> {
    list(v).iter().map(|v| DVec3::from_array(numbers(v))).collect()
}

#[track_caller]
fn near(got: f64, expected: f64, what: &str) {
    let error = (got - expected).abs();
    assert!(error <= TOLERANCE * (1.0 + expected.abs()), "{what}: {got} is not {expected}");
}

#[track_caller]
fn all_near<const N: usize>(got: [f64; N], expected: &Value, what: &str) {
    for (got, expected) in got.into_iter().zip(numbers::<N>(expected)) {
        near(got, expected, what);
    }
}

#[track_caller]
fn vector_near(got: DVec3, expected: &Value, what: &str) {
    all_near(got.to_array(), expected, what);
}

fn kind(v: &Value) -> Convexity {
    match v.as_str().unwrap() {
        "positive" => Convexity::Positive,
        "negative" => Convexity::Negative,
        "nonconvex" => Convexity::Nonconvex,
        _ => Convexity::Zero,
    }
}

fn build(case: &Value) -> RationalSurface {
    let faces: Vec<[usize; 3]> =
        list(&case["F"]).iter().map(|f| [0, 1, 2].map(|i| index(&f[i]))).collect();
    let mesh = TriMesh::new(vectors(&case["V"]), &faces).unwrap();
    let rule = match case["f0003_rule"].as_str().unwrap() {
        "paper" => FreeWeightRule::Published,
        _ => FreeWeightRule::Clamped,
    };
    let sheet = SheetSettings { refine: false, ..SheetSettings::default() };
    let settings = Settings { rule, sheet, repair: RepairSettings::NONE, ..Settings::default() };
    let normals = Normals::Given(VertexMap::from_vec(vectors(&case["N"])));
    RationalSurface::new(mesh, normals, &settings).unwrap()
}

const SIDES: [(Side, &str); 2] = [(Side::Positive, "side0"), (Side::Negative, "side1")];

#[test]
fn faces() {
    let oracle = oracle();
    let mut samples = 0;
    for case in list(&oracle["cases"]) {
        let surface = build(case);
        for expected in list(&case["faces"]) {
            let face = FaceId::new(index(&expected["face"]));
            let what = format!("{} {} face {face}", case["name"], case["f0003_rule"]);
            face_weights(&surface, face, expected, &what);
            for point in list(&expected["surface"]) {
                let got = surface.face_point(face, numbers(&point["q"])).unwrap();
                vector_near(got.point, &point["X"], &what);
                vector_near(got.normal(), &point["n"], &what);
                near(got.t, number(&point["t"]).abs(), &what);
                samples += 1;
            }
            for value in list(&expected["F"]) {
                let side = SIDES[index(&value["side"])].0;
                let (f, gradient) =
                    surface.face_value(face, side, numbers(&value["bary"])).unwrap();
                near(f, number(&value["F"]), &what);
                vector_near_loosely(gradient, &value["grad"], &what);
                samples += 1;
            }
        }
    }
    assert!(samples > 50, "only {samples} samples");
}

fn face_weights(surface: &RationalSurface, face: FaceId, expected: &Value, what: &str) {
    let patch = surface.face(face);
    assert_eq!(patch.convexity, kind(&expected["type"]), "{what}");
    for a in 0..3 {
        for b in (0..3).filter(|&b| b != a) {
            near(patch.base.edge_weight(a, b), number(&expected["e"][a][b]), what);
        }
    }
    all_near(patch.base.middle_weights(), &expected["g"], what);
    assert_eq!(patch.base.is_split(), expected["split"].as_bool().unwrap(), "{what}");
    if let Some(&Split { d, m, r, q }) = patch.base.split() {
        all_near(d, &expected["ct_d"], what);
        all_near(m, &expected["ct_m"], what);
        all_near(r, &expected["ct_r"], what);
        near(q, number(&expected["ct_z"]), what);
    }
    for (side, name) in SIDES {
        let (got, expected) = (patch.sides[side.index()], &expected[name]);
        assert_eq!(got.is_some(), expected.is_object(), "{what} {name}");
        let Some(got) = got else { continue };
        vector_near(got.apex, &expected["apex"], what);
        let [a, b, c] = patch.corners;
        let height = (got.apex - a).dot((b - a).cross(c - a).normalize());
        near(height, number(&expected["t"]), what);
        all_near(got.l1v, &expected["L1v"], what);
        all_near(got.l1e, &expected["L1e"], what);
        all_near(got.fitted, &expected["q_au"], what);
        near(got.published(&patch.base), number(&expected["p_u"]), what);
        near(got.neighbours, number(&expected["neighbour"]), what);
        near(got.free, number(&expected["f3"]), what);
        all_near(got.l2v, &expected["L2v"], what);
        near(got.bound, number(&expected["B"]), what);
    }
}

/// Gradients of the reference are central differences in places.
#[track_caller]
fn vector_near_loosely(got: DVec3, expected: &Value, what: &str) {
    let expected = DVec3::from_array(numbers(expected));
    assert!(got.distance(expected) <= 1e-9 * (1.0 + expected.length()), "{what}: {got} {expected}");
}

#[test]
fn edges() {
    let oracle = oracle();
    let mut samples = 0;
    for case in list(&oracle["cases"]) {
        let surface = build(case);
        for expected in list(&case["edges"]) {
            let ends = [0, 1].map(|i| index(&expected["edge"][i]));
            let topology = surface.mesh().topology();
            let edge = topology
                .edges()
                .find(|&e| {
                    let [a, b] = topology.edge_vertices(e).map(VertexId::index);
                    [a, b] == ends || [b, a] == ends
                })
                .unwrap();
            let what = format!("{} {} edge {ends:?}", case["name"], case["f0003_rule"]);
            samples += edge_numbers(&surface, edge, ends, expected, &what);
        }
    }
    assert!(samples > 20, "only {samples} samples");
}

/// The reference directs some edges the other way: `turned`.
fn edge_numbers(
    surface: &RationalSurface,
    edge: EdgeId,
    ends: [usize; 2],
    expected: &Value,
    what: &str,
) -> usize {
    let patch = surface.edge(edge);
    let turned = surface.mesh().topology().edge_vertices(edge).map(VertexId::index) != ends;
    assert_eq!(patch.convexity, kind(&expected["type"]), "{what}");
    let mut samples = 0;
    for (side, name) in SIDES {
        let (got, expected) = (patch.sides[side.index()], &expected[name]);
        assert_eq!(got.is_some(), expected.is_object(), "{what} {name}");
        let Some(got) = got else { continue };
        let wedge = surface.wedge(edge, side).unwrap();
        near(wedge.opening, number(&expected["theta"]), what);
        near(wedge.angle, number(&expected["psi"]), what);
        let order = |[a, b]: [f64; 2]| if turned { [b, a] } else { [a, b] };
        let weights = order(patch.weights);
        near(weights[0], number(&expected["e_ij"]), what);
        near(weights[1], number(&expected["e_ji"]), what);
        let (k, l) = if turned { (got.right, got.left) } else { (got.left, got.right) };
        share(&k, &order, expected, ["k", "b", "k"], what);
        share(&l, &order, expected, ["l", "a", "l"], what);
        let x = k.other_apex;
        let [i, j] = order([x[1], x[2]]);
        all_near([x[0], i, j, x[3]], &expected["mu"], what);
        let x = l.other_apex;
        let [i, j] = order([x[1], x[2]]);
        all_near([x[3], i, j, x[0]], &expected["nu"], what);
        for value in list(&expected["F"]) {
            let [l, i, j, k] = numbers(&value["bary_l_i_j_k"]);
            let at = if turned { [k, j, i, l] } else { [l, i, j, k] };
            let (f, gradient) = surface.edge_value(edge, side, at).unwrap();
            near(f, number(&value["F"]), what);
            vector_near_loosely(gradient, &value["grad"], what);
            samples += 1;
        }
        samples += 1;
    }
    for point in list(expected.get("surface").unwrap_or(&expected["side0"]["surface"])) {
        let (x, y) = (number(&point["x"]), number(&point["y"]));
        let at = if turned { [1.0 - x, 1.0 - y] } else { [x, y] };
        let got = surface.edge_point(edge, at).unwrap();
        vector_near(got.point, &point["X"], what);
        vector_near(got.normal(), &point["n"], what);
        samples += 1;
    }
    samples
}

fn share(
    got: &FaceShare,
    order: &dyn Fn([f64; 2]) -> [f64; 2],
    expected: &Value,
    [own, middle, last]: [&str; 3],
    what: &str,
) {
    let at = |name: String| number(&expected[name.as_str()]);
    let [i, j] = order(got.l1v);
    near(i, at(format!("{own}_i")), what);
    near(j, at(format!("{own}_j")), what);
    near(got.l1e, at(format!("{own}_ij")), what);
    let [i, j] = order(got.l2v);
    near(i, at(format!("{own}{own}_i")), what);
    near(j, at(format!("{own}{own}_j")), what);
    let [i, j] = order(got.middle);
    near(i, at(format!("{middle}_i")), what);
    near(j, at(format!("{middle}_j")), what);
    near(got.inner, at(format!("h_{last}")), what);
    near(got.free, at(format!("f_{last}")), what);
}
