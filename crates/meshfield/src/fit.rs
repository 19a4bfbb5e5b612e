//! Osculating jets: a polynomial at each vertex, fitted to its neighbours [CP05].
//!
//! In a frame whose third axis is an estimated normal, the surface is the graph of a function. Its
//! Taylor polynomial of degree `d` is estimated by least squares over rings of neighbours at distance
//! `h`: normals are then exact to `O(h^d)` and curvatures to `O(h^(d-1))` [CP05, section 4]. Here the
//! polynomial passes through the vertex.

use basemesh::{TriMesh, VertexId, VertexMap};
use glam::DVec3;
use nalgebra::{DMatrix, DVector};

use crate::error::JetError;
use crate::jet::{FitQuality, VertexJet};
use crate::plain::plain_jet;
use crate::polynomial::{Polynomial, coefficient_count};
use crate::rings::{Neighbours, neighbours};
use crate::settings::JetSettings;

/// Fits in turn to the axis found by the one before: the first one is that of the faces.
const ROUNDS: usize = 2;

/// A polynomial at each vertex of a mesh, from the positions of its neighbours.
///
/// # Errors
///
/// [`JetError`] for the first vertex where nothing can be fitted.
pub fn fit_jets(mesh: &TriMesh, settings: &JetSettings) -> Result<VertexMap<VertexJet>, JetError> {
    settings.check()?;
    let count = mesh.topology().vertex_count();
    let normals = VertexMap::try_from_fn(count, |v| {
        let no_normal = JetError::NoNormal { vertex: v.index(), at: mesh.position(v) };
        face_normal(mesh, v).ok_or(no_normal)
    })?;
    VertexMap::try_from_fn(count, |v| {
        fit_jet(mesh, &normals, v, settings)
            .or_else(|| plain_jet(mesh, &normals, v))
            .ok_or(JetError::NotFinite { vertex: v.index(), at: mesh.position(v) })
    })
}

/// Mean normal of the faces around a vertex, weighted by their angle there.
fn face_normal(mesh: &TriMesh, vertex: VertexId) -> Option<DVec3> {
    let topology = mesh.topology();
    let normal: DVec3 = topology
        .fan(vertex)
        .map(|h| {
            let [o, a, b] = [topology.origin(h), topology.target(h), topology.origin(h.previous())]
                .map(|v| mesh.position(v));
            let cross = (a - o).cross(b - o);
            let angle = cross.length().atan2((a - o).dot(b - o));
            cross.normalize_or_zero() * angle
        })
        .sum();
    normal.try_normalize()
}

/// The highest degree, up to that of the settings, that the neighbours determine; `None` if not even a
/// quadric agrees with the faces.
fn fit_jet(
    mesh: &TriMesh,
    normals: &VertexMap<DVec3>,
    vertex: VertexId,
    settings: &JetSettings,
) -> Option<VertexJet> {
    let (near, far) = (settings.max_turning.cos(), settings.max_far_turning.cos());
    let normal = normals[vertex];
    let accept =
        |v: VertexId, ring: usize| normals[v].dot(normal) > if ring == 1 { near } else { far };
    (2..=settings.degree).rev().find_map(|degree| {
        let needed = coefficient_count(degree);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let wanted = (needed as f64 * settings.points_per_coefficient).ceil() as usize;
        let mut around = neighbours(mesh, vertex, wanted, accept);
        if degree == 2 && !around.complete {
            // no more rings than it takes
            around = neighbours(mesh, vertex, needed, accept);
        }
        let Neighbours { vertices, rings, complete } = around;
        if vertices.len() < needed || !(complete || degree == 2) {
            return None;
        }
        let offsets: Vec<DVec3> =
            vertices.iter().map(|&v| mesh.position(v) - mesh.position(vertex)).collect();
        let mut axis = normal;
        let mut jet = None;
        for _ in 0..ROUNDS {
            let fitted = fit_along(mesh.position(vertex), axis, &offsets, rings, degree, settings)?;
            axis = fitted.surface_jet()?.normal;
            jet = Some(fitted);
        }
        let mut jet = jet?;
        jet.quality.normal_error = normal_error(mesh, normals, vertex, &jet);
        let most = if degree == 2 { settings.max_quadric_error } else { settings.max_normal_error };
        let is_resolved = jet.quality.normal_error <= most;
        (is_resolved && jet.quality.condition <= settings.max_condition).then_some(jet)
    })
}

/// How far the polynomial leans against the faces at the neighbours along edges.
fn normal_error(
    mesh: &TriMesh,
    normals: &VertexMap<DVec3>,
    vertex: VertexId,
    jet: &VertexJet,
) -> f64 {
    let lean = |v: VertexId| {
        let normal = jet.normal_at(mesh.position(v)).unwrap_or(-normals[v]);
        normal.cross(normals[v]).length().atan2(normal.dot(normals[v]))
    };
    neighbours(mesh, vertex, 1, |_, _| true).vertices.into_iter().map(lean).fold(0.0, f64::max)
}

/// Least squares in the frame with this third axis; `None` if a number is not finite.
fn fit_along(
    origin: DVec3,
    axis: DVec3,
    offsets: &[DVec3],
    rings: usize,
    degree: usize,
    settings: &JetSettings,
) -> Option<VertexJet> {
    let (x, y) = axis.any_orthonormal_pair();
    let axes = [x, y, axis];
    let local: Vec<[f64; 3]> = offsets.iter().map(|o| axes.map(|a| a.dot(*o))).collect();
    let radius = local.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max);
    let (rows, columns) = (local.len(), coefficient_count(degree));
    let mut matrix = DMatrix::zeros(rows, columns);
    let mut heights = DVector::zeros(rows);
    let mut squares = 0.0;
    for (row, &[x, y, z]) in local.iter().enumerate() {
        let [x, y, z] = [x, y, z].map(|v| v / radius);
        let weight = x.hypot(y).hypot(z).powi(-settings.distance_power);
        squares += weight * weight;
        heights[row] = weight * z;
        for (column, power) in Polynomial::monomials(degree, x, y).enumerate() {
            matrix[(row, column)] = weight * power;
        }
    }
    let (solution, condition) = least_squares(matrix.clone(), &heights)?;
    let residual = ((matrix * &solution - heights).norm_squared() / squares).sqrt();
    let quality =
        FitQuality { degree, points: rows, rings, condition, residual, normal_error: 0.0, radius };
    let polynomial = Polynomial::new(degree, solution.as_slice());
    let is_finite = residual.is_finite() && solution.iter().all(|c| c.is_finite());
    is_finite.then_some(VertexJet { origin, axes, polynomial, quality })
}

/// The solution by singular values, of equations whose columns are scaled to the same length first,
/// and the condition number after that.
fn least_squares(mut matrix: DMatrix<f64>, rhs: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
    let scales: Vec<f64> = matrix.column_iter().map(|c| c.norm()).collect();
    for (mut column, &scale) in matrix.column_iter_mut().zip(&scales) {
        if scale > 0.0 {
            column /= scale;
        }
    }
    let svd = matrix.try_svd(true, true, f64::EPSILON, 1000)?;
    let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
    let mut solution = svd.solve(rhs, 0.0).ok()?;
    for (value, scale) in solution.iter_mut().zip(scales) {
        *value /= scale;
    }
    Some((solution, largest / smallest))
}
