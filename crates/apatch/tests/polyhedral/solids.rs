//! The fifteen solids in both schemes.

use apatch::polyhedral::{PolyhedralSurface, Scheme};

use super::common::{jumps, settings, solids};

#[test]
fn c1() {
    for (name, solid) in solids() {
        let surface = PolyhedralSurface::new(&solid, &settings(Scheme::C1Cubic)).unwrap();
        let report = surface.report();
        println!("{name} hulls {} findings {} {:?} bad {:?} {:?}", report.hulls, report.findings.len(), report.findings.iter().take(3).collect::<Vec<_>>(), report.bad_rays, report.margins);
        println!("   {:?}", jumps(&surface));
        for n in [6, 12] {
            let m = surface.tessellate(n, n);
            println!("   n {n} missing {} flipped {} volume {}", m.missing, m.flipped_facets(), m.signed_volume());
        }
    }
}

#[test]
fn c2() {
    for (name, solid) in solids() {
        let start = std::time::Instant::now();
        let surface = PolyhedralSurface::new(&solid, &settings(Scheme::C2Quintic)).unwrap();
        let time = start.elapsed().as_secs_f64() * 1e3 / solid.facets().len() as f64;
        let report = surface.report();
        println!("{name} {time:.0} ms/face {:?} bad {:?}", report.fairness, report.bad_rays);
        println!("   {:?}", jumps(&surface));
        for n in [6, 12] {
            let m = surface.tessellate(n, n);
            println!("   n {n} missing {} flipped {} volume {}", m.missing, m.flipped_facets(), m.signed_volume());
        }
    }
}
