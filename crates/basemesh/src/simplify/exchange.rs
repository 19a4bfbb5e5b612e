//! Vertices moved from where the surface is flat to where it turns too far along an edge.

use glam::DVec3;

use super::guarded::collapse_guarded;
use super::merge::vertex_quadrics;
use super::report::{Relaxation, SimplifyReport};
use super::settings::SimplifySettings;
use super::{RELAXATIONS, relaxed};
use crate::ids::HalfedgeId;
use crate::improve::guard::area_vector;
use crate::improve::surface_mesh::SurfaceMesh;
use crate::improve::{ImproveReport, improve_surface};
use crate::quality::angle_between;
use crate::target::Foot;

/// Share by which an edge must exceed a limit to be split: many edges are exactly at the limit that
/// the guards set, up to rounding.
const EXCESS: f64 = 1e-9;

/// Rings around changed vertices that are improved together with them.
const RINGS: usize = 2;

/// Splits the edges along which the surface turns farther than allowed and collapses as many
/// elsewhere, up to `exchange_rounds` times or until nothing gets better.
///
/// The number of faces stays the same. A round that does not lower the total excess is undone.
pub(super) fn exchange(
    surface: &mut SurfaceMesh<'_>,
    settings: &SimplifySettings,
    report: &mut SimplifyReport,
) {
    let mut excess = Excess::of(surface, settings);
    for _ in 0..settings.exchange_rounds {
        if excess.edges.is_empty() {
            return;
        }
        let Some((trial, round)) = exchanged(surface, settings, &excess, report) else { return };
        let left = Excess::of(&trial, settings);
        if !left.is_less_than(&excess) {
            return;
        }
        excess = left;
        *surface = trial;
        report.relaxation = report.relaxation.max(round.relaxation);
        report.flips += round.improved.flips;
        report.moves += round.improved.moves;
        report.exchanges += 1;
    }
}

/// What a round did.
struct Round {
    relaxation: Relaxation,
    improved: ImproveReport,
}

/// The mesh after one round; `None` if the guards refuse too many collapses.
///
/// Valence and quality give way where the surface turns too far from end to end, which is what folds
/// patches; else all guards hold.
fn exchanged<'a>(
    surface: &SurfaceMesh<'a>,
    settings: &SimplifySettings,
    excess: &Excess,
    report: &mut SimplifyReport,
) -> Option<(SurfaceMesh<'a>, Round)> {
    let guard = settings.improve_settings().guard();
    let faces = surface.mesh.face_count();
    let mut trial = surface.clone();
    trial.resting.fill(true);
    for &(_, h) in &excess.edges {
        split(&mut trial, h);
    }
    let farthest = if excess.end_to_end > 0.0 { Relaxation::Quality } else { Relaxation::None };
    for relaxation in RELAXATIONS.into_iter().filter(|&r| r <= farthest) {
        let mut quadrics = vertex_quadrics(&trial.mesh, settings.isotropy);
        let guard = relaxed(&guard, relaxation);
        collapse_guarded(&mut trial, &mut quadrics, faces, &guard, &mut report.refusals);
        trial.compact();
        if trial.mesh.face_count() <= faces {
            for _ in 0..RINGS {
                trial.wake_neighbours();
            }
            let improved = improve_surface(&mut trial, &settings.improve_settings());
            trial.resting.fill(false);
            return Some((trial, Round { relaxation, improved }));
        }
    }
    None
}

/// The edges along which the surface turns too far.
struct Excess {
    /// Turning over the limit and edge, the largest first (ties by half-edge id).
    edges: Vec<(f64, HalfedgeId)>,
    /// Sum of squares of what is beyond the limit from end to end, in parts of it.
    end_to_end: f64,
    /// The same for the turning to the middle.
    to_middle: f64,
}

impl Excess {
    fn of(surface: &SurfaceMesh<'_>, settings: &SimplifySettings) -> Self {
        let limit = settings.max_turning_deg.to_radians();
        let middle_limit = settings.max_middle_turning_deg.to_radians();
        let beyond =
            |part: f64| if part > 1.0 + EXCESS { (part - 1.0) * (part - 1.0) } else { 0.0 };
        let mut result = Self { edges: Vec::new(), end_to_end: 0.0, to_middle: 0.0 };
        for (h, end_to_end, to_middle) in turnings(surface) {
            let (end_to_end, to_middle) = (end_to_end / limit, to_middle / middle_limit);
            result.end_to_end += beyond(end_to_end);
            result.to_middle += beyond(to_middle);
            result.edges.push((end_to_end.max(to_middle), h));
        }
        result.edges.retain(|&(turning, _)| turning > 1.0 + EXCESS);
        result.edges.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        result
    }

    /// Less from end to end, or as much there and less to the middle.
    fn is_less_than(&self, other: &Self) -> bool {
        let order = self.end_to_end.total_cmp(&other.end_to_end);
        order.then(self.to_middle.total_cmp(&other.to_middle)).is_lt()
    }
}

/// Every edge with the angle in radians between the normals at its ends, and twice the larger angle
/// between those and the normal near its middle (the former if there is no surface point).
fn turnings(surface: &SurfaceMesh<'_>) -> Vec<(HalfedgeId, f64, f64)> {
    let mesh = &surface.mesh;
    let edges: Vec<HalfedgeId> = mesh.edges().collect();
    let ends = |h| [mesh.origin(h), mesh.target(h)];
    let middle = |h| {
        let [p, q] = ends(h).map(|v| mesh.position(v));
        0.5 * (p + q)
    };
    let middles: Vec<DVec3> = edges.iter().map(|&h| middle(h)).collect();
    let feet = surface.feet(&middles);
    let turning = |(h, foot): (HalfedgeId, Option<Foot>)| {
        let normals @ [n, m] = ends(h).map(|v| surface.normal(v));
        let end_to_end = angle_between(n, m);
        let in_the_middle =
            foot.filter(|foot| foot.point.distance(middle(h)) <= mesh.length(h)).map(|foot| {
                2.0 * normals.map(|n| angle_between(n, foot.normal)).into_iter().fold(0.0, f64::max)
            });
        (h, end_to_end, in_the_middle.unwrap_or(end_to_end))
    };
    edges.into_iter().zip(feet).map(turning).collect()
}

/// Puts a vertex on the surface near the middle of an edge, unless a face would lean away from the
/// surface.
fn split(surface: &mut SurfaceMesh<'_>, h: HalfedgeId) {
    let mesh = &surface.mesh;
    let [pa, pb] = [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v));
    let Some(foot) = surface.foot(0.5 * (pa + pb), 0.5 * pa.distance(pb)) else { return };
    let stands = |v, p, q: DVec3, r| {
        let area = area_vector([p, q, r]);
        area.dot(foot.normal) > 0.0 && area.dot(surface.normal(v)) > 0.0
    };
    let fits = [h, mesh.twin(h)].into_iter().all(|side| {
        let ids @ [a, b, c] = [mesh.origin(side), mesh.target(side), mesh.apex(side)];
        let [p, q, r] = ids.map(|v| mesh.position(v));
        stands(a, p, foot.point, r)
            && stands(c, p, foot.point, r)
            && stands(b, foot.point, q, r)
            && stands(c, foot.point, q, r)
    });
    if fits {
        surface.split(h, foot);
    }
}
