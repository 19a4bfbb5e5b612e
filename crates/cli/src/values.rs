//! From the text of an option to its value.

use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::implicit::Aabb;
use smoothpatch::io::MAX_MSH_ORDER;

/// Fewest faces of a closed triangle mesh.
const MIN_FACES: usize = 4;
/// More would not fit the memory of today's machines.
const MAX_FACES: usize = 10_000_000;

pub(crate) fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err("the number must be finite".into()),
        Err(_) => Err(format!("`{text}` is not a number")),
    }
}

/// A share: a number between 0 and 1.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    finite(text).and_then(|value| {
        if value > 0.0 && value < 1.0 {
            Ok(value)
        } else {
            Err("give a number between 0 and 1".into())
        }
    })
}

/// A bound: a number that is not negative.
pub(crate) fn bound(text: &str) -> Result<f64, String> {
    finite(text).and_then(|value| {
        if value >= 0.0 { Ok(value) } else { Err("a bound cannot be negative".into()) }
    })
}

/// A tolerance: a number above zero.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    finite(text).and_then(|value| {
        if value > 0.0 { Ok(value) } else { Err("a tolerance must be above zero".into()) }
    })
}

/// Smallest angle between normals that can be asked for, in degrees: a hundred times what rounding
/// turns the normals of small patches by.
const SMALLEST_ANGLE: f64 = 1e-9;

/// A tolerance of normals in degrees.
pub(crate) fn angle(text: &str) -> Result<f64, String> {
    positive(text).and_then(|degrees| {
        if degrees >= SMALLEST_ANGLE {
            Ok(degrees)
        } else {
            Err(format!("normals can be measured to {SMALLEST_ANGLE:e}°, not to less"))
        }
    })
}

/// An angle between the normals of two faces, in degrees.
pub(crate) fn crease_angle(text: &str) -> Result<f64, String> {
    finite(text).and_then(|degrees| {
        if (0.0..=180.0).contains(&degrees) {
            Ok(degrees)
        } else {
            Err("an angle between normals is from 0 to 180 degrees".into())
        }
    })
}

pub(crate) fn faces(text: &str) -> Result<usize, String> {
    let count: usize = text.parse().map_err(|_| format!("`{text}` is not a number of faces"))?;
    match count {
        ..MIN_FACES => Err(format!("a closed triangle mesh has at least {MIN_FACES} faces")),
        _ if count > MAX_FACES => Err(format!("at most {MAX_FACES} faces are supported")),
        _ if count % 2 == 1 => Err(format!(
            "the number of faces of a closed triangle mesh is even; ask for {} or {}",
            count - 1,
            count + 1
        )),
        _ => Ok(count),
    }
}

pub(crate) fn divisions(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count @ 1..=256) => Ok(count),
        _ => Err("give a whole number from 1 to 256".into()),
    }
}

/// Order of the elements of Gmsh.
pub(crate) fn order(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(order @ 1..=MAX_MSH_ORDER) => Ok(order),
        _ => Err(format!("give a whole number from 1 to {MAX_MSH_ORDER}")),
    }
}

/// `NAME=VALUE`
pub(crate) fn constant(text: &str) -> Result<(String, f64), String> {
    let (name, value) =
        text.split_once('=').ok_or_else(|| format!("`{text}` should look like r=1.5"))?;
    Ok((name.trim().to_owned(), finite(value)?))
}

/// `XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX`
pub(crate) fn region(text: &str) -> Result<Aabb, String> {
    let numbers = text.split(',').map(finite).collect::<Result<Vec<f64>, _>>()?;
    let Ok([x, y, z, to_x, to_y, to_z]) = <[f64; 6]>::try_from(numbers.as_slice()) else {
        return Err(format!(
            "six numbers are needed, XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX, not {}",
            numbers.len()
        ));
    };
    let (min, max) = (DVec3::new(x, y, z), DVec3::new(to_x, to_y, to_z));
    for (axis, (low, high)) in
        ["x", "y", "z"].into_iter().zip(min.to_array().into_iter().zip(max.to_array()))
    {
        // the extent of two finite numbers may still be infinite
        if low >= high || !(high - low).is_finite() {
            return Err(format!(
                "the region runs from {low} to {high} in {axis}; give the lower corner first"
            ));
        }
    }
    Ok(Aabb { min, max })
}

/// A region as the option `--region` takes it.
pub(crate) fn region_text(region: &Aabb) -> String {
    let [min, max] = [region.min, region.max].map(|p| format!("{},{},{}", p.x, p.y, p.z));
    format!("{min},{max}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions() {
        let parsed = region("-1, -2,-3,1,2,3.5").unwrap();
        assert_eq!(
            parsed,
            Aabb { min: DVec3::new(-1.0, -2.0, -3.0), max: DVec3::new(1.0, 2.0, 3.5) }
        );
        assert_eq!(region(&region_text(&parsed)), Ok(parsed));
        for bad in ["", "1,2,3", "0,0,0,1,1,0", "0,0,0,1,1,inf", "0,0,0,1,1,1,1", "a,0,0,1,1,1"] {
            assert!(region(bad).is_err(), "{bad:?} was taken for a region");
        }
    }

    #[test]
    fn constants() {
        assert_eq!(constant("r = -1.5"), Ok(("r".into(), -1.5)));
        for bad in ["r", "r=", "r=x", "r=nan"] {
            assert!(constant(bad).is_err(), "{bad:?} was taken for a constant");
        }
    }

    #[test]
    fn numbers_of_faces() {
        assert_eq!(faces("600"), Ok(600));
        for bad in ["3", "-4", "601", "6e2", "99999999999999"] {
            assert!(faces(bad).is_err(), "{bad:?} was taken for a number of faces");
        }
    }
}
