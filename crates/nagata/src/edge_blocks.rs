//! The curves of all edges, many at a time.

use basemesh::{EdgeId, EdgeMap, VertexId};
use glam::DVec3;

use crate::corner_normals::CornerNormals;
use crate::curvature_parameter::{EdgeStatus, Limits};
use crate::lanes::{Flags, Lanes, curvature_parameters, refuse_misfits};
use crate::polygon_mesh::PolygonMesh;
use crate::settings::Settings;
use crate::status_byte::StatusByte;
use crate::widest::{Loops, widest};

/// Edges that are computed and stored together.
const LANES: usize = 64;

/// Curvature parameter and status of each edge, in blocks of neighbours.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct EdgeBlocks(EdgeMap<Block>);

impl Default for EdgeBlocks {
    fn default() -> Self {
        Self(EdgeMap::from_vec(Vec::new()))
    }
}

/// The last lanes of the last block have zeros.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Block {
    curvature: [DVec3; LANES],
    status: [StatusByte; LANES],
}

impl Block {
    const EMPTY: Self =
        Self { curvature: [DVec3::ZERO; LANES], status: [StatusByte::STRAIGHT; LANES] };
}

/// What the block of the edges from `first` on is made of.
struct Filling<'a, N, S> {
    block: &'a mut Block,
    first: usize,
    ends: &'a [[VertexId; 2]],
    positions: &'a [DVec3],
    /// The normals at both ends of an edge; `None` if there is not one each.
    normals: &'a N,
    /// The road for all edges.
    solve: &'a S,
    limits: Limits,
    /// Largest misfit, in chords; `None` if that does not matter.
    max_misfit: Option<f64>,
}

impl EdgeBlocks {
    /// Those of all edges, in the memory of `old` if that has the size. What `solve` returns is asked for only
    /// for edges with more or fewer normals than two, or those that fail a test; for the others it would be
    /// the same, bit for bit.
    pub(crate) fn new(
        mesh: &PolygonMesh,
        normals: &CornerNormals,
        settings: &Settings,
        old: Option<Self>,
        solve: impl Fn(EdgeId) -> (DVec3, EdgeStatus) + Sync,
    ) -> Self {
        if let Some(of_vertex) = normals.of_vertices() {
            let at_ends = |_, ends: [VertexId; 2]| Some(ends.map(|v| of_vertex[v.index()]));
            Self::filled(mesh, settings, old, &at_ends, &solve)
        } else {
            let at_ends = |edge, _| normals.one_each(mesh, edge);
            Self::filled(mesh, settings, old, &at_ends, &solve)
        }
    }

    fn filled(
        mesh: &PolygonMesh,
        settings: &Settings,
        old: Option<Self>,
        normals: &(impl Fn(EdgeId, [VertexId; 2]) -> Option<[DVec3; 2]> + Sync),
        solve: &(impl Fn(EdgeId) -> (DVec3, EdgeStatus) + Sync),
    ) -> Self {
        let limits = Limits::new(&settings.edges);
        let (ends, positions) = (mesh.all_edge_vertices(), mesh.positions().as_slice());
        let fill = |id: EdgeId, block: &mut Block| {
            let first = id.index() * LANES;
            let ends = &ends[first..ends.len().min(first + LANES)];
            let max_misfit = settings.max_misfit();
            widest(Filling { block, first, ends, positions, normals, solve, limits, max_misfit });
        };
        let count = ends.len().div_ceil(LANES);
        match old {
            Some(Self(mut blocks)) if blocks.len() == count => {
                blocks.change(fill);
                Self(blocks)
            }
            _ => Self(EdgeMap::from_fn(count, |id| {
                let mut block = Block::EMPTY;
                fill(id, &mut block);
                block
            })),
        }
    }

    #[inline]
    pub(crate) fn curvature(&self, edge: EdgeId) -> DVec3 {
        let (block, lane) = at(edge);
        self.0[block].curvature[lane]
    }

    #[inline]
    pub(crate) fn status(&self, edge: EdgeId) -> EdgeStatus {
        let (block, lane) = at(edge);
        self.0[block].status[lane].get()
    }

    /// Bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.0.as_slice())
    }
}

#[inline]
fn at(edge: EdgeId) -> (EdgeId, usize) {
    (EdgeId::new(edge.index() / LANES), edge.index() % LANES)
}

impl<N, S> Loops for Filling<'_, N, S>
where
    N: Fn(EdgeId, [VertexId; 2]) -> Option<[DVec3; 2]>,
    S: Fn(EdgeId) -> (DVec3, EdgeStatus),
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (mut chords, mut starts, mut ends, mut values) =
            (Lanes::<LANES>::ZERO, Lanes::ZERO, Lanes::ZERO, Lanes::ZERO);
        for (lane, vertices) in self.ends.iter().enumerate() {
            let [start, end] = vertices.map(|v| self.positions[v.index()]);
            // zeros are refused
            let normals = (self.normals)(self.edge(lane), *vertices).unwrap_or_default();
            chords.set(lane, end - start);
            starts.set(lane, normals[0]);
            ends.set(lane, normals[1]);
        }
        let normals = [&starts, &ends];
        let mut flags = Flags::NONE;
        curvature_parameters(&chords, normals, &self.limits, &mut values, &mut flags);
        if let Some(most) = self.max_misfit {
            refuse_misfits(&mut flags, &chords, normals, &values, most);
        }
        for (lane, value) in self.block.curvature[..self.ends.len()].iter_mut().enumerate() {
            *value = values.get(lane);
        }
        for (lane, status) in self.block.status[..self.ends.len()].iter_mut().enumerate() {
            *status = StatusByte::quadratic(flags.full_rank(lane));
        }
        if flags.any_refused() {
            for lane in (0..self.ends.len()).filter(|lane| flags.refused(*lane)) {
                let (value, status) = (self.solve)(self.edge(lane));
                self.block.curvature[lane] = value;
                self.block.status[lane] = StatusByte::new(status);
            }
        }
    }
}

impl<N, S> Filling<'_, N, S> {
    #[inline(always)]
    fn edge(&self, lane: usize) -> EdgeId {
        EdgeId::new(self.first + lane)
    }
}
