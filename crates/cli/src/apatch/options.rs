//! The options that decide which surface is made.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use smoothpatch::apatch::polyhedral::{SOLID_NAMES, Scheme};
use smoothpatch::apatch::rational::{FreeWeightRule, RepairSettings, Settings};

use super::tension::Tension;
use crate::nagata::options::NormalsName;
use crate::output_files::extension;

/// A mesh and what is made of it.
#[derive(Args)]
#[group(skip)]
pub(crate) struct RationalOptions {
    /// Triangles, with or without normals (OBJ); for the schemes of solids an OFF or OBJ file with
    /// planar faces, or a name such as `cube`, `icosahedron`, `frame`; or a file that `--weights` wrote
    #[arg(value_name = "MESH.obj")]
    pub(crate) mesh: PathBuf,

    /// Where normals come from: `file`, `estimate`, or a scene file with the surface that the mesh
    /// stands for, whose gradients are taken [default: file if it has any, otherwise estimate]
    #[arg(long, value_name = "file|estimate|SCENE.ron", value_parser = NormalsName::parse)]
    pub(crate) normals: Option<NormalsName>,

    /// Cut quadrilaterals along their shorter diagonals, and larger faces around their first corners
    #[arg(long)]
    pub(crate) triangulate: bool,

    /// Which function
    #[arg(long, value_enum, default_value_t = SchemeName::Rational)]
    scheme: SchemeName,

    /// How the number that is free in each tetrahedron is chosen
    #[arg(long, value_enum, default_value_t = RuleName::Clamped)]
    rule: RuleName,

    /// From -1 (as far out as the surface stays in one piece) over 0 (the rule's choice) to any
    /// positive number (close to the triangles): one number, or a .ron or .json file with one for
    /// each face. For c1-cubic from -1 to 50: each unit doubles the pull inwards
    #[arg(long, value_name = "T|FILE", default_value = "0", value_parser = Tension::parse)]
    #[arg(allow_hyphen_values = true)]
    tension: Tension,

    /// What may be changed where tetrahedra overlap
    #[arg(long, value_enum, default_value_t = RepairName::All)]
    repair: RepairName,
}

impl RationalOptions {
    /// Files that must not be overwritten with results.
    pub(crate) fn files_read(&self) -> Vec<&Path> {
        let scene = self.normals.as_ref().and_then(NormalsName::scene);
        [Some(self.mesh.as_path()), scene, self.tension.file()].into_iter().flatten().collect()
    }

    /// The file with the tensions, if there is one.
    pub(crate) fn tension_file(&self) -> Option<&Path> {
        self.tension.file()
    }

    pub(crate) fn tension(&self) -> &Tension {
        &self.tension
    }

    /// The scheme, if it is one for solids; their normals are those of their faces.
    pub(crate) fn solid_scheme(&self, compared: bool) -> anyhow::Result<Option<Scheme>> {
        let scheme = match self.scheme {
            SchemeName::Rational => return Ok(None),
            SchemeName::C1Cubic => Scheme::C1Cubic,
            SchemeName::C2Quintic => Scheme::C2Quintic,
        };
        match self.rational_option(compared) {
            Some(name) => anyhow::bail!("{name} is not for solids; use --scheme rational"),
            None => Ok(Some(scheme)),
        }
    }

    /// An option that only the rational scheme has, if one is given.
    fn rational_option(&self, compared: bool) -> Option<&'static str> {
        let given = [
            ("--normals", self.normals.is_some()),
            ("--reference", compared),
            ("--triangulate", self.triangulate),
            ("--rule", self.rule != RuleName::Clamped),
            ("--repair", self.repair != RepairName::All),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
    }

    /// Whether the file holds a surface that is made already.
    pub(crate) fn is_saved(&self) -> bool {
        extension(&self.mesh) == "json"
    }

    /// Refuses everything that would make another surface of a file with tetrahedra and weights.
    pub(crate) fn refuse_choices(&self, compared: bool, solid: bool) -> anyhow::Result<()> {
        let given = [
            ("--scheme", self.scheme != SchemeName::Rational),
            ("--tension", self.tension != Tension::Uniform(0.0)),
            ("--cut and --weights", solid),
        ];
        let other = given.into_iter().find(|(_, given)| *given).map(|(name, _)| name);
        match self.rational_option(compared).or(other) {
            Some(name) => {
                anyhow::bail!("{name}: the surface in {} is made already", self.mesh.display())
            }
            None => Ok(()),
        }
    }

    /// Refuses names and files of solids, which need another scheme.
    pub(crate) fn refuse_solids(&self) -> anyhow::Result<()> {
        let named = SOLID_NAMES.iter().any(|name| self.mesh == Path::new(name));
        if (named && !self.mesh.exists()) || extension(&self.mesh) == "off" {
            let name = self.mesh.display();
            anyhow::bail!("{name} is a solid; add --scheme c1-cubic or c2-quintic");
        }
        Ok(())
    }

    /// Settings of the construction.
    pub(crate) fn settings(&self) -> anyhow::Result<Settings> {
        Ok(Settings {
            rule: self.rule.into(),
            shape: self.tension.read()?,
            repair: self.repair.into(),
            ..Settings::default()
        })
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SchemeName {
    /// C1, rational over convex faces, with given or estimated normals (Xu, Huang and Bajaj 2001)
    Rational,
    /// Solids: C1, degree 3 (Bajaj, Chen and Xu 1994)
    C1Cubic,
    /// Solids: C2, degree 5, the fairest
    C2Quintic,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum RuleName {
    /// After the neighbours: reproduces quadrics, order 3
    Clamped,
    /// As in the paper: order 2, often closer on very coarse meshes
    Published,
}

impl From<RuleName> for FreeWeightRule {
    fn from(name: RuleName) -> Self {
        match name {
            RuleName::Clamped => Self::Clamped,
            RuleName::Published => Self::Published,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum RepairName {
    /// Tetrahedra, then estimated normals, then one step of Loop's scheme, which rounds the shape
    All,
    /// Tetrahedra and estimated normals
    KeepMesh,
    /// Nothing
    None,
}

impl From<RepairName> for RepairSettings {
    fn from(name: RepairName) -> Self {
        match name {
            RepairName::All => Self::default(),
            RepairName::KeepMesh => Self { loop_step: false, ..Self::default() },
            RepairName::None => Self::NONE,
        }
    }
}
