//! From the text of an array to its numbers.

use std::borrow::Cow;
use std::fmt::Display;
use std::str::FromStr;

use base64::engine::Engine;
use base64::engine::general_purpose::STANDARD;

use super::appended::{block, declared_bytes, missing_bytes, too_short};
use super::document::{BinaryLayout, Document, Format, RawArray};
use super::error::VtuReadError;

impl RawArray<'_> {
    pub(super) fn is_float(&self) -> bool {
        matches!(self.type_name.as_str(), "Float32" | "Float64")
    }

    pub(super) fn is_number(&self) -> bool {
        let integers = ["Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"];
        self.is_float() || integers.contains(&self.type_name.as_str())
    }

    /// The numbers of a `Float32` or `Float64` array; the former are widened.
    pub(super) fn floats(&self, document: &Document<'_>) -> Result<Vec<f64>, VtuReadError> {
        match self.type_name.as_str() {
            "Float64" => self.numbers(document, f64::from_le_bytes, Ok),
            "Float32" => self.numbers(document, f32::from_le_bytes, |x| Ok(f64::from(x))),
            other => Err(self.error(format!("has type '{other}'; expected Float32 or Float64"))),
        }
    }

    /// The numbers of an integer array.
    pub(super) fn integers(&self, document: &Document<'_>) -> Result<Vec<i64>, VtuReadError> {
        match self.type_name.as_str() {
            "Int8" => self.numbers(document, i8::from_le_bytes, |x| Ok(i64::from(x))),
            "UInt8" => self.numbers(document, u8::from_le_bytes, |x| Ok(i64::from(x))),
            "Int16" => self.numbers(document, i16::from_le_bytes, |x| Ok(i64::from(x))),
            "UInt16" => self.numbers(document, u16::from_le_bytes, |x| Ok(i64::from(x))),
            "Int32" => self.numbers(document, i32::from_le_bytes, |x| Ok(i64::from(x))),
            "UInt32" => self.numbers(document, u32::from_le_bytes, |x| Ok(i64::from(x))),
            "Int64" => self.numbers(document, i64::from_le_bytes, Ok),
            "UInt64" => self.numbers(document, u64::from_le_bytes, |x| {
                i64::try_from(x).map_err(|_| format!("{x} does not fit 63 bits"))
            }),
            other => Err(self.error(format!("has type '{other}'; expected an integer type"))),
        }
    }

    fn numbers<T: FromStr, U, const N: usize>(
        &self,
        document: &Document<'_>,
        from_le_bytes: fn([u8; N]) -> T,
        convert: impl Fn(T) -> Result<U, String>,
    ) -> Result<Vec<U>, VtuReadError> {
        let at =
            |index: usize| move |problem: String| format!("is damaged at value {index}: {problem}");
        let numbers = if let Format::Ascii(text) = &self.format {
            let words = text.split_ascii_whitespace().enumerate();
            words
                .map(|(i, word)| parse(word).and_then(&convert).map_err(at(i)))
                .collect::<Result<Vec<U>, String>>()
        } else {
            let bytes = self.payload(document).map_err(|problem| self.error(problem))?;
            let (chunks, []) = bytes.as_chunks::<N>() else {
                let problem = format!("has {} bytes, not a multiple of {N}", bytes.len());
                return Err(self.error(problem));
            };
            let native = |mut chunk: [u8; N]| {
                if document.layout.big_endian {
                    chunk.reverse();
                }
                from_le_bytes(chunk)
            };
            let values = chunks.iter().map(|&chunk| native(chunk)).enumerate();
            values.map(|(i, value)| convert(value).map_err(at(i))).collect()
        };
        numbers.map_err(|problem| self.error(problem))
    }

    /// The bytes of an array that is no text, without the byte count before them.
    fn payload<'d>(&self, document: &Document<'d>) -> Result<Cow<'d, [u8]>, String> {
        let layout = document.layout;
        if layout.compressed {
            return Err(
                "is compressed, which is not supported: re-save with compressor 'none', or as data mode 'ascii'".to_owned()
            );
        }
        match &self.format {
            Format::Ascii(text) | Format::Binary(text) => inline_block(text, layout),
            Format::Appended(offset) => {
                let blocks =
                    document.appended.ok_or("is appended, but there is no <AppendedData>")?;
                let blocks = blocks.get(*offset..).ok_or_else(|| {
                    format!("begins at byte {offset} of {}; the file is damaged", blocks.len())
                })?;
                block(blocks, layout)
            }
        }
    }

    pub(super) fn error(&self, problem: impl Into<String>) -> VtuReadError {
        VtuReadError::Array { array: self.name.clone(), problem: problem.into() }
    }
}

fn parse<T: FromStr>(word: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("'{word}' is not a number of this type"))
}

/// The bytes in an element, which must be as many as announced.
fn inline_block<'d>(text: &str, layout: BinaryLayout) -> Result<Cow<'d, [u8]>, String> {
    let header_bytes = layout.header_bytes();
    let text = without_whitespace(text.as_bytes());
    // some programs encode the byte count by itself, which then ends with padding
    let mut bytes = match text.split_at_checked(header_bytes.div_ceil(3) * 4) {
        Some((header, rest)) if header.ends_with(b"=") => [decode(header)?, decode(rest)?].concat(),
        _ => decode(&text)?,
    };
    let declared = declared_bytes(bytes.get(..header_bytes).ok_or_else(too_short)?, layout)?;
    let found = bytes.len() - header_bytes;
    if declared != found {
        return Err(missing_bytes(declared, found));
    }
    bytes.drain(..header_bytes);
    Ok(Cow::Owned(bytes))
}

pub(super) fn decode(text: &[u8]) -> Result<Vec<u8>, String> {
    let problem = |error: &dyn Display| format!("is not base64 ({error}); the file is damaged");
    STANDARD.decode(text).map_err(|error| problem(&error))
}

fn without_whitespace(text: &[u8]) -> Cow<'_, [u8]> {
    let trimmed = text.trim_ascii();
    if trimmed.iter().any(u8::is_ascii_whitespace) {
        trimmed
            .iter()
            .copied()
            .filter(|byte| !byte.is_ascii_whitespace())
            .collect::<Vec<_>>()
            .into()
    } else {
        trimmed.into()
    }
}
