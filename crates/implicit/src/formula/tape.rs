//! A formula as a straight list of operations.

use crate::number::Number;

/// Where an operand is: slots 0, 1, 2 hold x, y, z, and slot 3 + i the result of operation i.
pub(super) type Slot = u32;

/// The number of variables in front of the results.
pub(super) const VARIABLES: usize = 3;

/// A constant, compared by its bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constant(pub(super) f64);

impl PartialEq for Constant {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for Constant {}

impl std::hash::Hash for Constant {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Unary {
    Neg,
    Square,
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Tanh,
    Abs,
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Atan2,
    Min,
    Max,
}

/// One operation; its operands are in smaller slots than its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    Constant(Constant),
    AddConstant(Slot, Constant),
    MulConstant(Slot, Constant),
    DivConstant(Slot, Constant),
    Powi(Slot, i32),
    Powf(Slot, Constant),
    Unary(Unary, Slot),
    Binary(Binary, Slot, Slot),
}

impl Operation {
    /// Replaces every operand slot.
    pub(super) fn map_slots(self, f: impl Fn(Slot) -> Slot) -> Self {
        match self {
            Self::Constant(c) => Self::Constant(c),
            Self::AddConstant(a, c) => Self::AddConstant(f(a), c),
            Self::MulConstant(a, c) => Self::MulConstant(f(a), c),
            Self::DivConstant(a, c) => Self::DivConstant(f(a), c),
            Self::Powi(a, n) => Self::Powi(f(a), n),
            Self::Powf(a, c) => Self::Powf(f(a), c),
            Self::Unary(function, a) => Self::Unary(function, f(a)),
            Self::Binary(function, a, b) => Self::Binary(function, f(a), f(b)),
        }
    }

    /// The operand slots.
    pub(super) fn operands(self) -> impl Iterator<Item = Slot> {
        let (first, second) = match self {
            Self::Constant(_) => (None, None),
            Self::AddConstant(a, _)
            | Self::MulConstant(a, _)
            | Self::DivConstant(a, _)
            | Self::Powi(a, _)
            | Self::Powf(a, _)
            | Self::Unary(_, a) => (Some(a), None),
            Self::Binary(_, a, b) => (Some(a), Some(b)),
        };
        first.into_iter().chain(second)
    }
}

/// What executes operations: on single numbers or on blocks of them.
///
/// The meaning of each operation is written once, in [`Tape::run`].
pub(super) trait Machine {
    /// The number computed with.
    type Number: Number;

    /// Puts the same number everywhere.
    fn constant(&mut self, out: usize, c: f64);

    /// Applies a function of one operand.
    fn unary(&mut self, out: usize, a: Slot, f: impl Fn(Self::Number) -> Self::Number);

    /// Applies a function of two operands.
    fn binary(
        &mut self,
        out: usize,
        operands: [Slot; 2],
        f: impl Fn(Self::Number, Self::Number) -> Self::Number,
    );
}

/// The operations of a formula in order of execution, each different from all others.
#[derive(Clone, Debug)]
pub(super) struct Tape {
    pub(super) operations: Vec<Operation>,
    /// The slot of the value.
    pub(super) result: usize,
}

impl Tape {
    pub(super) fn len(&self) -> usize {
        self.operations.len()
    }

    /// The number of slots that an evaluation needs.
    pub(super) fn slot_count(&self) -> usize {
        VARIABLES + self.operations.len()
    }

    /// Executes all operations; the machine holds the variables already.
    #[inline]
    pub(super) fn run(&self, machine: &mut impl Machine) {
        for (out, operation) in (VARIABLES..).zip(&self.operations) {
            match *operation {
                Operation::Constant(Constant(c)) => machine.constant(out, c),
                Operation::AddConstant(a, Constant(c)) => machine.unary(out, a, |u| u + c),
                Operation::MulConstant(a, Constant(c)) => machine.unary(out, a, |u| u * c),
                Operation::DivConstant(a, Constant(c)) => machine.unary(out, a, |u| u / c),
                // a known exponent turns the loop over its bits into straight code
                Operation::Powi(a, 3) => machine.unary(out, a, |u| u.powi(3)),
                Operation::Powi(a, 4) => machine.unary(out, a, |u| u.powi(4)),
                Operation::Powi(a, 5) => machine.unary(out, a, |u| u.powi(5)),
                Operation::Powi(a, 6) => machine.unary(out, a, |u| u.powi(6)),
                Operation::Powi(a, 8) => machine.unary(out, a, |u| u.powi(8)),
                Operation::Powi(a, n) => machine.unary(out, a, |u| u.powi(n)),
                Operation::Powf(a, Constant(c)) => machine.unary(out, a, |u| u.powf(c)),
                Operation::Unary(function, a) => match function {
                    Unary::Neg => machine.unary(out, a, |u| -u),
                    Unary::Square => machine.unary(out, a, Number::square),
                    Unary::Sqrt => machine.unary(out, a, Number::sqrt),
                    Unary::Exp => machine.unary(out, a, Number::exp),
                    Unary::Ln => machine.unary(out, a, Number::ln),
                    Unary::Sin => machine.unary(out, a, Number::sin),
                    Unary::Cos => machine.unary(out, a, Number::cos),
                    Unary::Tan => machine.unary(out, a, Number::tan),
                    Unary::Tanh => machine.unary(out, a, Number::tanh),
                    Unary::Abs => machine.unary(out, a, Number::abs),
                },
                Operation::Binary(function, a, b) => match function {
                    Binary::Add => machine.binary(out, [a, b], |u, v| u + v),
                    Binary::Sub => machine.binary(out, [a, b], |u, v| u - v),
                    Binary::Mul => machine.binary(out, [a, b], |u, v| u * v),
                    Binary::Div => machine.binary(out, [a, b], |u, v| u / v),
                    Binary::Atan2 => machine.binary(out, [a, b], Number::atan2),
                    Binary::Min => machine.binary(out, [a, b], Number::min),
                    Binary::Max => machine.binary(out, [a, b], Number::max),
                },
            }
        }
    }
}
