//! What got slower or faster between two reports.

use super::measured::{Measurement, Measurements};
use crate::table::Table;

/// Changes below this part are not reported even where the spread is smaller: memory layout alone
/// does as much.
const LEAST: f64 = 0.03;

/// The benches of both reports whose intervals lie apart, as a table, and how many got slower.
pub(super) fn compare(earlier: &Measurements, now: &Measurements) -> (String, usize) {
    let mut table = Table::new(&["bench", "before, ns", "now, ns", "change"]);
    let (mut slower, mut any) = (0, false);
    for (name, now) in now.iter() {
        let Some(before) = earlier.get(name) else { continue };
        let change = now.nanoseconds / before.nanoseconds - 1.0;
        if change.abs() < LEAST || overlap(before, now) {
            continue;
        }
        any = true;
        slower += usize::from(change > 0.0);
        let [old, new] = [before, now].map(|m| format!("{:.1}", m.nanoseconds));
        table.add(vec![name.into(), old, new, format!("{:+.0} %", 100.0 * change)]);
    }
    let text = if any { table.text() } else { "no change beyond the noise\n".to_owned() };
    (text, slower)
}

fn overlap(a: Measurement, b: Measurement) -> bool {
    a.interval[0] <= b.interval[1] && b.interval[0] <= a.interval[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(nanoseconds: f64) -> Measurements {
        let interval = [0.98 * nanoseconds, 1.02 * nanoseconds];
        let value = serde_json::json!({"a": {"nanoseconds": nanoseconds, "interval": interval}});
        serde_json::from_value(value).expect("a report")
    }

    #[test]
    fn noise_is_no_change() {
        assert_eq!(compare(&report(100.0), &report(102.5)).1, 0);
        let (text, slower) = compare(&report(100.0), &report(110.0));
        assert_eq!(slower, 1, "{text}");
        let (text, slower) = compare(&report(110.0), &report(100.0));
        assert!(slower == 0 && text.contains("-9 %"), "{text}");
    }
}
