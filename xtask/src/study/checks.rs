//! What the study must show.

use super::Convergence;
use super::cost::Cost;
use super::levels::{Errors, Level, Variant};
use super::tolerance::{Fit, Scene};
use crate::check::Check;

const POSITION: fn(&Errors) -> Option<f64> = |errors| Some(errors.max);
const NORMAL: fn(&Errors) -> Option<f64> = |errors| errors.normal_deg;

/// Orders between the two finest levels of a family.
pub(super) fn orders(family: &Convergence) -> Vec<Check> {
    let published = [
        (Variant::Curves, "position", POSITION, 5.5),
        (Variant::PublishedG0, "position", POSITION, 5.5),
        (Variant::Published, "position", POSITION, 3.5),
    ];
    let refined = [
        (Variant::Unrefined, "position", POSITION, 5.3),
        (Variant::Unrefined, "normal", NORMAL, 4.4),
    ];
    let wanted: Vec<_> = match family.family {
        "sphere" => published.into(),
        "torus" => published.into_iter().chain(refined).collect(),
        "quartic" | "fourth powers" => refined.into(),
        _ => Vec::new(),
    };
    let check = |(variant, quantity, figure, bound)| {
        let value = last_order(&family.levels, variant, figure).unwrap_or(f64::NAN);
        let what = format!("{}: order of {} {quantity}", family.family, name(variant));
        Check::at_least(what, value, bound)
    };
    wanted.into_iter().map(check).collect()
}

fn last_order(
    levels: &[Level],
    variant: Variant,
    figure: fn(&Errors) -> Option<f64>,
) -> Option<f64> {
    let [.., coarse, fine] = levels else { return None };
    let of = |level: &Level| level.errors.get(&variant).and_then(figure);
    Some(order(of(coarse)?, of(fine)?))
}

/// The order that halving the edges shows.
pub(super) fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

/// Exactness and folds on all levels, and the refined method against the published one.
pub(super) fn invariants(families: &[Convergence]) -> Vec<Check> {
    let levels = || families.iter().flat_map(|family| &family.levels);
    let folds = |variant| -> usize {
        levels().filter_map(|level| level.errors.get(&variant)).map(|errors| errors.folds).sum()
    };
    let worst_ratio = levels()
        .filter_map(|level| {
            let refined = level.errors.get(&Variant::Refined)?;
            Some(refined.max / level.errors.get(&Variant::Published)?.max)
        })
        .fold(0.0, f64::max);
    let largest = |figure: fn(&Level) -> f64| levels().map(figure).fold(0.0, f64::max);
    vec![
        Check::at_most("G1 angle °, all surfaces", largest(|l| l.g1_angle_deg), 1e-9),
        Check::at_most("row residual, all surfaces", largest(|l| l.row_residual), 1e-12),
        Check::at_most("folds, refined", folds(Variant::Refined) as f64, 0.0),
        Check::at_most("max deviation, refined over published", worst_ratio, 1.0),
    ]
}

/// Accuracies that were asked for: met everywhere, and not with many more faces than needed.
pub(super) fn tolerances(scenes: &[Scene]) -> Vec<Check> {
    let missed = |scene: &Scene| scene.fits.iter().filter(|fit| !fit.holds()).count();
    let excess = |scene: &Scene| scene.fits.iter().map(Fit::excess).fold(0.0, f64::max);
    let of_scene = |scene: &Scene| {
        let what = |text: &str| format!("{}: {text}", scene.shape);
        [
            Check::at_most(what("tolerances missed"), missed(scene) as f64, 0.0),
            Check::at_most(what("faces over those of a sweep"), excess(scene), 1.5),
        ]
    };
    scenes.iter().flat_map(of_scene).collect()
}

/// Cost per face of each method: the largest over the smallest.
pub(super) fn costs(costs: &[Cost]) -> Vec<Check> {
    let methods = [smoothpatch::Method::Published, smoothpatch::Method::Refined];
    let check = |method| {
        let of_method = costs.iter().filter(|cost| cost.method == method);
        let per_face: Vec<f64> = of_method.map(|cost| cost.microseconds_per_face).collect();
        let largest = per_face.iter().copied().fold(0.0, f64::max);
        let smallest = per_face.iter().copied().fold(f64::INFINITY, f64::min);
        let what = format!("cost per face, largest over smallest, {method:?}").to_lowercase();
        Check::at_most(what, largest / smallest, 1.2)
    };
    methods.map(check).into()
}

/// In tables and messages.
pub(crate) fn name(variant: Variant) -> &'static str {
    match variant {
        Variant::Curves => "published curves",
        Variant::PublishedG0 => "published G0",
        Variant::Published => "published G1",
        Variant::Unrefined => "refined G1, published curves",
        Variant::RefinedCurves => "refined curves",
        Variant::Refined => "refined G1",
        Variant::Interpolant4 => "C0 interpolant, degree 4",
        Variant::Interpolant7 => "C0 interpolant, degree 7",
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn level(max: f64, folds: usize) -> Level {
        let errors = Errors { max, rms: None, normal_deg: Some(16.0 * max), folds, retreats: 0 };
        let all = [Variant::Unrefined, Variant::Refined, Variant::Published];
        Level {
            faces: 80,
            errors: BTreeMap::from(all.map(|variant| (variant, errors.clone()))),
            g1_angle_deg: 1e-11,
            row_residual: 1e-15,
        }
    }

    fn family(levels: Vec<Level>) -> Convergence {
        Convergence { family: "quartic", formula: String::new(), levels }
    }

    #[test]
    fn orders_are_those_of_the_last_two_levels() {
        let checks = orders(&family(vec![level(1.0, 0), level(1.0, 0), level(1.0 / 32.0, 0)]));
        let orders: Vec<f64> = checks.iter().map(|check| check.value).collect();
        assert_eq!(orders, [5.0, 5.0]);
        // position fails, normals hold
        assert_eq!(checks.iter().map(|check| check.holds).collect::<Vec<_>>(), [false, true]);
    }

    #[test]
    fn missing_levels_fail() {
        assert!(orders(&family(vec![level(1.0, 0)])).iter().all(|check| !check.holds));
    }

    #[test]
    fn folds_fail() {
        let checks = invariants(&[family(vec![level(1.0, 1)])]);
        assert_eq!(checks.iter().filter(|check| !check.holds).count(), 1);
    }
}
