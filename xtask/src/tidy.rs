//! `cargo xtask tidy`: documents that point at things which exist, and no fixture without origin.

mod fixtures;
mod formulas;
mod links;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// Folders without sources or documents of ours.
const SKIPPED: [&str; 3] = ["target", "out", "node_modules"];

/// Returns whether everything is in order.
pub(crate) fn run() -> Result<bool> {
    let root = crate::root();
    let pages = files_below(&root, "md")?;
    let math = root.join("docs/math");
    let mut problems = Vec::new();
    let mut rows = 0;
    for page in &pages {
        let text = read(page)?;
        let mut found = links::broken(&root, page, &text);
        if page.starts_with(&math) {
            let checked = formulas::check(&root, &text);
            if checked.rows == 0 && !page.ends_with("README.md") {
                found.push("1: no table `formula | code | test`".into());
            }
            rows += checked.rows;
            found.extend(checked.problems);
        }
        let shown = page.strip_prefix(&root).unwrap_or(page).display();
        problems.extend(found.into_iter().map(|problem| format!("{shown}:{problem}")));
    }
    problems.extend(fixtures::unnamed(&root.join("fixtures"))?);
    for problem in &problems {
        println!("{problem}");
    }
    println!("tidy: {} pages, {rows} formulas, {} problems", pages.len(), problems.len());
    Ok(problems.is_empty())
}

/// All files with this extension, sorted; hidden folders are left out.
fn files_below(folder: &Path, extension: &str) -> Result<Vec<PathBuf>> {
    let all = all_files_below(folder)?;
    Ok(all.into_iter().filter(|path| path.extension().is_some_and(|e| e == extension)).collect())
}

fn all_files_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type()?.is_file() {
            files.push(entry.path());
        } else if entry.file_type()?.is_dir()
            && !name.starts_with('.')
            && !SKIPPED.contains(&&*name)
        {
            files.extend(all_files_below(&entry.path())?);
        }
    }
    files.sort();
    Ok(files)
}

fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).with_context(|| path.display().to_string())
}
