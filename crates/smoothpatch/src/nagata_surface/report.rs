//! Everything measured about a Nagata surface.

use basemesh::glam::DVec3;
use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, SurfaceTarget, VertexId};
use bezier_core::Barycentric;
use nagata::{Area, EdgeReport, Join, NagataSurface, Patch};
use serde::Serialize;

use crate::measure::{Deviation, FaceDeviation, GRID, PatchSamples, SEAM_SAMPLES, deviation_of};

/// Relative accuracy of the area of each patch.
const AREA_ACCURACY: f64 = 1e-6;

/// The measured qualities of a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NagataReport {
    /// Number of patches with three corners.
    pub triangles: usize,
    /// Number of patches with four corners.
    pub quadrilaterals: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Vertices minus edges plus faces, not counting vertices without faces.
    pub euler_characteristic: i64,
    /// Whether every edge has two faces.
    pub closed: bool,
    /// Diagonal of the bounding box of the vertices. Unit: length.
    pub diagonal: f64,
    /// Area of all patches. Unit: length squared.
    pub area: Area,
    /// Number of corners of faces without a normal.
    pub corners_without_normal: usize,
    /// What the construction says about edges and corners.
    pub construction: nagata::Report,
    /// Largest angle between the normals of two patches at [`SEAM_SAMPLES`] points of the edges that
    /// are no creases, in degrees.
    pub max_kink_deg: f64,
    /// The edge with that angle: its two vertices.
    pub worst_edge: Option<[usize; 2]>,
    /// The same over the edges that have common tangent planes by construction, in radians; missing
    /// if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub g1_residual: Option<f64>,
    /// Edges that should have common tangent planes and have not.
    pub flawed_edges: Vec<EdgeFlaw>,
    /// Patches whose normal somewhere turns by more than 90° from the mean one.
    pub folded: Vec<usize>,
    /// Distance from a reference surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation: Option<Deviation>,
}

/// An edge without the common tangent planes that were asked for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EdgeFlaw {
    /// Its two vertices, the lower first.
    pub vertices: [usize; 2],
    /// Why.
    pub join: Join,
    /// Largest angle between the normals of its patches, in degrees.
    pub kink_deg: f64,
}

/// The figures of each edge and face.
#[derive(Clone, Debug)]
pub struct NagataFigures {
    /// What the construction says about each edge.
    pub edges: EdgeMap<EdgeReport>,
    /// Largest angle between the normals of the patches at each edge, in radians; zero for
    /// boundaries.
    pub kinks: EdgeMap<f64>,
    /// Whether each patch folds over, as in [`NagataReport::folded`].
    pub folded: FaceMap<bool>,
    /// Distance of each patch from the reference surface, if there is one.
    pub deviation: Option<FaceMap<FaceDeviation>>,
}

/// Measures a surface, and how far it is from a reference surface.
///
/// Deviations are measured on grids as those of fitted patches; points where a patch has no normal
/// are left out. Takes the results of each edge and patch from a grid of at least 17 points a side.
#[must_use]
pub fn report(
    surface: &NagataSurface,
    reference: Option<&dyn SurfaceTarget>,
) -> (NagataReport, NagataFigures) {
    let mesh = surface.mesh();
    let edges = EdgeMap::from_fn(mesh.edge_count(), |edge| surface.edge_report(edge));
    let kinks = EdgeMap::from_fn(mesh.edge_count(), |edge| {
        surface.kink(edge, SEAM_SAMPLES - 1).unwrap_or(0.0)
    });
    let folded = FaceMap::from_fn(mesh.face_count(), |face| is_folded(surface, face));
    let compared = reference.map(|target| {
        let sample = |face, divisions| usable_samples(&surface.patch(face), divisions);
        deviation_of(mesh.face_count(), sample, target, mesh.diagonal())
    });
    let (deviation, by_face) = compared.unzip();
    let figures = NagataFigures { edges, kinks, folded, deviation: by_face };
    (summary(surface, &figures, deviation), figures)
}

fn summary(
    surface: &NagataSurface,
    figures: &NagataFigures,
    deviation: Option<Deviation>,
) -> NagataReport {
    let mesh = surface.mesh();
    let quadrilaterals = mesh.faces().filter(|&face| mesh.corners(face).len() == 4).count();
    let sides = mesh.faces().flat_map(|face| mesh.sides(face));
    let without = sides.filter(|side| surface.normals().id(mesh, side.face, side.corner).is_none());
    let smooth = figures.edges.iter().filter(|(_, edge)| is_smooth(edge.join));
    let worst = smooth
        .map(|(edge, _)| (edge, figures.kinks[edge]))
        .reduce(|worst, edge| if edge.1 > worst.1 { edge } else { worst });
    let held = figures.edges.iter().filter(|(_, edge)| edge.join == Join::TangentPlane);
    let folded = figures.folded.iter().filter(|(_, folded)| **folded);
    NagataReport {
        triangles: mesh.face_count() - quadrilaterals,
        quadrilaterals,
        vertices: mesh.vertex_count(),
        euler_characteristic: euler_characteristic(surface),
        closed: mesh.is_closed(),
        diagonal: mesh.diagonal(),
        area: surface.area(AREA_ACCURACY),
        corners_without_normal: without.count(),
        construction: surface.report(),
        max_kink_deg: worst.map_or(0.0, |(_, kink)| kink.to_degrees()),
        worst_edge: worst.map(|(edge, _)| vertices(surface, edge)),
        g1_residual: held.map(|(edge, _)| figures.kinks[edge]).reduce(f64::max),
        flawed_edges: flaws(surface, figures),
        folded: folded.map(|(face, _)| face.index()).collect(),
        deviation,
    }
}

/// Whether the faces at an edge are parts of one smooth piece.
fn is_smooth(join: Join) -> bool {
    !matches!(join, Join::Boundary | Join::Branching | Join::Crease | Join::Flipped)
}

fn flaws(surface: &NagataSurface, figures: &NagataFigures) -> Vec<EdgeFlaw> {
    let flawed = figures.edges.iter().filter(|(_, edge)| edge.join.is_failure());
    let flaw = |(edge, report): (EdgeId, &EdgeReport)| EdgeFlaw {
        vertices: vertices(surface, edge),
        join: report.join,
        kink_deg: figures.kinks[edge].to_degrees(),
    };
    flawed.map(flaw).collect()
}

fn vertices(surface: &NagataSurface, edge: EdgeId) -> [usize; 2] {
    surface.mesh().edge_vertices(edge).map(VertexId::index)
}

fn euler_characteristic(surface: &NagataSurface) -> i64 {
    let mesh = surface.mesh();
    let mut used = vec![false; mesh.vertex_count()];
    mesh.faces().flat_map(|face| mesh.corners(face)).for_each(|v| used[v.index()] = true);
    let unused = used.iter().filter(|used| !**used).count();
    mesh.euler_characteristic() - i64::try_from(unused).expect("invariant: counts fit 32 bits")
}

fn is_folded(surface: &NagataSurface, face: FaceId) -> bool {
    let (_, normals) = usable_samples(&surface.patch(face), GRID);
    let mean: DVec3 = normals.iter().sum();
    !normals.iter().all(|normal| normal.dot(mean) > 0.0)
}

/// Positions and area normals at a regular grid, without the points that have no normal.
fn usable_samples(patch: &Patch, divisions: usize) -> PatchSamples {
    let samples: Vec<(DVec3, DVec3)> = match patch {
        Patch::Triangle(patch) => {
            let at = Barycentric::lattice(divisions);
            at.map(|at| (patch.point(at), weighted(patch.normal(at), patch.area_normal(at))))
                .collect()
        }
        Patch::TangentPlane(patch) => {
            let at = Barycentric::lattice(divisions);
            at.map(|at| (patch.point(at), weighted(patch.normal(at), patch.area_normal(at))))
                .collect()
        }
        Patch::Quad(patch) => {
            let rows = (0..=divisions).flat_map(|j| (0..=divisions).map(move |i| [i, j]));
            let at = rows.map(|steps| steps.map(|step| step as f64 / divisions as f64));
            at.map(|at| (patch.point(at), weighted(patch.normal(at), patch.area_normal(at))))
                .collect()
        }
    };
    samples.into_iter().filter(|(_, normal)| *normal != DVec3::ZERO).collect()
}

/// The normal with the length of the area normal, whose direction is round-off where a patch is singular.
fn weighted(normal: Option<DVec3>, area_normal: DVec3) -> DVec3 {
    normal.map_or(DVec3::ZERO, |normal| normal * area_normal.length())
}
