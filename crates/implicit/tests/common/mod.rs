//! Formulas and boxes for several suites.

use implicit::Aabb;
use implicit::glam::DVec3;
use proptest::prelude::*;

/// Formulas that use every operation, smooth on the box from 0.2 to 1.8 without its diagonals.
pub(crate) const FORMULAS: [&str; 22] = [
    "x^3 + y^5 - z^7 + x*y*z",
    "x^-2 + y^-3 - z^-1",
    "x^0.5 + y^1.5 + z^-0.25",
    "x^y + 2^z + (x + y)^(z - 1)",
    "x/y + y/z - 3/x + z/7",
    "sqrt(x^2 + y^2) + sqrt(z)",
    "exp(x*y) - exp(-z)",
    "ln(x + y*z)",
    "sin(3*x)*cos(2*y) + sin(z)",
    "tan(0.5*x*z) - y",
    "tanh(x - y) + tanh(4*z)",
    "atan2(y, x) + atan2(z, x - 3) + atan2(-y, -z)",
    "abs(x - 5) + abs(y + 1)*z",
    "min(x - 4, y) + max(z + 4, x)",
    "max(min(x^2 + y^2 + z^2 - 9, x + 6), y - 5)",
    "pi*x - (-y)^3 + -z^2",
    "-(x - 2*y)^2/(1 + z^2)",
    "sin(x) + cos(x) + sin(x)^2 + sin(x)*cos(x)",
    "3 - x",
    "min(7, x + y) + atan2(1, x) - 2/(z + 1)",
    "42",
    "z^100/2^60 + x^8",
];

pub(crate) fn formula_region() -> Aabb {
    Aabb::new(DVec3::splat(0.2), DVec3::splat(1.8)).expect("ordered")
}

/// Boxes of all sizes, flat ones and points too, around all places, also where functions have poles or end.
pub(crate) fn any_box() -> impl Strategy<Value = Aabb> {
    let coordinate = || -3.0..3.0;
    let size = || prop_oneof![1 => Just(0.0), 4 => (-12.0..1.0_f64).prop_map(f64::exp2)];
    ([coordinate(), coordinate(), coordinate()], [size(), size(), size()]).prop_map(
        |(center, size)| {
            let (center, size) = (DVec3::from_array(center), DVec3::from_array(size));
            Aabb { min: center - size, max: center + size }
        },
    )
}
