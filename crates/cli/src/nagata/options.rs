//! The options that decide which surface is made.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use smoothpatch::nagata::{Apex, Settings, TangentPlanes};
use smoothpatch::nagata_surface::Tips;

use crate::output_files::extension;
use crate::values;

/// A mesh and how it is curved.
#[derive(Args)]
#[group(skip)]
pub(crate) struct SurfaceOptions {
    /// Triangles and quadrilaterals, with or without normals (OBJ)
    #[arg(value_name = "MESH.obj")]
    pub(crate) mesh: PathBuf,

    /// How smoothly neighbouring patches join
    #[arg(long, value_enum, default_value_t = ContinuityName::C0)]
    pub(crate) continuity: ContinuityName,

    /// How tangent planes along edges are chosen with `--continuity g1` [default: robust]
    #[arg(long, value_enum)]
    pub(crate) tangent_planes: Option<TangentPlanesName>,

    /// Where normals come from: `file`, `estimate`, or a scene file with the surface that the mesh
    /// stands for [default: file if it has any, otherwise estimate]
    #[arg(long, value_name = "file|estimate|SCENE.ron", value_parser = NormalsName::parse)]
    pub(crate) normals: Option<NormalsName>,

    /// Estimated normals are separated at edges whose faces meet at this angle or more. It must be
    /// larger than the angle from face to face on round parts
    #[arg(long, value_name = "DEG", default_value = "60", value_parser = values::crease_angle)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) crease_angle: f64,

    /// Which normals sharp tips have, such as the apexes of cones [default: as elsewhere]
    #[arg(long, value_enum, value_name = "none|faces|axis")]
    pub(crate) apex: Option<ApexName>,

    /// Tips are vertices from whose mean normal all faces turn by more than this
    #[arg(long, value_name = "DEG", default_value = "30", value_parser = values::crease_angle)]
    #[arg(allow_hyphen_values = true, requires = "apex")]
    pub(crate) apex_angle: f64,

    /// Cut quadrilaterals along their shorter diagonals, and larger faces around their first corners
    #[arg(long)]
    pub(crate) triangulate: bool,
}

impl SurfaceOptions {
    /// Files that must not be overwritten with results.
    pub(crate) fn files_read(&self) -> Vec<&Path> {
        let scene = self.normals.as_ref().and_then(NormalsName::scene);
        [Some(self.mesh.as_path()), scene].into_iter().flatten().collect()
    }

    /// What tips get, if they are to be treated.
    pub(crate) fn tips(&self) -> Option<Tips> {
        let angle = self.apex_angle.to_radians();
        self.apex.map(|name| Tips { angle, normals: name.into() })
    }

    /// Settings of the construction.
    pub(crate) fn settings(&self) -> anyhow::Result<Settings> {
        match (self.continuity, self.tangent_planes) {
            (ContinuityName::C0, None) => Ok(Settings::position()),
            (ContinuityName::C0, Some(_)) => anyhow::bail!(
                "--tangent-planes: C0 patches have no common tangent planes; add --continuity g1"
            ),
            (ContinuityName::G1, planes) => match planes.map(TangentPlanes::from) {
                None | Some(TangentPlanes::Robust) => Ok(Settings::tangent_plane()),
                Some(TangentPlanes::Published) => Ok(Settings::published()),
            },
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ContinuityName {
    /// Common edges; polynomial patches, which .vtu files hold exactly
    C0,
    /// Common tangent planes as well; triangles only, rational patches
    G1,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TangentPlanesName {
    /// Works on edges with inflections too
    Robust,
    /// As in Nagata (2010)
    Published,
}

impl From<TangentPlanesName> for TangentPlanes {
    fn from(name: TangentPlanesName) -> Self {
        match name {
            TangentPlanesName::Robust => Self::Robust,
            TangentPlanesName::Published => Self::Published,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ApexName {
    /// None: straight rulings and regular patches, but small kinks at the tip; for finite elements
    None,
    /// One for each face: exact cones without kinks, whose derivatives vanish at the tip
    Faces,
    /// The axis: the same for straight rulings
    Axis,
}

impl From<ApexName> for Apex {
    fn from(name: ApexName) -> Self {
        match name {
            ApexName::None => Self::NoNormal,
            ApexName::Faces => Self::FaceNormals,
            ApexName::Axis => Self::Axis,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CellName {
    /// Quadratic triangles and quadrilaterals: one a face and exact for C0, N² a face for G1
    Quadratic,
    /// Flat triangles, N² a triangle
    Flat,
}

/// A source of normals.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NormalsName {
    File,
    Estimate,
    Scene(PathBuf),
}

impl NormalsName {
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        match text {
            "file" => Ok(Self::File),
            "estimate" => Ok(Self::Estimate),
            _ if extension(Path::new(text)) == "ron" => Ok(Self::Scene(text.into())),
            _ => {
                Err("give `file`, `estimate` or the name of a scene file, which ends with .ron"
                    .into())
            }
        }
    }

    pub(crate) fn scene(&self) -> Option<&Path> {
        match self {
            Self::Scene(path) => Some(path),
            _ => None,
        }
    }
}
