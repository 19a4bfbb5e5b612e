//! No hidden length: a problem 2¹² times as large has 2¹² times as large results, bit for bit.

use implicit::glam::{DMat3, DVec3};
use implicit::{
    Aabb, Chair, Ellipsoid, Formula, ImplicitSurface, Plane, ProjectionSettings, Quadric, Sphere,
    Torus, project_many, project_with_gradient, surface_point,
};
use testkit::conformance::field::sample_points;

const SCALE: f64 = 4096.0;

/// The same shape in small and in large, with its name.
type Pair = (&'static str, Box<dyn ImplicitSurface>, Box<dyn ImplicitSurface>);

fn pairs() -> Vec<Pair> {
    let center = DVec3::new(0.3, -0.2, 0.1);
    let normal = DVec3::new(0.3, -0.2, 0.9);
    let quadric = Quadric { linear: center, ..Default::default() };
    let scaled_quadric =
        Quadric { linear: center * SCALE, constant: quadric.constant * SCALE * SCALE, ..quadric };
    let text = "sqrt(x^2 + 2*y^2) - s + z^3/s^2 + abs(x*y)/s + max(z, min(x, y))/7";
    let formula = |s: f64| -> Box<dyn ImplicitSurface> {
        Box::new(Formula::parse_with(text, &[("s", s)]).expect("a valid formula"))
    };
    vec![
        (
            "sphere",
            Box::new(Sphere { center, radius: 1.0 }),
            Box::new(Sphere { center: center * SCALE, radius: SCALE }),
        ),
        (
            "plane",
            Box::new(Plane { normal, offset: 0.1 }),
            Box::new(Plane { normal, offset: 0.1 * SCALE }),
        ),
        (
            "torus",
            Box::new(Torus { major_radius: 1.0, minor_radius: 0.3 }),
            Box::new(Torus { major_radius: SCALE, minor_radius: 0.3 * SCALE }),
        ),
        (
            "ellipsoid",
            Box::new(Ellipsoid::default()),
            Box::new(Ellipsoid { semi_axes: Ellipsoid::default().semi_axes * SCALE }),
        ),
        ("quadric", Box::new(quadric), Box::new(scaled_quadric)),
        (
            "chair",
            Box::new(Chair { k: 1.0, ..Default::default() }),
            Box::new(Chair { k: SCALE, ..Default::default() }),
        ),
        ("formula", formula(1.0), formula(SCALE)),
    ]
}

fn bits(v: DVec3) -> [u64; 3] {
    v.to_array().map(f64::to_bits)
}

fn matrix_bits(m: DMat3) -> [u64; 9] {
    m.to_cols_array().map(f64::to_bits)
}

#[test]
fn projection_scales() {
    // coarse as well, so that the iteration ends by tolerance and not by round-off
    let settings = ProjectionSettings { tolerance: 1e-6, ..Default::default() };
    for (name, small, large) in pairs() {
        let mut converged = 0;
        // from half the size of the shape to lengths that are as small as round-off
        let lengths = [0.5, 1e-2, 1e-4, 1e-7].into_iter().cycle();
        for (p, length) in sample_points(&Aabb::from_half_size(1.5), 300).into_iter().zip(lengths) {
            let a = project_with_gradient(&small, p, length, &settings);
            let b = project_with_gradient(&large, p * SCALE, length * SCALE, &settings);
            assert_eq!(a.is_ok(), b.is_ok(), "{name} from {p}: {a:?}, {b:?}");
            if let (Ok((foot, normal)), Ok((large_foot, large_normal))) = (a, b) {
                assert_eq!(bits(foot * SCALE), bits(large_foot), "{name} from {p}: foot");
                assert_eq!(bits(normal), bits(large_normal), "{name} from {p}: normal");
                converged += 1;
            }
        }
        assert!(converged > 200, "{name}: only {converged} points converged");
    }
}

#[test]
fn batch_projection_scales() {
    let settings = ProjectionSettings::default();
    for (name, small, large) in pairs() {
        let mut feet = sample_points(&Aabb::from_half_size(1.5), 300);
        let mut large_feet: Vec<DVec3> = feet.iter().map(|&p| p * SCALE).collect();
        let a = project_many(&small, &mut feet, 0.1, &settings);
        let b = project_many(&large, &mut large_feet, 0.1 * SCALE, &settings);
        for (i, (a, b)) in a.iter().zip(&b).enumerate() {
            assert_eq!(a.ok().map(bits), b.ok().map(bits), "{name}: normal {i}");
            assert_eq!(bits(feet[i] * SCALE), bits(large_feet[i]), "{name}: foot {i}");
        }
    }
}

#[test]
fn curvature_scales_inversely() {
    for (name, small, large) in pairs() {
        for p in sample_points(&Aabb::from_half_size(1.5), 300) {
            let a = surface_point(&small, p).unwrap();
            let b = surface_point(&large, p * SCALE).unwrap();
            let (form, large_form) = (a.second_fundamental_form, b.second_fundamental_form);
            assert_eq!(bits(a.normal), bits(b.normal), "{name} at {p}: normal");
            assert_eq!(matrix_bits(form), matrix_bits(large_form * SCALE), "{name} at {p}: form");
            let (k, large_k) = (a.principal(), b.principal());
            assert_eq!(k.min.to_bits(), (large_k.min * SCALE).to_bits(), "{name} at {p}");
            assert_eq!(k.max.to_bits(), (large_k.max * SCALE).to_bits(), "{name} at {p}");
            assert_eq!(bits(k.direction_min), bits(large_k.direction_min), "{name} at {p}");
            assert_eq!(k.umbilic, large_k.umbilic, "{name} at {p}");
        }
    }
}

#[test]
fn enclosures_scale() {
    // f of the quadric and of the sphere is a squared length
    let region = Aabb::new(DVec3::new(-0.3, 0.2, 0.1), DVec3::new(0.4, 0.5, 1.1)).unwrap();
    let large_region = Aabb::new(region.min * SCALE, region.max * SCALE).unwrap();
    for (name, small, large) in pairs() {
        if !["sphere", "quadric"].contains(&name) {
            continue;
        }
        let (a, b) = (small.enclosure(&region), large.enclosure(&large_region));
        assert_eq!((a.lo * SCALE * SCALE).to_bits(), b.lo.to_bits(), "{name}");
        assert_eq!((a.hi * SCALE * SCALE).to_bits(), b.hi.to_bits(), "{name}");
    }
}
