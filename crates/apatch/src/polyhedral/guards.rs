//! Guards: the points of the faces where the surface touches them \[BCX94 section 5\].

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::error::HullError;
use super::fill::fill;
use super::flat_face::FlatFace;
use super::polyhedron::Polyhedron;
use super::settings::ShapeControl;

/// The guards of all faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Guards {
    /// Points, in the order of the faces.
    pub(crate) points: Vec<DVec3>,
    /// The face of each point.
    pub(crate) faces: Vec<usize>,
    /// The guard of the corner where each side starts.
    pub(crate) of_side: Vec<usize>,
    /// Triangles of guards of one face: planar pieces of the surface.
    pub(crate) fills: Vec<[usize; 3]>,
}

/// One guard for each corner of each face: the centroid of a convex face, the centre of the kernel of
/// a star-shaped one, otherwise several that form a net.
///
/// # Errors
///
/// [`HullError::NoGuards`], or [`HullError::BadGuard`] for a given one.
pub(crate) fn guards(solid: &Polyhedron, shape: &ShapeControl) -> Result<Guards, HullError> {
    let mut all = Guards { of_side: vec![0; solid.sides.len()], ..Guards::default() };
    let mut first_side = 0;
    for face in 0..solid.facets().len() {
        let flat = FlatFace::new(solid, face, first_side);
        first_side += flat.loops.iter().map(Vec::len).sum::<usize>();
        let net = match shape.guards.get(&face) {
            Some(&given) => given_guard(solid, face, &flat, given)?,
            None => net_of(&flat, face)?,
        };
        let start = all.points.len();
        let sides = flat.loops.iter().flatten().zip(net.of_corner.iter().flatten());
        sides.for_each(|(&side, guard)| all.of_side[side] = start + guard);
        all.faces.extend(net.points.iter().map(|_| face));
        // exact for a single convex face, whose guard is the origin of its coordinates
        all.points.extend(net.points.iter().map(|&p| flat.lift(p)));
        all.fills.extend(net.fills.iter().map(|t| t.map(|guard| start + guard)));
    }
    Ok(all)
}

/// Guards of one face, in its plane.
#[derive(Debug)]
struct Net {
    points: Vec<DVec2>,
    /// The guard of each corner, loop by loop.
    of_corner: Vec<Vec<usize>>,
    fills: Vec<[usize; 3]>,
}

impl Net {
    fn single(flat: &FlatFace, p: DVec2) -> Self {
        let of_corner = flat.loops.iter().map(|l| vec![0; l.len()]).collect();
        Self { points: vec![p], of_corner, fills: Vec::new() }
    }
}

fn given_guard(
    solid: &Polyhedron,
    face: usize,
    flat: &FlatFace,
    given: DVec3,
) -> Result<Net, HullError> {
    let p = flat.drop(given);
    for (in_loop, sides) in flat.loops.iter().enumerate() {
        for (corner, &side) in sides.iter().enumerate() {
            if !flat.guards(p, [in_loop, corner]) {
                return Err(HullError::BadGuard { face, vertex: solid.sides[side].origin });
            }
        }
    }
    Ok(Net::single(flat, p))
}

fn net_of(flat: &FlatFace, face: usize) -> Result<Net, HullError> {
    if flat.is_convex() {
        return Ok(Net::single(flat, DVec2::ZERO));
    }
    if flat.loops.len() == 1
        && let Some(p) = flat.kernel_centre()
    {
        return Ok(Net::single(flat, p));
    }
    let found = if flat.loops.len() == 1 { arcs(flat, 0) } else { shared_with_holes(flat) };
    let (points, of_corner) = found.ok_or(HullError::NoGuards { face })?;
    match fill(&points, &walks(&of_corner)) {
        Some(fills) => Ok(Net { points, of_corner, fills }),
        None => Err(HullError::BranchingGuards { face }),
    }
}

/// The steps from guard to guard along the loops.
fn walks(of_corner: &[Vec<usize>]) -> BTreeMap<[usize; 2], usize> {
    let mut steps = BTreeMap::new();
    for guards in of_corner {
        let next = guards.iter().cycle().skip(1);
        for (&a, &b) in guards.iter().zip(next).filter(|(a, b)| a != b) {
            *steps.entry([a, b]).or_insert(0) += 1;
        }
    }
    steps
}

/// One loop cut into as few stretches as possible, each with a guard; of several ways that which
/// keeps the guards nearest to their corners, measured by their depths.
fn arcs(flat: &FlatFace, in_loop: usize) -> Option<(Vec<DVec2>, Vec<Vec<usize>>)> {
    let n = flat.loops[in_loop].len();
    let ways = (0..n).filter_map(|start| arcs_from(flat, in_loop, start));
    let best = ways.min_by(|a, b| (a.0.len().cmp(&b.0.len())).then(a.2.total_cmp(&b.2)))?;
    Some((best.0, vec![best.1]))
}

/// Guards, guard of each corner, largest distance of a guard from a corner over its depth.
type Cut = (Vec<DVec2>, Vec<usize>, f64);

fn arcs_from(flat: &FlatFace, in_loop: usize, start: usize) -> Option<Cut> {
    let n = flat.loops[in_loop].len();
    let (mut points, mut of_corner, mut worst) = (Vec::new(), vec![0; n], 0.0_f64);
    let mut done = 0;
    while done < n {
        let mut arc: Vec<[usize; 2]> = vec![[in_loop, (start + done) % n]];
        let mut found = flat.guard_of(&arc)?;
        while done + arc.len() < n {
            arc.push([in_loop, (start + done + arc.len()) % n]);
            match flat.guard_of(&arc) {
                Some(longer) => found = longer,
                None => {
                    arc.pop();
                    break;
                }
            }
        }
        for &[_, corner] in &arc {
            of_corner[corner] = points.len();
            let reach = flat.edges[in_loop][corner].from.distance(found.0) / found.1;
            worst = worst.max(reach);
        }
        done += arc.len();
        points.push(found.0);
    }
    Some((points, of_corner, worst))
}

/// Guards of the holes, which the corners of the outer loop share.
fn shared_with_holes(flat: &FlatFace) -> Option<(Vec<DVec2>, Vec<Vec<usize>>)> {
    let mut points: Vec<DVec2> = Vec::new();
    let mut of_corner = vec![Vec::new()];
    for hole in 1..flat.loops.len() {
        let (more, guards) = arcs(flat, hole)?;
        let start = points.len();
        of_corner.push(guards.into_iter().flatten().map(|g| start + g).collect());
        points.extend(more);
    }
    for (corner, edge) in flat.edges[0].iter().enumerate() {
        let sees = |&g: &usize| flat.guards(points[g], [0, corner]);
        let distance = |g: usize| points[g].distance(edge.from);
        let nearest = (0..points.len())
            .filter(sees)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)))?;
        of_corner[0].push(nearest);
    }
    Some((points, of_corner))
}
