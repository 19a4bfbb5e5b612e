//! Vertices moved from where the surface is flat to where it turns too far along an edge.

use glam::DVec3;

use super::guarded::collapse_guarded;
use super::merge::vertex_quadrics;
use super::report::SimplifyReport;
use super::settings::SimplifySettings;
use crate::ids::HalfedgeId;
use crate::improve::guard::area_vector;
use crate::improve::improve_surface;
use crate::improve::surface_mesh::SurfaceMesh;

/// Share by which an edge must exceed the limit to be split: many edges are exactly at the limit that
/// the guards set, up to rounding.
const EXCESS: f64 = 1e-9;

/// Splits the edges along which the surface turns farther than `max_turning_deg` and collapses as
/// many elsewhere, up to `exchange_rounds` times or until nothing gets better.
///
/// The number of faces stays the same. A round that does not lower the total excess is undone.
pub(super) fn exchange(
    surface: &mut SurfaceMesh<'_>,
    settings: &SimplifySettings,
    report: &mut SimplifyReport,
) {
    let guard = settings.improve_settings().guard();
    let faces = surface.mesh.face_count();
    let mut best = excess(surface, settings);
    for _ in 0..settings.exchange_rounds {
        if best == 0.0 {
            return;
        }
        let mut trial = surface.clone();
        split_turning_edges(&mut trial, settings);
        let mut quadrics = vertex_quadrics(&trial.mesh, settings.isotropy);
        collapse_guarded(&mut trial, &mut quadrics, faces, &guard, &mut report.refusals);
        trial.compact();
        let improved = improve_surface(&mut trial, &settings.improve_settings());
        let left = excess(&trial, settings);
        if trial.mesh.face_count() > faces || left >= best {
            return;
        }
        best = left;
        *surface = trial;
        report.flips += improved.flips;
        report.moves += improved.moves;
        report.exchanges += 1;
    }
}

/// Turning of an edge in radians.
fn turning(surface: &SurfaceMesh<'_>, h: HalfedgeId) -> f64 {
    let [n, m] = [surface.mesh.origin(h), surface.mesh.target(h)].map(|v| surface.normal(v));
    crate::quality::angle_between(n, m)
}

fn limit(settings: &SimplifySettings) -> f64 {
    settings.max_turning_deg.to_radians() * (1.0 + EXCESS)
}

/// Sum over all edges of the squared turning beyond the limit.
fn excess(surface: &SurfaceMesh<'_>, settings: &SimplifySettings) -> f64 {
    let beyond = |h| (turning(surface, h) - limit(settings)).max(0.0);
    surface.mesh.edges().map(|h| beyond(h) * beyond(h)).sum()
}

/// Splits edges beyond the limit, the ones that turn farthest first (ties by half-edge id).
fn split_turning_edges(surface: &mut SurfaceMesh<'_>, settings: &SimplifySettings) {
    let mut edges: Vec<(f64, HalfedgeId)> = surface
        .mesh
        .edges()
        .map(|h| (turning(surface, h), h))
        .filter(|&(turning, _)| turning > limit(settings))
        .collect();
    edges.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
    for (_, h) in edges {
        split(surface, h);
    }
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
