//! How well the jets of a mesh fit.

use meshfield::MeshField;
use serde::{Deserialize, Serialize};

/// The fits at all vertices of a mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JetSummary {
    /// Number of vertices with polynomials of each degree, from 1 to 4.
    pub by_degree: [usize; 4],
    /// The vertices of degree 1, counted from 0: no polynomial agrees with the faces there.
    pub plain_vertices: Vec<usize>,
    /// Largest condition number of the scaled equations.
    pub max_condition: f64,
    /// Largest distance of neighbours from the polynomial of a vertex (a weighted root mean square), over
    /// their radius.
    pub max_residual: f64,
    /// The root mean square of all residuals.
    pub rms_residual: f64,
    /// The vertex with the largest residual, counted from 0.
    pub worst_vertex: usize,
}

/// Summary of the fits of a mesh, or of the pieces of one: vertices are then counted piece after piece.
#[must_use]
pub fn jet_summary(fields: &[&MeshField]) -> JetSummary {
    let mut summary = JetSummary::default();
    let jets = fields.iter().flat_map(|field| field.jets().as_slice());
    let mut count = 0;
    for (vertex, jet) in jets.enumerate() {
        count += 1;
        let quality = jet.quality();
        summary.by_degree[quality.degree - 1] += 1;
        if quality.degree == 1 {
            summary.plain_vertices.push(vertex);
        }
        summary.max_condition = summary.max_condition.max(quality.condition);
        summary.rms_residual += quality.residual.powi(2);
        if quality.residual > summary.max_residual {
            summary.max_residual = quality.residual;
            summary.worst_vertex = vertex;
        }
    }
    summary.rms_residual = (summary.rms_residual / f64::from(count.max(1))).sqrt();
    summary
}
