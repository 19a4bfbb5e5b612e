//! Solids from plain polygons: coplanar neighbours merged, cuts that lead to holes removed.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use glam::DVec3;

use super::error::PolyhedronError;
use super::polyhedron::{Planarity, Polyhedron};

impl Polyhedron {
    /// From vertices and polygons of one loop each, as files have them.
    ///
    /// Neighbouring polygons in one plane become one face, so that triangulated solids can be used; a
    /// polygon that runs along an edge in both directions is cut open there: its loops are an outline
    /// and holes. Vertices in the middle of straight edges are left out. Faces are numbered by their
    /// first polygon.
    ///
    /// # Errors
    ///
    /// As [`Polyhedron::new`]; faces and vertices are those of the merged solid, vertices with their
    /// old numbers.
    pub fn from_polygons(
        vertices: Vec<DVec3>,
        polygons: &[Vec<usize>],
        planarity: &Planarity,
    ) -> Result<Self, PolyhedronError> {
        for (face, polygon) in polygons.iter().enumerate() {
            if let Some(&vertex) = polygon.iter().find(|&&v| v >= vertices.len()) {
                let count = vertices.len();
                return Err(PolyhedronError::MissingVertex { face, vertex, count });
            }
        }
        let group = groups(&vertices, polygons, planarity);
        let mut faces: Vec<Vec<Vec<usize>>> = Vec::new();
        for first in (0..polygons.len()).filter(|&f| group[f] == f) {
            let members = (0..polygons.len()).filter(|&f| group[f] == first);
            let members: Vec<&Vec<usize>> = members.map(|f| &polygons[f]).collect();
            faces.push(outline(&vertices, &members, faces.len())?);
        }
        drop_middles(&vertices, &mut faces, planarity);
        Self::new(vertices, faces, planarity)
    }
}

fn steps(polygon: &[usize]) -> impl Iterator<Item = [usize; 2]> {
    let n = polygon.len();
    (0..n).map(move |i| [polygon[i], polygon[(i + 1) % n]])
}

/// Twice the vector area.
fn vector_area(vertices: &[DVec3], polygon: &[usize]) -> DVec3 {
    let base = polygon.first().map_or(DVec3::ZERO, |&p| vertices[p]);
    steps(polygon).map(|[a, b]| (vertices[a] - base).cross(vertices[b] - base)).sum()
}

/// For each polygon the first one of its plane, among those connected to it.
fn groups(vertices: &[DVec3], polygons: &[Vec<usize>], planarity: &Planarity) -> Vec<usize> {
    let normals: Vec<DVec3> =
        polygons.iter().map(|p| vector_area(vertices, p).normalize_or_zero()).collect();
    let mut by_step: HashMap<[usize; 2], usize> = HashMap::new();
    for (f, polygon) in polygons.iter().enumerate() {
        by_step.extend(steps(polygon).map(|step| (step, f)));
    }
    let mut group: Vec<usize> = (0..polygons.len()).collect();
    for f in 0..polygons.len() {
        if group[f] != f {
            continue;
        }
        let mut open = vec![f];
        while let Some(at) = open.pop() {
            for [a, b] in steps(&polygons[at]) {
                let Some(&other) = by_step.get(&[b, a]) else { continue };
                // against the first one: planes do not drift along a chain
                let flat = normals[f].cross(normals[other]).length() <= planarity.flat_edge
                    && normals[f].dot(normals[other]) > 0.0;
                if other > f && group[other] == other && flat {
                    group[other] = f;
                    open.push(other);
                }
            }
        }
    }
    group
}

/// The loops of merged polygons, the outline first.
fn outline(
    vertices: &[DVec3],
    members: &[&Vec<usize>],
    face: usize,
) -> Result<Vec<Vec<usize>>, PolyhedronError> {
    let all: BTreeSet<[usize; 2]> = members.iter().flat_map(|p| steps(p)).collect();
    let mut next: BTreeMap<usize, usize> = BTreeMap::new();
    for &[a, b] in all.iter().filter(|[a, b]| !all.contains(&[*b, *a])) {
        if next.insert(a, b).is_some() {
            // two loops of the face meet in this point
            return Err(PolyhedronError::NonManifoldVertex { vertex: a });
        }
    }
    let mut loops: Vec<Vec<usize>> = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let mut corners = Vec::new();
        let mut at = start;
        while let Some(onwards) = next.remove(&at) {
            corners.push(at);
            at = onwards;
        }
        loops.push(corners);
    }
    let area = |l: &Vec<usize>| vector_area(vertices, l).length();
    loops.sort_by(|a, b| area(b).total_cmp(&area(a)));
    if loops.is_empty() { Err(PolyhedronError::NoArea { face }) } else { Ok(loops) }
}

/// Leaves out vertices of only two faces in the middle of a straight line.
fn drop_middles(vertices: &[DVec3], faces: &mut [Vec<Vec<usize>>], planarity: &Planarity) {
    let mut uses = vec![0_usize; vertices.len()];
    faces.iter().flatten().flatten().for_each(|&v| uses[v] += 1);
    for corners in faces.iter_mut().flatten() {
        let n = corners.len();
        let straight = |i: usize| {
            let [a, b, c] = [i + n - 1, i, i + 1].map(|k| vertices[corners[k % n]]);
            let (u, v) = ((b - a).normalize_or_zero(), (c - b).normalize_or_zero());
            u.dot(v) > 0.0 && u.cross(v).length() <= planarity.flat_edge
        };
        let keep: Vec<bool> = (0..n).map(|i| uses[corners[i]] != 2 || !straight(i)).collect();
        let mut i = 0;
        corners.retain(|_| {
            i += 1;
            keep[i - 1]
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangulated(solid: &Polyhedron) -> Vec<Vec<usize>> {
        let fan = |l: &Vec<usize>| (1..l.len() - 1).map(|i| vec![l[0], l[i], l[i + 1]]).collect();
        solid.facets().iter().flat_map(|f| -> Vec<Vec<usize>> { fan(&f.loops[0]) }).collect()
    }

    #[test]
    fn triangles_of_a_dodecahedron_become_pentagons() {
        let solid = Polyhedron::named("dodecahedron").expect("a solid");
        let planarity = Planarity::default();
        let polygons = triangulated(&solid);
        assert_eq!(polygons.len(), 36);
        let merged = Polyhedron::from_polygons(solid.vertices().to_vec(), &polygons, &planarity)
            .expect("a solid");
        assert_eq!(merged.facets().len(), 12);
        assert_eq!(merged.edge_count(), 30);
    }

    #[test]
    fn cuts_to_holes_are_removed() {
        let frame = Polyhedron::named("frame").expect("a solid");
        let keyhole = |f: &super::super::Facet| match &*f.loops {
            [outer, hole] => {
                // from the first corner to the nearest of the hole and back
                let near =
                    |&&i: &&usize| frame.vertices()[i].distance_squared(frame.vertices()[outer[0]]);
                let start = hole.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("one");
                let at = hole.iter().position(|v| v == start).expect("in the hole");
                let around = (0..=hole.len()).map(|i| hole[(at + i) % hole.len()]);
                outer.iter().copied().chain([outer[0]]).chain(around).collect()
            }
            loops => loops[0].clone(),
        };
        let polygons: Vec<Vec<usize>> = frame.facets().iter().map(keyhole).collect();
        let planarity = Planarity::default();
        let solid = Polyhedron::from_polygons(frame.vertices().to_vec(), &polygons, &planarity)
            .expect("a solid");
        assert_eq!(solid.euler_characteristic(), 0);
        assert_eq!(solid.facets().iter().filter(|f| f.loops.len() == 2).count(), 2);
    }

    #[test]
    fn vertices_on_straight_edges_are_left_out() {
        let cube = Polyhedron::named("cube").expect("a solid");
        let [a, b] = [cube.facets()[0].loops[0][0], cube.facets()[0].loops[0][1]];
        let mut vertices = cube.vertices().to_vec();
        let middle = vertices.len();
        vertices.push(0.5 * (vertices[a] + vertices[b]));
        let split = |l: &Vec<usize>| -> Vec<usize> {
            steps(l)
                .flat_map(|[p, q]| {
                    let here = [p, q] == [a, b] || [p, q] == [b, a];
                    [Some(p), here.then_some(middle)].into_iter().flatten()
                })
                .collect()
        };
        let polygons: Vec<_> = cube.facets().iter().map(|f| split(&f.loops[0])).collect();
        let solid =
            Polyhedron::from_polygons(vertices, &polygons, &Planarity::default()).expect("a solid");
        assert_eq!((solid.facets().len(), solid.edge_count()), (6, 12));
    }
}
