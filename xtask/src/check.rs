//! Statements with a figure and a bound.

use serde::Serialize;

use crate::table::{Table, scientific};

/// One statement with its figure.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Check {
    pub(crate) what: String,
    pub(crate) value: f64,
    /// As text, with the direction.
    pub(crate) bound: String,
    pub(crate) holds: bool,
}

impl Check {
    /// Not a number does not hold.
    pub(crate) fn at_least(what: impl Into<String>, value: f64, bound: f64) -> Self {
        let text = format!("≥ {}", short(bound));
        Self { what: what.into(), value, bound: text, holds: value >= bound }
    }

    /// Not a number does not hold.
    pub(crate) fn at_most(what: impl Into<String>, value: f64, bound: f64) -> Self {
        let text = format!("≤ {}", short(bound));
        Self { what: what.into(), value, bound: text, holds: value <= bound }
    }

    /// A count, or an Euler characteristic.
    pub(crate) fn exactly(what: impl Into<String>, value: i64, bound: i64) -> Self {
        let text = format!("= {bound}");
        Self { what: what.into(), value: value as f64, bound: text, holds: value == bound }
    }

    /// What is wrong, as a sentence.
    pub(crate) fn failure(&self) -> String {
        format!("{} {:.3e}, asked for {}", self.what, self.value, self.bound)
    }
}

/// Plain for numbers around one, with an exponent for small ones.
fn short(bound: f64) -> String {
    if bound == 0.0 || bound > 0.01 { bound.to_string() } else { format!("{bound:e}") }
}

/// One line per check.
pub(crate) fn table(checks: &[Check]) -> Table {
    let mut table = Table::new(&["check", "measured", "bound", ""]);
    for check in checks {
        let value = if (0.01..100.0).contains(&check.value) {
            format!("{:.2}", check.value)
        } else {
            scientific(check.value)
        };
        let verdict = if check.holds { "pass" } else { "FAIL" };
        table.add(vec![check.what.clone(), value, check.bound.clone(), verdict.into()]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_with_equality_and_never_for_what_is_no_number() {
        assert!(Check::at_least("order", 3.0, 3.0).holds);
        assert!(!Check::at_least("order", 2.99, 3.0).holds);
        assert!(Check::at_most("gap", 1e-12, 1e-12).holds);
        assert!(!Check::at_most("gap", f64::NAN, 1e-12).holds);
        assert!(!Check::at_least("order", f64::NAN, 1.0).holds);
        assert!(!Check::exactly("Euler characteristic", 2, 0).holds);
    }

    #[test]
    fn failures_are_sentences() {
        let check = Check::at_most("gap", 2e-12, 1e-12);
        assert_eq!(check.failure(), "gap 2.000e-12, asked for ≤ 1e-12");
    }
}
