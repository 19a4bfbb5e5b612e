//! The connected parts of a surface: open or closed, and which closed ones are holes in others.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{PatchSurface, PatchSurfaceError};

/// A connected part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shell {
    /// In ascending order.
    pub(crate) faces: Vec<usize>,
    pub(crate) is_closed: bool,
    /// For a closed shell that faces inward: the shell that it is a hole in, by its number.
    pub(crate) hole_in: Option<usize>,
}

/// The connected parts, ordered by their lowest faces. Faces are connected through edges.
///
/// # Errors
///
/// [`PatchSurfaceError`] for an edge with more than two faces or with faces that are turned against
/// each other.
pub(crate) fn shells(surface: &PatchSurface) -> Result<Vec<Shell>, PatchSurfaceError> {
    let at_edge = faces_at_edges(surface)?;
    let mut shell_of = vec![usize::MAX; surface.faces().len()];
    let mut shells: Vec<Shell> = Vec::new();
    for first in 0..shell_of.len() {
        if shell_of[first] != usize::MAX {
            continue;
        }
        let (mut faces, mut is_closed) = (vec![first], true);
        shell_of[first] = shells.len();
        let mut next = 0;
        while let Some(&face) = faces.get(next) {
            next += 1;
            for &edge in surface.sides(face) {
                is_closed &= at_edge[edge].len() == 2;
                for &other in &at_edge[edge] {
                    if shell_of[other] == usize::MAX {
                        shell_of[other] = shells.len();
                        faces.push(other);
                    }
                }
            }
        }
        faces.sort_unstable();
        shells.push(Shell { faces, is_closed, hole_in: None });
    }
    find_holes(surface, &mut shells);
    Ok(shells)
}

fn faces_at_edges(surface: &PatchSurface) -> Result<Vec<Vec<usize>>, PatchSurfaceError> {
    let mut at_edge: Vec<Vec<(usize, bool)>> = vec![Vec::new(); surface.edges().len()];
    for face in 0..surface.faces().len() {
        for (side, &edge) in surface.sides(face).iter().enumerate() {
            at_edge[edge].push((face, surface.runs_forward(face, side)));
        }
    }
    for (edge, faces) in at_edge.iter().enumerate() {
        let [lower, higher] = surface.edges()[edge];
        match **faces {
            [(a, forward), (b, other)] if forward == other => {
                return Err(PatchSurfaceError::Turned { lower, higher, faces: [a, b] });
            }
            [_, _, _, ..] => {
                let faces = faces.len();
                return Err(PatchSurfaceError::TooManyFaces { lower, higher, faces });
            }
            _ => {}
        }
    }
    Ok(at_edge.into_iter().map(|faces| faces.into_iter().map(|(face, _)| face).collect()).collect())
}

/// A closed shell that faces inward is a hole in the smallest shell around it that faces outward.
fn find_holes(surface: &PatchSurface, shells: &mut [Shell]) {
    if shells.len() < 2 {
        return;
    }
    let volumes: Vec<f64> = shells
        .iter()
        .map(|shell| if shell.is_closed { volume(surface, shell) } else { 0.0 })
        .collect();
    for hole in 0..shells.len() {
        if volumes[hole] >= 0.0 {
            continue;
        }
        let inside = surface.vertices()[surface.faces()[shells[hole].faces[0]].corners()[0]];
        shells[hole].hole_in = (0..shells.len())
            .filter(|&around| volumes[around] > 0.0)
            .filter(|&around| winding(surface, &shells[around], inside) > 0.5)
            .min_by(|&a, &b| volumes[a].total_cmp(&volumes[b]));
    }
}

/// The flat triangles between the corners.
fn triangles<'a>(
    surface: &'a PatchSurface,
    shell: &'a Shell,
) -> impl Iterator<Item = [DVec3; 3]> + 'a {
    shell.faces.iter().flat_map(move |&face| {
        let corners = surface.faces()[face].corners();
        (1..corners.len() - 1)
            .map(move |k| [corners[0], corners[k], corners[k + 1]].map(|v| surface.vertices()[v]))
    })
}

/// Volume inside the flat triangles; negative if they face inward.
fn volume(surface: &PatchSurface, shell: &Shell) -> f64 {
    // from a point of the shell, so that large coordinates cancel
    let origin = surface.vertices()[surface.faces()[shell.faces[0]].corners()[0]];
    triangles(surface, shell)
        .map(|t| t.map(|p| p - origin))
        .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
        .sum()
}

/// How often the flat triangles go around a point: 1 inside a shell that faces outward, 0 outside.
fn winding(surface: &PatchSurface, shell: &Shell, around: DVec3) -> f64 {
    let solid_angle = |t: [DVec3; 3]| {
        let [a, b, c] = t.map(|p| p - around);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let across = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(across)
    };
    triangles(surface, shell).map(solid_angle).sum::<f64>() / (2.0 * TAU)
}
