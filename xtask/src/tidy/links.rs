//! Relative links of Markdown pages.

use std::path::Path;

/// `line: message` for every relative link whose target does not exist.
pub(super) fn broken(root: &Path, page: &Path, text: &str) -> Vec<String> {
    let folder = page.parent().unwrap_or(root);
    let mut problems = Vec::new();
    let mut in_code = false;
    for (number, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        if in_code {
            continue;
        }
        for target in targets(line) {
            // a place within a page, or on the web
            let path = target.split('#').next().unwrap_or_default();
            if path.is_empty() || path.contains("://") || path.starts_with("mailto:") {
                continue;
            }
            let absolute = match path.strip_prefix('/') {
                Some(path) => root.join(path),
                None => folder.join(path),
            };
            if !absolute.exists() {
                problems.push(format!("{}: the link to {target} leads nowhere", number + 1));
            }
        }
    }
    problems
}

/// Targets of inline links and images, `](target)`, and of definitions, `[name]: target`.
fn targets(line: &str) -> Vec<&str> {
    let mut targets = Vec::new();
    // rows of code in backticks are no links
    let mut rest = line;
    while let Some((before, after)) = rest.split_once("](") {
        let in_backticks = before.matches('`').count() % 2 == 1;
        let Some((target, after)) = after.split_once(')') else { break };
        if !in_backticks {
            targets.extend(target.split_whitespace().next());
        }
        rest = after;
    }
    let definition = line.trim_start().strip_prefix('[').and_then(|line| line.split_once("]: "));
    if let Some((_, target)) = definition {
        // a path into a crate's documentation is resolved by rustdoc
        targets.extend(target.split_whitespace().next().filter(|target| !target.contains("::")));
    }
    targets
}

#[cfg(test)]
mod tests {
    use super::*;

    fn broken_in(text: &str) -> Vec<String> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::create_dir(folder.path().join("docs")).expect("a folder");
        std::fs::write(folder.path().join("docs/a.md"), "").expect("a file");
        broken(folder.path(), &folder.path().join("docs/b.md"), text)
    }

    #[test]
    fn links_that_resolve() {
        let text = "[a](a.md#part) ![b](../docs/a.md \"title\") [c](https://x.org) [d](#here)\n\
                    [e]: a.md\n[f]: crate::Item\n```text\n[g](nowhere.md)\n```\n`v[i](j)`";
        assert_eq!(broken_in(text), Vec::<String>::new());
    }

    #[test]
    fn links_that_do_not() {
        let text = "see [a](a.md) and\n[b](c.md#part), [c](../a.md)\n\n[d]: d.md";
        let expected = [
            "2: the link to c.md#part leads nowhere",
            "2: the link to ../a.md leads nowhere",
            "4: the link to d.md leads nowhere",
        ];
        assert_eq!(broken_in(text), expected);
    }
}
