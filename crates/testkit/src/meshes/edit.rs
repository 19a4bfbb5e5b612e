//! Random edits: other valences and other shapes.

use basemesh::{EdgeId, HalfedgeId, TriMesh, VertexId, VertexMap, triangle_quality};
use glam::DVec3;

/// A local change of connectivity at an edge, whose number is taken modulo the number of edges.
#[derive(Clone, Copy, Debug)]
pub enum Edit {
    /// The other diagonal of the two faces: one valence more at two vertices, one less at two.
    Flip(usize),
    /// A new vertex of valence four in the middle of the edge.
    Split(usize),
    /// The higher end is merged into the lower one; no quality is kept.
    Collapse(usize),
}

/// Fewest edges of a vertex after an edit.
const MIN_VALENCE: usize = 4;

/// The mesh after the edits that leave every vertex at least four edges and every new face at least
/// the quality `min_quality` (see [`triangle_quality`]); the others are left out.
#[must_use]
pub fn apply_edits(mesh: TriMesh, edits: &[Edit], min_quality: f64) -> TriMesh {
    edits.iter().fold(mesh, |mesh, edit| {
        let edge = |number: usize| EdgeId::new(number % mesh.topology().edge_count());
        let edited = match *edit {
            Edit::Flip(number) => flip(&mesh, edge(number), min_quality),
            Edit::Split(number) => split(&mesh, edge(number), min_quality),
            Edit::Collapse(number) => collapse(&mesh, edge(number)),
        };
        edited.unwrap_or(mesh)
    })
}

/// The four vertices of the two faces at an edge: its ends, and the corners left and right of it.
fn quadrilateral(mesh: &TriMesh, edge: EdgeId) -> Option<([HalfedgeId; 2], [VertexId; 4])> {
    let t = mesh.topology();
    let h = t.canonical(edge);
    let w = t.twin(h)?;
    let far = |h: HalfedgeId| t.origin(h.previous());
    Some(([h, w], [t.origin(h), t.target(h), far(h), far(w)]))
}

fn flip(mesh: &TriMesh, edge: EdgeId, min_quality: f64) -> Option<TriMesh> {
    let t = mesh.topology();
    let ([h, w], [a, b, c, d]) = quadrilateral(mesh, edge)?;
    let connected = t.fan(c).any(|spoke| t.target(spoke) == d);
    if connected || t.valence(a) <= MIN_VALENCE || t.valence(b) <= MIN_VALENCE {
        return None;
    }
    replace_faces(
        mesh,
        None,
        [h, w],
        &[[a, d, c], [d, b, c]].map(|f| f.map(VertexId::index)),
        min_quality,
    )
}

fn split(mesh: &TriMesh, edge: EdgeId, min_quality: f64) -> Option<TriMesh> {
    let (halfedges, corners) = quadrilateral(mesh, edge)?;
    let [a, b, c, d] = corners.map(VertexId::index);
    let middle = (mesh.position(corners[0]) + mesh.position(corners[1])) * 0.5;
    let m = mesh.positions().len();
    let faces = [[a, m, c], [m, b, c], [b, m, d], [m, a, d]];
    replace_faces(mesh, Some(middle), halfedges, &faces, min_quality)
}

/// Only where the result has the same topology and every vertex at least three edges.
fn collapse(mesh: &TriMesh, edge: EdgeId) -> Option<TriMesh> {
    let t = mesh.topology();
    let (_, [a, b, c, d]) = quadrilateral(mesh, edge)?;
    let neighbours = |v| t.fan(v).map(|h| t.target(h));
    let common = neighbours(a).filter(|&v| neighbours(b).any(|w| v == w)).count();
    if common != 2 || t.valence(a) + t.valence(b) < 7 || [c, d].iter().any(|&v| t.valence(v) < 4) {
        return None;
    }
    let [kept, gone] = if a < b { [a, b] } else { [b, a] };
    let renamed = |v: usize| match v {
        v if v == gone.index() => kept.index(),
        v => v - usize::from(v > gone.index()),
    };
    let mut positions = mesh.positions().as_slice().to_vec();
    positions.remove(gone.index());
    let faces = mesh.face_indices().into_iter().map(|face| face.map(renamed));
    let faces: Vec<[usize; 3]> = faces.filter(|[p, q, r]| p != q && q != r && r != p).collect();
    TriMesh::new(positions, &faces).ok()
}

/// The mesh with the faces of two half-edges replaced, if all new faces are good and turn by less
/// than a right angle against the old ones.
fn replace_faces(
    mesh: &TriMesh,
    vertex: Option<DVec3>,
    old: [HalfedgeId; 2],
    new: &[[usize; 3]],
    min_quality: f64,
) -> Option<TriMesh> {
    let mut positions = mesh.positions().as_slice().to_vec();
    positions.extend(vertex);
    let area = |[p, q, r]: [DVec3; 3]| (q - p).cross(r - p);
    let old_areas = old.map(|h| area(mesh.triangle(h.face())));
    let good = |face: &[usize; 3]| {
        let corners = face.map(|v| positions[v]);
        let upright = old_areas.iter().all(|old| area(corners).dot(*old) > 0.0);
        upright && triangle_quality(corners) >= min_quality
    };
    if !new.iter().all(good) {
        return None;
    }
    let removed = old.map(|h| h.face().index());
    let kept = mesh.face_indices().into_iter().enumerate();
    let mut faces: Vec<[usize; 3]> =
        kept.filter(|(f, _)| !removed.contains(f)).map(|(_, face)| face).collect();
    faces.extend(new);
    TriMesh::new(positions, &faces).ok()
}

/// The mesh with every vertex moved by up to `amount` times its shortest edge, in a direction that
/// `seed` decides; the same for the same seed.
#[must_use]
pub fn jittered(mesh: &TriMesh, amount: f64, seed: u64) -> TriMesh {
    let t = mesh.topology();
    let positions = VertexMap::from_fn(t.vertex_count(), |v| {
        let shortest = t.fan(v).map(|h| mesh.edge_length(t.edge(h))).fold(f64::INFINITY, f64::min);
        let unit = |axis: u64| 2.0 * random(seed ^ (3 * v.index() as u64 + axis)) - 1.0;
        mesh.position(v) + DVec3::new(unit(0), unit(1), unit(2)) * (amount * shortest)
    });
    mesh.clone().with_positions(positions).expect("finite positions")
}

/// A number in [0, 1) that looks random: the finisher of the splitmix64 generator.
fn random(seed: u64) -> f64 {
    let mut x = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
