//! Surfaces, random points and references for queries.

use nagata::basemesh::FaceId;
use nagata::glam::{DVec2, DVec3};
use nagata::{
    CornerNormals, NagataSurface, Patch, PatchPoint, PolygonMesh, Ray, Settings, SurfaceQueries,
};

use super::{GridMesh as _, TORUS, smooth, torus};

pub fn torus_surface(split: bool, settings: Settings) -> NagataSurface {
    let mesh = torus(24, 12, split).mesh();
    let normals = smooth(&mesh, &TORUS);
    NagataSurface::new(mesh, normals, settings).unwrap()
}

pub fn spot(settings: Settings) -> NagataSurface {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/meshes/spot_triangulated.obj");
    let text = std::fs::read_to_string(path).unwrap();
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
                positions.push(DVec3::from_slice(&numbers));
            }
            Some("f") => {
                let index =
                    |word: &str| word.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
                faces.push(words.map(index).collect::<Vec<_>>());
            }
            _ => {}
        }
    }
    let mesh = PolygonMesh::new(positions, &faces).unwrap();
    let normals = CornerNormals::estimated(&mesh, std::f64::consts::FRAC_PI_2);
    NagataSurface::new(mesh, normals, settings).unwrap()
}

/// Numbers in [0, 1), the same in every run.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In the box of the surface, twice as large.
    pub fn point(&mut self, queries: &SurfaceQueries<'_>) -> DVec3 {
        let aabb = queries.aabb();
        let at = DVec3::new(self.next(), self.next(), self.next()) * 2.0 - 0.5;
        aabb.low + (aabb.high - aabb.low) * at
    }
}

pub fn is_on_patch(surface: &NagataSurface, face: FaceId, at: &PatchPoint) -> bool {
    let [u, v] = at.parameters;
    let quad = surface.mesh().corners(face).len() == 4;
    let inside = u >= 0.0 && v >= 0.0 && (if quad { u.max(v) } else { u + v }) <= 1.0 + 1e-15;
    inside && surface.patch(face).point(at.parameters) == at.point
}

/// A flat triangle between three points of a patch.
#[derive(Clone, Copy)]
pub struct Flat {
    pub face: FaceId,
    at: [DVec2; 3],
    points: [DVec3; 3],
}

impl Flat {
    fn new(patch: &Patch, face: FaceId, at: [DVec2; 3]) -> Self {
        Self { face, at, points: at.map(|q| patch.point(q.to_array())) }
    }

    /// Those of all patches, `n` divisions.
    pub fn all(surface: &NagataSurface, n: usize) -> Vec<Self> {
        let mut all = Vec::new();
        for face in surface.mesh().faces() {
            let patch = surface.patch(face);
            let quad = matches!(patch, Patch::Quad(_));
            let at = |i: usize, j: usize| DVec2::new(i as f64, j as f64) / n as f64;
            for i in 0..n {
                for j in 0..if quad { n } else { n - i } {
                    let (b, c) = (at(i + 1, j), at(i, j + 1));
                    all.push(Self::new(&patch, face, [at(i, j), b, c]));
                    if quad || i + j + 1 < n {
                        all.push(Self::new(&patch, face, [b, at(i + 1, j + 1), c]));
                    }
                }
            }
        }
        all
    }

    fn parts(&self, patch: &Patch) -> [Self; 4] {
        let [a, b, c] = self.at;
        let [d, e, f] = [(b + c) / 2.0, (c + a) / 2.0, (a + b) / 2.0];
        [[a, f, e], [f, b, d], [e, d, c], [d, e, f]].map(|at| Self::new(patch, self.face, at))
    }

    /// A ball around it, and what bulges from it: centre and radius.
    fn ball(&self) -> (DVec3, f64) {
        let centre = self.points.into_iter().sum::<DVec3>() / 3.0;
        (centre, 1.5 * self.points.map(|p| p.distance(centre)).into_iter().fold(0.0, f64::max))
    }

    /// Ray parameter and cosine of the angle with the normal, if the line hits it. Along edges, it hits
    /// at least one of the triangles there.
    fn hit(&self, ray: &Ray) -> Option<(f64, f64)> {
        let [a, b, c] = self.points.map(|p| p - ray.origin);
        let side = |p: DVec3, q: DVec3| ray.direction.dot(p.cross(q));
        let sides = [side(a, b), side(b, c), side(c, a)];
        if !(sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)) {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let along = normal.dot(ray.direction);
        (along != 0.0)
            .then(|| (normal.dot(a) / along, along / (normal.length() * ray.direction.length())))
    }
}

/// Balls around flat triangles of all patches.
pub struct Reference<'a> {
    surface: &'a NagataSurface,
    flats: Vec<Flat>,
    balls: Vec<(DVec3, f64)>,
}

impl<'a> Reference<'a> {
    pub fn new(surface: &'a NagataSurface) -> Self {
        let flats = Flat::all(surface, 3);
        let balls = flats.iter().map(Flat::ball).collect();
        Self { surface, flats, balls }
    }

    /// The smallest distance, by bisection of every triangle that may come closer.
    pub fn distance(&self, p: DVec3) -> f64 {
        let farthest = |ball: &(DVec3, f64)| ball.0.distance_squared(p).sqrt() + ball.1;
        let mut best = self.balls.iter().map(farthest).fold(f64::INFINITY, f64::min);
        let near = |ball: (DVec3, f64), best: f64| ball.0.distance(p) - ball.1 <= best;
        let mut open: Vec<Flat> = Vec::new();
        open.extend(
            self.flats.iter().zip(&self.balls).filter(|(_, b)| near(**b, best)).map(|(f, _)| *f),
        );
        for _ in 0..14 {
            let closest = |flat: &Flat| {
                flat.points.map(|q| q.distance(p)).into_iter().fold(f64::INFINITY, f64::min)
            };
            best = open.iter().map(closest).fold(best, f64::min);
            // sagging shrinks with the square of the size
            open.retain(|flat| {
                let (_, radius) = flat.ball();
                flat_distance(p, flat.points) - 0.4 * radius * radius / self.scale(flat) <= best
            });
            open = open.iter().flat_map(|f| f.parts(&self.surface.patch(f.face))).collect();
            assert!(open.len() < 200_000, "{p}: the reference does not converge");
        }
        // the flat triangles are so small now that they are the surface
        open.iter().map(|flat| flat_distance(p, flat.points)).fold(f64::INFINITY, f64::min)
    }

    /// The longest side of the face: radii of curvature are longer.
    fn scale(&self, flat: &Flat) -> f64 {
        let corners = self.surface.mesh().corners(flat.face);
        let at = |k: usize| self.surface.mesh().position(corners[k % corners.len()]);
        (0..corners.len()).map(|k| at(k).distance(at(k + 1))).fold(0.0, f64::max)
    }

    /// Ray parameters and cosines of all hits, by bisection of every triangle that may be hit.
    pub fn hits(&self, ray: &Ray) -> Vec<(f64, f64)> {
        let direction = ray.direction.normalize();
        let near = |(centre, radius): (DVec3, f64)| {
            let from = centre - ray.origin;
            from.length_squared() - from.dot(direction).powi(2) <= radius * radius
        };
        let mut open: Vec<Flat> = Vec::new();
        open.extend(self.flats.iter().zip(&self.balls).filter(|(_, b)| near(**b)).map(|(f, _)| *f));
        for _ in 0..14 {
            open = open.iter().flat_map(|f| f.parts(&self.surface.patch(f.face))).collect();
            open.retain(|flat| near(flat.ball()));
        }
        open.iter().filter_map(|flat| flat.hit(ray)).filter(|(t, _)| *t >= 0.0).collect()
    }
}

fn flat_distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let inside = |a: DVec3, b: DVec3| (b - a).cross(p - a).dot(normal) >= 0.0;
    if normal != DVec3::ZERO && inside(a, b) && inside(b, c) && inside(c, a) {
        return normal.normalize().dot(p - a).abs();
    }
    let on_edge = |a: DVec3, b: DVec3| {
        let t = (p - a).dot(b - a) / (b - a).length_squared();
        p.distance(a.lerp(b, t.clamp(0.0, 1.0)))
    };
    on_edge(a, b).min(on_edge(b, c)).min(on_edge(c, a))
}
