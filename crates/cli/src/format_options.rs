//! The options of file formats, the same for every kind of surface.

use std::path::Path;

use clap::{Args, ValueEnum};
use smoothpatch::io::{LengthUnit, MshOptions, MshVersion, StepFaces, StepOptions, StepSchema};

use crate::values;

/// How surfaces are written.
#[derive(Args)]
#[group(skip)]
pub(crate) struct FormatOptions {
    /// The largest distance from the patches to the flat triangles of .obj, .ply, .stl and .glb files,
    /// in diagonals of the bounding box, instead of --divisions: as few triangles as that takes
    #[arg(long, value_name = "DISTANCE", conflicts_with = "divisions")]
    #[arg(value_parser = values::positive, allow_hyphen_values = true)]
    pub(crate) chord_tolerance: Option<f64>,

    /// The order of elements in .msh files, 1 to 10 [default: the degree of the patches]
    #[arg(long, value_name = "N", value_parser = values::order)]
    pub(crate) order: Option<usize>,

    /// The version of .msh files
    #[arg(long, value_enum, default_value_t = MshVersionName::V4, value_name = "VERSION")]
    msh_version: MshVersionName,

    /// What becomes of a triangular patch in .step files: three regular faces, which every program
    /// reads, or one with a side of length zero, a third of the size
    #[arg(long, value_enum, default_value_t = StepFacesName::Quads, value_name = "KIND")]
    step_faces: StepFacesName,

    /// Which application protocol .step files name
    #[arg(long, value_enum, default_value_t = StepSchemaName::Ap242, value_name = "PROTOCOL")]
    step_schema: StepSchemaName,

    /// The unit of coordinates in .step files
    #[arg(long, value_enum, default_value_t = UnitName::Mm, value_name = "UNIT")]
    unit: UnitName,
}

impl FormatOptions {
    /// What is written to a Gmsh file.
    pub(crate) fn msh(&self) -> MshOptions {
        let version = match self.msh_version {
            MshVersionName::V4 => MshVersion::V4,
            MshVersionName::V2 => MshVersion::V2,
        };
        MshOptions { version, ..MshOptions::default() }
    }

    /// What is written to a STEP file with this name.
    pub(crate) fn step(&self, path: &Path) -> StepOptions {
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        StepOptions {
            schema: match self.step_schema {
                StepSchemaName::Ap242 => StepSchema::Ap242,
                StepSchemaName::Ap214 => StepSchema::Ap214,
            },
            faces: match self.step_faces {
                StepFacesName::Quads => StepFaces::Quads,
                StepFacesName::Degenerate => StepFaces::Degenerate,
            },
            unit: match self.unit {
                UnitName::Mm => LengthUnit::Millimetre,
                UnitName::Cm => LengthUnit::Centimetre,
                UnitName::M => LengthUnit::Metre,
            },
            name: stem.unwrap_or_default(),
            ..StepOptions::default()
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MshVersionName {
    /// For Gmsh 4
    #[value(name = "4.1")]
    V4,
    /// For most other programs
    #[value(name = "2.2")]
    V2,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum StepFacesName {
    /// Three faces for a triangle
    Quads,
    /// One face for a triangle
    Degenerate,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum StepSchemaName {
    /// Managed model based 3D engineering
    Ap242,
    /// Automotive design, for older programs
    Ap214,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum UnitName {
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
}
