//! What is verified: the scenes of `fixtures/scenes` in each method.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use smoothpatch::io::{Bounds, Method, Scene};

use super::MethodName;

/// One scene in one method.
pub(super) struct Case {
    pub(super) path: PathBuf,
    pub(super) scene: Scene,
    pub(super) method: Method,
}

impl Case {
    /// What the scene file demands of this method; nothing if it says nothing.
    pub(super) fn bounds(&self) -> Bounds {
        self.scene.bounds.get(&self.method).copied().unwrap_or_default()
    }
}

/// All scenes in these methods, small ones first.
pub(super) fn all(only: Option<MethodName>) -> Result<Vec<Case>> {
    let methods = match only {
        None => vec![Method::Published, Method::Refined],
        Some(MethodName::Published) => vec![Method::Published],
        Some(MethodName::Refined) => vec![Method::Refined],
    };
    let cases = read_scenes()?.into_iter().flat_map(|(path, scene)| {
        methods.clone().into_iter().map(move |method| Case {
            path: path.clone(),
            scene: scene.clone(),
            method,
        })
    });
    Ok(cases.collect())
}

fn read_scenes() -> Result<Vec<(PathBuf, Scene)>> {
    let folder = crate::root().join("fixtures/scenes");
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        if path.extension().is_none_or(|extension| extension != "ron") {
            continue;
        }
        let scene = Scene::read(&path)?;
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        ensure!(
            stem.as_deref() == Some(&*scene.name),
            "{}: the scene is named `{}`; name it like its file",
            path.display(),
            scene.name
        );
        scenes.push((path, scene));
    }
    ensure!(!scenes.is_empty(), "no scenes in {}", folder.display());
    scenes.sort_by(|(_, a), (_, b)| (a.faces, &a.name).cmp(&(b.faces, &b.name)));
    Ok(scenes)
}
