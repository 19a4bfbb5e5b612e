//! What every element of one surface is chosen by, and how a patch that folds retreats.

use basemesh::{EdgeMap, FaceId, FaceMap, Topology};
use g1_triangular::{Fill, InnerPoints, Plan, Rows};
use hermite_sqp::CurveRefinement;
use serde::{Deserialize, Serialize};

use crate::settings::Settings;

/// How far a patch that folded over with the refined objectives was taken back to the published
/// ones. The surface stays exactly smooth; only its deviation grows near the patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Retreat {
    /// Its free inner points.
    InnerPoints,
    /// Also the rows along its edges.
    Rows,
    /// Also its curves and twists.
    Curves,
    /// Also the curves and twists around its vertices: the patch of the published method.
    Neighbourhood,
}

impl Retreat {
    const FIRST: Self = Self::InnerPoints;

    fn next(self) -> Option<Self> {
        match self {
            Self::InnerPoints => Some(Self::Rows),
            Self::Rows => Some(Self::Curves),
            Self::Curves => Some(Self::Neighbourhood),
            Self::Neighbourhood => None,
        }
    }
}

/// The objectives of every element.
pub(crate) struct Objectives {
    pub(crate) curves: EdgeMap<CurveRefinement>,
    pub(crate) patches: Plan,
    pub(crate) retreats: FaceMap<Option<Retreat>>,
    published: bool,
}

impl Objectives {
    /// The same everywhere.
    pub(crate) fn uniform(topology: &Topology, settings: &Settings) -> Self {
        Self {
            curves: EdgeMap::from_vec(vec![settings.curve_refinement; topology.edge_count()]),
            patches: Plan::uniform(topology, settings.patches),
            retreats: FaceMap::from_vec(vec![None; topology.face_count()]),
            published: settings.curve_refinement == CurveRefinement::None
                && settings.patches == g1_triangular::Settings::PUBLISHED,
        }
    }

    /// Takes a folded patch one step closer to the published method; `false` if it is there.
    pub(crate) fn retreat(&mut self, topology: &Topology, face: FaceId) -> bool {
        let next = self.retreats[face].map_or(Some(Retreat::FIRST), Retreat::next);
        let Some(level) = next.filter(|_| !self.published) else { return false };
        self.retreats[face] = Some(level);
        match level {
            Retreat::InnerPoints => self.patches.inner_points[face] = InnerPoints::Keep,
            Retreat::Rows => {
                for h in face.halfedges() {
                    self.patches.rows[topology.edge(h)] = Rows::Nearest;
                }
            }
            Retreat::Curves => self.publish_curves(topology, face),
            Retreat::Neighbourhood => {
                for vertex in topology.corners(face) {
                    topology.fan(vertex).for_each(|h| self.publish_curves(topology, h.face()));
                }
            }
        }
        true
    }

    /// The curves of a face and the twists that they lead to.
    fn publish_curves(&mut self, topology: &Topology, face: FaceId) {
        self.patches.fill[face] = Fill::Septic;
        for h in face.halfedges() {
            self.curves[topology.edge(h)] = CurveRefinement::None;
        }
    }
}
