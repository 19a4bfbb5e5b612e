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
    }
}
