//! Formulas typed as text.

mod batch;
mod build;
mod error;
mod evaluate;
mod lexer;
mod names;
mod parser;
mod tape;

use std::fmt;
use std::str::FromStr;

use glam::DVec3;

pub use self::error::{FormulaError, FormulaErrorKind};
use self::tape::Tape;
use crate::aabb::Aabb;
use crate::field::{
    BoundedField, FieldJet, ImplicitField, TwiceDifferentiable, assert_same_length,
};
use crate::interval::Interval;
use crate::jet1::Jet1;
use crate::jet2::Jet2;

/// A field typed as text, for example `x^2 + y^2 = 1 + z^2`.
///
/// | | |
/// | --- | --- |
/// | variables | `x` `y` `z` |
/// | numbers | `2`, `.5`, `1e-3`, `pi`, and the constants given to [`parse_with`](Self::parse_with) |
/// | operators, strongest first | `^` (to the right: `2^3^2` is `2^9`), unary `-` (`-x^2` is `-(x^2)`), `*` `/`, `+` `-` |
/// | functions | `sqrt` `exp` `ln` `sin` `cos` `tan` `tanh` `abs`, `atan2(y, x)` `min(a, b)` `max(a, b)` |
/// | equation | `a = b` means `a - b` |
///
/// Integer exponents up to ±1024 are multiplied out and so work for every sign of the base; other
/// constant exponents need a base ≥ 0, and `a^b` with a variable exponent is exp(b ln a).
/// Common subexpressions are evaluated once, constants in advance.
/// Derivatives at the ties of `abs`, `min` and `max` are those of [`Number`](crate::Number).
///
/// A single point is evaluated on the stack as long as the formula has fewer than about 60
/// operations; batches go through in blocks of eight jets or sixteen values and give the same
/// bits.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    /// The text with the values of the constants in place of their names.
    self_contained: String,
    tape: Tape,
}

impl Formula {
    /// Parses a formula in `x`, `y`, `z`.
    ///
    /// # Errors
    /// If the text is no formula; the message shows the place.
    ///
    /// ```
    /// use implicit::Formula;
    ///
    /// let error = Formula::parse("x^2 + y^2 - rr").unwrap_err();
    /// assert_eq!(error.column(), 13);
    /// ```
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        Self::parse_with::<&str>(text, &[])
    }

    /// Parses a formula that may use named constants.
    ///
    /// # Errors
    /// As for [`parse`](Self::parse); also if a constant is not finite, is no name, or has the name
    /// of a variable, a function or `pi`.
    ///
    /// ```
    /// use implicit::{Formula, ImplicitField, glam::DVec3};
    ///
    /// let sphere = Formula::parse_with("x^2 + y^2 + z^2 = r^2", &[("r", 2.0)])?;
    /// assert_eq!(sphere.value(DVec3::ZERO), -4.0);
    /// # Ok::<(), implicit::FormulaError>(())
    /// ```
    pub fn parse_with<N: AsRef<str>>(
        text: &str,
        constants: &[(N, f64)],
    ) -> Result<Self, FormulaError> {
        let constants: Vec<(&str, f64)> =
            constants.iter().map(|(name, value)| (name.as_ref(), *value)).collect();
        let parsed = parser::parse(text, &constants)?;
        Ok(Self { text: text.to_owned(), self_contained: parsed.self_contained, tape: parsed.tape })
    }

    /// The text as it was given.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text with the values of named constants in place of their names: what
    /// [`parse`](Self::parse) reads back into the same field.
    #[must_use]
    pub fn self_contained_text(&self) -> &str {
        &self.self_contained
    }

    /// The number of operations after sharing and folding.
    #[must_use]
    pub fn operation_count(&self) -> usize {
        self.tape.len()
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl FromStr for Formula {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        Self::parse(text)
    }
}

impl ImplicitField for Formula {
    fn value(&self, p: DVec3) -> f64 {
        self.tape.evaluate(p.to_array())
    }

    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        self.tape.evaluate(Jet1::variables(p.to_array())).into()
    }

    fn values(&self, points: &[DVec3], out: &mut [f64]) {
        assert_same_length(points, out);
        self.tape.evaluate_batch::<f64, _>(points, out);
    }

    fn value_gradients(&self, points: &[DVec3], out: &mut [(f64, DVec3)]) {
        assert_same_length(points, out);
        self.tape.evaluate_batch::<Jet1, _>(points, out);
    }
}

impl TwiceDifferentiable for Formula {
    fn jet(&self, p: DVec3) -> FieldJet {
        self.tape.evaluate(Jet2::variables(p.to_array())).into()
    }

    fn jets(&self, points: &[DVec3], out: &mut [FieldJet]) {
        assert_same_length(points, out);
        self.tape.evaluate_batch::<Jet2, _>(points, out);
    }
}

impl BoundedField for Formula {
    fn enclosure(&self, region: &Aabb) -> Interval {
        self.tape.evaluate(region.intervals())
    }

    fn gradient_enclosure(&self, region: &Aabb) -> [Interval; 3] {
        self.tape.evaluate(Jet1::variables(region.intervals())).gradient
    }

    fn hessian_enclosure(&self, region: &Aabb) -> [Interval; 6] {
        self.tape.evaluate(Jet2::variables(region.intervals())).hessian
    }
}

/// As text, constants included: a formula read back is the same field.
#[cfg(feature = "serde")]
impl serde::Serialize for Formula {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.self_contained)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Formula {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::parse(&text).map_err(serde::de::Error::custom)
    }
}
