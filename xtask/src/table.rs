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

    /// A table of a page for browsers; rows whose last cell is `FAIL` are marked.
    pub(crate) fn html(&self) -> String {
        let cells = |row: &Vec<String>, tag: &str| -> String {
            row.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect()
        };
        let line = |row: &Vec<String>| {
            let failed = row.last().is_some_and(|cell| cell == "FAIL");
            let class = if failed { " class=\"fail\"" } else { "" };
            format!("<tr{class}>{}</tr>\n", cells(row, "td"))
        };
        let body: String = self.rows[1..].iter().map(line).collect();
        let head = cells(&self.rows[0], "th");
        format!(
            "<div class=\"wide\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n\
             </table></div>\n"
        )
    }

    fn widths(&self) -> Vec<usize> {
        let width = |column: usize| self.rows.iter().map(|row| row[column].chars().count()).max();
        (0..self.rows[0].len()).map(|column| width(column).unwrap_or(0)).collect()
    }
}

/// Text that browsers show as it is.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Two digits and an exponent, or a plain zero.
pub(crate) fn scientific(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_show_text_as_it_is_and_mark_failures() {
        let mut table = Table::new(&["a", "b"]);
        table.add(vec!["1 < 2 & 3".into(), "FAIL".into()]);
        let html = table.html();
        assert!(html.contains("<td>1 &lt; 2 &amp; 3</td>"), "{html}");
        assert!(html.contains("<tr class=\"fail\">"), "{html}");
    }

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(&["scene", "°"]);
        table.add(vec!["a".into(), scientific(1.234e-5)]);
        table.add(vec!["b".into(), scientific(0.0)]);
        assert_eq!(table.text(), "scene       °\na      1.2e-5\nb           0\n");
        assert_eq!(table.markdown(), "| scene | ° |\n| --- | ---: |\n| a | 1.2e-5 |\n| b | 0 |\n");
    }
}
