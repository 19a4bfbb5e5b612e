//! Shapes by name.

mod catalogue;
mod chair;
mod deccube;
mod dodecahedron;
mod double_torus;
mod ellipsoid;
mod mcmullen;
mod plane;
mod quadric;
mod sphere;
mod torus;

pub use self::catalogue::{NamedShape, catalogue};
pub use self::chair::Chair;
pub use self::deccube::Deccube;
pub use self::dodecahedron::Dodecahedron;
pub use self::double_torus::DoubleTorus;
pub use self::ellipsoid::Ellipsoid;
pub use self::mcmullen::McMullen;
pub use self::plane::Plane;
pub use self::quadric::Quadric;
pub use self::sphere::Sphere;
pub use self::torus::Torus;
