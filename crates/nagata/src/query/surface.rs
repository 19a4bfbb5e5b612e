//! Queries on a whole surface.

use std::cell::Cell;

use basemesh::FaceId;
use glam::DVec3;

use super::bounds::{self, Bounds};
use super::piece::{Aabb, Flat, Piece};
use super::ray::{self, Ray};
use super::side::{self, Candidate};
use super::tree::{Tree, WIDTH};
use super::{Closest, Hit, PatchPoint, closest};
use crate::settings::Continuity;
use crate::surface::{NagataSurface, Patch};

/// Distances that differ by less, relatively, are taken for equal.
const TIE: f64 = 1e-12;
/// Closest points of faces that are closer to each other than this, in sizes of the patch, are one.
const SAME_POINT: f64 = 1e-9;
/// Hits of faces with a common vertex that are closer than this, in sizes of the patch, are one.
const SAME_HIT: f64 = 1e-10;

/// The closest point of one face.
#[derive(Clone, Copy, Debug)]
struct Near {
    item: usize,
    face: FaceId,
    parameters: [f64; 2],
    distance: f64,
    size: f64,
}

impl Patch {
    /// A box around the patch.
    #[must_use]
    pub fn aabb(&self) -> Aabb {
        bounds::aabb(self, &Bounds::of(self))
    }

    /// The closest point of the closed patch, and the distance, negative on the side the normal points
    /// away from; `None` if `p` is not finite.
    ///
    /// Global: no other point of the patch is closer by more than 1e-10 of its size and the round-off of the
    /// positions.
    #[must_use]
    pub fn closest(&self, p: DVec3) -> Option<(PatchPoint, f64)> {
        let bounds = Bounds::of(self);
        let mut open = Vec::new();
        let each = Flat::all(self, bounds, FaceId::new(0))
            .filter_map(|flat| closest::closest(self, &flat, p, f64::INFINITY, &mut open));
        let (parameters, distance) =
            each.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|_| p.is_finite())?;
        Some(signed(self.at(parameters), p, distance))
    }

    /// All points where a ray meets the patch, with the ray parameters, ascending. None if the ray is
    /// not [valid](Ray::is_valid).
    #[must_use]
    pub fn hits(&self, ray: &Ray) -> Vec<(PatchPoint, f64)> {
        let mut all = Vec::new();
        if ray.is_valid() {
            let bounds = Bounds::of(self);
            let size = bounds::aabb(self, &bounds).size();
            for flat in Flat::all(self, bounds, FaceId::new(0)) {
                ray::hits(self, &flat, ray, f64::INFINITY, |parameters, t| {
                    all.push((self.at(parameters), t));
                });
            }
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
    /// The items of the tree.
    flats: Vec<Flat>,
    tree: Tree,
    aabb: Aabb,
}

impl<'a> SurfaceQueries<'a> {
    /// Prepares queries.
    #[must_use]
    pub fn new(surface: &'a NagataSurface) -> Self {
        let count = surface.mesh().face_count();
        let mut flats = Vec::with_capacity(count);
        let mut aabb = Aabb::EMPTY;
        for face in surface.mesh().faces() {
            let patch = surface.patch(face);
            let bounds = Bounds::of(&patch);
            aabb = aabb.with(&bounds::aabb(&patch, &bounds));
            flats.extend(Flat::all(&patch, bounds, face));
        }
        let tree = Tree::new(&mut flats);
        Self { surface, flats, tree, aabb }
    }

    /// The surface.
    #[must_use]
    pub fn surface(&self) -> &'a NagataSurface {
        self.surface
    }

    /// A box around the surface.
    #[must_use]
    pub fn aabb(&self) -> Aabb {
        self.aabb
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
        let limit = Cell::new(f64::INFINITY);
        let lower = |distance: f64| limit.set(limit.get().min(widened(distance)));
        let mut items: Vec<(f64, usize)> = Vec::new();
        self.tree.visit_near(p, &limit, |first, [least, most]| {
            let here = first..self.flats.len().min(first + WIDTH);
            most[..here.len()].iter().for_each(|most| lower(*most));
            items
                .extend(least.iter().copied().zip(here).filter(|(least, _)| *least <= limit.get()));
        });
        items.retain(|(least, _)| *least <= limit.get());
        items.iter().for_each(|(_, item)| self.flats[*item].fetch());
        items.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (mut nearest, mut open): (Vec<Near>, _) = (Vec::new(), Vec::new());
        for (least, item) in items {
            if least > limit.get() {
                break;
            }
            if let Some(next) = self.near(item, p, limit.get(), &mut open) {
                lower(next.distance);
                nearest.retain(|near| near.distance <= limit.get() && near.face != next.face);
                nearest.push(next);
            }
        }
        nearest.retain(|near| near.distance <= limit.get());
        let candidates = nearest.iter().map(|near| self.candidate(near));
        let mut candidates: Vec<Candidate> = candidates.collect();
        let order = |a: &(&Near, &Candidate), b: &(&Near, &Candidate)| {
            a.0.distance.total_cmp(&b.0.distance).then(a.0.face.cmp(&b.0.face))
        };
        let (first, at) = nearest.iter().zip(&candidates).min_by(order)?;
        let (at, same) = (at.found.at.point, SAME_POINT * first.size);
        candidates.retain(|candidate| candidate.found.at.point.distance(at) <= same);
        side::signed(&candidates, p)
    }

    /// The patch of an item; of a quadrilateral for each of its halves.
    fn patch(&self, flat: &Flat) -> Patch {
        match self.surface.settings().continuity {
            Continuity::Position if self.surface.mesh().is_triangular() => {
                Patch::Triangle(flat.quadratic())
            }
            _ => self.surface.patch(flat.face),
        }
    }

    /// The closest point of an item, if it is not farther than `limit`.
    fn near(
        &self,
        item: usize,
        p: DVec3,
        limit: f64,
        open: &mut Vec<(f64, Piece)>,
    ) -> Option<Near> {
        let flat = &self.flats[item];
        if matches!(self.surface.settings().continuity, Continuity::TangentPlane(_)) {
            // the quadratic patch nearby is much faster to search
            let quadratic = Patch::Triangle(flat.quadratic());
            let nearby = Flat { bounds: Bounds::of(&quadratic), ..*flat };
            closest::closest(&quadratic, &nearby, p, limit + flat.off_quadratic, open)?;
        }
        let patch = self.patch(flat);
        let (parameters, distance) = closest::closest(&patch, flat, p, limit, open)?;
        Some(Near { item, face: flat.face, parameters, distance, size: flat.size() })
    }

    fn candidate(&self, near: &Near) -> Candidate {
        let Near { item, face, parameters, distance, .. } = *near;
        let patch = self.patch(&self.flats[item]);
        let found = Closest { face, at: patch.at(parameters), signed_distance: distance };
        Candidate { found, weight: side::angle_at(&patch, parameters) }
    }

    /// The first hit of a ray, with the smallest parameter; `None` if there is none or the ray is not
    /// [valid](Ray::is_valid).
    #[must_use]
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.visit_hits(ray, |hit, _, limit| {
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
        let mut all: Vec<(Hit, f64)> = Vec::new();
        self.visit_hits(ray, |hit, size, _| all.push((hit, size)));
        all.sort_by(|(a, _), (b, _)| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
        let mut kept: Vec<Hit> = Vec::with_capacity(all.len());
        for (hit, size) in all {
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

    fn visit_hits(&self, ray: &Ray, mut take: impl FnMut(Hit, f64, &mut f64)) {
        if !ray.is_valid() {
            return;
        }
        let limit = Cell::new(f64::INFINITY);
        let slack = ray.round_off(self.aabb.low.abs().max(self.aabb.high.abs()));
        self.tree.visit_along(ray, slack, &limit, |item| {
            let flat = &self.flats[item];
            let (face, patch) = (flat.face, self.surface.patch(flat.face));
            let (mut to, size) = (limit.get(), flat.size());
            ray::hits(&patch, flat, ray, to, |parameters, t| {
                take(Hit { face, at: patch.at(parameters), t }, size, &mut to);
            });
            limit.set(to);
        });
    }
}
