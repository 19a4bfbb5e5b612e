//! The same bits every time, in every unit of length.

use basemesh::{Simplified, SimplifySettings, SurfaceTarget, TriMesh, simplify};

use crate::support::{Scaled, Torus, map_positions, noise, torus_mesh};

const TORUS: Torus = Torus { major: 1.0, minor: 0.4 };

fn noisy_torus(scale: f64) -> TriMesh {
    map_positions(torus_mesh(&TORUS, 48, 24), |i, p| scale * (p + 0.004 * noise(7, i)))
}

fn run(mesh: TriMesh, target: &dyn SurfaceTarget) -> Simplified {
    simplify(mesh, target, &SimplifySettings::to_faces(300)).unwrap()
}

#[test]
fn twice_the_same() {
    assert_eq!(run(noisy_torus(1.0), &TORUS), run(noisy_torus(1.0), &TORUS));
}

#[test]
fn scaling_by_a_power_of_two_is_exact() {
    let unit = run(noisy_torus(1.0), &TORUS);
    for factor in [4096.0, 1.0 / 4096.0] {
        let scaled = run(noisy_torus(factor), &Scaled { inner: &TORUS, factor });
        assert_eq!(scaled.mesh, map_positions(unit.mesh.clone(), |_, p| factor * p), "{factor}");
        assert_eq!(scaled.normals, unit.normals, "{factor}");
        assert_eq!(scaled.report, unit.report, "{factor}");
    }
}

#[test]
#[cfg(feature = "rayon")]
fn the_number_of_threads_does_not_matter() {
    let mesh = noisy_torus(1.0);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let one = pool(1).install(|| run(mesh.clone(), &TORUS));
    assert_eq!(one, pool(3).install(|| run(mesh, &TORUS)));
}
