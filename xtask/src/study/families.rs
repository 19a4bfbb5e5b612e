//! Sequences of base meshes whose edges are halved from level to level.
//!
//! The vertices of every level are moved at random, each level anew, so that no symmetry of a regular
//! mesh raises the orders; only the sphere stays regular.

use anyhow::{Context, Result};
use smoothpatch::Settings;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{
    FieldTarget, SimplifySettings, TriMesh, VertexMap, polygonize_to_faces, simplify,
};
use smoothpatch::implicit::{Formula, ImplicitSurface, NamedShape};
use testkit::meshes::{icosphere, jittered, on_surface, radially_on_surface, refined, torus_grid};

/// How far vertices are moved, in lengths of their shortest edge.
const JITTER: f64 = 0.15;
const SEED: u64 = 2009;

/// A surface with its base meshes, coarse ones first.
pub(super) struct Family {
    pub(super) name: &'static str,
    pub(super) formula: String,
    pub(super) field: Box<dyn ImplicitSurface>,
    pub(super) meshes: Vec<TriMesh>,
}

pub(super) fn all() -> Result<Vec<Family>> {
    Ok(vec![
        sphere()?,
        torus()?,
        star_shaped("quartic", "x^4 + y^4 + z^4 - 0.2*(x^2 + y^2 + z^2) - 0.8")?,
        star_shaped("fourth powers", "x^4 + y^4 + z^4 - 1")?,
        double_torus()?,
    ])
}

fn shape(name: &str) -> Result<&'static NamedShape> {
    NamedShape::find(name).with_context(|| format!("no shape named {name}"))
}

/// Icospheres of 80 to 5120 faces.
fn sphere() -> Result<Family> {
    let shape = shape("sphere")?;
    Ok(Family {
        name: "sphere",
        formula: shape.formula.into(),
        field: shape.field(),
        meshes: (1..5).map(icosphere).collect(),
    })
}

/// The mesh with every vertex moved within its tangent plane by a fixed part of its shortest edge;
/// only the direction is random.
///
/// With random lengths, finer levels would have odder triangles, for the largest of more numbers is
/// larger, and the largest error would fall more slowly than the order says.
fn jitter(mesh: &TriMesh, seed: u64) -> Result<TriMesh> {
    let topology = mesh.topology();
    let directions = jittered(mesh, 1.0, seed);
    let positions = VertexMap::from_fn(topology.vertex_count(), |v| {
        let edges = topology.fan(v).map(|h| topology.edge(h));
        let shortest = edges.map(|e| mesh.edge_length(e)).fold(f64::INFINITY, f64::min);
        let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let areas = topology.fan(v).map(|h| area(mesh.triangle(h.face())));
        let normal = areas.sum::<DVec3>().normalize_or_zero();
        let direction = directions.position(v) - mesh.position(v);
        let tangent = direction.reject_from_normalized(normal).normalize_or_zero();
        mesh.position(v) + tangent * (JITTER * shortest)
    });
    Ok(mesh.clone().with_positions(positions)?)
}

/// Grids of 256 to 16384 faces.
fn torus() -> Result<Family> {
    let shape = shape("torus")?;
    let field = shape.field();
    let grid = |level: u64| {
        let cells = 8 << level;
        let mesh = jitter(&torus_grid([5.0, 1.0], 2 * cells, cells), SEED + level)?;
        on_surface(&mesh, &*field).context("a vertex has no foot")
    };
    let meshes = (0..4).map(grid).collect::<Result<_>>()?;
    Ok(Family { name: "torus", formula: shape.formula.into(), field, meshes })
}

/// Icospheres of 80 to 20480 faces, moved along rays from the origin.
fn star_shaped(name: &'static str, formula: &str) -> Result<Family> {
    let field = Formula::parse(formula)?;
    let mesh = |level: u64| {
        let sphere = icosphere(usize::try_from(level)?);
        Ok(radially_on_surface(&jitter(&sphere, SEED + level)?, &field, 4.0))
    };
    let meshes = (1..6).map(mesh).collect::<Result<_>>()?;
    Ok(Family { name, formula: formula.into(), field: Box::new(field), meshes })
}

/// A base mesh of 500 faces, split to 32000.
fn double_torus() -> Result<Family> {
    const FACES: usize = 500;
    let shape = shape("double-torus")?;
    let field = shape.field();
    let settings = Settings::with_faces(FACES);
    let dense = polygonize_to_faces(&*field, &shape.region, 20 * FACES)?.mesh;
    let target = FieldTarget::new(&*field, dense.diagonal(), settings.projection);
    let coarse = simplify(dense, &target, &SimplifySettings::to_faces(FACES))?.mesh;
    let mut split = vec![coarse];
    for level in 1..4 {
        let finer = on_surface(&refined(&split[level - 1]), &*field);
        split.push(finer.context("a vertex has no foot")?);
    }
    let jittered = (SEED..).zip(&split).map(|(seed, mesh)| {
        on_surface(&jitter(mesh, seed)?, &*field).context("a vertex has no foot")
    });
    let meshes = jittered.collect::<Result<_>>()?;
    Ok(Family { name: "double torus", formula: shape.formula.into(), field, meshes })
}
