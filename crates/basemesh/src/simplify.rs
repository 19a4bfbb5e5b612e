//! From a dense mesh to a base mesh with a given number of faces.

mod exchange;
mod guarded;
mod merge;
mod minimum;
mod plain;
mod quadric;
mod relax;
mod report;
mod settings;

use glam::DVec3;

pub(crate) use guarded::check_collapse;
pub use report::{Refusals, Relaxation, SimplifyError, SimplifyReport};
pub use settings::SimplifySettings;

use crate::ids::VertexId;
use crate::improve::guard::Guard;
use crate::improve::improve_surface;
use crate::improve::surface_mesh::SurfaceMesh;
use crate::maps::VertexMap;
use crate::mesh::TriMesh;
use crate::quality::{MeshQuality, angle_between, invalid_fans};
use crate::target::SurfaceTarget;

/// A base mesh made from a denser one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Simplified {
    /// The base mesh, its vertices on the surface.
    pub mesh: TriMesh,
    /// Unit surface normals at its vertices.
    pub normals: VertexMap<DVec3>,
    /// What was done.
    pub report: SimplifyReport,
}

/// Reduces a dense closed mesh near a smooth surface to `settings.faces` faces.
///
/// 1. The vertices are smoothed along the surface, which removes the slivers of a marched mesh.
/// 2. Down to `plain_factor` times the number of faces, edges are collapsed by their mean quadric
///    error alone.
/// 3. From there every collapse is projected onto the surface and tested: no sliver, no face that
///    leans away from the surface, no edge along which the normal turns by more than
///    `max_turning_deg`, no valence below `min_valence`, unless that was worse before. If the guards
///    refuse everything, the mesh is improved as in step 4 and the guards give way one after the
///    other, in the order of [`Relaxation`].
/// 4. Flips and smoothing under the same guards, see [`improve`](crate::improve).
/// 5. Edges that turn too far, from end to end or to their middle, are split, and as many collapsed
///    where that costs least.
///
/// The topology is never changed: every component survives with its genus. A mesh that has no more
/// faces than asked for goes through steps 4 and 5 only. Step 1 is left out where the mesh is not
/// dense: with fewer than twice the faces asked for, or where the normal turns along its edges by
/// more than a quarter of `max_turning_deg` on average. Results do not depend on the number of threads,
/// and scaling mesh and surface by a power of two scales the result bit for bit.
///
/// See `docs/math/base-mesh.md`; quadrics as by Garland and Heckbert (1997).
///
/// # Errors
///
/// [`SimplifyError`] if the mesh has a boundary or if no mesh of this topology has that many faces.
pub fn simplify(
    mesh: TriMesh,
    target: &dyn SurfaceTarget,
    settings: &SimplifySettings,
) -> Result<Simplified, SimplifyError> {
    check_faces(&mesh, settings.faces)?;
    let mut report = SimplifyReport {
        faces_before: mesh.topology().face_count(),
        euler_before: mesh.topology().euler_characteristic(),
        ..SimplifyReport::default()
    };
    let mut surface = on_surface(mesh, target)?;
    decimate(&mut surface, settings, &mut report);
    let improved = improve_surface(&mut surface, &settings.improve_settings());
    report.flips += improved.flips;
    report.moves += improved.moves;
    exchange::exchange(&mut surface, settings, &mut report);
    Ok(finish(surface, settings, report))
}

fn check_faces(mesh: &TriMesh, faces: usize) -> Result<(), SimplifyError> {
    let (components, needed) = minimum::fewest_faces(mesh);
    if faces < needed {
        let euler = mesh.topology().euler_characteristic();
        return Err(SimplifyError::TooFewFaces { faces, needed, components, euler });
    }
    if faces % 2 == 1 {
        return Err(SimplifyError::OddFaces { faces, below: faces - 1, above: faces + 1 });
    }
    Ok(())
}

/// The mesh with all vertices on the surface; frees the input.
fn on_surface(mesh: TriMesh, target: &dyn SurfaceTarget) -> Result<SurfaceMesh<'_>, SimplifyError> {
    SurfaceMesh::new(&mesh, target).map_err(|edge| {
        let [a, b] = mesh.topology().edge_vertices(edge).map(VertexId::index);
        SimplifyError::Open { a, b }
    })
}

/// Steps 1 to 3.
fn decimate(
    surface: &mut SurfaceMesh<'_>,
    settings: &SimplifySettings,
    report: &mut SimplifyReport,
) {
    if surface.mesh.face_count() <= settings.faces {
        return;
    }
    if surface.mesh.face_count() >= 2 * settings.faces && is_dense(surface, settings) {
        relax::relax(surface, settings.relaxation_iterations);
    }
    let mut quadrics = merge::vertex_quadrics(&surface.mesh, settings.isotropy);
    let plain = settings.faces.saturating_mul(settings.plain_factor.max(1));
    if surface.mesh.face_count() > plain {
        plain::collapse_plain(&mut surface.mesh, &mut quadrics, plain, settings.flip_cos);
        let before = surface.mesh.positions().to_vec();
        surface.project_all();
        for (v, quadric) in quadrics.iter_mut().enumerate() {
            *quadric = quadric.moved_by(surface.mesh.position(VertexId::new(v)) - before[v]);
        }
    }
    for relaxation in RELAXATIONS {
        let guard = relaxed(&settings.improve_settings().guard(), relaxation);
        report.relaxation = relaxation;
        loop {
            let before = surface.mesh.face_count();
            guarded::collapse_guarded(
                surface,
                &mut quadrics,
                settings.faces,
                &guard,
                &mut report.refusals,
            );
            surface.compact();
            if surface.mesh.face_count() <= settings.faces {
                return;
            }
            let removed = before - surface.mesh.face_count();
            if removed * WORTHWHILE < before - settings.faces {
                break;
            }
            let improved = improve_surface(surface, &settings.improve_settings());
            report.flips += improved.flips;
            report.moves += improved.moves;
            quadrics = merge::vertex_quadrics(&surface.mesh, settings.isotropy);
        }
    }
    report.stalled = true;
}

/// Whether smoothing without guards is harmless: on a coarse mesh, of a thin tube for instance,
/// vertices would slip around the bend, and edges turn too far that did not before.
fn is_dense(surface: &SurfaceMesh<'_>, settings: &SimplifySettings) -> bool {
    let mesh = &surface.mesh;
    let turning = |h| angle_between(surface.normal(mesh.origin(h)), surface.normal(mesh.target(h)));
    let (sum, count) =
        mesh.edges().map(turning).fold((0.0, 0), |(sum, count), angle| (sum + angle, count + 1));
    sum <= f64::from(count) * DENSE * settings.max_turning_deg.to_radians()
}

/// Mean turning along the edges of a dense mesh, in parts of the largest allowed.
const DENSE: f64 = 0.25;

/// Improving the mesh and trying the same guards again is worth while if the last attempt removed
/// one in so many of the faces too many.
const WORTHWHILE: usize = 8;

const RELAXATIONS: [Relaxation; 5] = [
    Relaxation::None,
    Relaxation::Valence,
    Relaxation::Quality,
    Relaxation::Turning,
    Relaxation::Everything,
];

/// Cosine of the lean of faces once quality gives way: what remains keeps edges in order around
/// their vertices.
const RELAXED_LEAN_COS: f64 = 0.1;

/// The guard that is left at a level of relaxation.
fn relaxed(guard: &Guard, relaxation: Relaxation) -> Guard {
    let mut result = *guard;
    if relaxation >= Relaxation::Valence {
        result.min_valence = 3;
    }
    if relaxation >= Relaxation::Quality {
        result.min_quality = 0.4 * guard.min_quality;
        result.quality_keep = 0.5 * guard.quality_keep;
        result.lean_cos = guard.lean_cos.min(RELAXED_LEAN_COS);
    }
    if relaxation >= Relaxation::Turning {
        result.turning_cos = (1.5 * guard.turning_cos.acos()).min(std::f64::consts::PI).cos();
    }
    if relaxation >= Relaxation::Everything {
        result = Guard { turning_cos: -1.0, min_quality: 0.0, ..result };
    }
    result
}

fn finish(
    surface: SurfaceMesh<'_>,
    settings: &SimplifySettings,
    mut report: SimplifyReport,
) -> Simplified {
    let (mesh, normals, off_surface) = surface.finish();
    let quality = MeshQuality::measure(&mesh, &normals);
    report.faces = mesh.topology().face_count();
    report.stalled = report.faces > settings.faces;
    report.euler = mesh.topology().euler_characteristic();
    report.max_turning_deg = quality.max_turning_deg;
    report.min_angle_deg = quality.min_angle_deg;
    report.invalid_fans = invalid_fans(&mesh, &normals);
    report.off_surface = off_surface;
    Simplified { mesh, normals, report }
}
