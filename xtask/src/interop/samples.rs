//! The files and what is true of them.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::Result;
use serde_json::{Value, json};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::io::{
    CreasedTessellation, CurvedMesh, MshOptions, MshVersion, PatchSurface, StepOptions,
    write_atomically, write_glb, write_msh, write_obj_creased, write_ply, write_step, write_stl,
};

/// A folder of samples.
pub(super) struct Samples {
    folder: PathBuf,
    entries: Vec<Value>,
}

impl Samples {
    pub(super) fn new(folder: &Path) -> Result<Self> {
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
        fs::create_dir_all(folder)?;
        Ok(Self { folder: folder.to_owned(), entries: Vec::new() })
    }

    pub(super) fn count(&self) -> usize {
        self.entries.len()
    }

    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes a file and notes what is true of it.
    pub(super) fn add(
        &mut self,
        kind: &str,
        file: &str,
        facts: Value,
        contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<()> {
        write_atomically(self.folder.join(file), contents)?;
        let mut entry = json!({ "kind": kind, "file": file });
        let (Value::Object(all), Value::Object(facts)) = (&mut entry, facts) else {
            unreachable!("invariant: facts are an object")
        };
        all.extend(facts);
        self.entries.push(entry);
        Ok(())
    }

    /// Writes the list of all samples.
    pub(super) fn finish(&self) -> Result<()> {
        let text = serde_json::to_string_pretty(&self.entries)?;
        Ok(fs::write(self.folder.join("samples.json"), text)?)
    }

    /// A surface as STEP; `facts` is completed with what the writer counts.
    pub(super) fn step(
        &mut self,
        file: &str,
        surface: &PatchSurface,
        options: &StepOptions,
        mut facts: Value,
    ) -> Result<()> {
        let counts = write_step(&mut io::sink(), surface, options)?;
        facts["faces"] = counts.faces.into();
        facts["solids"] = counts.solids.into();
        facts["size"] = surface.diagonal().into();
        if facts.get("shells").is_none() {
            facts["shells"] = (counts.solids + counts.open_shells).into();
        }
        self.add("step", file, facts, |out| Ok(write_step(out, surface, options).map(drop)?))
    }

    /// Curved elements in both versions of the format.
    pub(super) fn msh(&mut self, name: &str, mesh: &CurvedMesh, facts: &Value) -> Result<()> {
        let nodes = mesh.points.len();
        let some = (0..nodes).step_by(nodes.div_ceil(40));
        let points: Vec<_> = some.map(|node| numbered(node, mesh.points[node])).collect();
        for (version, number) in [(MshVersion::V4, "4.1"), (MshVersion::V2, "2.2")] {
            let mut facts = facts.clone();
            facts["version"] = number.into();
            facts["order"] = mesh.order.into();
            facts["nodes"] = nodes.into();
            facts["elements"] = mesh.counts().into_iter().sum::<usize>().into();
            facts["points"] = json!(points);
            let options = MshOptions { version, ..MshOptions::default() };
            let file = format!("{name}-{}-{number}.msh", mesh.order);
            self.add("msh", &file, facts, |out| Ok(write_msh(out, mesh, &options)?))?;
        }
        Ok(())
    }

    /// Flat triangles in all formats.
    pub(super) fn triangles(
        &mut self,
        name: &str,
        triangles: &CreasedTessellation,
        facts: &Value,
    ) -> Result<()> {
        for format in ["obj", "ply", "stl", "glb"] {
            let mut facts = facts.clone();
            facts["format"] = format.into();
            facts["triangles"] = triangles.triangles.len().into();
            facts["first_corner"] =
                json!(triangles.positions[triangles.triangles[0][0]].to_array());
            self.add("triangles", &format!("{name}.{format}"), facts, |out| {
                match format {
                    "obj" => write_obj_creased(out, triangles)?,
                    "ply" => write_ply(out, triangles)?,
                    "stl" => write_stl(out, triangles)?,
                    _ => write_glb(out, triangles)?,
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}

/// A number and a point in one row.
pub(super) fn numbered(number: usize, DVec3 { x, y, z }: DVec3) -> [f64; 4] {
    [number as f64, x, y, z]
}
