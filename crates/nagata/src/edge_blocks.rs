//! The curves of all edges, several at a time.

use basemesh::{EdgeId, EdgeMap};
use glam::DVec3;

use crate::corner_normals::CornerNormals;
use crate::curvature_parameter::{EdgeStatus, Limits, bow_and_shear};
use crate::polygon_mesh::PolygonMesh;
use crate::settings::Settings;

/// Edges that are computed and stored together.
const LANES: usize = 8;

/// Curvature parameter and status of each edge, in blocks of neighbours.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct EdgeBlocks(EdgeMap<Block>);

impl Default for EdgeBlocks {
    fn default() -> Self {
        Self(EdgeMap::from_vec(Vec::new()))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Block {
    curvature: [DVec3; LANES],
    status: [EdgeStatus; LANES],
}

/// Vectors of each lane, component by component.
type Lanes = [[f64; LANES]; 3];

/// When a curvature parameter is taken as it is.
#[derive(Clone, Copy, Debug)]
struct Test {
    limits: Limits,
    /// Largest misfit, in chords; `None` if that does not matter.
    max_misfit: Option<f64>,
}

impl EdgeBlocks {
    /// Those of all edges, in the memory of `old` if that has the size. What `solve` returns is asked for only
    /// for edges with more or fewer normals than two, or those that fail the test; for the others it would be
    /// the same, bit for bit.
    pub(crate) fn new(
        mesh: &PolygonMesh,
        normals: &CornerNormals,
        settings: &Settings,
        old: Option<Self>,
        solve: impl Fn(EdgeId) -> (DVec3, EdgeStatus) + Sync,
    ) -> Self {
        let limits = Limits::new(&settings.edges);
        let test = Test { limits, max_misfit: settings.max_misfit() };
        if let Some(of_vertex) = normals.of_vertices() {
            let of_edge = |edge| Some(mesh.edge_vertices(edge).map(|v| of_vertex[v.index()]));
            Self::filled(mesh, old, |first| test.block(mesh, first, of_edge, &solve))
        } else {
            let of_edge = |edge| normals.one_each(mesh, edge);
            Self::filled(mesh, old, |first| test.block(mesh, first, of_edge, &solve))
        }
    }

    #[inline(always)]
    fn filled(
        mesh: &PolygonMesh,
        old: Option<Self>,
        block: impl Fn(usize) -> Block + Sync,
    ) -> Self {
        let count = mesh.edge_count().div_ceil(LANES);
        match old {
            Some(Self(mut blocks)) if blocks.len() == count => {
                blocks.change(|id, value| *value = block(id.index() * LANES));
                Self(blocks)
            }
            _ => Self(EdgeMap::from_fn(count, |id| block(id.index() * LANES))),
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
        self.0[block].status[lane]
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

/// Chord and normals of an edge; zeros if there is not one normal at each end, which fails the test.
#[inline(always)]
fn edge_data(
    mesh: &PolygonMesh,
    edge: EdgeId,
    normals: impl Fn(EdgeId) -> Option<[DVec3; 2]>,
) -> [DVec3; 3] {
    let [start, end] = mesh.edge_vertices(edge).map(|v| mesh.position(v));
    let [n_start, n_end] = normals(edge).unwrap_or_default();
    [end - start, n_start, n_end]
}

#[inline(always)]
fn set(lanes: &mut Lanes, lane: usize, v: DVec3) {
    (lanes[0][lane], lanes[1][lane], lanes[2][lane]) = (v.x, v.y, v.z);
}

#[inline(always)]
fn get(lanes: &Lanes, lane: usize) -> DVec3 {
    DVec3::new(lanes[0][lane], lanes[1][lane], lanes[2][lane])
}

impl Test {
    /// The block that starts with the edge `first`.
    #[inline(always)]
    fn block(
        &self,
        mesh: &PolygonMesh,
        first: usize,
        normals: impl Fn(EdgeId) -> Option<[DVec3; 2]>,
        solve: impl Fn(EdgeId) -> (DVec3, EdgeStatus),
    ) -> Block {
        // the last lanes of the last block repeat the last edge
        let last = mesh.edge_count() - 1;
        let edge = |lane: usize| EdgeId::new((first + lane).min(last));
        let mut input = [[[0.0; LANES]; 3]; 3];
        for lane in 0..LANES {
            let data = edge_data(mesh, edge(lane), &normals);
            for (lanes, v) in input.iter_mut().zip(data) {
                set(lanes, lane, v);
            }
        }
        let (mut block, passed) = self.direct(&input);
        if passed != [true; LANES] {
            for lane in (0..LANES).filter(|lane| !passed[*lane]) {
                (block.curvature[lane], block.status[lane]) = solve(edge(lane));
            }
        }
        block
    }

    /// The block, and the lanes for which it can be used.
    #[inline(always)]
    fn direct(&self, [chords, starts, ends]: &[Lanes; 3]) -> (Block, [bool; LANES]) {
        let mut value = [[0.0; LANES]; 3];
        let (mut passed, mut full_rank) = ([false; LANES], [false; LANES]);
        for lane in 0..LANES {
            let (chord, start, end) = (get(chords, lane), get(starts, lane), get(ends, lane));
            let found = bow_and_shear(chord, [start, end], &self.limits);
            let c = found.value;
            let missed = self.max_misfit.is_some_and(|most| {
                let most = most * chord.length();
                (start.dot(chord - c).abs() > most) | (end.dot(chord + c).abs() > most)
            });
            set(&mut value, lane, c);
            passed[lane] = found.accepted & !missed;
            full_rank[lane] = found.full_rank;
        }
        let block = Block {
            curvature: std::array::from_fn(|lane| get(&value, lane)),
            status: full_rank.map(EdgeStatus::quadratic),
        };
        (block, passed)
    }
}
