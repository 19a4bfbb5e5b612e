//! Exit codes, and the one message when something is wrong.

use std::io::Write;
use std::process::ExitCode;

/// How a command ended that could be carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Exit code 0.
    Success,
    /// Exit code 1: the result is not as good as it must be.
    NotGoodEnough,
}

const CANNOT_BE_DONE: u8 = 2;

/// The exit code of a command; an error is written to stderr.
pub(crate) fn code(result: anyhow::Result<Outcome>) -> ExitCode {
    match result {
        Ok(Outcome::Success) => ExitCode::SUCCESS,
        Ok(Outcome::NotGoodEnough) => ExitCode::FAILURE,
        Err(error) => {
            // our errors contain their causes, so only the outermost is shown
            complain(&format!("error: {error}"));
            ExitCode::from(CANNOT_BE_DONE)
        }
    }
}

/// Writes a message to stderr. Nobody can be told if that fails.
pub(crate) fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "{}", without_control_characters(message));
}

/// File names and formulas come from outside and may contain anything.
fn without_control_characters(text: &str) -> String {
    text.replace(|c: char| c.is_control() && c != '\n', "\u{fffd}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_cannot_steer_the_terminal() {
        assert_eq!(without_control_characters("a\n\x1b[31mb"), "a\n\u{fffd}[31mb");
    }
}
