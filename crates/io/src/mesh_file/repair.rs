//! From polygons to a mesh: what is safe is done and counted, the rest refused.

use std::collections::{HashMap, HashSet};

use basemesh::{FaceMap, MeshError, TopologyError, TriMesh};
use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::error::MeshFileError;
use super::orientation::{Origin, orient};
use super::polygon_soup::PolygonSoup;
use super::triangulate::triangulate;
use super::{MeshFile, MeshFormat};

/// What was done to make a file a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Repairs {
    /// Faces with more than three corners, which were cut into triangles.
    pub polygons: usize,
    /// Vertices with the position of an earlier one, which took their place.
    pub merged_vertices: usize,
    /// Vertices without a face, which were dropped.
    pub unused_vertices: usize,
    /// Triangles with two equal corners, which were dropped.
    pub collapsed_faces: usize,
    /// Triangles with the same three corners as an earlier one, in the same sense, which were dropped.
    pub double_faces: usize,
    /// Triangles that were turned round.
    pub turned_faces: usize,
}

impl Repairs {
    /// Whether something was changed, other than cutting polygons.
    #[must_use]
    pub fn any(&self) -> bool {
        Self { polygons: 0, ..*self } != Self::default()
    }
}

/// Makes a mesh of polygons; see [`read_mesh_file`](super::read_mesh_file). In STL files, whose triangles
/// share no vertices, merging is not counted.
///
/// # Errors
///
/// [`MeshFileError`].
pub fn repair(soup: PolygonSoup, format: MeshFormat) -> Result<MeshFile, MeshFileError> {
    check(&soup)?;
    let mut repairs = Repairs::default();
    let mut triangles = cut(&soup, &mut repairs)?;
    let (new_ids, mut vertices) = merge(&soup.positions);
    let used: HashSet<usize> = soup.faces.iter().flatten().copied().collect();
    repairs.unused_vertices = soup.positions.len() - used.len();
    if format != MeshFormat::Stl {
        repairs.merged_vertices = used.iter().filter(|&&v| vertices[new_ids[v]] != v).count();
    }
    triangles.iter_mut().for_each(|t| t.corners = t.corners.map(|v| new_ids[v]));
    drop_useless(&mut triangles, &mut repairs);
    compact(&mut triangles, &mut vertices);
    let positions: Vec<DVec3> = vertices.iter().map(|&v| soup.positions[v]).collect();
    refuse_flat(&triangles, &positions)?;

    let mut corners: Vec<[usize; 3]> = triangles.iter().map(|t| t.corners).collect();
    let faces: Vec<usize> = triangles.iter().map(|t| t.face).collect();
    let mut turned = vec![false; corners.len()];
    let origin = Origin { faces: &faces, vertices: &vertices, positions: &positions };
    orient(&mut corners, &mut turned, &origin)?;
    repairs.turned_faces = turned.iter().filter(|turned| **turned).count();
    let mesh = TriMesh::new(positions.clone(), &corners).map_err(|error| match error {
        MeshError::Topology(TopologyError::NonManifoldVertex { vertex }) => {
            MeshFileError::NonManifoldVertex { vertex: vertices[vertex], at: positions[vertex] }
        }
        other => other.into(),
    })?;
    Ok(finish(mesh, format, repairs, soup, &triangles, &turned))
}

/// A triangle and where it comes from.
struct Triangle {
    corners: [usize; 3],
    /// Face of the file, and its corners there.
    face: usize,
    places: [usize; 3],
}

fn check(soup: &PolygonSoup) -> Result<(), MeshFileError> {
    if soup.faces.is_empty() {
        return Err(MeshFileError::NoFaces);
    }
    if let Some(vertex) = soup.positions.iter().position(|p| !p.is_finite()) {
        return Err(MeshFileError::NotFinite { vertex, position: soup.positions[vertex] });
    }
    let count = soup.positions.len();
    for (face, corners) in soup.faces.iter().enumerate() {
        if corners.len() < 3 {
            return Err(MeshFileError::FewCorners { face, corners: corners.len() });
        }
        if let Some(&vertex) = corners.iter().find(|&&v| v >= count) {
            let vertex = i64::try_from(vertex).unwrap_or(i64::MAX);
            return Err(MeshFileError::MissingVertex { face, vertex, count });
        }
    }
    Ok(())
}

fn cut(soup: &PolygonSoup, repairs: &mut Repairs) -> Result<Vec<Triangle>, MeshFileError> {
    let mut triangles = Vec::with_capacity(soup.faces.len());
    for (face, corners) in soup.faces.iter().enumerate() {
        let points: Vec<DVec3> = corners.iter().map(|&v| soup.positions[v]).collect();
        let pieces = triangulate(&points).ok_or(MeshFileError::NoTriangles { face })?;
        repairs.polygons += usize::from(pieces.len() > 1);
        let triangle =
            |places: [usize; 3]| Triangle { corners: places.map(|k| corners[k]), face, places };
        triangles.extend(pieces.into_iter().map(triangle));
    }
    Ok(triangles)
}

/// The new number of each vertex, and the first of the file's vertices with each new number. Equal are
/// positions with the same numbers; zeros of either sign are the same.
fn merge(positions: &[DVec3]) -> (Vec<usize>, Vec<usize>) {
    let mut known: HashMap<[u64; 3], usize> = HashMap::with_capacity(positions.len());
    let mut vertices = Vec::new();
    let new_ids = positions.iter().enumerate().map(|(v, p)| {
        *known.entry(p.to_array().map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            vertices.push(v);
            vertices.len() - 1
        })
    });
    let new_ids = new_ids.collect();
    (new_ids, vertices)
}

fn drop_useless(triangles: &mut Vec<Triangle>, repairs: &mut Repairs) {
    let mut known = HashSet::with_capacity(triangles.len());
    triangles.retain(|triangle| {
        let [a, b, c] = triangle.corners;
        if a == b || b == c || c == a {
            repairs.collapsed_faces += 1;
            return false;
        }
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        let first = turns.into_iter().min().unwrap_or([a, b, c]);
        let is_new = known.insert(first);
        repairs.double_faces += usize::from(!is_new);
        is_new
    });
}

/// Renumbers the vertices that are used, in their order.
fn compact(triangles: &mut [Triangle], vertices: &mut Vec<usize>) {
    let mut used = vec![false; vertices.len()];
    triangles.iter().flat_map(|t| t.corners).for_each(|v| used[v] = true);
    let mut new_ids = vec![0; vertices.len()];
    let mut count = 0;
    for (v, used) in used.iter().enumerate() {
        new_ids[v] = count;
        count += usize::from(*used);
    }
    triangles.iter_mut().for_each(|t| t.corners = t.corners.map(|v| new_ids[v]));
    let mut keep = used.into_iter();
    vertices.retain(|_| keep.next().unwrap_or(false));
}

fn refuse_flat(triangles: &[Triangle], positions: &[DVec3]) -> Result<(), MeshFileError> {
    if triangles.is_empty() {
        return Err(MeshFileError::NoFaces);
    }
    let is_flat = |t: &&Triangle| {
        let [a, b, c] = t.corners.map(|v| positions[v]);
        let (ab, ac) = (b - a, c - a);
        // what rounding of the product leaves of a line
        ab.cross(ac).length() <= 4.0 * f64::EPSILON * ab.length() * ac.length()
    };
    let mut faces: Vec<usize> = triangles.iter().filter(is_flat).map(|t| t.face).collect();
    faces.dedup();
    if faces.is_empty() { Ok(()) } else { Err(MeshFileError::FlatFaces { faces }) }
}

fn finish(
    mesh: TriMesh,
    format: MeshFormat,
    repairs: Repairs,
    soup: PolygonSoup,
    triangles: &[Triangle],
    turned: &[bool],
) -> MeshFile {
    let normals = |(triangle, turned): (&Triangle, &bool)| {
        let [a, b, c] = triangle.places.map(|k| soup.corner_normals[triangle.face][k]);
        if *turned { [a, c, b].map(|n| n.map(|n| -n)) } else { [a, b, c] }
    };
    let corner_normals = (!soup.corner_normals.is_empty())
        .then(|| FaceMap::from_vec(triangles.iter().zip(turned).map(normals).collect()));
    let group = |triangle: &Triangle| soup.group_of.get(triangle.face).copied().unwrap_or(0);
    let group_of = FaceMap::from_vec(triangles.iter().map(group).collect());
    let groups = if soup.groups.is_empty() { vec![String::new()] } else { soup.groups };
    MeshFile { mesh, format, repairs, corner_normals, groups, group_of }
}
