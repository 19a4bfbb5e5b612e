//! Queries on a whole surface.

use basemesh::FaceId;
use glam::DVec3;

use super::bounds::{self, Bounds};
use super::piece::Aabb;
use super::ray::{self, Ray};
use super::side::{self, Candidate};
use super::tree::Tree;
use super::{Closest, Hit, PatchPoint, closest};
use crate::surface::{NagataSurface, Patch};

/// Distances that differ by less, relatively, are taken for equal.
const TIE: f64 = 1e-12;
/// Closest points of faces that are closer to each other than this, in sizes of the patch, are one.
const SAME_POINT: f64 = 1e-9;
/// Hits of faces with a common vertex that are closer than this, in sizes of the patch, are one.
const SAME_HIT: f64 = 1e-10;

impl Patch {
    /// A box around the patch.
    #[must_use]
    pub fn aabb(&self) -> Aabb {
        bounds::aabb(self, &Bounds::of(self))
    }

    /// The closest point of the closed patch, and the distance, negative on the side the normal points
    /// away from; `None` if `p` is not finite.
    ///
    /// Global: no other point of the patch is closer by more than 1e-10 of its size.
    #[must_use]
    pub fn closest(&self, p: DVec3) -> Option<(PatchPoint, f64)> {
        let bounds = Bounds::of(self);
        let found = closest::closest(self, &bounds, p, f64::INFINITY).filter(|_| p.is_finite());
        found.map(|(parameters, distance)| signed(self.at(parameters), p, distance))
    }

    /// All points where a ray meets the patch, with the ray parameters, ascending. None if the ray is
    /// not [valid](Ray::is_valid).
    #[must_use]
    pub fn hits(&self, ray: &Ray) -> Vec<(PatchPoint, f64)> {
        let mut all = Vec::new();
        if ray.is_valid() {
            let bounds = Bounds::of(self);
            let found = ray::hits(self, &bounds, ray, f64::INFINITY).into_iter();
            all.extend(found.map(|(parameters, t)| (self.at(parameters), t)));
            let size = bounds::aabb(self, &bounds).size();
            all.sort_by(|a, b| a.1.total_cmp(&b.1));
            all.dedup_by(|b, a| is_same(ray, size, a, b));
        }
        all
    }
}

fn signed(at: PatchPoint, p: DVec3, distance: f64) -> (PatchPoint, f64) {
    let below = at.normal.is_some_and(|normal| normal.dot(p - at.point) < 0.0);
    (at, if below { -distance } else { distance })
}

/// Whether two hits on patches of this size are one up to round-off, which grows where a ray is nearly
/// tangent.
fn is_same(ray: &Ray, size: f64, a: &(PatchPoint, f64), b: &(PatchPoint, f64)) -> bool {
    /// Square root of the round-off, relative to [`SAME_HIT`].
    const TANGENT: f64 = 1e-4;
    let length = ray.direction.length();
    let slope = a.0.normal.map_or(1.0, |normal| normal.dot(ray.direction).abs() / length);
    (b.1 - a.1).abs() * length <= SAME_HIT * size / slope.max(TANGENT)
}

/// Closest points and ray intersections on a surface, through a hierarchy of boxes that is built once.
#[derive(Clone, Debug)]
pub struct SurfaceQueries<'a> {
    surface: &'a NagataSurface,
    bounds: Vec<Bounds>,
    boxes: Vec<Aabb>,
    tree: Tree,
}

impl<'a> SurfaceQueries<'a> {
    /// Prepares queries.
    #[must_use]
    pub fn new(surface: &'a NagataSurface) -> Self {
        let (bounds, boxes): (Vec<_>, Vec<_>) = surface
            .mesh()
            .faces()
            .map(|face| {
                let patch = surface.patch(face);
                let bounds = Bounds::of(&patch);
                (bounds, bounds::aabb(&patch, &bounds))
            })
            .unzip();
        let tree = Tree::new(&boxes);
        Self { surface, bounds, boxes, tree }
    }

    /// The surface.
    #[must_use]
    pub fn surface(&self) -> &'a NagataSurface {
        self.surface
    }

    /// A box around the surface.
    #[must_use]
    pub fn aabb(&self) -> Aabb {
        self.tree.aabb()
    }

    /// The closest point; `None` if `p` is not finite.
    ///
    /// If it is on an edge or a vertex, all faces there together decide the sign, so it is right at
    /// creases, too; the face is the one whose normal shows that side most clearly.
    #[must_use]
    pub fn closest(&self, p: DVec3) -> Option<Closest> {
        if !p.is_finite() {
            return None;
        }
        let Aabb { low, high } = self.aabb();
        let far = p.abs().max(low.abs()).max(high.abs()).max_element();
        let widened = |distance: f64| distance * (1.0 + TIE) + 8.0 * f64::EPSILON * far;
        let mut best = f64::INFINITY;
        let mut candidates: Vec<Candidate> = Vec::new();
        let key = |aabb: &Aabb, _| Some(aabb.distance(p));
        self.tree.visit(f64::INFINITY, key, |item| {
            if self.boxes[item].distance(p) <= widened(best) {
                let next = self.candidate(item, p, widened(best));
                best = next.map_or(best, |next| best.min(next.found.signed_distance));
                candidates.extend(next);
            }
            widened(best)
        });
        let nearest = candidates.iter().min_by(|a, b| {
            let distance = |c: &Candidate| c.found.signed_distance;
            distance(a).total_cmp(&distance(b)).then(a.found.face.cmp(&b.found.face))
        })?;
        let at = nearest.found.at.point;
        let same = SAME_POINT * self.boxes[nearest.found.face.index()].size();
        candidates.retain(|c| {
            c.found.signed_distance <= widened(best) && c.found.at.point.distance(at) <= same
        });
        side::signed(&candidates, p)
    }

    /// The closest point of one face, if it is not farther than `limit`, without sign.
    fn candidate(&self, item: usize, p: DVec3, limit: f64) -> Option<Candidate> {
        let face = FaceId::new(item);
        let patch = self.surface.patch(face);
        let (parameters, signed_distance) = closest::closest(&patch, &self.bounds[item], p, limit)?;
        let found = Closest { face, at: patch.at(parameters), signed_distance };
        Some(Candidate { found, weight: side::angle_at(&patch, parameters) })
    }

    /// The first hit of a ray, with the smallest parameter; `None` if there is none or the ray is not
    /// [valid](Ray::is_valid).
    #[must_use]
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.visit_hits(ray, |hit, limit| {
            if best.is_none_or(|best| (hit.t, hit.face) < (best.t, best.face)) {
                best = Some(hit);
            }
            *limit = best.map_or(*limit, |best| best.t);
        });
        best
    }

    /// All hits of a ray, by ascending parameter. A hit on an edge is listed once, with the lowest
    /// face. Where a ray runs within the surface there is no hit. None if the ray is not
    /// [valid](Ray::is_valid).
    #[must_use]
    pub fn hits(&self, ray: &Ray) -> Vec<Hit> {
        let mut all: Vec<Hit> = Vec::new();
        self.visit_hits(ray, |hit, _| all.push(hit));
        all.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
        let mut kept: Vec<Hit> = Vec::with_capacity(all.len());
        for hit in all {
            let size = self.boxes[hit.face.index()].size();
            let same = |k: &&mut Hit| is_same(ray, size, &(k.at, k.t), &(hit.at, hit.t));
            let mut recent = kept.iter_mut().rev().take_while(same);
            match recent.find(|k| self.touch(k.face, hit.face)) {
                Some(k) if hit.face < k.face => *k = hit,
                Some(_) => {}
                None => kept.push(hit),
            }
        }
        kept
    }

    fn touch(&self, a: FaceId, b: FaceId) -> bool {
        let mesh = self.surface.mesh();
        mesh.corners(a).iter().any(|v| mesh.corners(b).contains(v))
    }

    fn visit_hits(&self, ray: &Ray, mut take: impl FnMut(Hit, &mut f64)) {
        if !ray.is_valid() {
            return;
        }
        let mut limit = f64::INFINITY;
        self.tree.visit(
            limit,
            |aabb, limit| {
                aabb.grown(ray.round_off(aabb.low.abs().max(aabb.high.abs())))
                    .entry(ray, 0.0, limit)
            },
            |item| {
                let face = FaceId::new(item);
                let patch = self.surface.patch(face);
                for (parameters, t) in ray::hits(&patch, &self.bounds[item], ray, limit) {
                    take(Hit { face, at: patch.at(parameters), t }, &mut limit);
                }
                limit
            },
        );
    }
}
