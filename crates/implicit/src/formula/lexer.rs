//! From text to tokens.

use super::error::{FormulaError, FormulaErrorKind};

/// The longest text, in bytes; the numbers of operations and slots then fit in 32 bits.
const LONGEST_TEXT: usize = 1 << 20;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TokenKind {
    Number(f64),
    Name,
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Open,
    Close,
    Comma,
    Equal,
    End,
}

/// A token and its place in the text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'t> {
    pub(super) kind: TokenKind,
    pub(super) text: &'t str,
    pub(super) offset: usize,
}

/// All tokens, closed by [`TokenKind::End`] behind the last character that is not white space.
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, FormulaError> {
    if text.len() > LONGEST_TEXT {
        return Err(FormulaError::new(FormulaErrorKind::TooLong(LONGEST_TEXT), text, 0));
    }
    let mut tokens = Vec::new();
    let end = text.trim_end().len();
    let mut offset = 0;
    while let Some(first) = text[offset..end].chars().next() {
        if first.is_whitespace() {
            offset += first.len_utf8();
            continue;
        }
        let (kind, length) = scan(&text[offset..end], first)
            .map_err(|kind| FormulaError::new(kind, text, offset))?;
        tokens.push(Token { kind, text: &text[offset..offset + length], offset });
        offset += length;
    }
    tokens.push(Token { kind: TokenKind::End, text: "", offset: end });
    Ok(tokens)
}

/// Kind and length of the token at the start of `rest`.
fn scan(rest: &str, first: char) -> Result<(TokenKind, usize), FormulaErrorKind> {
    if first.is_ascii_digit() || first == '.' {
        return scan_number(rest);
    }
    if first.is_alphabetic() || first == '_' {
        let length = rest.find(|c: char| !is_name_character(c)).unwrap_or(rest.len());
        return Ok((TokenKind::Name, length));
    }
    let kind = match first {
        '+' => TokenKind::Plus,
        '-' => TokenKind::Minus,
        '*' => TokenKind::Times,
        '/' => TokenKind::Over,
        '^' => TokenKind::Power,
        '(' => TokenKind::Open,
        ')' => TokenKind::Close,
        ',' => TokenKind::Comma,
        '=' => TokenKind::Equal,
        _ => return Err(FormulaErrorKind::UnexpectedCharacter(first)),
    };
    Ok((kind, 1))
}

fn scan_number(rest: &str) -> Result<(TokenKind, usize), FormulaErrorKind> {
    let digits_from =
        |start: usize| rest[start..].bytes().take_while(u8::is_ascii_digit).count() + start;
    let mut length = digits_from(0);
    if rest[length..].starts_with('.') {
        length = digits_from(length + 1);
    }
    // `2e` without digits is the number 2 and the name e
    if rest[length..].starts_with(['e', 'E']) {
        let sign = usize::from(rest[length + 1..].starts_with(['+', '-']));
        let exponent = length + 1 + sign;
        if digits_from(exponent) > exponent {
            length = digits_from(exponent);
        }
    }
    match rest[..length].parse() {
        Ok(number) if f64::is_finite(number) => Ok((TokenKind::Number(number), length)),
        _ => Err(FormulaErrorKind::InvalidNumber(rest[..length].to_owned())),
    }
}

/// Whether a name may contain the character; its first one may not be a digit.
pub(super) fn is_name_character(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
