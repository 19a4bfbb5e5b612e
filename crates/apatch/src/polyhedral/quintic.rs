//! The C2 quintic: of all functions with the data and second-order smoothness the fairest one whose
//! zero set is a single sheet.
//!
//! The order of the paper (Appendix D: second derivatives and the weights next to them first) cannot
//! work: its vertex systems are singular. All weights are found together. \[ours\]

use super::dofs::Dofs;
use super::hull::Hull;
use super::program::Program;
use super::report::{FairnessReport, Report};
use super::settings::FairnessSettings;
use super::signs::{ray_cuts, sign_conditions};
use super::surface::PolyhedralSurface;

/// Steps of the grid of rays that are tried.
const RAYS: usize = 16;

/// The weights of all cells, 56 each.
///
/// First the fairest function whatever its signs, which takes one sparse factorisation; if all its
/// rays meet the surface once it is the answer. Otherwise conditions on the signs of the weights are
/// added, and then conditions for rays that still go wrong.
pub(crate) fn quintic(
    hull: &Hull,
    report: &Report,
    settings: &FairnessSettings,
) -> (Vec<f64>, FairnessReport) {
    // in units of about the size: solvers have absolute tolerances
    let unit = hull.size().log2().floor().exp2();
    let hull = hull.clone().scaled(1.0 / unit);
    let dofs = Dofs::new(&hull);
    let mut done = FairnessReport {
        unknowns: dofs.unknowns,
        conditions: 0,
        programs: 0,
        cuts: 0,
        accurate: true,
        residual: f64::INFINITY,
    };
    let weights = dofs.weights(&vec![0.0; dofs.unknowns]);
    let mut surface = PolyhedralSurface { weights, hull, degree: 5, report: report.clone() };
    if let Some(mut program) = Program::new(&surface.hull, &dofs) {
        surface.weights = dofs.weights(&program.unknowns());
        if surface.count_bad_rays(RAYS)[0] > 0 {
            add_signs(&mut program, &dofs, &mut surface, settings, &mut done);
        }
        program.polish();
        surface.weights = dofs.weights(&program.unknowns());
        (done.conditions, done.residual) = program.smoothness();
    }
    (surface.weights.iter().map(|w| w * unit).collect(), done)
}

fn add_signs(
    program: &mut Program,
    dofs: &Dofs,
    surface: &mut PolyhedralSurface,
    settings: &FairnessSettings,
    done: &mut FairnessReport,
) {
    program.add(sign_conditions(&surface.hull, dofs, settings.margin));
    for round in 0..=settings.rounds {
        done.accurate = program.satisfy();
        done.programs += 1;
        surface.weights = dofs.weights(&program.unknowns());
        let cuts = ray_cuts(surface, dofs, RAYS, settings.margin);
        if cuts.is_empty() || round == settings.rounds {
            break;
        }
        done.cuts += cuts.len();
        program.add(cuts);
    }
}
