//! Two aligned columns for people, and how numbers look in them.

use std::fmt;

/// Names on the left, what they stand for on the right.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    rows: Vec<(String, String)>,
}

impl Table {
    pub(crate) fn row(&mut self, name: impl Into<String>, value: impl fmt::Display) {
        self.rows.push((name.into(), value.to_string()));
    }

    /// An empty line.
    pub(crate) fn gap(&mut self) {
        self.row("", "");
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        for (name, value) in &self.rows {
            let line = format!("  {name:width$}  {value}");
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// An angle in degrees.
pub(crate) fn degrees(angle: f64) -> String {
    format!("{angle:.2e}°")
}

pub(crate) fn length(value: f64) -> String {
    let text = format!("{value:.2e}");
    if text == "0.00e0" { "0".to_owned() } else { text }
}

/// A length relative to a diagonal.
pub(crate) fn of_diagonal(part: f64) -> String {
    format!("{part:.2e} of the diagonal")
}

/// The grid on which the worst patches were compared with the surface.
pub(crate) fn grid(divisions: usize) -> String {
    format!("{divisions} divisions")
}

pub(crate) fn yes_no(value: bool) -> &'static str {
    if value { "yes" } else { "no" }
}

/// A file size with three digits or so.
pub(crate) fn bytes(count: u64) -> String {
    let size = count as f64;
    match count {
        0..1_000 => format!("{count} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", size / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", size / 1e6),
        _ => format!("{:.1} GB", size / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_by_characters() {
        let mut table = Table::default();
        table.row("é", 1);
        table.row("long", "two");
        table.gap();
        assert_eq!(table.to_string(), "  é     1\n  long  two\n\n");
    }

    #[test]
    fn sizes() {
        assert_eq!(
            [0, 999, 1_000, 2_345_678].map(bytes),
            ["0 bytes", "999 bytes", "1.0 kB", "2.3 MB"]
        );
    }
}
