//! Every refusal says where and what to do.

use basemesh::PolygonizeError;
use implicit::glam::DVec3;
use implicit::{Aabb, BoundedField, Formula, NamedShape, Plane, Sphere};

use crate::fields::{mesh_of, unbounded};

fn refusal(field: &dyn BoundedField, region: &Aabb, cells: usize) -> PolygonizeError {
    mesh_of(field, region, cells).expect_err("this cannot be polygonized")
}

#[test]
fn leaving_surface_that_closes_in_a_larger_region() {
    let shape = NamedShape::find("torus").unwrap();
    let field = shape.field();
    for region in [
        Aabb::from_half_size(3.0),
        // one side only
        Aabb { min: DVec3::new(-7.0, -7.0, -2.0), max: DVec3::new(4.0, 7.0, 2.0) },
        // a piece that a corner cuts out
        Aabb { min: DVec3::new(3.0, 3.0, 0.0), max: DVec3::new(6.0, 6.0, 3.0) },
    ] {
        let error = refusal(&field, &region, 40);
        let PolygonizeError::LeavesRegion { at, suggested, closes } = error.clone() else {
            panic!("{error}");
        };
        assert!(closes, "{error}");
        assert!(region.expanded(1.2).contains(at), "{error}");
        assert!(suggested.contains(region.min) && suggested.contains(region.max), "{error}");
        assert!(suggested != region, "{error}");
        let mesh = mesh_of(&field, &suggested, 60).unwrap();
        assert_eq!(mesh.topology().euler_characteristic(), 0);
        assert!(error.to_string().contains("on a coarse grid the surface is closed there"));
    }
}

#[test]
fn unbounded_surface() {
    let region = Aabb::from_half_size(1.0);
    let error = refusal(&Plane::default(), &region, 10);
    let PolygonizeError::LeavesRegion { suggested, closes, .. } = error.clone() else {
        panic!("{error}");
    };
    assert!(!closes && suggested != region && suggested.contains(region.max), "{error}");
    assert!(error.to_string().contains("a guess"), "{error}");
}

#[test]
fn no_surface_reports_the_values() {
    let region = Aabb::from_half_size(1.0);
    let positive = unbounded(|p| 2.0 + p.x);
    let PolygonizeError::NoSurface { min, max, .. } = refusal(&positive, &region, 20) else {
        panic!("positive everywhere");
    };
    assert!(min > 0.8 && min <= 1.0 && (3.0..3.2).contains(&max), "values {min} to {max}");

    // discarded by its enclosure without one sample
    let PolygonizeError::NoSurface { min, max, .. } =
        refusal(&Sphere { radius: 9.0, ..Sphere::default() }, &region, 20)
    else {
        panic!("negative everywhere");
    };
    assert!(min <= -81.0 && max < -70.0, "values {min} to {max}");
}

#[test]
fn values_that_are_not_finite_are_located() {
    let region = Aabb::from_half_size(1.5);
    let root = Formula::parse("x^2+y^2+z^2-1+0*sqrt(0.3-x)").unwrap();
    let PolygonizeError::NotFinite { at, value } = refusal(&root, &region, 30) else {
        panic!("the root of a negative number");
    };
    assert!(value.is_nan() && at.x > 0.3, "{value} at {at}");

    let pole = unbounded(|p| if p.z > 0.5 { f64::INFINITY } else { p.length() - 1.0 });
    let PolygonizeError::NotFinite { at, value } = refusal(&pole, &region, 30) else {
        panic!("infinite values");
    };
    assert!(value.is_infinite() && at.z > 0.5, "{value} at {at}");
}

#[test]
fn unusable_arguments() {
    let sphere = Sphere::default();
    let region = Aabb::from_half_size(1.5);
    let box_of = |min: f64, max: f64| Aabb { min: DVec3::splat(min), max: DVec3::splat(max) };
    for bad in [box_of(1.0, -1.0), box_of(0.0, 0.0), box_of(f64::NAN, 1.0), box_of(-1e308, 1e308)] {
        let error = refusal(&sphere, &bad, 10);
        assert!(matches!(error, PolygonizeError::InvalidRegion { .. }), "{error}");
    }
    let error = refusal(&sphere, &region, 0);
    assert_eq!(error, PolygonizeError::InvalidCells { cells: 0, max: 1 << 20 });
    let error = refusal(&sphere, &region, usize::MAX);
    assert_eq!(error, PolygonizeError::InvalidCells { cells: usize::MAX, max: 1 << 20 });

    // far from the origin there are few numbers
    let far = box_of(1e9, 1e9 + 1.0);
    let PolygonizeError::InvalidCells { max, .. } = refusal(&sphere, &far, 1000) else {
        panic!("cells of a few units in the last place");
    };
    assert!((1..1000).contains(&max), "{max}");
}

#[test]
fn an_impure_field_is_an_error_or_a_closed_mesh() {
    use std::sync::atomic::{AtomicU64, Ordering};
    let calls = AtomicU64::new(0);
    let flicker = unbounded(|p| {
        let call = calls.fetch_add(1, Ordering::Relaxed);
        if p.length() > 1.0 { 1.0 } else { crate::fields::noise(call, p) - 0.5 }
    });
    let error = refusal(&flicker, &Aabb::from_half_size(1.5), 30);
    let expected = matches!(error, PolygonizeError::Inconsistent { .. } | PolygonizeError::Mesh(_));
    assert!(expected, "{error}");
}
