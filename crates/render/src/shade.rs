//! The colour of a point.

use std::fmt;

use glam::DVec3;

use crate::colour::Colour;
use crate::patches::Hit;
use crate::scale::Scale;

/// A number at each visible point; `None` where there is none.
pub type Value<'a> = &'a (dyn Fn(&Hit) -> Option<f64> + Sync);

/// What the colours show.
#[derive(Clone, Copy)]
pub enum Shade<'a> {
    /// Mirror images of a striped room, as CAD programs show them: on a sphere they are straight and
    /// equally wide. They break where tangent planes do, and have a kink where curvatures jump. The
    /// number counts the dark stripes on a sphere.
    Zebra(f64),
    /// Lines of equal angle between the normal and the direction of light: the same test with less
    /// distortion. The number counts the dark bands over half a turn.
    Isophotes(f64),
    /// Normals as colours: (n + 1) / 2, of the coordinates right, up and towards the viewer.
    Normals,
    /// Numbers as colours.
    Values(Value<'a>, Scale),
}

impl fmt::Debug for Shade<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Zebra(stripes) => f.debug_tuple("Zebra").field(stripes).finish(),
            Self::Isophotes(bands) => f.debug_tuple("Isophotes").field(bands).finish(),
            Self::Normals => f.write_str("Normals"),
            Self::Values(_, scale) => f.debug_tuple("Values").field(scale).finish_non_exhaustive(),
        }
    }
}

/// From where light comes, in coordinates right, up and towards the viewer.
const LIGHT: DVec3 = DVec3::new(-0.35, 0.55, 0.76);
/// Where a number or a normal is missing.
const NOTHING: [f64; 3] = [0.75, 0.75, 0.75];

impl Shade<'_> {
    /// A number that grows by one from stripe to stripe; `None` for other shades and without a normal.
    #[must_use]
    pub fn phase(&self, hit: &Hit, axes: [DVec3; 3]) -> Option<f64> {
        let seen = DVec3::from_array(axes.map(|axis| axis.dot(hit.normal)));
        if seen == DVec3::ZERO {
            return None;
        }
        self.phase_of(if seen.z >= 0.0 { seen } else { -seen })
    }

    /// The same of a normal to the right, upwards and towards the viewer.
    fn phase_of(&self, n: DVec3) -> Option<f64> {
        match self {
            Self::Zebra(stripes) => Some(zebra(n, *stripes)),
            Self::Isophotes(bands) => Some(isophote(n, *bands)),
            Self::Normals | Self::Values(..) => None,
        }
    }

    /// The colour of a point, in a picture with these axes to the right, up and towards the viewer.
    #[must_use]
    pub fn colour(&self, hit: &Hit, axes: [DVec3; 3]) -> Colour {
        let seen = DVec3::from_array(axes.map(|axis| axis.dot(hit.normal)));
        let outside = seen.z >= 0.0;
        // the inner side of open surfaces is lit as well, and darker
        let n = if outside { seen } else { -seen };
        let side = if outside { 1.0 } else { 0.7 };
        if n == DVec3::ZERO {
            return Colour::from_srgb(NOTHING);
        }
        match self {
            Self::Zebra(_) | Self::Isophotes(_) => {
                let stripes = self.phase_of(n).map_or(Colour::from_srgb(NOTHING), striped);
                stripes.times(side * soft(n, 0.62))
            }
            Self::Normals => Colour::from_srgb(((n + DVec3::ONE) * 0.5).to_array()).times(side),
            Self::Values(value, scale) => {
                let colour = value(hit).map_or(Colour::from_srgb(NOTHING), |x| scale.colour(x));
                colour.times(side * soft(n, 0.55))
            }
        }
    }
}

/// Across the stripes, in coordinates to the right and upwards.
const ACROSS: DVec3 = DVec3::new(0.5, 0.866_025_403_784_438_6, 0.0);

/// A number that grows by one from stripe to stripe. The normal is half-way between the viewer and the
/// mirrored ray, so that it gives the place in the sphere map of the mirrored room.
fn zebra(n: DVec3, stripes: f64) -> f64 {
    stripes * (1.0 + n.dot(ACROSS))
}

fn isophote(n: DVec3, bands: f64) -> f64 {
    let light = LIGHT.normalize();
    2.0 * bands * n.dot(light).clamp(-1.0, 1.0).acos() / std::f64::consts::PI
}

fn striped(phase: f64) -> Colour {
    let dark = phase.rem_euclid(2.0) < 1.0;
    if dark { Colour::from_srgb([0.13, 0.16, 0.22]) } else { Colour::from_srgb([0.97, 0.97, 0.95]) }
}

/// Soft light: one where the light comes from, `least` where the surface is seen from its side.
fn soft(n: DVec3, least: f64) -> f64 {
    let lit = 0.5 + 0.5 * n.dot(LIGHT.normalize());
    least + (1.0 - least) * lit * n.z.max(0.0).powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

    fn hit(normal: DVec3) -> Hit {
        Hit { patch: 0, at: glam::DVec2::ZERO, point: DVec3::ZERO, normal }
    }

    #[test]
    fn stripes_alternate_with_the_phase() {
        let shade = Shade::Zebra(12.0);
        let brightness = |angle: f64| {
            let normal = DVec3::new(0.8 * angle.sin(), 0.6 * angle.sin(), angle.cos());
            let phase = shade.phase(&hit(normal), AXES).expect("stripes have a phase");
            (phase, shade.colour(&hit(normal), AXES).0[1])
        };
        for step in -60..60 {
            let (phase, green) = brightness(f64::from(step) * 0.0123);
            assert_eq!(phase.rem_euclid(2.0) < 1.0, green < 0.3, "phase {phase}, green {green}");
        }
    }

    #[test]
    fn both_sides_have_the_same_stripes() {
        let normal = DVec3::new(0.3, -0.2, 0.8).normalize();
        let shade = Shade::Isophotes(9.0);
        let [front, back] = [normal, -normal].map(|n| shade.phase(&hit(n), AXES));
        assert_eq!(front, back, "the inner side is lit as well");
        assert_eq!(Shade::Normals.phase(&hit(normal), AXES), None, "no stripes");
        assert_eq!(shade.phase(&hit(DVec3::ZERO), AXES), None, "no normal");
    }
}
