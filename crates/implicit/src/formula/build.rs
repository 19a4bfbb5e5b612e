//! From expressions to a tape: constants are folded, equal operations shared, dead ones dropped.

use std::collections::HashMap;

use super::tape::{Binary, Constant, Operation, Slot, Tape, Unary, VARIABLES};
use crate::number::Number;

/// Larger exponents are left to the power function: multiplying them out would cost accuracy.
const LARGEST_MULTIPLIED_EXPONENT: f64 = 1024.0;

/// A subexpression: a number, or the slot where its value will be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    Number(f64),
    Slot(Slot),
}

/// A tape under construction.
#[derive(Debug, Default)]
pub(super) struct Builder {
    operations: Vec<Operation>,
    /// Slots of the operations so far; looked up only, never iterated.
    known: HashMap<Operation, Slot>,
}

impl Builder {
    pub(super) fn unary(&mut self, function: Unary, a: Node) -> Node {
        match a {
            Node::Number(a) => Node::Number(apply_unary(function, a)),
            Node::Slot(a) => self.push(Operation::Unary(function, a)),
        }
    }

    pub(super) fn binary(&mut self, function: Binary, a: Node, b: Node) -> Node {
        match (function, a, b) {
            (_, Node::Number(a), Node::Number(b)) => Node::Number(apply_binary(function, a, b)),
            (Binary::Add, Node::Slot(a), Node::Number(c))
            | (Binary::Add, Node::Number(c), Node::Slot(a)) => self.add_constant(a, c),
            (Binary::Sub, Node::Slot(a), Node::Number(c)) => self.add_constant(a, -c),
            (Binary::Sub, Node::Number(c), b @ Node::Slot(_)) => {
                let negative = self.unary(Unary::Neg, b);
                self.binary(Binary::Add, negative, Node::Number(c))
            }
            (Binary::Mul, Node::Slot(a), Node::Number(c))
            | (Binary::Mul, Node::Number(c), Node::Slot(a)) => {
                self.push_unless_one(Operation::MulConstant(a, Constant(c)), a, c)
            }
            (Binary::Div, Node::Slot(a), Node::Number(c)) => {
                self.push_unless_one(Operation::DivConstant(a, Constant(c)), a, c)
            }
            (Binary::Mul, Node::Slot(a), Node::Slot(b)) if a == b => {
                self.push(Operation::Unary(Unary::Square, a))
            }
            (Binary::Add | Binary::Mul, Node::Slot(a), Node::Slot(b)) => {
                self.push(Operation::Binary(function, a.min(b), a.max(b)))
            }
            _ => {
                let (a, b) = (self.slot(a), self.slot(b));
                self.push(Operation::Binary(function, a, b))
            }
        }
    }

    /// `base`^`exponent`, by what is known of the exponent.
    pub(super) fn power(&mut self, base: Node, exponent: Node) -> Node {
        match (base, exponent) {
            (Node::Number(a), Node::Number(c)) => Node::Number(match small_integer(c) {
                Some(n) => Number::powi(a, n),
                None => a.powf(c),
            }),
            (Node::Slot(a), Node::Number(c)) => match small_integer(c) {
                Some(0) => Node::Number(1.0),
                Some(1) => Node::Slot(a),
                Some(2) => self.push(Operation::Unary(Unary::Square, a)),
                Some(n) => self.push(Operation::Powi(a, n)),
                None if Constant(c) == Constant(0.5) => self.push(Operation::Unary(Unary::Sqrt, a)),
                None => self.push(Operation::Powf(a, Constant(c))),
            },
            (_, Node::Slot(_)) => {
                let logarithm = self.unary(Unary::Ln, base);
                let product = self.binary(Binary::Mul, exponent, logarithm);
                self.unary(Unary::Exp, product)
            }
        }
    }

    /// The finished tape with only the operations that the result depends on.
    pub(super) fn finish(mut self, result: Node) -> Tape {
        let result = self.slot(result) as usize;
        let mut used = vec![false; VARIABLES + self.operations.len()];
        used[result] = true;
        for (i, operation) in self.operations.iter().enumerate().rev() {
            if used[VARIABLES + i] {
                operation.operands().for_each(|a| used[a as usize] = true);
            }
        }
        compact(&self.operations, &used, result)
    }

    fn add_constant(&mut self, a: Slot, c: f64) -> Node {
        if c.abs() > 0.0 {
            self.push(Operation::AddConstant(a, Constant(c)))
        } else {
            Node::Slot(a)
        }
    }

    fn push_unless_one(&mut self, operation: Operation, a: Slot, c: f64) -> Node {
        if Constant(c) == Constant(1.0) { Node::Slot(a) } else { self.push(operation) }
    }

    fn slot(&mut self, node: Node) -> Slot {
        match node {
            Node::Slot(slot) => slot,
            Node::Number(c) => self.push_slot(Operation::Constant(Constant(c))),
        }
    }

    fn push(&mut self, operation: Operation) -> Node {
        Node::Slot(self.push_slot(operation))
    }

    fn push_slot(&mut self, operation: Operation) -> Slot {
        let next = VARIABLES + self.operations.len();
        *self.known.entry(operation).or_insert_with(|| {
            self.operations.push(operation);
            Slot::try_from(next).expect("invariant: the parser limits the length of the text")
        })
    }
}

/// The tape of the used operations, renumbered; variables keep their slots.
fn compact(operations: &[Operation], used: &[bool], result: usize) -> Tape {
    let mut new_slots: Vec<Slot> = (0..).take(VARIABLES).collect();
    let mut next = (0..).skip(VARIABLES);
    let mut kept = Vec::new();
    for (operation, &is_used) in operations.iter().zip(&used[VARIABLES..]) {
        if is_used {
            kept.push(operation.map_slots(|a| new_slots[a as usize]));
            new_slots.extend(next.next());
        } else {
            // never read: an operand of a used operation is used
            new_slots.push(Slot::MAX);
        }
    }
    Tape { operations: kept, result: new_slots[result] as usize }
}

fn small_integer(c: f64) -> Option<i32> {
    let is_small_integer = c.fract().abs() <= 0.0 && c.abs() <= LARGEST_MULTIPLIED_EXPONENT;
    #[allow(clippy::cast_possible_truncation, reason = "an integer of at most 1024 fits")]
    is_small_integer.then_some(c as i32)
}

fn apply_unary(function: Unary, a: f64) -> f64 {
    match function {
        Unary::Neg => -a,
        Unary::Square => a.square(),
        Unary::Sqrt => a.sqrt(),
        Unary::Exp => a.exp(),
        Unary::Ln => a.ln(),
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Tanh => a.tanh(),
        Unary::Abs => a.abs(),
    }
}

fn apply_binary(function: Binary, a: f64, b: f64) -> f64 {
    match function {
        Binary::Add => a + b,
        Binary::Sub => a - b,
        Binary::Mul => a * b,
        Binary::Div => a / b,
        Binary::Atan2 => a.atan2(b),
        Binary::Min => Number::min(a, b),
        Binary::Max => Number::max(a, b),
    }
}
