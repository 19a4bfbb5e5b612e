//! Closest points and rays against dense sampling, refined by bisection.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests; figures for the record")]

mod common;

use common::queries::{Random, Reference, is_on_patch, spot, torus_surface};
use nagata::{Hit, NagataSurface, Ray, Settings, SurfaceQueries};

/// Distances differ by less than this from those of the reference, in sizes of the surface.
const DISTANCE: f64 = 1e-10;
/// The same for hits that are not nearly tangent.
const HIT: f64 = 1e-7;
/// Cosine of a ray and the normal below which a hit is nearly tangent.
const TANGENT: f64 = 0.1;

fn closest_points(surface: &NagataSurface, count: usize, seed: u64) {
    let queries = SurfaceQueries::new(surface);
    let reference = Reference::new(surface);
    let mut random = Random(seed);
    let size = queries.aabb().high.distance(queries.aabb().low);
    let mut largest: f64 = 0.0;
    for _ in 0..count {
        let p = random.point(&queries);
        let found = queries.closest(p).unwrap();
        assert!(is_on_patch(surface, found.face, &found.at), "{p}: {found:?} is not on its patch");
        let distance = found.at.point.distance(p);
        assert!((distance - found.signed_distance.abs()).abs() < 1e-14 * size, "{p}: {found:?}");
        let expected = reference.distance(p);
        let difference = (distance - expected) / size;
        assert!(difference.abs() <= DISTANCE, "{p}: {distance}, the reference has {expected}");
        largest = largest.max(difference.abs());
    }
    println!("{count} closest points: {largest:.1e} of the size from the reference at most");
}

fn check_hit(surface: &NagataSurface, ray: &Ray, hit: &Hit) {
    assert!(is_on_patch(surface, hit.face, &hit.at), "{hit:?} is not on its patch");
    let miss = hit.at.point.distance(ray.point(hit.t));
    assert!(miss < 1e-12 * (1.0 + ray.origin.length()), "{hit:?} is off the ray by {miss}");
}

fn rays(surface: &NagataSurface, count: usize, seed: u64) {
    let queries = SurfaceQueries::new(surface);
    let reference = Reference::new(surface);
    let mut random = Random(seed);
    let size = queries.aabb().high.distance(queries.aabb().low);
    let (mut total, mut in_order) = (0, 0);
    for _ in 0..count {
        let origin = queries.aabb().low - random.point(&queries).abs();
        let target = (random.point(&queries) + queries.aabb().low + queries.aabb().high) * 0.4;
        let ray = Ray { origin, direction: (target - origin).normalize() };
        let hits = queries.hits(&ray);
        hits.iter().for_each(|hit| check_hit(surface, &ray, hit));
        assert_eq!(
            queries.first_hit(&ray).map(|hit| hit.t),
            hits.first().map(|hit| hit.t),
            "{ray:?}"
        );
        let cosine = |hit: &Hit| hit.at.normal.unwrap().dot(ray.direction);
        // rays from outside enter and leave in turn
        if hits.iter().all(|hit| cosine(hit).abs() > TANGENT) {
            let right = |(k, hit): (usize, &Hit)| (cosine(hit) < 0.0) == (k % 2 == 0);
            assert!(
                hits.len().is_multiple_of(2) && hits.iter().enumerate().all(right),
                "{ray:?}: {hits:?}"
            );
            in_order += 1;
        }
        let expected = reference.hits(&ray);
        for (t, _) in expected.iter().filter(|(_, cosine)| cosine.abs() > TANGENT) {
            let found = hits.iter().any(|hit| (hit.t - t).abs() <= HIT * size);
            assert!(found, "{ray:?} misses t = {t}: {hits:?}");
        }
        for hit in hits.iter().filter(|hit| cosine(hit).abs() > TANGENT) {
            let known = expected.iter().any(|(t, _)| (hit.t - t).abs() <= HIT * size);
            assert!(known, "{ray:?}: the reference does not know {hit:?}: {expected:?}");
        }
        total += hits.len();
    }
    assert!(total > count / 4 && in_order > count / 2, "{total} hits, {in_order} rays");
    println!("{count} rays: {total} hits agree");
}

fn everything(points: usize, number_of_rays: usize) {
    for surface in [
        torus_surface(true, Settings::position()),
        torus_surface(true, Settings::tangent_plane()),
        torus_surface(false, Settings::position()),
        spot(Settings::position()),
        spot(Settings::tangent_plane()),
    ] {
        closest_points(&surface, points, 1);
        rays(&surface, number_of_rays, 2);
    }
}

#[test]
fn random_queries_agree_with_dense_sampling() {
    everything(40, 20);
}

/// 10⁵ of each: `cargo test --release -p nagata --test query_reference -- --ignored --nocapture`.
#[test]
#[ignore = "minutes, in release"]
fn many_random_queries_agree_with_dense_sampling() {
    everything(20_000, 20_000);
}
