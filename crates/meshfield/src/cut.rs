//! A mesh cut open along its sharp edges.

use basemesh::{EdgeId, EdgeMap, FaceMap, HalfedgeId, HalfedgeMap, TriMesh, VertexId, VertexMap};

/// The same faces, with the vertices of sharp edges repeated: once for each sector of faces between them.
#[derive(Clone, Debug)]
pub struct CutMesh {
    /// The cut mesh; its faces have the numbers of the uncut ones.
    pub mesh: TriMesh,
    /// Where each vertex comes from.
    pub original: VertexMap<VertexId>,
    /// Faces that are connected without crossing a sharp edge have the same region, counted from 0.
    pub regions: FaceMap<usize>,
    /// How many regions there are.
    pub region_count: usize,
    /// Sharp edges of the uncut mesh that are still closed: single ones, among smooth ones only. There is
    /// nothing to cut off.
    pub uncut: Vec<EdgeId>,
}

/// Cuts a mesh along edges with two faces. New vertices are numbered by the old ones, then by their faces.
#[must_use]
pub fn cut_open(mesh: &TriMesh, sharp: &EdgeMap<bool>) -> CutMesh {
    let topology = mesh.topology();
    let sectors = sectors(mesh, sharp);
    // the first corner of each sector, by vertex and corner
    let mut firsts: Vec<(VertexId, HalfedgeId)> = topology
        .halfedges()
        .filter(|&h| sectors[h] == h)
        .map(|h| (topology.origin(h), h))
        .collect();
    firsts.sort_unstable();
    let mut number = HalfedgeMap::from_vec(vec![0_usize; topology.halfedge_count()]);
    for (k, &(_, h)) in firsts.iter().enumerate() {
        number[h] = k;
    }
    let faces: Vec<[usize; 3]> =
        topology.faces().map(|face| face.halfedges().map(|h| number[sectors[h]])).collect();
    let positions = firsts.iter().map(|&(v, _)| mesh.position(v)).collect();
    let cut = TriMesh::new(positions, &faces).expect("invariant: a sector is one fan of faces");
    let uncut = topology
        .edges()
        .filter(|&edge| sharp[edge])
        .filter(|&edge| cut.topology().twin(topology.canonical(edge)).is_some())
        .filter(|&edge| topology.twin(topology.canonical(edge)).is_some())
        .collect();
    let (regions, region_count) = regions(&cut);
    let original = firsts.iter().map(|&(v, _)| v).collect();
    CutMesh { mesh: cut, original: VertexMap::from_vec(original), regions, region_count, uncut }
}

/// For each corner, the lowest corner of its sector: the faces around the vertex between sharp edges.
fn sectors(mesh: &TriMesh, sharp: &EdgeMap<bool>) -> HalfedgeMap<HalfedgeId> {
    let topology = mesh.topology();
    let corners: Vec<HalfedgeId> = topology.halfedges().collect();
    let mut first = HalfedgeMap::from_vec(corners);
    for vertex in topology.vertices() {
        let fan: Vec<HalfedgeId> = topology.fan(vertex).collect();
        let n = fan.len();
        // whether the edge that starts each corner separates it from the one before
        let separated = |i: usize| {
            let h = fan[i];
            topology.twin(h).is_none() || sharp[topology.edge(h)]
        };
        let start = (0..n).find(|&i| separated(i)).unwrap_or(0);
        let mut sector: Vec<HalfedgeId> = Vec::new();
        for k in 0..=n {
            let i = (start + k) % n;
            if k == n || (k > 0 && separated(i)) {
                if let Some(&lowest) = sector.iter().min() {
                    sector.iter().for_each(|&h| first[h] = lowest);
                }
                sector.clear();
            }
            sector.push(fan[i]);
        }
    }
    first
}

/// The component of each face, in the order of their first faces.
fn regions(mesh: &TriMesh) -> (FaceMap<usize>, usize) {
    let topology = mesh.topology();
    let mut regions = FaceMap::from_vec(vec![usize::MAX; topology.face_count()]);
    let mut count = 0;
    for start in topology.faces() {
        if regions[start] != usize::MAX {
            continue;
        }
        regions[start] = count;
        let mut open = vec![start];
        while let Some(face) = open.pop() {
            for twin in face.halfedges().into_iter().filter_map(|h| topology.twin(h)) {
                if regions[twin.face()] == usize::MAX {
                    regions[twin.face()] = count;
                    open.push(twin.face());
                }
            }
        }
        count += 1;
    }
    (regions, count)
}
