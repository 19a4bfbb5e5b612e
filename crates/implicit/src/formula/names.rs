//! The names that a formula knows.

use super::error::FormulaErrorKind;
use super::lexer::is_name_character;
use super::tape::{Binary, Unary};

/// Names with more bytes get no suggestion, because the search takes time quadratic in the length.
const LONGEST_CORRECTED: usize = 64;

/// What a name stands for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Meaning {
    /// A variable and its slot.
    Variable(u32),
    Number(f64),
    Unary(Unary),
    Binary(Binary),
}

const BUILT_IN: [(&str, Meaning); 16] = [
    ("x", Meaning::Variable(0)),
    ("y", Meaning::Variable(1)),
    ("z", Meaning::Variable(2)),
    ("pi", Meaning::Number(std::f64::consts::PI)),
    ("π", Meaning::Number(std::f64::consts::PI)),
    ("sqrt", Meaning::Unary(Unary::Sqrt)),
    ("exp", Meaning::Unary(Unary::Exp)),
    ("ln", Meaning::Unary(Unary::Ln)),
    ("sin", Meaning::Unary(Unary::Sin)),
    ("cos", Meaning::Unary(Unary::Cos)),
    ("tan", Meaning::Unary(Unary::Tan)),
    ("tanh", Meaning::Unary(Unary::Tanh)),
    ("abs", Meaning::Unary(Unary::Abs)),
    ("atan2", Meaning::Binary(Binary::Atan2)),
    ("min", Meaning::Binary(Binary::Min)),
    ("max", Meaning::Binary(Binary::Max)),
];

/// The built-in names and the constants of one formula.
#[derive(Debug)]
pub(super) struct Names<'c> {
    constants: &'c [(&'c str, f64)],
}

impl<'c> Names<'c> {
    /// Checks the constants.
    pub(super) fn new(constants: &'c [(&'c str, f64)]) -> Result<Self, FormulaErrorKind> {
        for (i, &(name, value)) in constants.iter().enumerate() {
            let starts_well = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
            let reason = if !(starts_well && name.chars().all(is_name_character)) {
                "it needs a name of letters, digits and `_`"
            } else if built_in(name).is_some() {
                "the name has a meaning already"
            } else if constants[..i].iter().any(|&(other, _)| other == name) {
                "the name is given twice"
            } else if !value.is_finite() {
                "the value is not finite"
            } else {
                continue;
            };
            return Err(FormulaErrorKind::InvalidConstant { name: name.to_owned(), value, reason });
        }
        Ok(Self { constants })
    }

    /// The value of a constant given by the caller.
    pub(super) fn constant(&self, name: &str) -> Option<f64> {
        self.constants.iter().find(|(known, _)| *known == name).map(|&(_, value)| value)
    }

    /// What `name` means; the error names the nearest known name.
    pub(super) fn meaning(&self, name: &str) -> Result<Meaning, FormulaErrorKind> {
        built_in(name).or_else(|| self.constant(name).map(Meaning::Number)).ok_or_else(|| {
            FormulaErrorKind::UnknownName { name: name.to_owned(), hint: self.hint(name) }
        })
    }

    fn hint(&self, name: &str) -> String {
        let known = || BUILT_IN.iter().map(|(known, _)| *known);
        let known = || known().chain(self.constants.iter().map(|(known, _)| *known));
        let lower = name.to_lowercase();
        match lower.as_str() {
            "log" => return "the natural logarithm is `ln`".to_owned(),
            "e" => return "write `exp(1)`".to_owned(),
            "atan" | "arctan" => return "write `atan2(u, 1)`".to_owned(),
            "pow" => return "write `a^b`".to_owned(),
            _ => {}
        }
        let is_short = name.len() <= LONGEST_CORRECTED;
        let distances = known().map(|known| (edit_distance(&lower, known), known));
        match is_short.then(|| distances.min()).flatten() {
            // half the name wrong is a different name
            Some((distance, known)) if 2 * distance < known.chars().count().max(2) => {
                format!("did you mean `{known}`?")
            }
            _ => format!("known are {}", known().collect::<Vec<_>>().join(", ")),
        }
    }
}

fn built_in(name: &str) -> Option<Meaning> {
    BUILT_IN.iter().find(|(known, _)| *known == name).map(|&(_, meaning)| meaning)
}

/// The number of characters to insert, drop, replace or swap with a neighbour to turn one name into
/// the other.
fn edit_distance(from: &str, to: &str) -> usize {
    let [from, to]: [Vec<char>; 2] = [from.chars().collect(), to.chars().collect()];
    // distance[i][j] between the first i and the first j characters
    let mut distance = vec![vec![0; to.len() + 1]; from.len() + 1];
    for i in 0..=from.len() {
        for j in 0..=to.len() {
            distance[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let replaced = distance[i - 1][j - 1] + usize::from(from[i - 1] != to[j - 1]);
                replaced.min(distance[i - 1][j] + 1).min(distance[i][j - 1] + 1)
            };
            if i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1] {
                distance[i][j] = distance[i][j].min(distance[i - 2][j - 2] + 1);
            }
        }
    }
    distance[from.len()][to.len()]
}
