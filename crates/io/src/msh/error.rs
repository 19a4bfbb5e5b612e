//! Why a mesh was not written.

use std::io;

use glam::DVec3;
use thiserror::Error;

/// Why a mesh was not written. Nothing was written before the error, except for [`MshError::Io`].
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MshError {
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// There is no such element type.
    #[error("elements of order {order} do not exist in Gmsh; choose an order from 1 to {limit}")]
    Order {
        /// The order.
        order: usize,
        /// The largest that exists.
        limit: usize,
    },
    /// The nodes do not make up whole elements.
    #[error("{nodes} nodes are no whole number of {what} with {each} nodes each")]
    NodeCount {
        /// Number of nodes.
        nodes: usize,
        /// Triangles or quadrilaterals.
        what: &'static str,
        /// Nodes of one element.
        each: usize,
    },
    /// An element names a node that does not exist.
    #[error("{what} {element} uses node {node}, but there are only {count}")]
    MissingNode {
        /// Triangle or quadrilateral.
        what: &'static str,
        /// The element, from 0.
        element: usize,
        /// The node, from 0.
        node: usize,
        /// Number of nodes.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("node {node} of {what} {element} is {position}, which is not finite")]
    NotFinite {
        /// Triangle or quadrilateral.
        what: &'static str,
        /// The element, from 0.
        element: usize,
        /// The node, from 0.
        node: usize,
        /// Its position.
        position: DVec3,
    },
    /// A name that the format cannot keep.
    #[error("{name:?} cannot be the name of a group; use letters without quotes and line ends")]
    Group {
        /// The name.
        name: String,
    },
}

impl From<MshError> for io::Error {
    fn from(error: MshError) -> Self {
        match error {
            MshError::Io(cause) => cause,
            other => Self::new(io::ErrorKind::InvalidInput, other),
        }
    }
}
