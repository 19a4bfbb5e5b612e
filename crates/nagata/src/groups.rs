//! Estimated normals: corners in groups separated by creases, one normal for each group.

use basemesh::{FaceId, VertexId};
use glam::DVec3;

use crate::corner_normals::CornerNormals;
use crate::ids::Side;
use crate::polygon_mesh::PolygonMesh;
use crate::unit::{angle, unit};

impl CornerNormals {
    /// Normals estimated from the mesh alone.
    ///
    /// Two faces belong together at their edge if their normals differ by less than `crease_angle`
    /// (radians) there; edges with another number of faces than two separate. The corners around a
    /// vertex that hang together have one normal, the sum of `(e1 × e2) / (|e1|² |e2|²)` over the
    /// corners with edges `e1`, `e2` \[Max99\]: exact on spheres, better than weights by area or
    /// angle elsewhere, and usually what limits the accuracy of the surface.
    ///
    /// The angle must exceed the turning from face to face on coarse round parts, 2π/n for n
    /// segments around. A group whose sum vanishes has no normal.
    #[must_use]
    pub fn estimated(mesh: &PolygonMesh, crease_angle: f64) -> Self {
        let mut groups = Groups::new(mesh.slot_count());
        for edge in mesh.edges() {
            let mut sides = mesh.sides_at(edge);
            if let (Some(a), Some(b), None) = (sides.next(), sides.next(), sides.next())
                && mesh.runs_forward(a) != mesh.runs_forward(b)
                && angle(area_normal(mesh, a.face), area_normal(mesh, b.face)) < crease_angle
            {
                for (a, b) in [(a, end_corner(mesh, b)), (end_corner(mesh, a), b)] {
                    groups.join(mesh.slot(a), mesh.slot(b));
                }
            }
        }
        let mut sums = vec![DVec3::ZERO; mesh.slot_count()];
        for side in mesh.faces().flat_map(|f| mesh.sides(f)) {
            sums[groups.root(mesh.slot(side))] += max_weighted(mesh, side);
        }
        let normals: Vec<Option<DVec3>> = sums.into_iter().map(unit).collect();
        let roots = groups.roots();
        Self::from_groups(&normals, roots.into_iter().map(Some))
    }

    /// The same normals, with another choice for the normals at conical apexes.
    ///
    /// An apex has no tangent plane. What serves best there depends on the purpose: [`Apex`].
    #[must_use]
    pub fn with_apexes(self, mesh: &PolygonMesh, apexes: &[VertexId], choice: Apex) -> Self {
        let mut is_apex = vec![false; mesh.vertex_count()];
        apexes.iter().for_each(|v| is_apex[v.index()] = true);
        let mut axes = vec![DVec3::ZERO; if choice == Apex::Axis { is_apex.len() } else { 0 }];
        if choice == Apex::Axis {
            for side in mesh.faces().flat_map(|f| mesh.sides(f)) {
                axes[mesh.ends(side)[0].index()] += max_weighted(mesh, side);
            }
        }
        let given = self.clone();
        self.with_changed(mesh, |side, vertex| {
            is_apex[vertex.index()].then(|| match choice {
                Apex::NoNormal => None,
                Apex::FaceNormals => unit(
                    mesh.sides(side.face)
                        .filter(|other| *other != side)
                        .filter_map(|other| given.at(mesh, other.face, other.corner))
                        .sum(),
                ),
                Apex::Axis => unit(axes[vertex.index()]),
            })
        })
    }
}

/// The normals at a conical apex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Apex {
    /// None: rulings are straight and the patches regular; order 3 in position, kinks of order 1 at
    /// the apex. Suits finite elements.
    NoNormal,
    /// For each face its own, the mean of those at its other corners: the patches are exact cones over
    /// their base arcs, six times more accurate and without kinks, but their derivatives vanish at
    /// the apex. (The normal of the flat face would not do: it is orthogonal to the rulings and leaves
    /// them as they are.)
    FaceNormals,
    /// The axis: the same surface as with face normals as long as the rulings are straight.
    Axis,
}

/// Vertices at which every face turns by more than `angle` (radians) from the estimated normal of
/// the whole vertex: the apexes of cones, among others.
#[must_use]
pub fn apexes(mesh: &PolygonMesh, smallest: f64) -> Vec<VertexId> {
    let mut axes = vec![DVec3::ZERO; mesh.vertex_count()];
    let sides = || mesh.faces().flat_map(|f| mesh.sides(f));
    for side in sides() {
        axes[mesh.ends(side)[0].index()] += max_weighted(mesh, side);
    }
    let mut least = vec![f64::INFINITY; mesh.vertex_count()];
    for side in sides() {
        let vertex = mesh.ends(side)[0].index();
        least[vertex] = least[vertex].min(angle(max_weighted(mesh, side), axes[vertex]));
    }
    mesh.vertices()
        .filter(|v| least[v.index()] > smallest && least[v.index()] < f64::INFINITY)
        .collect()
}

/// The corner where a side ends, as the side that starts there.
fn end_corner(mesh: &PolygonMesh, side: Side) -> Side {
    let count = mesh.corners(side.face).len();
    Side { corner: (side.corner + 1) % count, ..side }
}

/// Twice the area times the normal of the flat face; for a quadrilateral, of its mean plane.
pub(crate) fn area_normal(mesh: &PolygonMesh, face: FaceId) -> DVec3 {
    let corners = mesh.corners(face);
    let p = |c: usize| mesh.position(corners[c]);
    if corners.len() == 3 {
        (p(1) - p(0)).cross(p(2) - p(0))
    } else {
        (p(2) - p(0)).cross(p(3) - p(1))
    }
}

/// The corner's contribution to the normal of its vertex \[Max99\]; zero if an edge has no length.
fn max_weighted(mesh: &PolygonMesh, corner: Side) -> DVec3 {
    let corners = mesh.corners(corner.face);
    let at = |step: usize| mesh.position(corners[(corner.corner + step) % corners.len()]);
    let e1 = at(1) - at(0);
    let e2 = at(corners.len() - 1) - at(0);
    let weight = e1.length_squared() * e2.length_squared();
    if weight > 0.0 && weight.is_finite() { e1.cross(e2) / weight } else { DVec3::ZERO }
}

/// Corner slots by vertex: where each vertex starts, and the slots. Slots left over are left out.
pub(crate) fn slots_by_vertex(mesh: &PolygonMesh) -> (Vec<u32>, Vec<u32>) {
    let corners =
        || mesh.faces().flat_map(|f| mesh.sides(f)).map(|s| (mesh.slot(s), mesh.ends(s)[0]));
    let mut starts = vec![0_u32; mesh.vertex_count() + 1];
    corners().for_each(|(_, v)| starts[v.index() + 1] += 1);
    for v in 0..mesh.vertex_count() {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut slots = vec![0; starts[mesh.vertex_count()] as usize];
    for (slot, vertex) in corners() {
        let at = &mut next[vertex.index()];
        slots[*at as usize] = u32::try_from(slot).expect("invariant: element counts fit 32 bits");
        *at += 1;
    }
    (starts, slots)
}

/// Disjoint sets of corner slots; the root of a set is its lowest member.
struct Groups(Vec<u32>);

impl Groups {
    fn new(count: usize) -> Self {
        Self((0..u32::try_from(count).expect("invariant: element counts fit 32 bits")).collect())
    }

    fn root(&mut self, slot: usize) -> usize {
        let mut at = slot;
        while self.0[at] as usize != at {
            self.0[at] = self.0[self.0[at] as usize];
            at = self.0[at] as usize;
        }
        at
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = self.0[a.min(b)];
    }

    fn roots(mut self) -> Vec<usize> {
        (0..self.0.len()).map(|slot| self.root(slot)).collect()
    }
}
