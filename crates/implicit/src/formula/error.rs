//! What is wrong with a text, and where.

use std::fmt;

/// Why a text is no formula, and the place in it.
///
/// `Display` gives several lines: the message, the line of the text, and a caret under the place.
///
/// ```
/// let error = implicit::Formula::parse("x^2 + 2y").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "an operator is missing between `2` and `y`; a product is written with `*`
///   x^2 + 2y
///          ^"
/// );
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaError {
    kind: FormulaErrorKind,
    text: String,
    offset: usize,
}

/// What is wrong with a formula.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FormulaErrorKind {
    /// There is nothing but white space.
    #[error("the formula is empty")]
    Empty,
    /// A character that no formula contains.
    #[error("unexpected character `{0}`")]
    UnexpectedCharacter(char),
    /// A number that cannot be read or does not fit.
    #[error("the number `{0}` is malformed or too large")]
    InvalidNumber(String),
    /// Something else was due here.
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// What was due.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// Two operands stand side by side.
    #[error("an operator is missing between `{left}` and `{right}`; a product is written with `*`")]
    MissingOperator {
        /// The end of the left operand.
        left: String,
        /// The start of the right operand.
        right: String,
    },
    /// The text ends within parentheses.
    #[error("missing `)`: the parenthesis opened in column {opened} is never closed")]
    MissingParenthesis {
        /// The column of the opening parenthesis, from 1.
        opened: usize,
    },
    /// A closing parenthesis without an opening one.
    #[error("this `)` closes nothing")]
    UnmatchedParenthesis,
    /// A second equality sign.
    #[error("a formula has at most one `=`")]
    SecondEquality,
    /// A name that is no variable, function or constant.
    #[error("unknown name `{name}`; {hint}")]
    UnknownName {
        /// The name.
        name: String,
        /// The nearest known name, or all of them.
        hint: String,
    },
    /// A function without its arguments.
    #[error("the function `{0}` needs its arguments in parentheses")]
    MissingArguments(String),
    /// A function with too few or too many arguments.
    #[error("the function `{name}` takes {expected} argument(s), not {found}")]
    ArgumentCount {
        /// The function.
        name: String,
        /// How many it takes.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A constant part has no finite value, for example 1/0.
    #[error("this constant part has the value {0}")]
    NotFinite(f64),
    /// More nesting than the parser descends into.
    #[error("more than {0} levels of nesting")]
    TooDeep(usize),
    /// More text than the parser reads.
    #[error("more than {0} bytes of text")]
    TooLong(usize),
    /// A named constant that cannot be used in any formula.
    #[error("the constant `{name}` = {value} is unusable: {reason}")]
    InvalidConstant {
        /// Its name.
        name: String,
        /// Its value.
        value: f64,
        /// What is wrong with it.
        reason: &'static str,
    },
}

impl FormulaError {
    pub(super) fn new(kind: FormulaErrorKind, text: &str, offset: usize) -> Self {
        Self { kind, text: text.to_owned(), offset }
    }

    /// What is wrong.
    #[must_use]
    pub const fn kind(&self) -> &FormulaErrorKind {
        &self.kind
    }

    /// The place in bytes from the start of the text.
    #[must_use]
    pub const fn offset(&self) -> usize {
        self.offset
    }

    /// The place in characters from the start of its line, from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        column(&self.text, self.offset)
    }

    /// The line of the text that contains the place.
    fn line(&self) -> &str {
        let start = line_start(&self.text, self.offset);
        self.text[start..].lines().next().unwrap_or_default()
    }

    fn has_a_place(&self) -> bool {
        use FormulaErrorKind::{Empty, InvalidConstant, TooLong};
        !matches!(self.kind, Empty | InvalidConstant { .. } | TooLong(_))
    }
}

/// The column of a byte offset within its line, counted in characters from 1.
pub(super) fn column(text: &str, offset: usize) -> usize {
    text[line_start(text, offset)..offset].chars().count() + 1
}

fn line_start(text: &str, offset: usize) -> usize {
    text[..offset].rfind('\n').map_or(0, |newline| newline + 1)
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.kind)?;
        if self.has_a_place() {
            // tabs would move the caret
            let line = self.line().replace('\t', " ");
            write!(f, "\n  {line}\n  {:>column$}", '^', column = self.column())?;
        }
        Ok(())
    }
}

impl std::error::Error for FormulaError {}
