//! From where a surface is seen.

use glam::{DVec2, DVec3};

/// The axis that points up in pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The third coordinate.
    #[default]
    Z,
}

/// A direction from which a surface is seen, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Angle around the upward axis. Zero looks from the positive end of the axis that follows it
    /// (x, if z is up); it grows counter-clockwise seen from above.
    pub azimuth: f64,
    /// Angle above the horizontal plane, -90 to 90.
    pub elevation: f64,
}

impl View {
    /// Views with a name.
    pub const NAMED: [(&'static str, Self); 7] = [
        ("iso", Self::new(-45.0, 35.264_389_682_754_654)),
        ("front", Self::new(-90.0, 0.0)),
        ("back", Self::new(90.0, 0.0)),
        ("left", Self::new(180.0, 0.0)),
        ("right", Self::new(0.0, 0.0)),
        ("top", Self::new(-90.0, 90.0)),
        ("bottom", Self::new(-90.0, -90.0)),
    ];

    /// A view from these angles.
    #[must_use]
    pub const fn new(azimuth: f64, elevation: f64) -> Self {
        Self { azimuth, elevation }
    }

    /// The view with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMED.into_iter().find(|(known, _)| *known == name).map(|(_, view)| view)
    }

    /// Unit vectors to the right, upwards and towards the viewer.
    #[must_use]
    pub fn axes(self, up: UpAxis) -> [DVec3; 3] {
        let (sin, cos) = self.azimuth.to_radians().sin_cos();
        let (rise, reach) = self.elevation.to_radians().sin_cos();
        let (toward, right) =
            (DVec3::new(reach * cos, reach * sin, rise), DVec3::new(-sin, cos, 0.0));
        [right, toward.cross(right), toward].map(|v| match up {
            UpAxis::Z => v,
            UpAxis::Y => DVec3::new(v.y, v.z, v.x),
            UpAxis::X => DVec3::new(v.z, v.x, v.y),
        })
    }
}

/// A parallel projection to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Unit vectors to the right, upwards and towards the viewer.
    pub axes: [DVec3; 3],
    /// The point in the middle of the picture.
    pub centre: DVec3,
    /// Pixels for each unit of length.
    pub pixels_per_length: f64,
}

impl Camera {
    /// Pixels to the right and down from the middle of the picture, and pixels towards the viewer.
    #[must_use]
    pub fn project(&self, point: DVec3) -> DVec3 {
        let [right, up, toward] = self.axes;
        let from_centre = (point - self.centre) * self.pixels_per_length;
        DVec3::new(from_centre.dot(right), -from_centre.dot(up), from_centre.dot(toward))
    }

    /// A camera that shows all points in a picture of this size, with a margin of `margin` times the
    /// smaller side; `None` if the points are none, not finite, or all in one place.
    #[must_use]
    pub fn framing(
        points: impl IntoIterator<Item = DVec3>,
        axes: [DVec3; 3],
        size: [usize; 2],
        margin: f64,
    ) -> Option<Self> {
        let on_axes = |p: DVec3| DVec3::from_array(axes.map(|axis| p.dot(axis)));
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in points {
            let at = on_axes(point);
            low = low.min(at);
            high = high.max(at);
        }
        let middle = (low + high) * 0.5;
        let extent = (high - low).truncate();
        let size = DVec2::new(size[0] as f64, size[1] as f64);
        let room = size - DVec2::splat(2.0 * margin * size.min_element());
        let pixels_per_length = (room / extent).min_element();
        let centre = axes[0] * middle.x + axes[1] * middle.y + axes[2] * middle.z;
        let usable = pixels_per_length.is_finite() && pixels_per_length > 0.0 && centre.is_finite();
        usable.then_some(Self { axes, centre, pixels_per_length })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_views_look_along_axes() {
        let axes = |name: &str, up| View::named(name).expect("a name").axes(up);
        let close = |a: DVec3, b: DVec3| a.distance(b) < 4.0 * f64::EPSILON;
        let [right, up, toward] = axes("front", UpAxis::Z);
        assert!(close(right, DVec3::X) && close(up, DVec3::Z) && close(toward, -DVec3::Y), "front");
        let [right, up, toward] = axes("top", UpAxis::Z);
        assert!(close(right, DVec3::X) && close(up, DVec3::Y) && close(toward, DVec3::Z), "top");
        let [right, up, toward] = axes("front", UpAxis::Y);
        assert!(close(up, DVec3::Y), "y is up");
        assert!(close(right.cross(up), toward), "right-handed");
        let [_, _, toward] = axes("iso", UpAxis::Z);
        assert!(close(toward, DVec3::new(1.0, -1.0, 1.0).normalize()), "all axes alike");
    }

    #[test]
    fn a_frame_holds_all_points() {
        let points =
            [DVec3::new(3.0, 0.0, 0.0), DVec3::new(5.0, 1.0, 0.0), DVec3::new(4.0, 7.0, 9.0)];
        let axes = View::new(20.0, 30.0).axes(UpAxis::Z);
        let camera = Camera::framing(points, axes, [300, 200], 0.1).expect("a camera");
        let seen = points.map(|p| camera.project(p).truncate().abs());
        assert!(seen.iter().all(|p| p.x <= 130.0 + 1e-9 && p.y <= 80.0 + 1e-9), "{seen:?}");
        let touches = |p: &DVec2| (p.x - 130.0).abs() < 1e-9 || (p.y - 80.0).abs() < 1e-9;
        assert!(seen.iter().any(touches), "as large as possible: {seen:?}");
        assert_eq!(Camera::framing([DVec3::X], axes, [300, 200], 0.1), None, "a single point");
    }
}
