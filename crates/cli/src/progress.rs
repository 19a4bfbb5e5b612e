//! One line per stage while the work goes on.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use smoothpatch::{Progress, Silent, Stage};

/// Lines on stderr if that is a terminal and nobody asked for quiet.
pub(crate) fn listener(quiet: bool) -> Box<dyn Progress> {
    if quiet || !std::io::stderr().is_terminal() {
        Box::new(Silent)
    } else {
        Box::new(StageLines::default())
    }
}

/// A line on stderr while work of another kind goes on, under the same conditions; it vanishes when
/// this is dropped.
pub(crate) struct WorkLine(ProgressBar);

impl WorkLine {
    pub(crate) fn new(quiet: bool, what: &'static str) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new_spinner();
        bar.set_style(style("{spinner} {msg:<12} {elapsed:>6}"));
        bar.set_message(what);
        bar.enable_steady_tick(TICK);
        Self(bar)
    }
}

impl Drop for WorkLine {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A line for each stage with its size and time; they vanish when this is dropped.
#[derive(Default)]
struct StageLines {
    screen: MultiProgress,
    lines: Vec<StageLine>,
}

/// A stage, which may run several times.
struct StageLine {
    stage: Stage,
    bar: ProgressBar,
    elements: usize,
    seconds: f64,
}

const TICK: Duration = Duration::from_millis(100);

impl StageLines {
    /// The line of a stage; a stage that runs again gets the same one.
    fn line(&mut self, stage: Stage) -> &mut StageLine {
        let known = self.lines.iter().position(|line| line.stage == stage);
        let at = known.unwrap_or_else(|| {
            let bar = self.screen.add(ProgressBar::new_spinner());
            bar.set_prefix(stage.name());
            self.lines.push(StageLine { stage, bar, elements: 0, seconds: 0.0 });
            self.lines.len() - 1
        });
        &mut self.lines[at]
    }
}

impl Progress for StageLines {
    fn begin(&mut self, stage: Stage, elements: usize) {
        let line = self.line(stage);
        line.elements = line.elements.max(elements);
        line.bar.reset();
        line.bar.set_style(style("{spinner} {prefix:<12} {elapsed:>6}  {msg}"));
        line.bar.set_message(match line.elements {
            0 => String::new(),
            count => format!("{count} {}", elements_of(stage)),
        });
        line.bar.enable_steady_tick(TICK);
    }

    fn end(&mut self, stage: Stage, seconds: f64) {
        let line = self.line(stage);
        line.seconds += seconds;
        let time = format!("{:.2}s", line.seconds);
        line.bar.set_style(style(&format!("✓ {{prefix:<12}} {time:>6}  {{msg}}")));
        line.bar.finish();
    }
}

impl Drop for StageLines {
    fn drop(&mut self) {
        // lines that cannot be wiped do no harm
        let _ = self.screen.clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("invariant: our templates are valid")
}

fn elements_of(stage: Stage) -> &'static str {
    match stage {
        Stage::Polygonize | Stage::Simplify => "triangles",
        Stage::Vertices => "vertices",
        Stage::Curves => "edges",
        _ => "patches",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_that_runs_twice_keeps_its_line() {
        let mut lines = StageLines::default();
        for (stage, elements) in [(Stage::Curves, 7), (Stage::Fill, 5), (Stage::Curves, 2)] {
            lines.begin(stage, elements);
            lines.end(stage, 0.25);
        }
        let found: Vec<_> =
            lines.lines.iter().map(|l| (l.stage, l.elements, format!("{}", l.seconds))).collect();
        let expected = [(Stage::Curves, 7, "0.5".into()), (Stage::Fill, 5, "0.25".into())];
        assert_eq!(found, expected);
    }
}
