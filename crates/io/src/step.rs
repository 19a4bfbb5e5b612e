//! Patches as the faces of solids in STEP files (ISO 10303-21), exact up to rounding.
//!
//! A triangle becomes three quadrilaterals around its centre, each a tensor-product Bézier surface
//! of the same degree in both directions: corner, middle of an edge, centre, middle of the other
//! edge. Their control points are values of the blossom. Or it becomes one surface with a side of
//! length zero, which some programs do not like. Vertices, edge curves and control points that
//! faces share are written once, so there is nothing to sew.

mod degenerate;
mod document;
mod edges;
mod error;
mod faces;
mod three_quads;

use std::io::{self, Write};

use crate::patch_surface::{PatchNet, PatchSurface, Shell, shells};
use document::Document;
use edges::EdgeInstances;
use faces::FaceWriter;

pub use error::StepError;

/// As far as our binomials go. OpenCASCADE, which most free programs use, takes 25.
const MAX_DEGREE: usize = bezier_core::MAX_DEGREE;

/// Which application protocol a file names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StepSchema {
    /// AP242, managed model based 3D engineering.
    #[default]
    Ap242,
    /// AP214, automotive design, for older programs.
    Ap214,
}

/// What becomes of a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StepFaces {
    /// Three regular faces.
    #[default]
    Quads,
    /// One face with a side of length zero, at the first corner: a third of the size.
    Degenerate,
}

/// The length that coordinates are multiples of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// Millimetres.
    #[default]
    Millimetre,
    /// Centimetres.
    Centimetre,
    /// Metres.
    Metre,
}

/// What to write.
#[derive(Clone, Debug, PartialEq)]
pub struct StepOptions {
    /// The application protocol.
    pub schema: StepSchema,
    /// What becomes of a triangle.
    pub faces: StepFaces,
    /// The unit of the coordinates.
    pub unit: LengthUnit,
    /// The name of the part.
    pub name: String,
    /// What the file says about the accuracy of its points, in diagonals of the bounding box of the
    /// vertices. Nothing is changed by it.
    pub uncertainty: f64,
}

impl Default for StepOptions {
    fn default() -> Self {
        Self {
            schema: StepSchema::default(),
            faces: StepFaces::default(),
            unit: LengthUnit::default(),
            name: "part".into(),
            uncertainty: 1e-7,
        }
    }
}

/// What was written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepCounts {
    /// Faces of the file.
    pub faces: usize,
    /// Edges of the file, without sides of length zero.
    pub edges: usize,
    /// Solids: closed shells, holes not counted.
    pub solids: usize,
    /// Shells with open edges.
    pub open_shells: usize,
}

/// Writes a surface as solids, one for each closed connected part, and as open shells for parts
/// with open edges.
///
/// A closed part that faces inward is a hole of the part around it. Coordinates are the shortest
/// digits that give the same f64; control points of triangles are convex combinations of those of
/// the patch, correct to a few roundings.
///
/// # Errors
///
/// [`StepError`]; nothing is written unless it is [`StepError::Io`].
pub fn write_step(
    out: &mut dyn Write,
    surface: &PatchSurface,
    options: &StepOptions,
) -> Result<StepCounts, StepError> {
    if surface.degree() > MAX_DEGREE {
        return Err(StepError::Degree { degree: surface.degree(), limit: MAX_DEGREE });
    }
    if surface.faces().is_empty() {
        return Err(StepError::NoFaces);
    }
    if !(options.uncertainty.is_finite() && options.uncertainty > 0.0) {
        return Err(StepError::Uncertainty { value: options.uncertainty });
    }
    let shells = shells(surface)?;
    Ok(write_checked(out, surface, &shells, options)?)
}

fn write_checked(
    out: &mut dyn Write,
    surface: &PatchSurface,
    shells: &[Shell],
    options: &StepOptions,
) -> io::Result<StepCounts> {
    let mut document = Document::begin(out, options, surface)?;
    let edges = EdgeInstances::write(&mut document, surface, options.faces)?;
    let mut writer = FaceWriter::new(surface, &edges, options.faces);
    let mut shell_ids = Vec::with_capacity(shells.len());
    for shell in shells {
        let mut faces = Vec::with_capacity(3 * shell.faces.len());
        for &face in &shell.faces {
            writer.write(&mut document, face, &mut faces)?;
        }
        let kind = if shell.is_closed { "CLOSED_SHELL" } else { "OPEN_SHELL" };
        shell_ids.push(document.list(kind, &faces)?);
    }
    let holes_of = |shell: usize| -> Vec<u64> {
        let holes = (0..shells.len()).filter(|&hole| shells[hole].hole_in == Some(shell));
        holes.map(|hole| shell_ids[hole]).collect()
    };
    let mut solids = Vec::new();
    for (at, shell) in shells.iter().enumerate() {
        if shell.is_closed && shell.hole_in.is_none() {
            solids.push(document.solid(shell_ids[at], &holes_of(at))?);
        }
    }
    let open = shells.iter().zip(&shell_ids).filter(|(shell, _)| !shell.is_closed);
    let open: Vec<_> = open.map(|(_, &id)| id).collect();
    let counts = StepCounts {
        faces: writer.written,
        edges: edges.written + writer.inner_edges,
        solids: solids.len(),
        open_shells: open.len(),
    };
    document.end(&solids, &open)?;
    Ok(counts)
}

/// About what a surface takes as STEP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepSize {
    /// Faces of the file.
    pub faces: u64,
    /// Bytes of the file, to a fifth.
    pub bytes: u64,
    /// Seconds that OpenCASCADE, which most free programs use, takes to read it: a rough guide.
    pub reading_seconds: u64,
}

/// About what a surface takes as STEP, before it is written.
///
/// Counted: each control point is written once (`POINT` bytes) and named in the net of each of its
/// faces (`NAME` bytes); each face has some more (`FACE`). The figures are those of fitted surfaces.
#[must_use]
pub fn step_size(surface: &PatchSurface, faces: StepFaces) -> StepSize {
    const POINT: u64 = 90;
    const NAME: u64 = 9;
    const FACE: u64 = 700;
    // of degree 7, on one core of 2.5 GHz
    const NET_POINTS_A_SECOND: u64 = 20_000;
    let n = surface.degree() as u64;
    let (inner, net) = ((n - 1) * (n - 1), (n + 1) * (n + 1));
    let cut = |face: usize| {
        faces == StepFaces::Quads && matches!(surface.net(face), PatchNet::Triangle(_))
    };
    let three = (0..surface.faces().len()).filter(|&face| cut(face)).count() as u64;
    let one = surface.faces().len() as u64 - three;
    let edges = surface.edges().len() as u64;
    let on_edges = if three > 0 { 2 * n - 1 } else { n - 1 };
    let points = surface.vertices().len() as u64
        + edges * on_edges
        + three * (3 * inner + 3 * (n - 1) + 1)
        + one * inner;
    let faces = 3 * three + one;
    let bytes = points * POINT + faces * (net * NAME + FACE);
    StepSize { faces, bytes, reading_seconds: faces * net / NET_POINTS_A_SECOND }
}
