//! Tables of numbers as text.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};

/// The rows of a table with so many columns, each with its line in the file.
pub(crate) struct Rows<const COLUMNS: usize> {
    pub(crate) path: PathBuf,
    pub(crate) rows: Vec<(usize, [f64; COLUMNS])>,
}

/// Reads a table; a first line that is no numbers holds names.
pub(crate) fn read<const COLUMNS: usize>(path: &Path) -> anyhow::Result<Rows<COLUMNS>> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| anyhow!("{}: cannot read: {error}", path.display()))?;
    let rows = parse(&text).map_err(|problem| anyhow!("{}: {problem}", path.display()))?;
    Ok(Rows { path: path.to_owned(), rows })
}

fn parse<const COLUMNS: usize>(text: &str) -> anyhow::Result<Vec<(usize, [f64; COLUMNS])>> {
    let mut rows = Vec::new();
    let mut may_be_names = true;
    for (line, text) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        let text = text.trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let separators = [',', ';'];
        let words: Vec<&str> = if text.contains(separators) {
            text.split(separators).map(str::trim).collect()
        } else {
            text.split_whitespace().collect()
        };
        let numbers: Vec<_> = words.iter().map(|word| word.parse::<f64>().ok()).collect();
        let is_names = may_be_names && numbers.iter().all(Option::is_none);
        may_be_names = false;
        if is_names {
            continue;
        }
        let Ok(row) = <[Option<f64>; COLUMNS]>::try_from(numbers.as_slice()) else {
            bail!("line {line}: {COLUMNS} numbers are needed, not {}", words.len());
        };
        if let Some(at) = row.iter().position(|x| x.is_none_or(|x| !x.is_finite())) {
            bail!("line {line}: `{}` is no finite number", words[at]);
        }
        rows.push((line, row.map(|x| x.expect("invariant: every word is a number"))));
    }
    if rows.is_empty() {
        bail!("there are no rows of numbers");
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_comments_and_separators() {
        let text = "\u{feff}x,y,z\n# nothing\n1,2,3\n\n 4; 5 ;6\r\n7 8\t9e1\n";
        let rows = parse::<3>(text).unwrap();
        let expected = [(3, [1.0, 2.0, 3.0]), (5, [4.0, 5.0, 6.0]), (6, [7.0, 8.0, 90.0])];
        assert_eq!(rows, expected);
    }

    #[test]
    fn bad_tables_are_refused_with_their_line() {
        for (text, expected) in [
            ("", "there are no rows"),
            ("x,y,z\n", "there are no rows"),
            ("1,2\n", "line 1: 3 numbers are needed, not 2"),
            ("1,2,3\n1,,3\n", "line 2: `` is no finite number"),
            ("1,2,3\nx,y,z\n", "line 2: `x` is no finite number"),
            ("1,2,nan\n", "line 1: `nan` is no finite number"),
        ] {
            let message = parse::<3>(text).unwrap_err().to_string();
            assert!(message.starts_with(expected), "{text:?}: {message}");
        }
    }
}
