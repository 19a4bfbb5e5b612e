//! The catalogue: formula and shape agree, the region holds the surface, the genus is right.

use implicit::glam::DVec3;
use implicit::{Aabb, Formula, ImplicitField, NamedShape, TwiceDifferentiable, catalogue};
use testkit::conformance::field::{check_encloses_surface, sample_points};

#[test]
fn names_are_unique_and_found() {
    for shape in catalogue() {
        let found = NamedShape::find(shape.name).unwrap();
        assert!(std::ptr::eq(found, shape), "{}", shape.name);
    }
    assert!(NamedShape::find("Torus").is_none(), "names are lower case");
}

/// Agreement to 1e-12 of the largest size that value, gradient or Hessian reach in the region.
#[test]
fn formulas_agree_with_shapes() {
    for shape in catalogue() {
        let (field, formula) = (shape.field(), Formula::parse(shape.formula).unwrap());
        let points = sample_points(&shape.region, 500);
        let (mut size, mut difference) = ([0.0_f64; 3], [0.0_f64; 3]);
        for &p in &points {
            let (a, b) = (field.jet(p), formula.jet(p));
            let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let raise = |to: &mut [f64; 3], value: f64, gradient: DVec3, hessian: [f64; 9]| {
                to[0] = to[0].max(value.abs());
                to[1] = to[1].max(largest(&gradient.to_array()));
                to[2] = to[2].max(largest(&hessian));
            };
            let hessian_difference = (a.hessian - b.hessian).to_cols_array();
            assert!(b.hessian.is_finite(), "{} at {p}", shape.name);
            raise(&mut size, b.value, b.gradient, b.hessian.to_cols_array());
            raise(&mut difference, a.value - b.value, a.gradient - b.gradient, hessian_difference);
        }
        for (what, (difference, size)) in
            ["value", "gradient", "Hessian"].iter().zip(difference.iter().zip(size))
        {
            assert!(*difference <= 1e-12 * size, "{}: {what} {difference} of {size}", shape.name);
        }
    }
}

#[test]
fn regions_contain_the_whole_surface() {
    for shape in catalogue().iter().filter(|shape| shape.name != "plane") {
        check_encloses_surface(shape.name, &shape.field(), &shape.region);
    }
}

/// The two regions for which the literature gives larger boxes: nothing is lost in ours.
#[test]
fn nothing_lies_outside_the_regions() {
    for (name, larger) in [("mcmullen", 4.5), ("chair", 9.0)] {
        let shape = NamedShape::find(name).unwrap();
        let field = shape.field();
        let lost = sample_points(&Aabb::from_half_size(larger), 200_000)
            .into_iter()
            .find(|&p| field.value(p) <= 0.0 && !shape.region.contains(p));
        assert_eq!(lost, None, "{name} has a point outside its region");
    }
}

/// A solid bounded by one surface of genus g has Euler number 1 − g: counted on the grid cells
/// whose centers are inside.
#[test]
fn genus() {
    for shape in catalogue() {
        let Some(genus) = shape.genus else { continue };
        let solid = Voxels::of(&shape.field(), &shape.region, 72);
        assert_eq!(solid.euler_number(), 1 - i64::from(genus), "{}", shape.name);
        assert_eq!(solid.component_count(), 1, "{}", shape.name);
    }
}

/// The grid cells inside a solid, with an empty margin.
struct Voxels {
    inside: Vec<bool>,
    edge: usize,
}

impl Voxels {
    fn of(field: &dyn ImplicitField, region: &Aabb, resolution: u32) -> Self {
        let step = region.size() / f64::from(resolution);
        let edge = resolution as usize + 2;
        let mut inside = vec![false; edge * edge * edge];
        let mut points = Vec::new();
        for (z, y, x) in cells(resolution) {
            let center = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) + 0.5;
            points.push(region.min + step * center);
        }
        let mut values = vec![0.0; points.len()];
        field.values(&points, &mut values);
        for ((z, y, x), value) in cells(resolution).zip(values) {
            let [x, y, z] = [x, y, z].map(|i| i as usize + 1);
            inside[(z * edge + y) * edge + x] = value < 0.0;
        }
        Self { inside, edge }
    }

    /// Vertices − edges + faces − cells of the closed cells.
    fn euler_number(&self) -> i64 {
        let strides = [1, self.edge, self.edge * self.edge];
        let mut number = 0;
        // an element of the grid is a cell with some of the axes collapsed to their lower end
        for collapsed in 0..8_usize {
            let axes: Vec<usize> = (0..3).filter(|axis| collapsed >> axis & 1 == 1).collect();
            let sign = if axes.len() % 2 == 1 { 1 } else { -1 };
            let offsets: Vec<usize> = (0..1_usize << axes.len())
                .map(|side| {
                    let behind = axes.iter().enumerate().filter(|(i, _)| side >> i & 1 == 1);
                    behind.map(|(_, &axis)| strides[axis]).sum()
                })
                .collect();
            let used = (strides.iter().sum()..self.inside.len())
                .filter(|cell| offsets.iter().any(|offset| self.inside[cell - offset]))
                .count();
            number += sign * i64::try_from(used).expect("fewer than a million");
        }
        number
    }

    /// Components connected across faces.
    fn component_count(&self) -> usize {
        let strides = [1, self.edge, self.edge * self.edge];
        let mut left = self.inside.clone();
        let mut count = 0;
        while let Some(seed) = left.iter().position(|&inside| inside) {
            count += 1;
            let mut open = vec![seed];
            left[seed] = false;
            while let Some(cell) = open.pop() {
                for next in strides.iter().flat_map(|stride| [cell - stride, cell + stride]) {
                    if left[next] {
                        left[next] = false;
                        open.push(next);
                    }
                }
            }
        }
        count
    }
}

fn cells(resolution: u32) -> impl Iterator<Item = (u32, u32, u32)> {
    let range = move || 0..resolution;
    range().flat_map(move |z| range().flat_map(move |y| range().map(move |x| (z, y, x))))
}
