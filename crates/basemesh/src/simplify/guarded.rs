//! Collapses on the surface, cheapest first, each tested against the guards.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use super::merge::merge;
use super::quadric::Quadric;
use super::report::Refusals;
use crate::ids::{HalfedgeId, VertexId};
use crate::improve::guard::{Guard, OldFace, Refusal};
use crate::improve::link::RingMarks;
use crate::improve::surface_mesh::SurfaceMesh;
use crate::target::Foot;

/// Collapses edges until `faces` are left or every remaining edge was refused.
///
/// The merged vertex goes to the optimum of its quadric and from there onto the surface, and is
/// tested there. A refused edge is tried again when its neighbourhood has changed. Ties of the cost
/// are broken by half-edge ids.
pub(super) fn collapse_guarded(
    surface: &mut SurfaceMesh<'_>,
    quadrics: &mut [Quadric],
    faces: usize,
    guard: &Guard,
    refusals: &mut Refusals,
) {
    let mut queue = Queue::new(surface, quadrics);
    let mut marks = RingMarks::default();
    while surface.mesh.face_count() > faces {
        let Some(h) = queue.pop(surface) else { return };
        let proposal = merge(&surface.mesh, quadrics, h);
        match check_collapse(surface, guard, h, proposal.position, &mut marks) {
            Ok(foot) => {
                let v = surface.mesh.origin(h);
                queue.forget(surface.mesh.target(h), v);
                surface.mesh.collapse(h);
                surface.put(v, foot);
                quadrics[v.index()] = proposal.quadric.moved_by(foot.point - proposal.position);
                queue.renew(surface, quadrics, v);
            }
            Err(refusal) => {
                refusals.count(refusal);
                queue.refuse(h);
            }
        }
    }
}

/// The surface point near `place` for the merged vertex, if the collapse passes all tests.
pub(crate) fn check_collapse(
    surface: &SurfaceMesh<'_>,
    guard: &Guard,
    h: HalfedgeId,
    place: DVec3,
    marks: &mut RingMarks,
) -> Result<Foot, Refusal> {
    let mesh = &surface.mesh;
    if !mesh.satisfies_link_condition(h, marks) {
        return Err(Refusal::Link);
    }
    let (a, b) = (mesh.origin(h), mesh.target(h));
    guard.check_valence(mesh.valence(a) + mesh.valence(b) - 4)?;
    for side in [h, mesh.twin(h)] {
        guard.check_valence(mesh.valence(mesh.apex(side)) - 1)?;
    }
    let reach = mesh.longest_edge(a).max(mesh.longest_edge(b));
    let foot = surface.foot(place, reach).ok_or(Refusal::Foot)?;
    for side in [h, mesh.twin(h)] {
        check_ring(surface, guard, side, &foot)?;
    }
    Ok(foot)
}

/// Tests what becomes of the faces and edges around the origin of `side` when its edge is collapsed
/// to `foot`.
fn check_ring(
    surface: &SurfaceMesh<'_>,
    guard: &Guard,
    side: HalfedgeId,
    foot: &Foot,
) -> Result<(), Refusal> {
    let mesh = &surface.mesh;
    let v = mesh.origin(side);
    let normal = surface.normal(v);
    let last = mesh.twin(side).next();
    // counter-clockwise from the edge after `side`; the two faces at the edge disappear
    for g in mesh.fan_from(mesh.twin(side.previous())).filter(|&g| g != side) {
        let (p, q) = (mesh.target(g), mesh.apex(g));
        let (np, nq) = (surface.normal(p), surface.normal(q));
        guard.check_turning(foot.normal, np, normal.dot(np))?;
        if g == last {
            continue;
        }
        let [pp, pq] = [p, q].map(|w| mesh.position(w));
        let old = OldFace::new([mesh.position(v), pp, pq], [normal, np, nq]);
        guard.check_face(&old, [foot.point, pp, pq], [foot.normal, np, nq])?;
    }
    Ok(())
}

/// An edge and its price at the time it was priced.
#[derive(Clone, Copy, Debug)]
struct Entry {
    cost: f64,
    h: HalfedgeId,
    /// Sum of the versions of both ends.
    version: u32,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        // reversed: the heap pops the cheapest edge, of equal ones the lowest id
        other.cost.total_cmp(&self.cost).then(other.h.cmp(&self.h))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

/// A priority queue of edges; outdated entries are dropped when they surface.
///
/// Only the cheapest entries are in the heap, so many as fit a processor's cache; all others cost
/// more than any of them and wait in no order.
struct Queue {
    heap: BinaryHeap<Entry>,
    waiting: Vec<Entry>,
    /// The dearest entry that goes to the heap; none before the first batch.
    limit: Option<Entry>,
    /// How often the surroundings of a vertex changed.
    versions: Vec<u32>,
    /// Half-edges whose edge was refused since its surroundings changed.
    refused: Vec<bool>,
}

/// Entries that go to the heap at a time, at least, and as a share of those that wait.
const MIN_BATCH: usize = 8192;
const BATCHES: usize = 16;

impl Queue {
    fn new(surface: &SurfaceMesh<'_>, quadrics: &[Quadric]) -> Self {
        let mesh = &surface.mesh;
        let price = |h| Entry { cost: merge(mesh, quadrics, h).cost, h, version: 0 };
        Self {
            heap: BinaryHeap::new(),
            waiting: mesh.edges().map(price).collect(),
            limit: None,
            versions: vec![0; mesh.vertex_slots()],
            refused: vec![false; 3 * mesh.face_slots()],
        }
    }

    /// Moves the cheapest of the waiting entries to the empty heap; `None` if there are none.
    fn refill(&mut self) -> Option<()> {
        let last = self.waiting.len().checked_sub(1)?;
        let count = (self.waiting.len() / BATCHES).max(MIN_BATCH);
        // the greatest entry is the cheapest
        let first = last.saturating_sub(count);
        self.waiting.select_nth_unstable(first);
        self.limit = Some(self.waiting[first]);
        self.heap = self.waiting.split_off(first).into();
        Some(())
    }

    fn version(&self, surface: &SurfaceMesh<'_>, h: HalfedgeId) -> u32 {
        let ends = [surface.mesh.origin(h), surface.mesh.target(h)];
        ends.into_iter().fold(0, |sum: u32, v| sum.wrapping_add(self.versions[v.index()]))
    }

    /// The cheapest edge whose price is up to date.
    fn pop(&mut self, surface: &SurfaceMesh<'_>) -> Option<HalfedgeId> {
        loop {
            let Some(entry) = self.heap.pop() else {
                self.refill()?;
                continue;
            };
            if surface.mesh.is_live_halfedge(entry.h)
                && entry.version == self.version(surface, entry.h)
            {
                return Some(entry.h);
            }
        }
    }

    fn push(&mut self, surface: &SurfaceMesh<'_>, quadrics: &[Quadric], h: HalfedgeId) {
        let h = h.min(surface.mesh.twin(h));
        self.refused[h.index()] = false;
        let version = self.version(surface, h);
        let entry = Entry { cost: merge(&surface.mesh, quadrics, h).cost, h, version };
        if self.limit.is_some_and(|limit| entry >= limit) {
            self.heap.push(entry);
        } else {
            self.waiting.push(entry);
        }
    }

    fn refuse(&mut self, h: HalfedgeId) {
        self.refused[h.index()] = true;
    }

    /// Before a collapse: makes the entries of all edges of both ends outdated.
    fn forget(&mut self, gone: VertexId, kept: VertexId) {
        let sum = self.versions[kept.index()].wrapping_add(self.versions[gone.index()]);
        self.versions[kept.index()] = sum.wrapping_add(1);
    }

    /// After a collapse: prices the edges of the merged vertex anew and gives refused edges around
    /// its neighbours another chance.
    fn renew(&mut self, surface: &SurfaceMesh<'_>, quadrics: &[Quadric], v: VertexId) {
        let mesh = &surface.mesh;
        for h in mesh.fan(v) {
            self.push(surface, quadrics, h);
            for g in mesh.fan(mesh.target(h)) {
                if self.refused[g.index()] || self.refused[mesh.twin(g).index()] {
                    self.push(surface, quadrics, g);
                }
            }
        }
    }
}
