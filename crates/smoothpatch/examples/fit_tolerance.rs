//! Fits a named shape to an accuracy: `cargo run --release --example fit_tolerance -- torus 1e-6`
#![allow(clippy::print_stdout, reason = "an example")]

use smoothpatch::implicit::NamedShape;
use smoothpatch::measure::deviation;
use smoothpatch::{Distance, FieldSource, Settings, Silent, Tolerance, fit_to_tolerance};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "torus".into());
    let distance = arguments.next().map_or(Ok(1e-6), |text| text.parse())?;
    let shape = NamedShape::find(&name).ok_or("no such shape")?;
    let field = shape.field();
    let settings = Settings::with_faces(0);
    let tolerance = Tolerance { distance: Distance::Relative(distance), normal_deg: None };

    let surface = fit_to_tolerance(&*field, &shape.region, &tolerance, &settings, &mut Silent)?;

    let diagonal = surface.mesh.diagonal();
    let source = FieldSource::new(&*field, diagonal, settings.projection);
    let (measured, _) = deviation(&surface.patches.nets, &source, diagonal);
    println!(
        "{name} {distance:.0e}: {} faces, max {:.2e}, rms {:.2e}, normal {:.4}°, {} folds, \
         residual {:.1e}, {:.2} s, {:?}",
        surface.mesh.topology().face_count(),
        measured.max,
        measured.rms,
        measured.max_normal_deg,
        measured.folded.len(),
        surface.max_row_residual(),
        surface.times.total(),
        surface.origin.adaptation,
    );
    Ok(())
}
