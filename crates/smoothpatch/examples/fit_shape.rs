//! Fits a named shape and prints how good the result is:
//! `cargo run --release --example fit_shape -- double-torus 1800 published`
#![allow(clippy::print_stdout, reason = "an example")]

use smoothpatch::implicit::NamedShape;
use smoothpatch::measure::{continuity, deviation, interpolation};
use smoothpatch::{FieldSource, Method, Settings, Silent, fit};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "torus".into());
    let faces = arguments.next().map_or(Ok(600), |text| text.parse())?;
    let shape = NamedShape::find(&name).ok_or("no such shape")?;
    let field = shape.field();
    let method = match arguments.next().as_deref() {
        None | Some("refined") => Method::Refined,
        Some("published") => Method::Published,
        Some(other) => return Err(format!("no such method: {other}").into()),
    };
    let settings = Settings::with_faces(faces).with_method(method);

    let surface = fit(&*field, &shape.region, &settings, &mut Silent)?;

    let nets = &surface.patches.nets;
    let joined = continuity(surface.mesh.topology(), nets);
    let diagonal = surface.mesh.diagonal();
    let source = FieldSource::new(&*field, diagonal, settings.projection);
    let (measured, _) = deviation(nets, &source, diagonal);
    println!("{joined:#?}\n{measured:#?}\n{:#?}", interpolation(&surface));
    println!("row residual {:e}", surface.max_row_residual());
    println!("{:?}\n{:#?}", surface.curve_summary(), surface.origin);
    for (stage, seconds) in surface.times.iter() {
        println!("{stage:>12} {seconds:.3} s");
    }
    Ok(())
}
