//! The fifteen solids, and measures of smoothness.

use std::collections::BTreeSet;

use apatch::Tessellation;
use apatch::glam::{DMat3, DVec3};
use apatch::polyhedral::{Hull, Planarity, PolyhedralSurface, Polyhedron, Scheme, Settings};
use apatch::rational::Side;
use serde_json::Value;
use testkit::Numbers;
use testkit::solids::sphere_points;

pub(crate) fn read(name: &str) -> Value {
    let folder = "/../../fixtures/oracle/polyhedra-a-patch/";
    let path = format!("{}{folder}{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

pub(crate) fn list(v: &Value) -> &Vec<Value> {
    v.as_array().unwrap()
}

pub(crate) fn number(v: &Value) -> f64 {
    v.as_f64().unwrap()
}

pub(crate) fn index(v: &Value) -> usize {
    usize::try_from(v.as_u64().unwrap()).unwrap()
}

pub(crate) fn vector(v: &Value) -> DVec3 {
    let n: Vec<f64> = list(v).iter().map(number).collect();
    DVec3::from_slice(&n)
}

pub(crate) fn solid(value: &Value) -> Polyhedron {
    let vertices = list(&value["vertices"]).iter().map(vector).collect();
    let looped = |l: &Value| list(l).iter().map(index).collect::<Vec<_>>();
    let face = |f: &Value| list(f).iter().map(looped).collect::<Vec<_>>();
    let faces = list(&value["faces"]).iter().map(face).collect();
    Polyhedron::new(vertices, faces, &Planarity::default()).unwrap()
}

/// All fifteen by name.
pub(crate) fn solids() -> Vec<(String, Polyhedron)> {
    let all = read("solids");
    let solids = all["solids"].as_object().unwrap();
    solids.iter().map(|(name, value)| (name.clone(), solid(value))).collect()
}

pub(crate) fn settings(scheme: Scheme) -> Settings {
    Settings { scheme, ..Settings::default() }
}

/// Largest jumps across all shared triangles of tetrahedra, relative to the largest gradient and
/// second derivative anywhere: gradient, second derivatives; and the angle of normals on the surface.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Jumps {
    pub(crate) value: f64,
    pub(crate) gradient: f64,
    pub(crate) hessian: f64,
    pub(crate) angle: f64,
    pub(crate) curvature: f64,
}

fn shared(a: [usize; 4], b: [usize; 4]) -> Option<[usize; 3]> {
    let common: Vec<usize> = a.into_iter().filter(|p| b.contains(p)).collect();
    common.try_into().ok()
}

/// Mean and Gauss curvature of a level set.
pub(crate) fn curvatures(gradient: DVec3, hessian: DMat3) -> [f64; 2] {
    let n = gradient.normalize();
    let (u, v) = n.any_orthonormal_pair();
    let form = |a: DVec3, b: DVec3| a.dot(hessian * b) / gradient.length();
    let (e, f, g) = (form(u, u), form(u, v), form(v, v));
    [0.5 * (e + g), e * g - f * f]
}

pub(crate) fn jumps(surface: &PolyhedralSurface) -> Jumps {
    let hull = surface.hull();
    let size = hull.size();
    let mut found = Jumps::default();
    let (mut steepest, mut largest) = (0.0_f64, 0.0_f64);
    let at = |corners: [usize; 4], points: [usize; 3], x: [f64; 3]| {
        corners.map(|c| points.iter().position(|&p| p == c).map_or(0.0, |i| x[i]))
    };
    for (i, &first) in hull.cells.iter().enumerate() {
        for (j, &second) in hull.cells.iter().enumerate().skip(i + 1) {
            let corners = [hull.corners(first), hull.corners(second)];
            let Some(points) = shared(corners[0], corners[1]) else { continue };
            for a in 0..=4 {
                for b in 0..=4 - a {
                    let x = [a, b, 4 - a - b].map(|k| k as f64 / 4.0);
                    let p = surface.jet(i, at(corners[0], points, x));
                    let q = surface.jet(j, at(corners[1], points, x));
                    steepest = steepest.max(p.gradient.length());
                    let square = |m: DMat3| m.to_cols_array().map(|v| v * v).iter().sum::<f64>();
                    let entries = square(p.hessian).sqrt();
                    largest = largest.max(entries);
                    found.value = found.value.max((p.value - q.value).abs() / size);
                    found.gradient = found.gradient.max(p.gradient.distance(q.gradient));
                    found.hessian = found.hessian.max(square(p.hessian - q.hessian).sqrt());
                }
            }
            // on the surface: rays within the common triangle
            let base: Vec<usize> = points.into_iter().filter(|&p| p < hull.base_count()).collect();
            let [p, q] = *base else { continue };
            let top = points.into_iter().find(|p| !base.contains(p)).unwrap();
            for k in 1..8 {
                let s = f64::from(k) / 8.0;
                let foot = at(corners[0], [p, q, top], [1.0 - s, s, 0.0]);
                let top = at(corners[0], [p, q, top], [0.0, 0.0, 1.0]);
                let Some(hit) = surface.point(i, foot, top) else { continue };
                let other = corners[1]
                    .map(|c| corners[0].iter().position(|&d| d == c).map_or(0.0, |k| hit.at[k]));
                let (a, b) = (surface.jet(i, hit.at), surface.jet(j, other));
                found.angle = found.angle.max(
                    a.gradient
                        .angle_between(b.gradient)
                        .min(a.gradient.normalize().distance(b.gradient.normalize())),
                );
                let [h, g] = curvatures(a.gradient, a.hessian);
                let [h2, g2] = curvatures(b.gradient, b.hessian);
                let scale = 1.0 + h.abs().max(g.abs());
                found.curvature = found.curvature.max((h - h2).abs().max((g - g2).abs()) / scale);
            }
        }
    }
    found.gradient /= steepest;
    found.hessian /= largest;
    found
}

/// Of the sides that a cell can have.
pub(crate) fn side(v: &Value) -> Side {
    if number(v) > 0.0 { Side::Positive } else { Side::Negative }
}

/// Euler characteristic of a mesh, if every side of a triangle has exactly one other triangle.
pub(crate) fn closed_characteristic(mesh: &Tessellation) -> Option<isize> {
    let mut sides = BTreeSet::new();
    let mut points = BTreeSet::new();
    for &[a, b, c] in &mesh.triangles {
        points.extend([a, b, c]);
        if ![[a, b], [b, c], [c, a]].into_iter().all(|side| sides.insert(side)) {
            return None;
        }
    }
    if !sides.iter().all(|&[a, b]| sides.contains(&[b, a])) {
        return None;
    }
    let signed = |n: usize| isize::try_from(n).unwrap();
    Some(signed(points.len()) - signed(sides.len() / 2) + signed(mesh.triangles.len()))
}

/// A random convex solid: even seeds have triangles for faces, odd ones corners of three edges.
pub(crate) fn convex_solid(seed: u64) -> Polyhedron {
    let count = [8, 11, 14, 17, 20][usize::try_from(seed / 2 % 5).unwrap()];
    let points = sphere_points(seed, count);
    let hull = Polyhedron::convex_hull(&points).unwrap();
    // all points on one side of the origin: no polar dual
    let around = hull.facets().iter().all(|f| f.normal.dot(f.centroid) > 0.1);
    match (seed.is_multiple_of(2), around) {
        (true, _) => hull,
        (false, true) => hull.dual().unwrap(),
        (false, false) => convex_solid(seed + 1000),
    }
}

/// The upright prism of height 1 over a polygon, counter-clockwise from above.
pub(crate) fn prism(polygon: &[[f64; 2]]) -> Polyhedron {
    let n = polygon.len();
    let at = |z: f64| polygon.iter().map(move |&[x, y]| DVec3::new(x, y, z));
    let sides = (0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]);
    let ends = [(0..n).rev().collect(), (n..2 * n).collect()];
    let faces = sides.chain(ends).map(|outline: Vec<usize>| vec![outline]).collect();
    Polyhedron::new(at(0.0).chain(at(1.0)).collect(), faces, &Planarity::default()).unwrap()
}

/// Number of pairs of tetrahedra with a common inner point, among some points of each.
pub(crate) fn overlapping_pairs(hull: &Hull) -> usize {
    let mut numbers = Numbers::new(5);
    let mut pairs = BTreeSet::new();
    for (i, &cell) in hull.cells.iter().enumerate() {
        let tetrahedron = hull.tetrahedron(cell);
        for _ in 0..10 {
            let p = tetrahedron.point(numbers.weights::<4>());
            for (j, &other) in hull.cells.iter().enumerate() {
                let at = hull.tetrahedron(other).barycentric(p);
                if j != i && at.into_iter().all(|x| x > 1e-6) {
                    pairs.insert([i.min(j), i.max(j)]);
                }
            }
        }
    }
    pairs.len()
}
