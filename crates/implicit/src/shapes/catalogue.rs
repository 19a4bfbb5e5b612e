//! Specimens of all shapes, found by name.

use glam::DVec3;

use super::{
    Chair, Deccube, Dodecahedron, DoubleTorus, Ellipsoid, McMullen, Plane, Quadric, Sphere, Torus,
};
use crate::aabb::Aabb;
use crate::field::ImplicitSurface;

/// A shape with its name, formula and surroundings.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct NamedShape {
    /// The name: lower case, words joined by a hyphen.
    pub name: &'static str,
    /// The same field as text for [`Formula::parse`](crate::Formula::parse); the two agree to
    /// round-off.
    pub formula: &'static str,
    /// A box around the whole surface: the field is positive on its boundary, except for the
    /// plane, which has no such box.
    pub region: Aabb,
    /// The genus of the surface, one component; `None` for plane and quadric, whose kind depends on
    /// the parameters.
    pub genus: Option<u32>,
    build: fn() -> Box<dyn ImplicitSurface>,
}

impl NamedShape {
    /// The shape with this name.
    #[must_use]
    pub fn find(name: &str) -> Option<&'static Self> {
        CATALOGUE.iter().find(|shape| shape.name == name)
    }

    /// The field with its default parameters.
    #[must_use]
    pub fn field(&self) -> Box<dyn ImplicitSurface> {
        (self.build)()
    }
}

/// All named shapes, simple ones first.
#[must_use]
pub fn catalogue() -> &'static [NamedShape] {
    &CATALOGUE
}

/// A box of the given half sizes around the origin.
const fn half_sizes(x: f64, y: f64, z: f64) -> Aabb {
    Aabb { min: DVec3::new(-x, -y, -z), max: DVec3::new(x, y, z) }
}

static CATALOGUE: [NamedShape; 10] = [
    NamedShape {
        name: "plane",
        formula: "z",
        region: Aabb::from_half_size(1.0),
        genus: None,
        build: || Box::new(Plane::default()),
    },
    NamedShape {
        name: "sphere",
        formula: "x^2 + y^2 + z^2 - 1",
        region: Aabb::from_half_size(1.5),
        genus: Some(0),
        build: || Box::new(Sphere::default()),
    },
    NamedShape {
        name: "ellipsoid",
        formula: "x^2 + (y/0.8)^2 + (z/0.6)^2 - 1",
        region: half_sizes(1.3, 1.1, 0.9),
        genus: Some(0),
        build: || Box::new(Ellipsoid::default()),
    },
    NamedShape {
        name: "quadric",
        formula: "1.25*(x^2 + y^2) - 1.5*x*y + 4*z^2 - 1",
        region: half_sizes(1.5, 1.5, 0.8),
        genus: None,
        build: || Box::new(Quadric::default()),
    },
    NamedShape {
        name: "torus",
        formula: "(sqrt(x^2 + y^2) - 5)^2 + z^2 - 1",
        region: half_sizes(7.0, 7.0, 2.0),
        genus: Some(1),
        build: || Box::new(Torus::default()),
    },
    NamedShape {
        name: "dodecahedron",
        formula: "x^6 + y^6 + z^6 + 20*(x^4*y^2 + y^4*z^2 + z^4*x^2) - 1",
        region: Aabb::from_half_size(1.3),
        genus: Some(0),
        build: || Box::new(Dodecahedron),
    },
    NamedShape {
        name: "double-torus",
        formula: "x^8 - 2*x^6 + x^4 + 2*x^4*y^2 - 2*x^2*y^2 + y^4 + z^2 - 0.04",
        region: half_sizes(1.4, 0.9, 0.5),
        genus: Some(2),
        build: || Box::new(DoubleTorus),
    },
    NamedShape {
        name: "mcmullen",
        formula: "(x^2 + 1)*(y^2 + 1)*(z^2 + 1) + 8*x*y*z - 2",
        region: Aabb::from_half_size(2.2),
        genus: Some(0),
        build: || Box::new(McMullen),
    },
    NamedShape {
        name: "chair",
        formula: "(x^2 + y^2 + z^2 - 0.95*5^2)^2 \
                  - 0.8*((z - 5)^2 - 2*x^2)*((z + 5)^2 - 2*y^2)",
        region: Aabb::from_half_size(6.0),
        genus: Some(3),
        build: || Box::new(Chair::default()),
    },
    NamedShape {
        name: "deccube",
        formula: "((x^2 + y^2 - 0.8^2)^2 + (z^2 - 1)^2) \
                  * ((y^2 + z^2 - 0.8^2)^2 + (x^2 - 1)^2) \
                  * ((z^2 + x^2 - 0.8^2)^2 + (y^2 - 1)^2) - 0.02",
        region: Aabb::from_half_size(1.6),
        genus: Some(13),
        build: || Box::new(Deccube::default()),
    },
];
