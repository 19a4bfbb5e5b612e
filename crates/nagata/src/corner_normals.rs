//! Normals by corner of face: corners that share one are smooth there, others meet in a crease.

use basemesh::{EdgeId, FaceId, VertexId};
use glam::DVec3;

use crate::error::NormalsError;
use crate::groups::slots_by_vertex;
use crate::ids::{NormalId, Side};
use crate::polygon_mesh::PolygonMesh;
use crate::unit::{angle, unit};

/// Stands for "no normal".
const NONE: u32 = u32::MAX;

/// A unit normal, or none, for each corner of each face of a mesh.
///
/// Which corners share a normal is decided by its id, never by comparing numbers. Faces that share
/// the normals at both ends of their edge are smooth across it; otherwise the edge is a crease. A
/// normal and its negative give the same surface.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerNormals {
    normals: Vec<DVec3>,
    /// The normal of each corner slot; `None` if normal `v` belongs to all corners at vertex `v`.
    of_slot: Option<Vec<u32>>,
}

impl CornerNormals {
    /// Normals of a file closer than this angle at one vertex are one normal with noise, in radians:
    /// half a degree.
    pub const MERGE_ANGLE: f64 = std::f64::consts::PI / 360.0;

    /// One normal for each vertex: a smooth surface. They are normalised.
    ///
    /// # Errors
    ///
    /// If there is not one for each vertex, or one is zero or not finite.
    pub fn per_vertex(mesh: &PolygonMesh, normals: &[DVec3]) -> Result<Self, NormalsError> {
        if normals.len() != mesh.vertex_count() {
            let (given, expected) = (normals.len(), mesh.vertex_count());
            return Err(NormalsError::Count { what: "normals", given, expected });
        }
        Ok(Self { normals: normalised(normals)?, of_slot: None })
    }

    /// The normal that `normal` returns for the position of each vertex, for example the gradient of
    /// an implicit function; vertices where it returns `None` (or zero, or no number) have none.
    #[must_use]
    pub fn from_fn(mesh: &PolygonMesh, normal: impl Fn(DVec3) -> Option<DVec3>) -> Self {
        let of_vertex: Vec<Option<DVec3>> =
            mesh.vertices().map(|v| normal(mesh.position(v)).and_then(unit)).collect();
        if let Some(normals) = of_vertex.iter().copied().collect() {
            return Self { normals, of_slot: None };
        }
        let of_slot = mesh.slots().iter().map(|v| Some(v.index()));
        Self::from_groups(&of_vertex, of_slot)
    }

    /// Normals by index, as in files: `corners` holds for each face the index of the normal at each
    /// corner. Normals at one vertex closer than `merge_angle` (radians, see
    /// [`MERGE_ANGLE`](Self::MERGE_ANGLE)) become one: the normalised sum.
    ///
    /// Two nearly equal normals at one end of an edge would look like a crease with a tangent that
    /// nothing determines.
    ///
    /// # Errors
    ///
    /// If numbers of faces or corners differ from the mesh, an index is out of range, or a normal
    /// that is used is zero or not finite.
    pub fn from_corners<C: AsRef<[Option<usize>]>>(
        mesh: &PolygonMesh,
        normals: &[DVec3],
        corners: &[C],
        merge_angle: f64,
    ) -> Result<Self, NormalsError> {
        let given = given_indices(mesh, normals.len(), corners)?;
        let mut used = vec![false; normals.len()];
        given.iter().flatten().for_each(|&index| used[index] = true);
        let units: Vec<DVec3> = normals.iter().map(|&n| unit(n).unwrap_or(DVec3::ZERO)).collect();
        if let Some(index) = (0..normals.len()).find(|&i| used[i] && units[i] == DVec3::ZERO) {
            return Err(NormalsError::NotUsable { index, normal: normals[index] });
        }
        let mut of_slot = vec![None; mesh.slot_count()];
        let mut groups = Vec::new();
        let (starts, slots) = slots_by_vertex(mesh);
        for range in starts.windows(2) {
            let here = &slots[range[0] as usize..range[1] as usize];
            let first_group = groups.len();
            let mut indices: Vec<usize> = here.iter().filter_map(|&s| given[s as usize]).collect();
            indices.sort_unstable();
            indices.dedup();
            let group_of = merged(&indices, &units, merge_angle, &mut groups);
            for &slot in here {
                of_slot[slot as usize] = given[slot as usize].map(|index| {
                    let at = indices.binary_search(&index).expect("invariant: collected above");
                    first_group + group_of[at]
                });
            }
        }
        let groups: Vec<Option<DVec3>> = groups.into_iter().map(unit).collect();
        Ok(Self::from_groups(&groups, of_slot.into_iter()))
    }

    /// One normal for each group of corners; groups without a normal leave their corners without.
    pub(crate) fn from_groups(
        groups: &[Option<DVec3>],
        of_slot: impl Iterator<Item = Option<usize>>,
    ) -> Self {
        let mut normals = Vec::with_capacity(groups.len());
        let ids: Vec<u32> = groups
            .iter()
            .map(|group| {
                group.map_or(NONE, |normal| {
                    normals.push(normal);
                    short(normals.len() - 1)
                })
            })
            .collect();
        let of_slot = of_slot.map(|group| group.map_or(NONE, |g| ids[g])).collect();
        normals.shrink_to_fit();
        Self { normals, of_slot: Some(of_slot) }
    }

    /// The same normals with others at some corners: `changed` returns, for each corner of the
    /// slots it wants to change, the new normal or `None` for no normal there.
    pub(crate) fn with_changed(
        self,
        mesh: &PolygonMesh,
        mut changed: impl FnMut(Side, VertexId) -> Option<Option<DVec3>>,
    ) -> Self {
        let Self { mut normals, of_slot } = self;
        let mut of_slot =
            of_slot.unwrap_or_else(|| mesh.slots().iter().map(|v| short(v.index())).collect());
        for side in mesh.faces().flat_map(|f| mesh.sides(f)) {
            let [vertex, _] = mesh.ends(side);
            if let Some(normal) = changed(side, vertex) {
                of_slot[mesh.slot(side)] = normal.map_or(NONE, |normal| {
                    normals.push(normal);
                    short(normals.len() - 1)
                });
            }
        }
        Self { normals, of_slot: Some(of_slot) }
    }

    /// All normals by id; unit vectors.
    #[must_use]
    pub fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// The normal of this id.
    #[inline]
    #[must_use]
    pub fn normal(&self, id: NormalId) -> DVec3 {
        self.normals[id.index()]
    }

    /// The id of the normal at a corner of a face; `None` if it has none.
    #[inline]
    #[must_use]
    pub fn id(&self, mesh: &PolygonMesh, face: FaceId, corner: usize) -> Option<NormalId> {
        self.slot_id(mesh, mesh.slot(Side { face, corner }))
    }

    /// The normal at a corner of a face; `None` if it has none.
    #[inline]
    #[must_use]
    pub fn at(&self, mesh: &PolygonMesh, face: FaceId, corner: usize) -> Option<DVec3> {
        self.id(mesh, face, corner).map(|id| self.normal(id))
    }

    /// The normals that an edge must respect at its lower and its higher vertex, each once and
    /// ascending by id: those of the corners, there, of the faces that contain the edge.
    #[must_use]
    pub fn ids_at_edge(&self, mesh: &PolygonMesh, edge: EdgeId) -> [Vec<NormalId>; 2] {
        let mut ids = [Vec::new(), Vec::new()];
        for slots in mesh.end_slots(edge) {
            for (ids, slot) in ids.iter_mut().zip(slots) {
                ids.extend(self.slot_id(mesh, slot));
            }
        }
        for ids in &mut ids {
            ids.sort_unstable();
            ids.dedup();
        }
        ids
    }

    /// The normal of each vertex, if all corners at it share it.
    pub(crate) fn of_vertices(&self) -> Option<&[DVec3]> {
        self.of_slot.is_none().then_some(&*self.normals)
    }

    /// The two normals of an edge with exactly one at each end, which most edges have.
    #[inline]
    pub(crate) fn one_each(&self, mesh: &PolygonMesh, edge: EdgeId) -> Option<[DVec3; 2]> {
        let Some(of_slot) = &self.of_slot else {
            return Some(mesh.edge_vertices(edge).map(|v| self.normals[v.index()]));
        };
        let mut ends = mesh.end_slots(edge).map(|slots| slots.map(|slot| of_slot[slot]));
        let first = ends.next()?;
        (!first.contains(&NONE) && ends.all(|other| other == first))
            .then(|| first.map(|id| self.normals[id as usize]))
    }

    /// Whether these are normals of a mesh with such vertices and corners.
    pub(crate) fn check(&self, mesh: &PolygonMesh) -> Result<(), NormalsError> {
        let (what, given, expected) = match &self.of_slot {
            None => ("normals", self.normals.len(), mesh.vertex_count()),
            Some(of_slot) => ("corners with normals", of_slot.len(), mesh.slot_count()),
        };
        if given == expected {
            return Ok(());
        }
        Err(NormalsError::Count { what, given, expected })
    }

    /// Bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.normals) + self.of_slot.as_ref().map_or(0, |ids| size_of_val(&**ids))
    }

    #[inline]
    fn slot_id(&self, mesh: &PolygonMesh, slot: usize) -> Option<NormalId> {
        match &self.of_slot {
            None => Some(NormalId::new(mesh.slots()[slot].index())),
            Some(of_slot) => {
                let id = of_slot[slot];
                (id != NONE).then(|| NormalId::new(id as usize))
            }
        }
    }
}

fn short(n: usize) -> u32 {
    u32::try_from(n).expect("invariant: normal counts fit 32 bits")
}

fn normalised(normals: &[DVec3]) -> Result<Vec<DVec3>, NormalsError> {
    let checked = |(index, &normal): (usize, &DVec3)| {
        unit(normal).ok_or(NormalsError::NotUsable { index, normal })
    };
    normals.iter().enumerate().map(checked).collect()
}

/// The index given for each slot, checked.
fn given_indices<C: AsRef<[Option<usize>]>>(
    mesh: &PolygonMesh,
    count: usize,
    corners: &[C],
) -> Result<Vec<Option<usize>>, NormalsError> {
    let differs = |what, given, expected| Err(NormalsError::Count { what, given, expected });
    if count >= NONE as usize {
        return Err(NormalsError::TooMany { given: count, max: NONE as usize - 1 });
    }
    if corners.len() != mesh.face_count() {
        return differs("faces with normals", corners.len(), mesh.face_count());
    }
    let mut given = vec![None; mesh.slot_count()];
    for face in mesh.faces() {
        let here = corners[face.index()].as_ref();
        let expected = mesh.corners(face).len();
        if here.len() != expected {
            return differs("corners with normals in a face", here.len(), expected);
        }
        for (corner, &index) in here.iter().enumerate() {
            if let Some(normal) = index.filter(|&n| n >= count) {
                let face = face.index();
                return Err(NormalsError::MissingNormal { face, corner, normal, count });
            }
            given[mesh.slot(Side { face, corner })] = index;
        }
    }
    Ok(given)
}

/// Puts each of the ascending `indices` into the first group whose first member is closer than
/// `merge_angle`; appends the sums of the members to `groups` and returns the group of each index.
fn merged(
    indices: &[usize],
    units: &[DVec3],
    merge_angle: f64,
    groups: &mut Vec<DVec3>,
) -> Vec<usize> {
    let first_group = groups.len();
    let mut first_members: Vec<DVec3> = Vec::new();
    let mut group_of = Vec::with_capacity(indices.len());
    for &index in indices {
        let normal = units[index];
        let near = first_members.iter().position(|&first| angle(first, normal) < merge_angle);
        let group = near.unwrap_or_else(|| {
            first_members.push(normal);
            groups.push(DVec3::ZERO);
            first_members.len() - 1
        });
        groups[first_group + group] += normal;
        group_of.push(group);
    }
    group_of
}
