//! What is tried, in which order, until all edge tetrahedra are valid.

use basemesh::{TriMesh, VertexMap};
use glam::DVec3;

use super::error::SurfaceError;
use super::hull::Hull;
use super::loop_step::loop_step;
use super::normals::{cone_normals, loop_limit_normals};
use super::report::NormalsUsed;
use super::settings::Settings;

/// Where the normals come from.
#[derive(Clone, Debug, PartialEq)]
pub enum Normals {
    /// One for each vertex, pointing to the positive side. Their lengths matter: they are the
    /// gradients of the function at the vertices. For data that are not gradients, take unit normals.
    Given(VertexMap<DVec3>),
    /// Estimated: unit normals of the limit surface of Loop's scheme.
    Estimated,
}

/// A hull and how it came about.
#[derive(Debug)]
pub(crate) struct Repaired {
    pub(crate) hull: Hull,
    pub(crate) normals: NormalsUsed,
    pub(crate) loop_steps: usize,
}

/// The first hull without defects of: the data as they are, cone normals, one step of Loop's scheme,
/// both; or the one with the fewest defects, the earlier one first. \[ours, replaces XHB01 3.1\]
pub(crate) fn repaired_hull(
    mesh: TriMesh,
    normals: Normals,
    settings: &Settings,
) -> Result<Repaired, SurfaceError> {
    let repair = &settings.repair;
    let build = |mesh: TriMesh, normals: VertexMap<DVec3>| -> Result<Hull, SurfaceError> {
        let mut hull = Hull::new(mesh, normals, settings)?;
        if repair.move_apices {
            hull.move_apices();
        }
        Ok(hull)
    };
    let mut limit = match normals {
        Normals::Given(given) => {
            let given = check(&mesh, given)?;
            let hull = build(mesh, given)?;
            return Ok(Repaired { hull, normals: NormalsUsed::Given, loop_steps: 0 });
        }
        Normals::Estimated => loop_limit_normals(&mesh),
    };
    let hull = build(mesh.clone(), limit.clone())?;
    let mut best = Repaired { hull, normals: NormalsUsed::LoopLimit, loop_steps: 0 };
    let mut mesh = mesh;
    for loop_steps in 0..=usize::from(repair.loop_step) {
        if loop_steps > 0 && best.hull.defects() > 0 {
            // a mesh too large to be split keeps its defects, which are reported
            let Ok(finer) = loop_step(&mesh) else { break };
            limit = loop_limit_normals(&finer);
            mesh = finer;
            best.take_if_better(
                build(mesh.clone(), limit.clone())?,
                NormalsUsed::LoopLimit,
                loop_steps,
            );
        }
        if repair.cone_normals && best.hull.defects() > 0 {
            let cone = cone_normals(&mesh, &limit);
            best.take_if_better(build(mesh.clone(), cone)?, NormalsUsed::Cone, loop_steps);
        }
    }
    Ok(best)
}

impl Repaired {
    fn take_if_better(&mut self, hull: Hull, normals: NormalsUsed, loop_steps: usize) {
        if hull.defects() < self.hull.defects() {
            *self = Self { hull, normals, loop_steps };
        }
    }
}

fn check(mesh: &TriMesh, normals: VertexMap<DVec3>) -> Result<VertexMap<DVec3>, SurfaceError> {
    let (given, expected) = (normals.len(), mesh.topology().vertex_count());
    if given != expected {
        return Err(SurfaceError::Count { given, expected });
    }
    let usable = |n: &DVec3| (f64::MIN_POSITIVE..f64::MAX).contains(&n.length_squared());
    let unusable = normals.iter().find(|(_, n)| !usable(n)).map(|(v, n)| (v.index(), *n));
    match unusable {
        Some((vertex, normal)) => Err(SurfaceError::Normal { vertex, normal }),
        None => Ok(normals),
    }
}
