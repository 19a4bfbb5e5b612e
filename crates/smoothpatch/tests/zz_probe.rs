#[path = "invariance.rs"]
mod inv;
use smoothpatch::basemesh::*;
use smoothpatch::hermite_sqp::*;
use smoothpatch::*;
#[test]
fn probe() {
    let mesh = inv::mesh();
    let last = mesh.topology().vertex_count() - 1;
    let mut positions = mesh.positions().as_slice().to_vec();
    positions.reverse();
    let faces: Vec<[usize; 3]> = mesh.face_indices().into_iter().map(|face| face.map(|v| last - v)).collect();
    let re = TriMesh::new(positions, &faces).unwrap();
    for refinement in [CurveRefinement::None, CurveRefinement::TangentFixed, CurveRefinement::TangentFree] {
    for rows in [g1_triangular::Settings::PUBLISHED, g1_triangular::Settings::REFINED] {
        let mut s = Settings::with_faces(0);
        s.curve_refinement = refinement; s.patches = rows;
        let a = fit_base_mesh(&inv::blob(), mesh.clone(), &s, &mut Silent).unwrap();
        let b = fit_base_mesh(&inv::blob(), re.clone(), &s, &mut Silent).unwrap();
        let mut d = vec![];
        for e in mesh.topology().edges() {
            let h = mesh.topology().canonical(e);
            let f = HalfedgeId::new(h.index());
            let p = a.network.along(mesh.topology(), h).points;
            let q = b.network.along(re.topology(), f).points;
            let m = p.iter().zip(q).map(|(x, y)| x.distance(y)).fold(0.0, f64::max);
            d.push((m, e.index(), a.curves[e].status));
        }
        d.sort_by(|x, y| y.0.total_cmp(&x.0));
        println!("{refinement:?} {rows:?} nets {:e}", inv::largest_distance(&inv::nets(&a), &inv::nets(&b)));
        println!("{:?}", &d[..4]);
        println!("retreats {:?} {:?}", a.retreats.as_slice().iter().flatten().count(), b.retreats.as_slice().iter().flatten().count());
    }}
}
