//! The tables `formula | code | test` of the math pages.
//!
//! A code cell is one or more of `` `path::item` (file) ``; a test cell the same with a test
//! function.

use std::path::Path;

/// What was looked at and what is wrong, with line numbers.
#[derive(Debug, Default)]
pub(super) struct Checked {
    pub(super) rows: usize,
    pub(super) problems: Vec<String>,
}

/// Checks every table of a page whose columns are formula, code and test.
pub(super) fn check(root: &Path, text: &str) -> Checked {
    let mut checked = Checked::default();
    let mut in_table = false;
    for (number, line) in text.lines().enumerate() {
        let Some(cells) = cells(line) else {
            in_table = false;
            continue;
        };
        if !in_table {
            in_table = is_head(&cells);
            continue;
        }
        if cells.iter().all(|cell| cell.chars().all(|c| "-: ".contains(c))) {
            continue;
        }
        checked.rows += 1;
        let wrong = row_problems(root, &cells);
        checked
            .problems
            .extend(wrong.into_iter().map(|problem| format!("{}: {problem}", number + 1)));
    }
    checked
}

/// The cells of a line of a table; bars within backticks or after a backslash do not separate.
fn cells(line: &str) -> Option<Vec<String>> {
    let inner = line.trim().strip_prefix('|')?.strip_suffix('|')?;
    let mut cells = vec![String::new()];
    let (mut quoted, mut escaped) = (false, false);
    for c in inner.chars() {
        match c {
            '|' if !quoted && !escaped => cells.push(String::new()),
            _ => cells.last_mut()?.push(c),
        }
        quoted ^= c == '`';
        escaped = c == '\\';
    }
    Some(cells.into_iter().map(|cell| cell.trim().to_owned()).collect())
}

fn is_head(cells: &[String]) -> bool {
    let head: Vec<String> = cells.iter().map(|cell| cell.to_lowercase()).collect();
    head == ["formula", "code", "test"]
}

fn row_problems(root: &Path, cells: &[String]) -> Vec<String> {
    let [_, code, test] = cells else {
        return vec![format!("a row with {} cells instead of 3", cells.len())];
    };
    let mut problems = Vec::new();
    for (what, cell) in [("code", code), ("test", test)] {
        let places = places(cell);
        if places.is_empty() {
            problems.push(format!("no `item` (file) in the {what} cell: {cell}"));
        }
        for Place { item, file } in places {
            let name = item.rsplit("::").next().unwrap_or(&item);
            match std::fs::read_to_string(root.join(&file)) {
                Err(_) => problems.push(format!("{file} cannot be read")),
                Ok(source) if what == "code" && !defines(&source, name, &KEYWORDS) => {
                    problems.push(format!("{file} defines no `{name}`"));
                }
                Ok(source) if what == "test" && !defines(&source, name, &["fn"]) => {
                    problems.push(format!("{file} has no test `{name}`"));
                }
                Ok(_) => {}
            }
        }
    }
    problems
}

/// An item and the file that it is in.
#[derive(Debug, PartialEq)]
struct Place {
    item: String,
    file: String,
}

/// All `` `item` (file) `` of a cell; an item without file is a place whose file cannot be read.
fn places(cell: &str) -> Vec<Place> {
    let mut places = Vec::new();
    let mut rest = cell;
    while let Some((_, after)) = rest.split_once('`') {
        let Some((item, after)) = after.split_once('`') else { break };
        let item = item.trim_end_matches("()").to_owned();
        let in_parentheses = after.trim_start().strip_prefix('(').and_then(|s| s.split_once(')'));
        let (file, after) = in_parentheses.unwrap_or(("", after));
        places.push(Place { item, file: file.trim_matches('`').trim().to_owned() });
        rest = after;
    }
    places
}

const KEYWORDS: [&str; 8] = ["fn", "struct", "enum", "trait", "const", "static", "type", "mod"];

/// Whether the source has one of these keywords followed by the name, outside of comments.
fn defines(source: &str, name: &str, keywords: &[&str]) -> bool {
    source.lines().map(str::trim_start).filter(|line| !line.starts_with("//")).any(|line| {
        let words = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        words.windows(2).any(|pair| keywords.contains(&pair[0]) && pair[1] == name)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "| formula | code | test |\n| --- | --- | --- |\n";

    /// Problems of one row, looked up in a folder with one source file.
    fn problems(row: &str) -> Vec<String> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let source = "// fn not_this\npub(crate) const fn solve<T>() {}\nenum Rows { A }\n\
                      #[test]\nfn systems_agree() {}\n";
        std::fs::write(folder.path().join("a.rs"), source).expect("a file");
        let checked = check(folder.path(), &format!("text\n\n{HEAD}{row}\n"));
        assert_eq!(checked.rows, 1, "{row}");
        checked.problems
    }

    #[test]
    fn right_rows_pass() {
        for row in [
            "| (14) | `g1::vertex::solve` (a.rs) | `systems_agree` (a.rs) |",
            "| a\\|b | `solve()` (`a.rs`), `Rows` (a.rs) | `systems_agree` (a.rs) |",
        ] {
            assert_eq!(problems(row), Vec::<String>::new(), "{row}");
        }
    }

    #[test]
    fn wrong_rows_fail() {
        for (row, problem) in [
            ("| 1 | `solv` (a.rs) | `systems_agree` (a.rs) |", "5: a.rs defines no `solv`"),
            ("| 1 | `not_this` (a.rs) | `systems_agree` (a.rs) |", "5: a.rs defines no `not_this`"),
            ("| 1 | `solve` (b.rs) | `systems_agree` (a.rs) |", "5: b.rs cannot be read"),
            ("| 1 | `solve` | `systems_agree` (a.rs) |", "5:  cannot be read"),
            ("| 1 | `solve` (a.rs) | `Rows` (a.rs) |", "5: a.rs has no test `Rows`"),
            (
                "| 1 | solve | `systems_agree` (a.rs) |",
                "5: no `item` (file) in the code cell: solve",
            ),
            ("| 1 | `solve` (a.rs) |", "5: a row with 2 cells instead of 3"),
        ] {
            assert_eq!(problems(row), [problem], "{row}");
        }
    }

    #[test]
    fn other_tables_are_left_alone() {
        let text = "| symbol | meaning |\n| --- | --- |\n| a | b |\n";
        let checked = check(Path::new("."), text);
        assert_eq!((checked.rows, checked.problems.len()), (0, 0));
    }
}
