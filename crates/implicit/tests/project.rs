//! Projection: what the stopping rule promises, order of convergence, failures.

use implicit::glam::DVec3;
use implicit::{
    Aabb, Formula, ImplicitField, ImplicitSurface, ProjectionError, ProjectionSettings, Sphere,
    Torus, catalogue, project, project_many, project_with_gradient,
};
use testkit::conformance::field::sample_points;

fn tolerance(tolerance: f64) -> ProjectionSettings {
    ProjectionSettings { tolerance, ..Default::default() }
}

/// Points of the region that are near the surface, as seen from the field's first order.
fn near_surface(field: &dyn ImplicitSurface, region: &Aabb, nearer: f64) -> Vec<DVec3> {
    sample_points(region, 4000)
        .into_iter()
        .filter(|&p| {
            let (value, gradient) = field.value_gradient(p);
            value.abs() <= nearer * gradient.length()
        })
        .collect()
}

#[test]
fn the_sphere_is_hit_at_the_closest_point() {
    let sphere = Sphere { center: DVec3::new(1.0, -2.0, 0.5), radius: 3.0 };
    for p in sample_points(&Aabb::from_half_size(9.0), 200) {
        let (foot, normal) = project_with_gradient(&sphere, p, 3.0, &tolerance(1e-13)).unwrap();
        let outward = (p - sphere.center).normalize();
        let expected = sphere.center + sphere.radius * outward;
        assert!((foot - expected).length() <= 1e-12 * sphere.radius, "{p} goes to {foot}");
        assert!((normal - outward).length() <= 1e-12, "{p} has the normal {normal}");
    }
}

#[test]
fn the_tolerance_is_relative_to_the_length() {
    let torus = Torus::default();
    for exponent in 1..=13 {
        for length in [1e-4, 1.0, 1e2] {
            let settings = tolerance(0.1_f64.powi(exponent));
            for p in near_surface(&torus, &Aabb::from_half_size(7.0), 0.5) {
                let foot = project(&torus, p, length, &settings).unwrap();
                let from_circle = (foot.x.hypot(foot.y) - 5.0).hypot(foot.z);
                // the estimate is of first order: a relative error as large as itself is left out
                let allowed = 1.5 * settings.tolerance * length + 8.0 * f64::EPSILON * 5.0;
                let deviation = (from_circle - 1.0).abs();
                assert!(deviation <= allowed, "{deviation} at {foot}, allowed {allowed}");
            }
        }
    }
}

#[test]
fn convergence_is_quadratic() {
    for shape in catalogue().iter().filter(|shape| shape.name != "plane") {
        let field = shape.field();
        let scale = shape.region.diagonal();
        let start = near_surface(&field, &shape.region, 1e-3 * scale);
        let estimate = |p: DVec3| {
            let (value, gradient) = field.value_gradient(p);
            value.abs() / gradient.length()
        };
        let one_step = ProjectionSettings { max_iterations: 1, tolerance: 1e-14 };
        for p in start {
            let after = match project(&field, p, scale, &one_step) {
                Ok(foot) => estimate(foot),
                Err(ProjectionError::NotConverged { distance, .. }) => distance,
                Err(error) => panic!("{}: {error}", shape.name),
            };
            // the largest curvature times the diagonal is 245, on the chair
            let allowed = 1000.0 * (estimate(p) / scale).powi(2) * scale + 1e-14 * scale;
            assert!(after <= allowed, "{}: from {} to {after}", shape.name, estimate(p));
        }
    }
}

#[test]
fn all_shapes_converge_also_for_tiny_lengths() {
    for shape in catalogue() {
        let field = shape.field();
        let formula = Formula::parse(shape.formula).unwrap();
        for p in near_surface(&field, &shape.region, 2e-3 * shape.region.diagonal()) {
            for field in [&field as &dyn ImplicitField, &formula] {
                // far below the round-off of the coordinates
                for length in [1.0, 1e-2, 1e-4] {
                    if let Err(error) = project(field, p, length, &tolerance(1e-13)) {
                        panic!("{} from {p}, length {length}: {error}", shape.name);
                    }
                }
            }
        }
    }
}

#[test]
fn batches_equal_single_projections() {
    for shape in catalogue() {
        let formula = Formula::parse(shape.formula).unwrap();
        let fields: [&dyn ImplicitField; 2] = [&shape.field(), &formula];
        for field in fields {
            // far away as well, so that some points fail
            let start = sample_points(&shape.region, 100);
            let settings = ProjectionSettings { max_iterations: 8, ..Default::default() };
            let mut feet = start.clone();
            let normals = project_many(field, &mut feet, 0.1, &settings);
            for ((&p, &foot), normal) in start.iter().zip(&feet).zip(normals) {
                match project_with_gradient(field, p, 0.1, &settings) {
                    Ok(expected) => assert_eq!((foot, normal.unwrap()), expected),
                    Err(error) => {
                        // compared as text: a point of the iteration may be NaN
                        let given = normal.unwrap_err().to_string();
                        assert_eq!((foot, given), (p, error.to_string()));
                    }
                }
            }
        }
    }
    let sphere = Sphere::default();
    assert!(project_many(&sphere, &mut [], 1.0, &tolerance(1e-13)).is_empty(), "no points");
}

#[test]
fn points_on_the_surface_stay() {
    let foot = project(&Sphere::default(), DVec3::X, 1.0, &tolerance(1e-13)).unwrap();
    assert_eq!(foot, DVec3::X);
}

#[test]
fn singular_points_are_errors() {
    let cone = Formula::parse("x^2 + y^2 - z^2").unwrap();
    let pole = Formula::parse("1/x").unwrap();
    let root = Formula::parse("sqrt(x) - 1").unwrap();
    let axis = Torus::default();
    let cases: [(&dyn ImplicitField, DVec3); 5] = [
        (&cone, DVec3::ZERO),
        (&pole, DVec3::ZERO),
        (&root, -DVec3::X),
        (&axis, DVec3::ZERO),
        (&Sphere::default(), DVec3::NAN),
    ];
    for (field, p) in cases {
        let error = project(field, p, 1.0, &tolerance(1e-13)).unwrap_err();
        assert!(matches!(error, ProjectionError::Singular { .. }), "{p}: {error}");
    }
}

#[test]
fn a_field_without_zeros_does_not_converge() {
    let positive = Formula::parse("x^2 + y^2 + z^2 + 1").unwrap();
    for p in sample_points(&Aabb::from_half_size(2.0), 50) {
        let error = project(&positive, p, 1.0, &ProjectionSettings::default()).unwrap_err();
        let ProjectionError::NotConverged { distance, .. } = error else { panic!("{p}: {error}") };
        assert!(distance > 1e-13, "{distance} would have been near enough");
    }
}

#[test]
fn a_multiple_zero_is_approached_and_not_taken_for_round_off() {
    // each step leaves five sixths of the distance: 60 steps reach 2e-5
    let field = Formula::parse("x^6").unwrap();
    let error = project(&field, DVec3::X, 1e3, &ProjectionSettings::default()).unwrap_err();
    assert!(matches!(error, ProjectionError::NotConverged { .. }), "{error}");
}
