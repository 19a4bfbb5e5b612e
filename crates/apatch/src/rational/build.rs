//! From the hull to all weights.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap};
use glam::DVec3;

use super::apex::{blocks_of, corner_normals, height, heights};
use super::base::BaseLayer;
use super::edge::{EdgePatch, EdgeSide, places};
use super::face::{FacePatch, FaceSide};
use super::free_weight::{Datum, bounded, neighbour_fit, wanted};
use super::hull::Hull;
use super::kinds::{Convexity, Side};
use super::repair::Repaired;
use super::report::{InvalidEdge, KindCounts, Report};
use super::settings::Settings;
use super::sheet::{Raise, edge_raise, face_bound, has_wrong_sign};
use super::surface::RationalSurface;

/// All weights over a hull.
pub(crate) fn surface(repaired: Repaired, settings: &Settings) -> RationalSurface {
    let hull = &repaired.hull;
    // tensions belong to the faces that were given: a step of Loop's scheme makes four of each
    let given = |face: FaceId| face.index() >> (2 * repaired.loop_steps);
    let tension = |face| settings.shape.of(given(face));
    let faces =
        FaceMap::from_fn(hull.kinds.len(), |face| face_patch(hull, face, tension(face), settings));
    let edges = EdgeMap::from_fn(hull.edges.len(), |edge| edge_patch(hull, &faces, edge));
    let report = first_report(&repaired, &faces, &edges);
    let Hull { mesh, normals, .. } = repaired.hull;
    let mut surface = RationalSurface { mesh, normals, faces, edges, report };
    sweep(&mut surface, settings);
    surface
}

/// One face with its tetrahedra.
pub(crate) fn face_patch(
    hull: &Hull,
    face: FaceId,
    tension: f64,
    settings: &Settings,
) -> FacePatch {
    let frame = &hull.frames[face];
    let convexity = hull.kinds[face];
    let blocks = blocks_of(&hull.mesh, &hull.blocks, face);
    let normals = corner_normals(&hull.mesh, &hull.normals, face);
    let e = edge_weights(hull, face);
    let base = |split| BaseLayer::new(e, &frame.corners, frame.centroid, blocks, split);
    let mut layer0 = base(settings.always_split || convexity == Convexity::Nonconvex);
    let mut apices = hull.apices[face];
    let known = apices.iter().flatten().next().copied();
    let promoted = known.is_some_and(|apex| {
        let scale = size_of_values(apex, &frame.corners, normals);
        is_wrong_inside(convexity, &layer0, scale, settings)
    });
    if promoted {
        layer0 = base(true);
        // both apices on one line through the centroid, as smoothness asks
        let up = known.map_or(frame.normal, |apex| apex - frame.centroid);
        let direction = up / up.dot(frame.normal);
        let heights = heights(frame, direction, normals, blocks);
        for side in Side::BOTH {
            let height = height(frame, &heights, side, &settings.apices);
            apices[side.index()].get_or_insert(frame.centroid + direction * height);
        }
    }
    let sides = Side::BOTH.map(|side| {
        let apex = apices[side.index()]?;
        let height = (apex - frame.centroid).dot(frame.normal);
        let mut s = FaceSide::new(apex, height, &frame.corners, normals, blocks, &layer0);
        s.neighbours = neighbour_fit(&layer0, &s, &frame.corners, frame.size, opposite(hull, face));
        s.bound = face_bound(&layer0, &s, side, &settings.sheet);
        let wanted = wanted(&s, side.sign(), settings.rule);
        let free = bounded(wanted, s.bound, settings.sheet.margin, s.scale(), tension);
        s.set_free(side.sign() * free);
        Some(s)
    });
    FacePatch { corners: frame.corners, convexity, promoted, base: layer0, sides }
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
fn opposite(hull: &Hull, face: FaceId) -> impl Iterator<Item = Datum> {
    let topology = hull.mesh.topology();
    face.halfedges().into_iter().filter_map(|h| topology.twin(h)).map(|twin| {
        let vertex = topology.origin(twin.previous());
        (hull.mesh.position(vertex), hull.normals[vertex])
    })
}

/// One edge with its tetrahedra.
pub(crate) fn edge_patch(hull: &Hull, faces: &FaceMap<FacePatch>, edge: EdgeId) -> EdgePatch {
    let topology = hull.mesh.topology();
    let [i, j] = topology.edge_vertices(edge);
    let data = &hull.edges[edge];
    let [lower, higher] = data.weights;
    let places = places(topology, topology.canonical(edge));
    let sides = Side::BOTH.map(|side| {
        let places = places.filter(|_| data.convexity.has(side))?;
        let patches = places.map(|p| &faces[p.face]);
        let [Some(left), Some(right)] = patches.map(|p| p.sides[side.index()].as_ref()) else {
            return None;
        };
        let mut s = EdgeSide::new(places, patches, [left, right]);
        // a promoted face has another apex only on a side where its edges need no tetrahedron
        let wedge = hull.wedges[edge][side.index()]?;
        (s.opening, s.angle) = (wedge.opening, wedge.angle);
        Some(s)
    });
    EdgePatch {
        ends: [i, j].map(|v| hull.mesh.position(v)),
        convexity: data.convexity,
        weights: if i < j { [lower, higher] } else { [higher, lower] },
        sides,
    }
}

fn first_report(
    repaired: &Repaired,
    faces: &FaceMap<FacePatch>,
    edges: &EdgeMap<EdgePatch>,
) -> Report {
    let hull = &repaired.hull;
    let topology = hull.mesh.topology();
    let invalid = |&(edge, side, angle): &(EdgeId, Side, f64)| InvalidEdge {
        edge: edge.index(),
        vertices: topology.edge_vertices(edge).map(basemesh::VertexId::index),
        side,
        angle,
    };
    let face_sides = || faces.iter().flat_map(|(_, f)| Side::BOTH.map(|s| (s, f.sides[s.index()])));
    let count = |sides: &[Option<EdgeSide>; 2]| sides.iter().flatten().count();
    Report {
        faces: KindCounts::of(faces.iter().map(|(_, f)| f.convexity)),
        edges: KindCounts::of(edges.iter().map(|(_, e)| e.convexity)),
        face_tetrahedra: face_sides().filter(|(_, s)| s.is_some()).count(),
        edge_tetrahedra: edges.iter().map(|(_, e)| count(&e.sides)).sum(),
        normals: repaired.normals,
        loop_steps: repaired.loop_steps,
        moved_apices: hull.moved,
        invalid_edges: hull.invalid.iter().map(invalid).collect(),
        behind: hull.behind.iter().map(|f| f.index()).collect(),
        promoted: faces.iter().filter(|(_, f)| f.promoted).map(|(f, _)| f.index()).collect(),
        ..Report::default()
    }
}

/// Raises free weights until every transversal of every edge crosses the surface once
/// \[XHB01 Step 6\]*: edge by edge with the weights as they are.
fn sweep(surface: &mut RationalSurface, settings: &Settings) {
    let raise_of = |patch: &EdgePatch, side: Side| match &patch.sides[side.index()] {
        Some(s) => edge_raise(s, patch.weights, side, &settings.sheet),
        None => Raise::Nothing,
    };
    let wants = |patch: &EdgePatch| Side::BOTH.map(|side| raise_of(patch, side));
    let mut asks = surface.edges.map(|_, patch| wants(patch));
    let mut raised = vec![[false; 2]; surface.edges.len()];
    for _ in 0..settings.sheet.max_sweeps {
        let asking: Vec<EdgeId> = asks
            .iter()
            .filter(|(_, a)| a.iter().any(|r| matches!(r, Raise::By(_))))
            .map(|(edge, _)| edge)
            .collect();
        if asking.is_empty() {
            break;
        }
        surface.report.sweeps += 1;
        let mut touched = Vec::new();
        for edge in asking {
            for side in Side::BOTH {
                if let Raise::By(by) = raise_of(&surface.edges[edge], side) {
                    touched.extend(raise(surface, edge, side, by, settings.sheet.margin));
                    raised[edge.index()][side.index()] = true;
                }
            }
        }
        touched.sort_unstable();
        touched.dedup();
        for edge in touched {
            asks[edge] = wants(&surface.edges[edge]);
        }
    }
    surface.report.raised_edges = raised.iter().flatten().filter(|r| **r).count();
    let left = asks.iter().filter(|(_, a)| a.iter().any(|r| *r != Raise::Nothing));
    surface.report.not_single = left.map(|(edge, _)| edge.index()).collect();
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
            s.set_free(s.free + side.sign() * (by + margin * scale));
        }
    }
    let mut seen: Vec<EdgeId> =
        both.iter().flat_map(|p| p.face.halfedges()).map(|h| topology.edge(h)).collect();
    seen.sort_unstable();
    seen.dedup();
    for &edge in &seen {
        let Some(both) = places(topology, topology.canonical(edge)) else { continue };
        let sides = both.map(|p| surface.faces[p.face].sides[side.index()]);
        let ([Some(left), Some(right)], Some(s)) =
            (&sides, &mut surface.edges[edge].sides[side.index()])
        else {
            continue;
        };
        s.update(both, [left, right]);
    }
    seen
}
