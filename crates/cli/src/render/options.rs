//! How a picture looks.

use clap::{Args, ValueEnum};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::render::{UpAxis, View};

use crate::values;

#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Picture")]
pub(crate) struct PictureOptions {
    /// What the colours show
    #[arg(long, value_enum, default_value_t = ShadeName::Zebra)]
    pub(crate) shade: ShadeName,

    /// Draw the edges of the patches
    #[arg(long)]
    pub(crate) edges: bool,

    /// From where to look: iso, front, back, left, right, top, bottom, or two angles in degrees: around
    /// the upward axis and above the horizon
    #[arg(long, value_name = "NAME|AZIMUTH,ELEVATION", default_value = "iso")]
    #[arg(allow_hyphen_values = true, value_parser = view)]
    pub(crate) view: View,

    /// The axis that points up
    #[arg(long, value_enum, default_value_t = UpName::Z)]
    pub(crate) up: UpName,

    /// Pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1200x900", value_parser = size)]
    pub(crate) size: [usize; 2],

    /// How much larger than if everything is to be seen
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) zoom: f64,

    /// The point in the middle of the picture [default: the middle of the surface]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = point)]
    pub(crate) centre: Option<DVec3>,

    /// Number of dark stripes, on a sphere for zebra, over half a turn for isophotes
    #[arg(long, value_name = "N", default_value_t = 10.0, value_parser = factor)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) stripes: f64,

    /// The numbers at both ends of the colours, for curvature (1 / length) and deviation (diagonals)
    /// [default: from the surface]
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true, value_parser = range)]
    pub(crate) range: Option<[f64; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShadeName {
    /// Mirror images of a striped room
    Zebra,
    /// Lines of equal angle between normal and light
    Isophotes,
    /// Mean curvature: blue convex, red concave
    Curvature,
    /// Normals as colours
    Normals,
    /// Distance from a surface that is named (--scene, --shape, --formula), or the largest one of each
    /// patch as the file has it
    Deviation,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UpName {
    X,
    Y,
    Z,
}

impl From<UpName> for UpAxis {
    fn from(name: UpName) -> Self {
        match name {
            UpName::X => Self::X,
            UpName::Y => Self::Y,
            UpName::Z => Self::Z,
        }
    }
}

/// Smallest and largest side of a picture; 16 samples of each pixel must fit the memory.
const SIDES: std::ops::RangeInclusive<usize> = 16..=16_384;

fn size(text: &str) -> Result<[usize; 2], String> {
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| {
        Some([width.trim().parse().ok()?, height.trim().parse().ok()?])
    });
    match sides {
        Some(sides) if sides.iter().all(|side| SIDES.contains(side)) => Ok(sides),
        Some(_) => Err(format!("both sides must have {} to {} pixels", SIDES.start(), SIDES.end())),
        None => Err("give two whole numbers, such as 1200x900".into()),
    }
}

fn view(text: &str) -> Result<View, String> {
    if let Some(view) = View::named(text) {
        return Ok(view);
    }
    let names = View::NAMED.map(|(name, _)| name).join(", ");
    let wrong = || format!("give one of {names}, or two angles such as 30,20");
    let (azimuth, elevation) = text.split_once(',').ok_or_else(wrong)?;
    let (azimuth, elevation) = (values::finite(azimuth)?, values::finite(elevation)?);
    if !(-90.0..=90.0).contains(&elevation) {
        return Err("the angle above the horizon is from -90 to 90 degrees".into());
    }
    Ok(View::new(azimuth, elevation))
}

fn factor(text: &str) -> Result<f64, String> {
    values::finite(text).and_then(|value| {
        if (1e-3..=1e3).contains(&value) {
            Ok(value)
        } else {
            Err("give a number from 0.001 to 1000".into())
        }
    })
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers = text.split(',').map(values::finite).collect::<Result<Vec<_>, _>>()?;
    let count = numbers.len();
    numbers.try_into().map_err(|_| format!("give {N} numbers separated by commas, not {count}"))
}

fn point(text: &str) -> Result<DVec3, String> {
    numbers(text).map(DVec3::from_array)
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let [low, high] = numbers(text)?;
    if low < high {
        Ok([low, high])
    } else {
        Err("the first number must be the smaller one".into())
    }
}
