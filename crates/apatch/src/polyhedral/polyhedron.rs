//! Solids with planar faces of any number of corners, with holes.

use std::collections::HashMap;

use glam::DVec3;

use super::error::PolyhedronError;

/// How far from planar a face may be.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Planarity {
    /// Largest distance of a corner from the plane of its face, in diameters of the face.
    pub corner: f64,
    /// Sine of the angle between two neighbouring faces below which they count as one plane.
    pub flat_edge: f64,
}

impl Default for Planarity {
    fn default() -> Self {
        Self { corner: 1e-6, flat_edge: 1e-6 }
    }
}

/// A face: its boundary and its plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// Vertices of the outer loop, counter-clockwise seen from outside, then of the holes, clockwise.
    pub loops: Vec<Vec<usize>>,
    /// Unit normal, outwards, of the plane that fits best in Newell's sense.
    pub normal: DVec3,
    /// Centroid of the area.
    pub centroid: DVec3,
    /// Area without the holes.
    pub area: f64,
}

/// A directed edge: from a corner of a face to the next one, the face on its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Side {
    pub(crate) origin: usize,
    pub(crate) target: usize,
    pub(crate) face: usize,
    pub(crate) next: usize,
    pub(crate) previous: usize,
    pub(crate) twin: usize,
}

/// A solid bounded by planar polygons: a closed oriented manifold of any genus.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    vertices: Vec<DVec3>,
    facets: Vec<Facet>,
    pub(crate) sides: Vec<Side>,
    /// For each vertex the side that leaves it towards the vertex with the lowest number.
    first_side: Vec<Option<usize>>,
}

impl Polyhedron {
    /// From vertices and faces; a face is its outer loop of vertex indices, counter-clockwise seen
    /// from outside, then its holes, clockwise. Vertices without faces are allowed.
    ///
    /// # Errors
    ///
    /// [`PolyhedronError`] with the first offending face, edge or vertex: faces that are not planar,
    /// edges that are not shared by two faces, neighbouring faces in one plane, a boundary turned
    /// inside out.
    pub fn new(
        vertices: Vec<DVec3>,
        faces: Vec<Vec<Vec<usize>>>,
        planarity: &Planarity,
    ) -> Result<Self, PolyhedronError> {
        if let Some(vertex) = vertices.iter().position(|p| !p.is_finite()) {
            let position = vertices[vertex];
            return Err(PolyhedronError::NotFinite { vertex, position });
        }
        if faces.is_empty() {
            return Err(PolyhedronError::Empty);
        }
        let facets = faces
            .into_iter()
            .enumerate()
            .map(|(face, loops)| facet(&vertices, face, loops, planarity))
            .collect::<Result<Vec<_>, _>>()?;
        let sides = sides(&facets)?;
        let first_side = first_sides(vertices.len(), &sides);
        let solid = Self { vertices, facets, sides, first_side };
        solid.check_vertices()?;
        solid.check_edges(planarity)?;
        let volume = solid.signed_volume();
        if volume > 0.0 { Ok(solid) } else { Err(PolyhedronError::InsideOut { volume }) }
    }

    /// The positions of the vertices.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The faces.
    #[must_use]
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// Number of edges.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.sides.len() / 2
    }

    /// Vertices in use minus edges plus faces minus holes: 2 for each component of genus 0.
    #[must_use]
    pub fn euler_characteristic(&self) -> isize {
        let used = self.first_side.iter().flatten().count();
        let holes: usize = self.facets.iter().map(|f| f.loops.len() - 1).sum();
        let signed = |n: usize| isize::try_from(n).expect("invariant: counts fit isize");
        signed(used) + signed(self.facets.len()) - signed(self.edge_count()) - signed(holes)
    }

    /// The enclosed volume.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let origin = self.vertices[self.sides[0].origin];
        self.facets.iter().map(|f| f.area * f.normal.dot(f.centroid - origin) / 3.0).sum()
    }

    /// Lower and upper corner of the bounding box of the vertices in use.
    #[must_use]
    pub fn bounding_box(&self) -> [DVec3; 2] {
        let used = self.sides.iter().map(|s| self.vertices[s.origin]);
        used.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| {
            [low.min(p), high.max(p)]
        })
    }

    /// Longest side of the bounding box: the unit of relative lengths.
    #[must_use]
    pub fn size(&self) -> f64 {
        let [low, high] = self.bounding_box();
        (high - low).max_element()
    }

    pub(crate) fn position(&self, vertex: usize) -> DVec3 {
        self.vertices[vertex]
    }

    /// Sides that leave a vertex, counter-clockwise seen from outside, from the one towards the
    /// lowest number; empty for a vertex without faces.
    pub(crate) fn fan(&self, vertex: usize) -> Vec<usize> {
        let Some(first) = self.first_side[vertex] else { return Vec::new() };
        let mut fan = vec![first];
        loop {
            let last = self.sides[*fan.last().expect("invariant: a fan has a first side")];
            let next = self.sides[last.previous].twin;
            if next == first || fan.len() > self.sides.len() {
                return fan;
            }
            fan.push(next);
        }
    }

    /// Unit vector in the plane of the face of a side, perpendicular to it, into the face.
    pub(crate) fn inward(&self, side: usize) -> DVec3 {
        let Side { origin, target, face, .. } = self.sides[side];
        let along = self.position(target) - self.position(origin);
        self.facets[face].normal.cross(along).normalize_or_zero()
    }

    /// Whether the solid is convex along an edge.
    pub(crate) fn is_ridge(&self, side: usize) -> bool {
        let other = self.sides[self.sides[side].twin].face;
        self.inward(side).dot(self.facets[other].normal) < 0.0
    }

    fn check_vertices(&self) -> Result<(), PolyhedronError> {
        let mut leaving = vec![0; self.vertices.len()];
        self.sides.iter().for_each(|s| leaving[s.origin] += 1);
        for (vertex, &count) in leaving.iter().enumerate() {
            let valence = self.fan(vertex).len();
            if valence != count {
                return Err(PolyhedronError::NonManifoldVertex { vertex });
            }
            if count == 1 || count == 2 {
                return Err(PolyhedronError::FewEdges { vertex, valence });
            }
        }
        Ok(())
    }

    fn check_edges(&self, planarity: &Planarity) -> Result<(), PolyhedronError> {
        for (index, side) in self.sides.iter().enumerate() {
            let other = self.sides[side.twin].face;
            let sine = self.inward(index).dot(self.facets[other].normal);
            // zero for edges without length
            if sine.abs() <= planarity.flat_edge {
                let (faces, vertices) = ([side.face, other], [side.origin, side.target]);
                return Err(PolyhedronError::FlatEdge { faces, vertices });
            }
        }
        Ok(())
    }
}

/// The plane of a face, by Newell's sums about its first corner.
fn facet(
    vertices: &[DVec3],
    face: usize,
    loops: Vec<Vec<usize>>,
    planarity: &Planarity,
) -> Result<Facet, PolyhedronError> {
    let corners = loops.iter().flatten();
    if let Some(&vertex) = corners.clone().find(|&&v| v >= vertices.len()) {
        return Err(PolyhedronError::MissingVertex { face, vertex, count: vertices.len() });
    }
    if let Some(few) = loops.iter().find(|l| l.len() < 3) {
        return Err(PolyhedronError::FewCorners { face, corners: few.len() });
    }
    let Some(&first) = loops.first().and_then(|outer| outer.first()) else {
        return Err(PolyhedronError::FewCorners { face, corners: 0 });
    };
    let base = vertices[first];
    let fans = || {
        let pairs = |l: &Vec<usize>| {
            let turned = l.iter().cycle().skip(1);
            l.iter().zip(turned).map(|(&a, &b)| [a, b]).collect::<Vec<_>>()
        };
        loops.iter().flat_map(pairs).map(|[a, b]| [vertices[a] - base, vertices[b] - base])
    };
    let twice: DVec3 = fans().map(|[a, b]| a.cross(b)).sum();
    let diameter = corners.clone().map(|&v| vertices[v].distance(base)).fold(0.0, f64::max);
    let normal = twice / twice.length();
    let area = 0.5 * twice.length();
    if !(normal.is_finite() && area > planarity.corner * diameter * diameter) {
        return Err(PolyhedronError::NoArea { face });
    }
    // moments of the signed triangles of the fans
    let moment: DVec3 = fans().map(|[a, b]| (a + b) * a.cross(b).dot(normal)).sum();
    let centroid = base + moment / (6.0 * area);
    for &vertex in corners {
        let distance = (vertices[vertex] - centroid).dot(normal).abs() / diameter;
        if distance > planarity.corner {
            return Err(PolyhedronError::NotPlanar { face, vertex, distance });
        }
    }
    Ok(Facet { loops, normal, centroid, area })
}

fn sides(facets: &[Facet]) -> Result<Vec<Side>, PolyhedronError> {
    let mut sides: Vec<Side> = Vec::new();
    for (face, facet) in facets.iter().enumerate() {
        for corners in &facet.loops {
            let (start, n) = (sides.len(), corners.len());
            sides.extend((0..n).map(|i| Side {
                origin: corners[i],
                target: corners[(i + 1) % n],
                face,
                next: start + (i + 1) % n,
                previous: start + (i + n - 1) % n,
                twin: usize::MAX,
            }));
        }
    }
    let mut by_ends: HashMap<[usize; 2], usize> = HashMap::with_capacity(sides.len());
    for (index, side) in sides.iter().enumerate() {
        if let Some(other) = by_ends.insert([side.origin, side.target], index) {
            let faces = [sides[other].face, side.face];
            let vertices = [side.origin, side.target];
            return Err(PolyhedronError::Orientation { faces, vertices });
        }
    }
    for side in &mut sides {
        let Side { origin, target, face, .. } = *side;
        let twin = by_ends.get(&[target, origin]);
        side.twin = *twin.ok_or(PolyhedronError::OpenEdge { face, vertices: [origin, target] })?;
    }
    Ok(sides)
}

fn first_sides(vertex_count: usize, sides: &[Side]) -> Vec<Option<usize>> {
    let mut first: Vec<Option<usize>> = vec![None; vertex_count];
    for (index, side) in sides.iter().enumerate() {
        let known = &mut first[side.origin];
        if known.is_none_or(|other| side.target < sides[other].target) {
            *known = Some(index);
        }
    }
    first
}
