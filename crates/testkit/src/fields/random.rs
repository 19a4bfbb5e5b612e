//! Closed surfaces around the origin, of parameters to be drawn at random.

use glam::DVec3;
use implicit::{Expression, Number};

/// A plane cosine wave `amplitude cos(wave·p + phase)`.
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    /// Half the difference of its extreme values.
    pub amplitude: f64,
    /// Its gradient of phase.
    pub wave: DVec3,
    /// Its phase at the origin.
    pub phase: f64,
}

/// An ellipsoid disturbed by waves and by a cubic polynomial.
#[derive(Clone, Debug)]
pub struct Blob {
    /// Semi-axes of the ellipsoid.
    pub semi_axes: DVec3,
    /// Disturbances of its equation.
    pub waves: Vec<Wave>,
    /// Coefficients of `x²y`, `y²z`, `z²x` and `xyz`.
    pub cubic: [f64; 4],
}

impl Expression for Blob {
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let DVec3 { x: a, y: b, z: c } = self.semi_axes;
        let ellipsoid = (x / a).square() + (y / b).square() + (z / c).square() - 1.0;
        let [xxy, yyz, zzx, xyz] = self.cubic;
        let cubic =
            x.square() * y * xxy + y.square() * z * yyz + z.square() * x * zzx + x * y * z * xyz;
        self.waves.iter().fold(ellipsoid + cubic, |sum, wave| {
            let phase = x * wave.wave.x + y * wave.wave.y + z * wave.wave.z + wave.phase;
            sum + phase.cos() * wave.amplitude
        })
    }
}

/// Balls blended into one another: `0.4 - Σ exp(-1.5 |p - c|²)`.
#[derive(Clone, Debug)]
pub struct Blend {
    /// The centres; near enough to the origin for it to lie inside.
    pub centers: Vec<DVec3>,
}

impl Expression for Blend {
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        self.centers.iter().fold(T::constant(0.4), |sum, c| {
            let square = (x - c.x).square() + (y - c.y).square() + (z - c.z).square();
            sum - (square * -1.5).exp()
        })
    }
}

implicit::field_from_expression!(Blob, Blend);
