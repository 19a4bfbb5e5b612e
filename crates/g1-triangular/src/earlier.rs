//! Results of an earlier construction that need not be found again.

use basemesh::{EdgeId, FaceId};
use bezier_core::SepticTriangle;

use crate::edge_system::EdgeRows;
use crate::fill::PositionalPatch;

/// What an earlier construction found for elements whose surroundings are still the same.
///
/// Everything here is a pure function of its surroundings, so that using an earlier result gives
/// the same bits as finding it again. The default is to know nothing.
pub trait Earlier: Sync {
    /// The positional patch of a face: depends on its curves. Around vertices all of whose edges and
    /// faces are known by [`rows`](Self::rows) and [`patch`](Self::patch) it is not read, and any net
    /// will do.
    fn positional(&self, face: FaceId) -> Option<PositionalPatch> {
        let _ = face;
        None
    }

    /// The rows along an edge: depend on all faces around its two vertices.
    fn rows(&self, edge: EdgeId) -> Option<EdgeRows> {
        let _ = edge;
        None
    }

    /// The smooth patch of a face: depends on all faces around its three vertices.
    fn patch(&self, face: FaceId) -> Option<SepticTriangle> {
        let _ = face;
        None
    }
}

/// There was no earlier construction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nothing;

impl Earlier for Nothing {}
