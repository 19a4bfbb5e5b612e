//! A sphere whose picture is known.

use std::f64::consts::FRAC_PI_2;

use render::glam::{DVec2, DVec3};
use render::{
    Camera, Colour, Domain, Hit, Patches, Scale, Shade, Style, SurfacePoint, UpAxis, View, draw,
    frame,
};

/// The unit sphere as eight triangles over an octahedron, with the parameters of great circles, and as
/// six squares over a cube.
struct Sphere(Domain);

const OCTANTS: [[f64; 3]; 8] = [
    [1., 1., 1.],
    [-1., 1., 1.],
    [-1., -1., 1.],
    [1., -1., 1.],
    [1., 1., -1.],
    [-1., 1., -1.],
    [-1., -1., -1.],
    [1., -1., -1.],
];

impl Sphere {
    /// A point of the octahedron or the cube, and its derivatives.
    fn flat(&self, patch: usize, at: DVec2) -> [DVec3; 3] {
        match self.0 {
            Domain::Triangle => {
                let sign = OCTANTS[patch];
                let (x, y, z) = (DVec3::X * sign[0], DVec3::Y * sign[1], DVec3::Z * sign[2]);
                [x * (1.0 - at.x - at.y) + y * at.x + z * at.y, y - x, z - x]
            }
            Domain::Square => {
                let axes = [DVec3::X, DVec3::Y, DVec3::Z];
                let side = if patch < 3 { 1.0 } else { -1.0 };
                let [n, u, v] =
                    [axes[patch % 3] * side, axes[(patch + 1) % 3], axes[(patch + 2) % 3]];
                let [x, y] = [2.0 * at.x - 1.0, 2.0 * at.y - 1.0];
                // equal angles
                let angle = |x: f64| (0.5 * FRAC_PI_2 * x).tan();
                let slope = |x: f64| FRAC_PI_2 / (0.5 * FRAC_PI_2 * x).cos().powi(2);
                [n + u * angle(x) + v * angle(y), u * slope(x), v * slope(y)]
            }
        }
    }
}

impl Patches for Sphere {
    fn count(&self) -> usize {
        if self.0 == Domain::Triangle { 8 } else { 6 }
    }

    fn domain(&self, _: usize) -> Domain {
        self.0
    }

    fn point(&self, patch: usize, at: DVec2) -> DVec3 {
        self.flat(patch, at)[0].normalize()
    }

    fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
        let [flat, u, v] = self.flat(patch, at);
        let (length, point) = (flat.length(), flat.normalize());
        let tangent = |d: DVec3| (d - point * point.dot(d)) / length;
        SurfacePoint { point, normal: point, du: tangent(u), dv: tangent(v) }
    }
}

const SIZE: [usize; 2] = [240, 180];

fn camera(sphere: &Sphere) -> Camera {
    frame(&[sphere], View::new(33.0, 21.0).axes(UpAxis::Z), SIZE).expect("a sphere")
}

/// The middle of a pixel, in pixels right, up and from the middle of the picture.
fn middle(column: usize, row: usize) -> DVec2 {
    DVec2::new(column as f64 + 0.5 - 120.0, 90.0 - (row as f64 + 0.5))
}

/// The part of each pixel that is covered: white values on black.
fn coverage(sphere: &Sphere, camera: &Camera) -> Vec<f64> {
    let one = |_: &Hit| Some(1.0);
    let white =
        Scale { low: 0.0, high: 1.0, logarithmic: false, map: render::ColourMap::Sequential };
    // the colour does not matter, only whether it is the background
    let shade = Shade::Values(&one, white);
    let background = Colour([50.0, 50.0, 50.0]);
    let picture =
        draw(sphere, camera, SIZE, &Style { background, ..Style::new(shade) }).expect("finite");
    let part = |colour: Colour| {
        let [red, ..] = colour.0;
        1.0 - red / 50.0
    };
    (0..SIZE[1])
        .flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
        .map(|(x, y)| part(picture.pixel(x, y)))
        .collect()
}

#[test]
fn the_silhouette_is_a_circle() {
    for domain in [Domain::Triangle, Domain::Square] {
        let sphere = Sphere(domain);
        let camera = camera(&sphere);
        let radius = camera.pixels_per_length;
        let covered = coverage(&sphere, &camera);
        let mut area = 0.0;
        for (at, &part) in covered.iter().enumerate() {
            let centre = middle(at % SIZE[0], at / SIZE[0]);
            // half a diagonal of a pixel, and the width of the colours that are not quite zero
            let distance = centre.length() - radius;
            if distance < -0.75 {
                assert!(part > 0.97, "inside at {centre}: {part}");
            } else if distance > 0.75 {
                assert_eq!(part, 0.0, "outside at {centre}");
            }
            area += part;
        }
        // the colours take up to two parts in a hundred of what is covered
        let circle = std::f64::consts::PI * radius * radius;
        assert!(
            (area / circle - 0.99).abs() < 0.01,
            "{domain:?}: {area} instead of {circle} pixels"
        );
    }
}

#[test]
fn normals_are_those_of_the_sphere_under_each_pixel() {
    for domain in [Domain::Triangle, Domain::Square] {
        let sphere = Sphere(domain);
        let camera = camera(&sphere);
        let radius = camera.pixels_per_length;
        let picture = draw(&sphere, &camera, SIZE, &Style::new(Shade::Normals)).expect("finite");
        let mut largest: f64 = 0.0;
        for (row, column) in
            (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| (row, column)))
        {
            let flat = middle(column, row) / radius;
            if flat.length() > 0.9 {
                continue;
            }
            let expected = flat.extend((1.0 - flat.length_squared()).sqrt());
            let found = DVec3::from_array(picture.pixel(column, row).to_srgb()) * 2.0 - DVec3::ONE;
            largest = largest.max(found.distance(expected));
        }
        // the normal turns by 1/(0.43 radius) from pixel to pixel there; a pixel is the mean of four
        // to sixteen samples, in linear light
        let bound = 0.2 / (0.43 * radius);
        assert!(largest < bound, "{domain:?}: {largest} above {bound}");
    }
}

#[test]
fn a_part_is_drawn_as_in_the_whole() {
    let sphere = Sphere(Domain::Triangle);
    let whole = camera(&sphere);
    // eight times larger, around a point off the middle
    let [right, up, _] = whole.axes;
    let centre = whole.centre + right * 0.4 + up * 0.3;
    let near = Camera { centre, pixels_per_length: 8.0 * whole.pixels_per_length, ..whole };
    let part = draw(&sphere, &near, SIZE, &Style::new(Shade::Normals)).expect("finite");
    for (row, column) in (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| (row, column)))
    {
        let flat = DVec2::new(0.4, 0.3) + middle(column, row) / near.pixels_per_length;
        let expected = flat.extend((1.0 - flat.length_squared()).sqrt());
        let found = DVec3::from_array(part.pixel(column, row).to_srgb()) * 2.0 - DVec3::ONE;
        assert!(found.distance(expected) < 0.2 / (0.43 * near.pixels_per_length), "{flat}");
    }
}

#[test]
fn the_far_side_is_hidden() {
    let sphere = Sphere(Domain::Square);
    let camera = camera(&sphere);
    let toward = camera.axes[2];
    let height = |hit: &Hit| Some(hit.point.dot(toward));
    let seen = std::sync::Mutex::new(f64::INFINITY);
    let lowest = |hit: &Hit| {
        let value = height(hit)?;
        let mut seen = seen.lock().expect("no panic");
        *seen = seen.min(value);
        Some(value)
    };
    let scale =
        Scale { low: 0.0, high: 1.0, logarithmic: false, map: render::ColourMap::Sequential };
    draw(&sphere, &camera, SIZE, &Style::new(Shade::Values(&lowest, scale))).expect("finite");
    let lowest = *seen.lock().expect("no panic");
    // at the silhouette a point may lie 0.03 pixels behind it
    let behind = (2.0 * 0.05 / camera.pixels_per_length).sqrt();
    assert!(lowest > -behind, "{lowest} below {}", -behind);
}

#[test]
fn a_line_is_drawn_where_the_edges_are() {
    let sphere = Sphere(Domain::Triangle);
    let camera = Camera { axes: View::new(0.0, 0.0).axes(UpAxis::Z), ..camera(&sphere) };
    let style = Style { edges: true, ..Style::new(Shade::Normals) };
    let lined = draw(&sphere, &camera, SIZE, &style).expect("finite");
    let plain = draw(&sphere, &camera, SIZE, &Style::new(Shade::Normals)).expect("finite");
    let differs = |column, row| lined.pixel(column, row) != plain.pixel(column, row);
    // seen along x, two great circles are the axes of the picture
    assert!((40..60).all(|row| differs(119, row) && differs(120, row)), "the upright edge");
    assert!((60..80).all(|column| differs(column, 89) && differs(column, 90)), "the level edge");
    assert!(!(40..60).any(|row| differs(116, row) || differs(123, row)), "thin");
}

#[test]
fn points_that_are_not_finite_are_refused() {
    struct Broken;
    impl Patches for Broken {
        fn count(&self) -> usize {
            2
        }
        fn domain(&self, _: usize) -> Domain {
            Domain::Triangle
        }
        fn point(&self, patch: usize, at: DVec2) -> DVec3 {
            if patch == 1 && at.x > 0.9 { DVec3::NAN } else { at.extend(0.0) }
        }
        fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
            let point = self.point(patch, at);
            SurfacePoint { point, normal: DVec3::Z, du: DVec3::X, dv: DVec3::Y }
        }
    }
    let camera = camera(&Sphere(Domain::Square));
    let error = draw(&Broken, &camera, SIZE, &Style::new(Shade::Normals)).expect_err("not finite");
    assert_eq!(error.to_string(), "patch 1 has a point that is not finite");
}
