//! Every fixture has an origin.

use std::path::Path;

use anyhow::Result;

/// A message for every file that `README.md` in the folder does not name by its path from there.
pub(super) fn unnamed(folder: &Path) -> Result<Vec<String>> {
    let readme = super::read(&folder.join("README.md"))?;
    let mut problems = Vec::new();
    for file in super::all_files_below(folder)? {
        let Ok(path) = file.strip_prefix(folder) else { continue };
        let path = path.display().to_string().replace('\\', "/");
        if path != "README.md" && !readme.contains(&format!("`{path}`")) {
            problems.push(format!("fixtures/{path}: README.md does not say where it comes from"));
        }
    }
    Ok(problems)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_with_their_paths() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::create_dir(folder.path().join("meshes")).expect("a folder");
        for file in ["meshes/a.obj", "meshes/b.obj"] {
            std::fs::write(folder.path().join(file), "").expect("a file");
        }
        std::fs::write(folder.path().join("README.md"), "| `meshes/a.obj` | by hand |, b.obj")
            .expect("a file");
        let problems = unnamed(folder.path()).expect("readable files");
        let expected = "fixtures/meshes/b.obj: README.md does not say where it comes from";
        assert_eq!(problems, [expected]);
    }
}
