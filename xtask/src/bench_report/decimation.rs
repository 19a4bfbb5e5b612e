//! How well a dense mesh of a surface of high genus is reduced to 5 %.

use std::time::Instant;

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use smoothpatch::basemesh::{
    FieldTarget, PolygonizeSettings, SimplifySettings, SurfaceTarget, TriMesh, cells_for_faces,
    polygonize, simplify,
};
use smoothpatch::bezier_core::Barycentric;
use smoothpatch::implicit::{NamedShape, ProjectionSettings};

/// The decorated cube with a million triangles, to 5 %, on one thread.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Decimation {
    faces_before: usize,
    faces: usize,
    seconds: f64,
    euler: i64,
    min_angle_deg: f64,
    /// Largest distance of the flat triangles from the surface, on a grid, over the diagonal.
    deviation: f64,
}

const FACES: usize = 1_034_000;
/// Of the surface, of genus 13.
const EULER: i64 = -24;
const TARGETS: [f64; 3] = [0.25, 3.4e-4, 10.0];

pub(super) fn measure() -> Result<Decimation> {
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    one_thread.install(|| {
        let shape = NamedShape::find("deccube").context("a shape of the catalogue")?;
        let field = shape.field();
        let cells = cells_for_faces(&*field, &shape.region, FACES)?;
        let dense = polygonize(&*field, &shape.region, &PolygonizeSettings::with_cells(cells))?;
        let faces_before = dense.topology().face_count();
        let diagonal = dense.diagonal();
        let target = FieldTarget::new(&*field, diagonal, ProjectionSettings::default());
        let start = Instant::now();
        let made = simplify(dense, &target, &SimplifySettings::to_faces(2 * (faces_before / 40)))?;
        let seconds = start.elapsed().as_secs_f64();
        Ok(Decimation {
            faces_before,
            faces: made.report.faces,
            seconds,
            euler: made.report.euler,
            min_angle_deg: made.report.min_angle_deg,
            deviation: deviation(&made.mesh, &target)? / diagonal,
        })
    })
}

fn deviation(mesh: &TriMesh, target: &dyn SurfaceTarget) -> Result<f64> {
    let grid: Vec<Barycentric> = Barycentric::lattice(6).collect();
    let mut largest: f64 = 0.0;
    for face in mesh.topology().faces() {
        let [a, b, c] = mesh.triangle(face);
        for at in &grid {
            let point = a * at.u + b * at.v + c * at.w;
            let foot = target.foot(point).context("a point without a foot")?;
            largest = largest.max(foot.point.distance(point));
        }
    }
    Ok(largest)
}

impl Decimation {
    /// One line with the targets.
    pub(super) fn line(&self) -> String {
        let rate = self.faces_before as f64 / self.seconds / 1e6;
        let [least_rate, most_deviation, least_angle] = TARGETS;
        let met = rate >= least_rate
            && self.deviation <= most_deviation
            && self.min_angle_deg >= least_angle
            && self.euler == EULER;
        format!(
            "decimation {} -> {}: {rate:.2} million/s [{least_rate}], deviation {:.1e} \
             [{most_deviation:.1e}], min angle {:.1} [{least_angle}], Euler {} [{EULER}]: {}\n",
            self.faces_before,
            self.faces,
            self.deviation,
            self.min_angle_deg,
            self.euler,
            if met { "met" } else { "missed" }
        )
    }
}
