//! From the hull to all weights.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap};
use glam::DVec3;

use super::apex::{blocks_of, corner_normals, height, heights};
use super::base::BaseLayer;
use super::edge::{EdgeRecord, EdgeSide, left_weights, other_apices, places};
use super::face::{FaceRecord, FaceSide};
use super::free_weight::{Datum, bounded, least, neighbour_fit, wanted};
use super::hull::Hull;
use super::kinds::{Convexity, Side};
use super::repair::Repaired;
use super::report::{InvalidEdge, KindCounts, Report};
use super::settings::{Settings, SheetSettings};
use super::sheet::{FaceGrid, Raise, edge_raise, face_bound, has_wrong_sign};
use super::surface::RationalSurface;

/// All weights over a hull.
pub(crate) fn surface(repaired: Repaired, settings: &Settings) -> RationalSurface {
    let hull = &repaired.hull;
    // tensions belong to the faces that were given: a step of Loop's scheme makes four of each
    let given = |face: FaceId| face.index() >> (2 * repaired.loop_steps);
    let tension = |face| settings.shape.of(given(face));
    let grid = FaceGrid::new(settings.sheet.grid);
    let faces = FaceMap::from_fn(hull.faces.len(), |face| {
        face_record(hull, face, tension(face), &grid, settings)
    });
    let edges =
        EdgeMap::from_fn(hull.edges.len(), |edge| edge_record(hull, &faces, edge, &settings.sheet));
    let report = first_report(&repaired, &faces, &edges, settings.sheet.margin);
    let Hull { mesh, normals, .. } = repaired.hull;
    let mut surface = RationalSurface { mesh, normals, faces, edges, report };
    sweep(&mut surface, settings);
    surface
}

/// One face with its tetrahedra.
fn face_record(
    hull: &Hull,
    face: FaceId,
    tension: f64,
    grid: &FaceGrid,
    settings: &Settings,
) -> FaceRecord {
    let frame = hull.frame(face);
    let convexity = hull.faces[face].kind;
    let blocks = blocks_of(&hull.mesh, &hull.edges, face);
    let normals = corner_normals(&hull.mesh, &hull.normals, face);
    let e = edge_weights(hull, face);
    let g = std::array::from_fn(|c| blocks[c].at(frame.corners[c]));
    let mut split = settings.always_split || convexity == Convexity::Nonconvex;
    let mut base = BaseLayer::new(e, g, split);
    let mut apices = hull.faces[face].apices;
    let known = apices.iter().flatten().next().copied();
    let promoted = known.is_some_and(|apex| {
        let scale = size_of_values(apex, &frame.corners, normals);
        is_wrong_inside(convexity, &base, scale, settings)
    });
    if promoted {
        split = true;
        base = BaseLayer::new(e, g, split);
        // both apices on one line through the centroid, as smoothness asks
        let up = known.map_or(frame.normal, |apex| apex - frame.centroid);
        let direction = up / up.dot(frame.normal);
        let heights = heights(&frame, direction, normals, blocks);
        for side in Side::BOTH {
            let height = height(&frame, &heights, side, &settings.apices);
            apices[side.index()].get_or_insert(frame.centroid + direction * height);
        }
    }
    let opposite = opposite(hull, face);
    let sides = Side::BOTH.map(|side| {
        let apex = apices[side.index()]?;
        let mut s = FaceSide::new(apex, &frame.corners, normals, blocks, &base);
        s.neighbours = neighbour_fit(&base, &s, &frame, &opposite);
        s.bound = face_bound(&base, &s, side, grid, &settings.sheet);
        let wanted = wanted(&base, &s, side.sign(), settings.rule);
        let free = bounded(wanted, s.bound, settings.sheet.margin, s.scale(), tension);
        s.free = side.sign() * free;
        Some(s.record())
    });
    FaceRecord { e, g, convexity, promoted, split, sides }
}

/// [`FaceSide::scale`] of the tetrahedron with this apex.
fn size_of_values(apex: DVec3, corners: &[DVec3; 3], normals: [DVec3; 3]) -> f64 {
    let heights = corners.iter().zip(normals).map(|(&corner, n)| (apex - corner).dot(n).abs());
    heights.fold(0.0, f64::max)
}

/// Whether the function on a convex face has the other sign somewhere inside; `scale` is its size.
fn is_wrong_inside(
    convexity: Convexity,
    base: &BaseLayer,
    scale: f64,
    settings: &Settings,
) -> bool {
    let side = match convexity {
        Convexity::Positive => Side::Positive,
        Convexity::Negative => Side::Negative,
        Convexity::Nonconvex | Convexity::Zero => return false,
    };
    // weights on the edges have the right sign: only the middle ones can spoil it
    base.middle_weights().iter().any(|g| side.sign() * g > 0.0)
        && has_wrong_sign(base, scale, side, settings.sheet.grid)
}

/// Weights on the edges of a face: for each corner, towards the next and the previous one.
fn edge_weights(hull: &Hull, face: FaceId) -> [[f64; 2]; 3] {
    let topology = hull.mesh.topology();
    let corners = topology.corners(face);
    let weight = |from: usize, to: usize, h: usize| {
        let weights = hull.edges[topology.edge(face.halfedge(h))].weights;
        weights[usize::from(corners[from] > corners[to])]
    };
    [0, 1, 2].map(|a| {
        let [next, previous] = super::base::others(a);
        [weight(a, next, a), weight(a, previous, previous)]
    })
}

/// The vertices opposite to the edges of a face, with their gradients.
fn opposite(hull: &Hull, face: FaceId) -> [Option<Datum>; 3] {
    let topology = hull.mesh.topology();
    face.halfedges().map(|h| {
        let vertex = topology.origin(topology.twin(h)?.previous());
        Some((hull.mesh.position(vertex), hull.normals[vertex]))
    })
}

/// One edge with the places of its tetrahedra.
fn edge_record(
    hull: &Hull,
    faces: &FaceMap<FaceRecord>,
    edge: EdgeId,
    settings: &SheetSettings,
) -> EdgeRecord {
    let topology = hull.mesh.topology();
    let convexity = hull.edges[edge].convexity;
    let places = places(topology, topology.canonical(edge));
    let mut record = EdgeRecord { convexity, single: [true; 2], apices: [None; 2] };
    for side in Side::BOTH.into_iter().filter(|&side| convexity.has(side)) {
        let Some(places) = places else { continue };
        let sides = places.map(|p| faces[p.face].sides[side.index()].as_ref().map(|s| s.apex));
        let [Some(left), Some(right)] = sides else { continue };
        let corners = places.map(|p| hull.mesh.triangle(p.face));
        let apices = other_apices(places, corners, [left, right]);
        record.apices[side.index()] = Some(apices);
        let raise = EdgeSide::of_faces(places, faces, side, apices)
            .map(|s| edge_raise(&s, left_weights(places, faces), side, settings));
        record.single[side.index()] = raise.is_none_or(|raise| raise == Raise::Nothing);
    }
    record
}

fn first_report(
    repaired: &Repaired,
    faces: &FaceMap<FaceRecord>,
    edges: &EdgeMap<EdgeRecord>,
    margin: f64,
) -> Report {
    let hull = &repaired.hull;
    let topology = hull.mesh.topology();
    let invalid = |&(edge, side, angle): &(EdgeId, Side, f64)| InvalidEdge {
        edge: edge.index(),
        vertices: topology.edge_vertices(edge).map(basemesh::VertexId::index),
        side,
        angle,
    };
    let mut report = Report {
        faces: KindCounts::of(hull.faces.as_slice().iter().map(|f| f.kind)),
        edges: KindCounts::of(hull.edges.as_slice().iter().map(|e| e.convexity)),
        normals: repaired.normals,
        loop_steps: repaired.loop_steps,
        moved_apices: hull.moved,
        invalid_edges: hull.invalid.iter().map(invalid).collect(),
        behind: hull.behind.iter().map(|f| f.index()).collect(),
        ..Report::default()
    };
    for (face, record) in faces.iter() {
        report.face_tetrahedra += record.sides.iter().flatten().count();
        report.bounded_faces += bounded_sides(record, margin);
        if record.promoted {
            report.promoted.push(face.index());
        }
    }
    for (_, record) in edges.iter() {
        report.edge_tetrahedra += record.apices.iter().flatten().count();
    }
    report
}

/// Number of tetrahedra of a face whose free weight is the least one that the bound allows.
fn bounded_sides(face: &FaceRecord, margin: f64) -> usize {
    let bounded = |side: &Side| {
        let s = face.sides[side.index()].as_ref();
        s.is_some_and(|s| side.sign() * s.free == least(s.bound, margin, s.scale()))
    };
    Side::BOTH.iter().filter(|side| bounded(side)).count()
}

/// Raises free weights until every transversal of every edge crosses the surface once
/// \[XHB01 Step 6\]*: edge by edge with the weights as they are.
fn sweep(surface: &mut RationalSurface, settings: &Settings) {
    let is_open = |surface: &RationalSurface, edge: EdgeId| surface.edges[edge].single != [true; 2];
    let edges = surface.mesh.topology().edges();
    let mut open: Vec<EdgeId> = edges.filter(|&edge| is_open(surface, edge)).collect();
    let mut raised = std::collections::BTreeSet::new();
    for _ in 0..settings.sheet.max_sweeps {
        let mut touched = Vec::new();
        for &edge in &open {
            for side in Side::BOTH {
                if let Raise::By(by) = raise_of(surface, edge, side, settings) {
                    touched.extend(raise(surface, edge, side, by, settings.sheet.margin));
                    raised.insert((edge, side));
                }
            }
        }
        if touched.is_empty() {
            break;
        }
        surface.report.sweeps += 1;
        touched.sort_unstable();
        touched.dedup();
        for &edge in &touched {
            surface.edges[edge].single =
                Side::BOTH.map(|side| raise_of(surface, edge, side, settings) == Raise::Nothing);
        }
        open.extend(touched);
        open.sort_unstable();
        open.dedup();
        open.retain(|&edge| is_open(surface, edge));
    }
    surface.report.raised_edges = raised.len();
    surface.report.not_single = open.into_iter().map(EdgeId::index).collect();
}

fn raise_of(surface: &RationalSurface, edge: EdgeId, side: Side, settings: &Settings) -> Raise {
    match surface.edge_side(edge, side) {
        Some(s) => edge_raise(&s, surface.edge_weights(edge), side, &settings.sheet),
        None => Raise::Nothing,
    }
}

/// Raises the free weights of both faces of an edge, and returns all edges that see them.
fn raise(
    surface: &mut RationalSurface,
    edge: EdgeId,
    side: Side,
    by: f64,
    margin: f64,
) -> Vec<EdgeId> {
    let topology = surface.mesh.topology();
    let Some(both) = places(topology, topology.canonical(edge)) else { return Vec::new() };
    let scale = both
        .iter()
        .filter_map(|p| surface.faces[p.face].sides[side.index()].as_ref())
        .fold(0.0, |scale: f64, s| scale.max(s.scale()));
    for place in both {
        if let Some(s) = &mut surface.faces[place.face].sides[side.index()] {
            s.free += side.sign() * (by + margin * scale);
        }
    }
    both.iter().flat_map(|p| p.face.halfedges()).map(|h| topology.edge(h)).collect()
}
