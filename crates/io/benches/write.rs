//! Writing files of 10^5 patches of degree 7 to memory: bytes a second.
#![allow(missing_docs, reason = "criterion makes an undocumented function")]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use io::basemesh::{FaceMap, Topology, VertexId};
use io::bezier_core::{BezierTriangle, MultiIndex, SepticTriangle};
use io::glam::DVec3;
use io::{
    CurvedMesh, Encoding, MshOptions, MshVersion, PatchSurface, StepFaces, StepOptions, VtuOptions,
    read_vtu, write_msh, write_step, write_vtu,
};

/// A torus of `2 n²` patches.
fn torus(n: usize) -> (Topology, FaceMap<SepticTriangle>) {
    let id = |i: usize, j: usize| (i % n) * n + j % n;
    let corners = |(i, j)| [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(corners);
    let faces: Vec<_> = quads.flat_map(|[a, b, c, d]| [[a, b, c], [c, d, a]]).collect();
    let topology = Topology::from_faces(n * n, &faces).expect("a torus");
    let place = |vertex: usize| {
        let [p, q] = [vertex / n, vertex % n].map(|k| std::f64::consts::TAU * k as f64 / n as f64);
        DVec3::new((5.0 + q.cos()) * p.cos(), (5.0 + q.cos()) * p.sin(), q.sin())
    };
    let nets = FaceMap::from_fn(topology.face_count(), |face| {
        let ids = topology.corners(face).map(VertexId::index);
        BezierTriangle::from_fn(|MultiIndex { i, j, k }| {
            let mut terms = [(ids[0], i), (ids[1], j), (ids[2], k)];
            // neighbours add in the same order
            terms.sort_unstable();
            terms.into_iter().map(|(vertex, n)| place(vertex) * (n as f64 / 7.0)).sum()
        })
    });
    (topology, nets)
}

fn write(criterion: &mut Criterion) {
    let (topology, nets) = torus(224);
    let mut group = criterion.benchmark_group("write_100352_patches");
    group.sample_size(10);
    let mut measure = |name: &str, write: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = Vec::new();
        write(&mut bytes);
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                bytes.clear();
                write(black_box(&mut bytes));
            });
        });
    };
    for encoding in [Encoding::Binary, Encoding::Appended] {
        let options = VtuOptions { encoding, ..VtuOptions::default() };
        measure(&format!("vtu_{encoding:?}"), &|out| {
            write_vtu(out, &topology, &nets, &options).expect("a good surface");
        });
    }
    for version in [MshVersion::V4, MshVersion::V2] {
        let options = MshOptions { version, ..MshOptions::default() };
        measure(&format!("msh_{version:?}"), &|out| {
            let mesh = CurvedMesh::from_patches(&topology, &nets, 7);
            write_msh(out, &mesh, &options).expect("a good mesh");
        });
    }
    let surface = PatchSurface::from_triangles(&topology, &nets).expect("a good surface");
    for faces in [StepFaces::Degenerate, StepFaces::Quads] {
        let options = StepOptions { faces, ..StepOptions::default() };
        measure(&format!("step_{faces:?}"), &|out| {
            write_step(out, &surface, &options).expect("a good surface");
        });
    }
    group.finish();

    let mut bytes = Vec::new();
    write_vtu(&mut bytes, &topology, &nets, &VtuOptions::default()).expect("a good surface");
    let back = read_vtu::<36>(&mut bytes.as_slice()).expect("our own file");
    assert_eq!((&back.topology, &back.nets), (&topology, &nets), "read back equal");
}

criterion_group!(benches, write);
criterion_main!(benches);
