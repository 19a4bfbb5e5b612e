//! Recursive descent over the tokens.
//!
//! ```text
//! formula = sum [ "=" sum ]
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = { "+" | "-" } power
//! power   = atom [ "^" signed ]
//! atom    = number | variable | constant | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```

use super::build::{Builder, Node};
use super::error::{FormulaError, FormulaErrorKind, column};
use super::lexer::{Token, TokenKind, tokens};
use super::names::{Meaning, Names};
use super::tape::{Binary, Tape, Unary};

/// Parentheses, signs and exponents may nest this deep, which any thread's stack has room for.
const DEEPEST_NESTING: usize = 128;

/// What [`parse`] makes of a text.
#[derive(Debug)]
pub(super) struct Parsed {
    pub(super) tape: Tape,
    pub(super) self_contained: String,
}

/// Parses a formula with the given named constants.
pub(super) fn parse(text: &str, constants: &[(&str, f64)]) -> Result<Parsed, FormulaError> {
    let names = Names::new(constants).map_err(|kind| FormulaError::new(kind, text, 0))?;
    let tokens = tokens(text)?;
    let self_contained = with_values(text, &tokens, &names);
    let mut parser =
        Parser { text, tokens: &tokens, next: 0, depth: 0, names, builder: Builder::default() };
    let result = parser.formula()?;
    Ok(Parsed { tape: parser.builder.finish(result), self_contained })
}

/// The text with the constants' values in place of their names.
fn with_values(text: &str, tokens: &[Token<'_>], names: &Names<'_>) -> String {
    let mut result = String::with_capacity(text.len());
    let mut copied = 0;
    for token in tokens.iter().filter(|token| token.kind == TokenKind::Name) {
        if let Some(value) = names.constant(token.text) {
            result.push_str(&text[copied..token.offset]);
            // the shortest digits that read back as the same number
            result.push_str(&format!("({value:?})"));
            copied = token.offset + token.text.len();
        }
    }
    result.push_str(&text[copied..]);
    result
}

struct Parser<'t> {
    text: &'t str,
    tokens: &'t [Token<'t>],
    next: usize,
    depth: usize,
    names: Names<'t>,
    builder: Builder,
}

impl<'t> Parser<'t> {
    fn formula(&mut self) -> Result<Node, FormulaError> {
        if self.peek().kind == TokenKind::End {
            return Err(self.error_here(FormulaErrorKind::Empty));
        }
        let left = self.sum()?;
        let equality = self.peek();
        let result = if self.take(TokenKind::Equal) {
            let right = self.sum()?;
            self.binary(Binary::Sub, left, right, equality)?
        } else {
            left
        };
        match self.peek().kind {
            TokenKind::End => Ok(result),
            TokenKind::Equal => Err(self.error_here(FormulaErrorKind::SecondEquality)),
            TokenKind::Close => Err(self.error_here(FormulaErrorKind::UnmatchedParenthesis)),
            _ => Err(self.unexpected("an operator or the end")),
        }
    }

    fn sum(&mut self) -> Result<Node, FormulaError> {
        let mut sum = self.product()?;
        loop {
            let operator = self.peek();
            let function = match operator.kind {
                TokenKind::Plus => Binary::Add,
                TokenKind::Minus => Binary::Sub,
                _ => return Ok(sum),
            };
            self.next += 1;
            let term = self.product()?;
            sum = self.binary(function, sum, term, operator)?;
        }
    }

    fn product(&mut self) -> Result<Node, FormulaError> {
        let mut product = self.signed()?;
        loop {
            let operator = self.peek();
            let function = match operator.kind {
                TokenKind::Times => Binary::Mul,
                TokenKind::Over => Binary::Div,
                TokenKind::Number(_) | TokenKind::Name | TokenKind::Open => {
                    return Err(self.missing_operator());
                }
                _ => return Ok(product),
            };
            self.next += 1;
            let factor = self.signed()?;
            product = self.binary(function, product, factor, operator)?;
        }
    }

    fn signed(&mut self) -> Result<Node, FormulaError> {
        self.descend(|parser| {
            if parser.take(TokenKind::Minus) {
                let operand = parser.signed()?;
                Ok(parser.builder.unary(Unary::Neg, operand))
            } else if parser.take(TokenKind::Plus) {
                parser.signed()
            } else {
                parser.power()
            }
        })
    }

    fn power(&mut self) -> Result<Node, FormulaError> {
        let base = self.atom()?;
        let operator = self.peek();
        if !self.take(TokenKind::Power) {
            return Ok(base);
        }
        let exponent = self.signed()?;
        let power = self.builder.power(base, exponent);
        self.finite(power, operator)
    }

    fn atom(&mut self) -> Result<Node, FormulaError> {
        let token = self.peek();
        match token.kind {
            TokenKind::Number(number) => {
                self.next += 1;
                Ok(Node::Number(number))
            }
            TokenKind::Name => {
                self.next += 1;
                self.named(token)
            }
            TokenKind::Open => {
                self.next += 1;
                let inner = self.sum()?;
                self.close(token)?;
                Ok(inner)
            }
            _ => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    fn named(&mut self, name: Token<'t>) -> Result<Node, FormulaError> {
        let meaning = self.names.meaning(name.text).map_err(|kind| self.error_at(kind, name))?;
        match meaning {
            Meaning::Variable(slot) => Ok(Node::Slot(slot)),
            Meaning::Number(number) => Ok(Node::Number(number)),
            Meaning::Unary(function) => {
                let [argument] = self.arguments(name)?;
                let call = self.builder.unary(function, argument);
                self.finite(call, name)
            }
            Meaning::Binary(function) => {
                let [a, b] = self.arguments(name)?;
                self.binary(function, a, b, name)
            }
        }
    }

    fn arguments<const N: usize>(&mut self, name: Token<'t>) -> Result<[Node; N], FormulaError> {
        let open = self.peek();
        if !self.take(TokenKind::Open) {
            return Err(self.error_at(FormulaErrorKind::MissingArguments(name.text.into()), name));
        }
        let mut arguments = Vec::with_capacity(N);
        if self.peek().kind != TokenKind::Close {
            arguments.push(self.sum()?);
            while self.take(TokenKind::Comma) {
                arguments.push(self.sum()?);
            }
        }
        self.close(open)?;
        let found = arguments.len();
        arguments.try_into().map_err(|_| {
            let name_text = name.text.to_owned();
            let kind = FormulaErrorKind::ArgumentCount { name: name_text, expected: N, found };
            self.error_at(kind, name)
        })
    }

    fn close(&mut self, open: Token<'t>) -> Result<(), FormulaError> {
        if self.take(TokenKind::Close) {
            Ok(())
        } else if self.peek().kind == TokenKind::End {
            let opened = column(self.text, open.offset);
            Err(self.error_here(FormulaErrorKind::MissingParenthesis { opened }))
        } else {
            Err(self.unexpected("an operator or `)`"))
        }
    }

    fn binary(
        &mut self,
        function: Binary,
        a: Node,
        b: Node,
        place: Token<'t>,
    ) -> Result<Node, FormulaError> {
        let node = self.builder.binary(function, a, b);
        self.finite(node, place)
    }

    /// Refuses a constant part that is infinite or undefined.
    fn finite(&self, node: Node, place: Token<'t>) -> Result<Node, FormulaError> {
        match node {
            Node::Number(c) if !c.is_finite() => {
                Err(self.error_at(FormulaErrorKind::NotFinite(c), place))
            }
            _ => Ok(node),
        }
    }

    fn descend(
        &mut self,
        parse: impl FnOnce(&mut Self) -> Result<Node, FormulaError>,
    ) -> Result<Node, FormulaError> {
        if self.depth == DEEPEST_NESTING {
            return Err(self.error_here(FormulaErrorKind::TooDeep(DEEPEST_NESTING)));
        }
        self.depth += 1;
        let result = parse(self);
        self.depth -= 1;
        result
    }

    /// The next token; the last one is `End` and never taken.
    fn peek(&self) -> Token<'t> {
        self.tokens[self.next]
    }

    fn take(&mut self, kind: TokenKind) -> bool {
        let found = self.peek().kind == kind;
        self.next += usize::from(found);
        found
    }

    fn missing_operator(&self) -> FormulaError {
        let (left, right) = (self.tokens[self.next - 1].text, self.peek().text);
        let (left, right) = (left.to_owned(), right.to_owned());
        self.error_here(FormulaErrorKind::MissingOperator { left, right })
    }

    fn unexpected(&self, expected: &'static str) -> FormulaError {
        let token = self.peek();
        let found = match token.kind {
            TokenKind::End => "the end of the text".to_owned(),
            _ => format!("`{}`", token.text),
        };
        self.error_here(FormulaErrorKind::Unexpected { expected, found })
    }

    fn error_here(&self, kind: FormulaErrorKind) -> FormulaError {
        self.error_at(kind, self.peek())
    }

    fn error_at(&self, kind: FormulaErrorKind, token: Token<'_>) -> FormulaError {
        FormulaError::new(kind, self.text, token.offset)
    }
}
