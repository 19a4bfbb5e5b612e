//! What must hold: the bounds of a scene, and what every surface of ours promises.

use smoothpatch::io::Bounds;

use super::measures::Measures;

/// Largest normal angle between neighbours where a scene states no bound.
const G1_ANGLE_DEG: f64 = 1e-9;
/// Largest defect of position, normal and second fundamental form at the vertices.
const VERTEX_DEFECT: f64 = 1e-10;

/// A sentence for everything that does not hold.
pub(super) fn broken(m: &Measures, bounds: Bounds) -> Vec<String> {
    let mut broken = Vec::new();
    let mut check = |holds: bool, message: String| {
        if !holds {
            broken.push(message);
        }
    };
    check(m.closed, "the surface is not closed".into());
    check(m.position_gap == 0.0, format!("boundary points differ by {:.1e}", m.position_gap));
    check(m.failed_samples == 0, format!("{} samples without foot", m.failed_samples));
    let g1_angle = bounds.g1_angle_deg.unwrap_or(G1_ANGLE_DEG);
    let upper = [
        ("G1 angle", m.g1_angle_deg, Some(g1_angle)),
        ("row residual", m.row_residual, bounds.row_residual),
        ("max deviation", m.max_deviation, bounds.max_deviation),
        ("RMS deviation", m.rms_deviation, bounds.rms_deviation),
        ("normal error", m.max_normal_error_deg, bounds.max_normal_error_deg),
        ("vertex position defect", m.vertex_position, Some(VERTEX_DEFECT)),
        ("vertex normal defect", m.vertex_normal, Some(VERTEX_DEFECT)),
        ("vertex second form defect", m.vertex_second_form, Some(VERTEX_DEFECT)),
    ];
    for (what, value, bound) in upper {
        if let Some(bound) = bound {
            // not a number fails too
            check(value <= bound, format!("{what} {value:.3e} exceeds {bound:e}"));
        }
    }
    let counts = [
        ("folds", m.folds, bounds.folds.or(Some(0))),
        ("fallbacks", m.fallbacks, bounds.fallbacks),
    ];
    for (what, count, bound) in counts {
        if let Some(bound) = bound {
            check(count <= bound, format!("{count} {what}, at most {bound} allowed"));
        }
    }
    if let Some(euler) = bounds.euler {
        check(m.euler == euler, format!("Euler characteristic {} instead of {euler}", m.euler));
    }
    if let Some((low, high)) = bounds.sqp_iterations {
        let steps = m.sqp_iterations;
        check(
            (low..=high).contains(&steps),
            format!("{steps:.3} SQP iterations, not within {low} to {high}"),
        );
    }
    broken
}

/// Where the refined surface is further from the target than the published one.
pub(super) fn worse_than_published(refined: &Measures, published: &Measures) -> Vec<String> {
    let pairs = [
        ("max deviation", refined.max_deviation, published.max_deviation),
        ("RMS deviation", refined.rms_deviation, published.rms_deviation),
        ("normal error", refined.max_normal_error_deg, published.max_normal_error_deg),
    ];
    pairs
        .into_iter()
        .filter(|(_, refined, published)| refined > published)
        .map(|(what, refined, published)| {
            format!("{what} {refined:.3e} is worse than {published:.3e} of the published method")
        })
        .collect()
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::BTreeMap;

    use super::*;

    /// A surface without defects.
    pub(in super::super) fn perfect() -> Measures {
        Measures {
            faces: 200,
            euler: 2,
            components: 1,
            closed: true,
            position_gap: 0.0,
            g1_angle_deg: 1e-12,
            row_residual: 1e-15,
            max_deviation: 1e-6,
            rms_deviation: 1e-7,
            max_normal_error_deg: 0.01,
            failed_samples: 0,
            folds: 0,
            fallbacks: 0,
            retreats: 0,
            sqp_iterations: 2.3,
            vertex_position: 0.0,
            vertex_normal: 1e-15,
            vertex_second_form: 1e-14,
            seconds: 0.1,
            seconds_by_stage: BTreeMap::new(),
        }
    }

    #[test]
    fn bounds_are_met_with_equality() {
        let bounds = Bounds {
            euler: Some(2),
            max_deviation: Some(1e-6),
            fallbacks: Some(0),
            sqp_iterations: Some((2.3, 2.3)),
            ..Bounds::default()
        };
        assert_eq!(broken(&perfect(), bounds), Vec::<String>::new());
    }

    #[test]
    fn every_bound_can_break() {
        let bounds = Bounds {
            euler: Some(0),
            max_deviation: Some(1e-7),
            rms_deviation: Some(1e-8),
            max_normal_error_deg: Some(0.001),
            g1_angle_deg: Some(1e-13),
            row_residual: Some(1e-16),
            sqp_iterations: Some((2.4, 2.7)),
            ..Bounds::default()
        };
        assert_eq!(broken(&perfect(), bounds).len(), 7);
    }

    #[test]
    fn promises_hold_without_bounds() {
        let bad = Measures {
            closed: false,
            position_gap: 1e-300,
            g1_angle_deg: f64::NAN,
            failed_samples: 1,
            folds: 1,
            vertex_position: 1e-9,
            vertex_normal: 1e-9,
            vertex_second_form: 1e-9,
            ..perfect()
        };
        assert_eq!(broken(&bad, Bounds::default()).len(), 8);
    }

    #[test]
    fn refinement_may_not_harm() {
        let worse = Measures { rms_deviation: 2e-7, ..perfect() };
        assert_eq!(worse_than_published(&worse, &perfect()).len(), 1);
        assert!(worse_than_published(&perfect(), &worse).is_empty());
    }
}
