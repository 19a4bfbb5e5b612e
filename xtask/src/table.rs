//! Tables for terminals and for Markdown pages.

/// Columns with a head; every row has as many cells as the head.
#[derive(Debug, Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new(head: &[&str]) -> Self {
        Self { rows: vec![head.iter().map(ToString::to_string).collect()] }
    }

    pub(crate) fn add(&mut self, row: Vec<String>) {
        debug_assert_eq!(row.len(), self.rows[0].len(), "one cell per column");
        self.rows.push(row);
    }

    /// Aligned columns: the first to the left, the others to the right.
    pub(crate) fn text(&self) -> String {
        let widths = self.widths();
        let line = |row: &Vec<String>| {
            let cells: Vec<String> = row
                .iter()
                .zip(&widths)
                .enumerate()
                .map(|(column, (cell, &width))| match column {
                    0 => format!("{cell:<width$}"),
                    _ => format!("{cell:>width$}"),
                })
                .collect();
            cells.join("  ").trim_end().to_owned() + "\n"
        };
        self.rows.iter().map(line).collect()
    }

    /// A Markdown table with the same alignment.
    pub(crate) fn markdown(&self) -> String {
        let line = |row: &Vec<String>| format!("| {} |\n", row.join(" | "));
        let rule = "| --- |".to_owned() + &" ---: |".repeat(self.rows[0].len() - 1) + "\n";
        line(&self.rows[0]) + &rule + &self.rows[1..].iter().map(line).collect::<String>()
    }

    fn widths(&self) -> Vec<usize> {
        let width = |column: usize| self.rows.iter().map(|row| row[column].chars().count()).max();
        (0..self.rows[0].len()).map(|column| width(column).unwrap_or(0)).collect()
    }
}

/// Two digits and an exponent, or a plain zero.
pub(crate) fn scientific(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(&["scene", "°"]);
        table.add(vec!["a".into(), scientific(1.234e-5)]);
        table.add(vec!["b".into(), scientific(0.0)]);
        assert_eq!(table.text(), "scene       °\na      1.2e-5\nb           0\n");
        assert_eq!(table.markdown(), "| scene | ° |\n| --- | ---: |\n| a | 1.2e-5 |\n| b | 0 |\n");
    }
}
