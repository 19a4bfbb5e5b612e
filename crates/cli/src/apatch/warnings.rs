//! What a user must know about a result that is not what it should be.

use smoothpatch::apatch::Element;
use smoothpatch::apatch_surface::RationalReport;

use super::outputs::Outputs;

/// One sentence for each kind of fault; none for a good result. Vertices, edges and faces are those
/// of the mesh that the patches are over.
pub(crate) fn warnings(report: &RationalReport, outputs: &Outputs) -> Vec<String> {
    let built = &report.construction;
    let mut warnings = Vec::new();
    if !built.invalid_edges.is_empty() {
        let names = built.invalid_edges.iter().map(|edge| {
            let [a, b] = edge.vertices;
            format!("{a}-{b}")
        });
        warnings.push(format!(
            "the surface folds back at {} edges ({}): their tetrahedra do not fit between those of \
             the faces; a finer mesh or other normals would help",
            built.invalid_edges.len(),
            listed(names)
        ));
    }
    if !built.behind.is_empty() {
        warnings.push(format!(
            "{} faces ({}) are turned away from the normal at a corner: mesh and normals do not fit",
            built.behind.len(),
            listed(built.behind.iter().map(usize::to_string))
        ));
    }
    if !built.not_single.is_empty() {
        warnings.push(format!(
            "the surface is not a single sheet over {} edges ({})",
            built.not_single.len(),
            listed(built.not_single.iter().map(usize::to_string))
        ));
    } else if report.sheet.bad > 0 {
        warnings.push(format!(
            "{} of {} transversals do not meet the surface exactly once",
            report.sheet.bad, report.sheet.transversals
        ));
    }
    if outputs.missing > 0 {
        warnings.push(format!(
            "{} points of the triangles are on the mesh, because there is no surface over it there",
            outputs.missing
        ));
    }
    if !outputs.flipped.is_empty() {
        warnings.push(format!(
            "{} flat triangles look the wrong way ({}); another --density would help",
            outputs.flipped.len(),
            listed(outputs.flipped.iter().map(|element| match element {
                Element::Face(face) => format!("face {face}"),
                Element::Edge(edge) => format!("edge {edge}"),
            }))
        ));
    }
    if let Some(deviation) = report.deviation.as_ref().filter(|d| d.failed_samples > 0) {
        warnings.push(format!(
            "{} sample points find no foot on the surface and count as infinitely far from it",
            deviation.failed_samples
        ));
    }
    if !warnings.is_empty() && built.loop_steps > 0 {
        warnings.push("numbers are those of the mesh after one step of Loop's scheme".to_owned());
    }
    warnings
}

/// The first few, separated by commas.
fn listed(mut names: impl Iterator<Item = String>) -> String {
    let first: Vec<String> = names.by_ref().take(5).collect();
    let more = if names.next().is_some() { ", …" } else { "" };
    first.join(", ") + more
}
