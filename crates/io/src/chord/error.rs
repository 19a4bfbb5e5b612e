//! Why a surface was not tessellated.

use glam::DVec3;
use thiserror::Error;

/// Why a surface was not tessellated within a distance. Faces and vertices count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ChordError {
    /// The tolerance is no length.
    #[error("the chord tolerance {value} is not a positive number")]
    Tolerance {
        /// The value.
        value: f64,
    },
    /// An edge was halved as often as can be.
    #[error(
        "edge {lower}-{higher} is not within the chord tolerance of {tolerance:e} after {halvings} \
         halvings; take a larger tolerance"
    )]
    Edge {
        /// Its lower vertex.
        lower: usize,
        /// Its higher vertex.
        higher: usize,
        /// The tolerance.
        tolerance: f64,
        /// How often it was halved.
        halvings: usize,
    },
    /// A face was cut as often as can be.
    #[error(
        "face {face} is not within the chord tolerance of {tolerance:e} after {cuts} cuts; take a \
         larger tolerance"
    )]
    Face {
        /// The face.
        face: usize,
        /// The tolerance.
        tolerance: f64,
        /// How often it was cut.
        cuts: usize,
    },
    /// A point of the surface is infinite or not a number.
    #[error("face {face} has the point {position}, which is not finite")]
    NotFinite {
        /// The face.
        face: usize,
        /// The point.
        position: DVec3,
    },
}
