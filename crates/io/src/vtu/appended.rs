//! The numbers that stand behind the XML, in `<AppendedData>`.

use std::borrow::Cow;

use super::decode::decode;
use super::document::BinaryLayout;
use super::error::VtuReadError;

/// How `<AppendedData>` stores its bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum AppendedEncoding {
    /// As they are; the file is no text.
    #[default]
    Raw,
    /// Each block by itself as base64.
    Base64,
}

/// Splits a file behind the opening tag of `<AppendedData>`: the XML up to there, and the blocks if
/// there is such an element.
pub(super) fn split(file: &[u8]) -> Result<(&[u8], Option<&[u8]>), VtuReadError> {
    const TAG: &[u8] = b"<AppendedData";
    let start = file.windows(TAG.len()).position(|window| window == TAG);
    let length = start.and_then(|start| file[start..].iter().position(|&byte| byte == b'>'));
    let (Some(start), Some(length)) = (start, length) else { return Ok((file, None)) };
    let (xml, rest) = file.split_at(start + length + 1);
    let rest = rest.trim_ascii_start();
    let truncated = || VtuReadError::Truncated { element: "AppendedData".to_owned() };
    if rest.is_empty() {
        return Err(truncated());
    }
    let what = "'_' before the appended data";
    let rest = rest.strip_prefix(b"_").ok_or(VtuReadError::Missing { what })?;
    // from the end, because raw bytes may look like a tag
    let rest = rest.trim_ascii_end().strip_suffix(b"</VTKFile>").ok_or_else(truncated)?;
    let blocks = rest.trim_ascii_end().strip_suffix(b"</AppendedData>").ok_or_else(truncated)?;
    Ok((xml, Some(blocks)))
}

/// The bytes of the block at the start of `blocks`, without the byte count before them.
pub(super) fn block(blocks: &[u8], layout: BinaryLayout) -> Result<Cow<'_, [u8]>, String> {
    match layout.appended {
        AppendedEncoding::Raw => {
            let header = blocks.get(..layout.header_bytes()).ok_or_else(too_short)?;
            let bytes = declared_bytes(header, layout)?;
            let found = &blocks[header.len()..];
            found.get(..bytes).map(Cow::Borrowed).ok_or_else(|| missing_bytes(bytes, found.len()))
        }
        AppendedEncoding::Base64 => base64_block(blocks, layout).map(Cow::Owned),
    }
}

fn base64_block(blocks: &[u8], layout: BinaryLayout) -> Result<Vec<u8>, String> {
    let header_symbols = layout.header_bytes().div_ceil(3) * 4;
    let (header, rest) = blocks.split_at_checked(header_symbols).ok_or_else(too_short)?;
    let alone = header.ends_with(b"=");
    let decoded = decode(header)?;
    let declared = declared_bytes(&decoded[..layout.header_bytes()], layout)?;
    // the rest of the last group of the header belongs to the numbers, if they are one stream
    let begun = if alone { 0 } else { decoded.len() - layout.header_bytes() };
    let symbols = declared.saturating_sub(begun).div_ceil(3).saturating_mul(4);
    let text = rest.get(..symbols).ok_or_else(|| missing_bytes(declared, rest.len() / 4 * 3))?;
    let mut bytes = decoded[decoded.len() - begun..].to_vec();
    bytes.extend(decode(text)?);
    bytes.truncate(declared);
    Ok(bytes)
}

/// The byte count before the numbers.
pub(super) fn declared_bytes(header: &[u8], layout: BinaryLayout) -> Result<usize, String> {
    let mut little_endian = [0; 8];
    little_endian[..header.len()].copy_from_slice(header);
    if layout.big_endian {
        little_endian[..header.len()].reverse();
    }
    let declared = u64::from_le_bytes(little_endian);
    usize::try_from(declared).map_err(|_| missing_bytes(declared, 0))
}

pub(super) fn too_short() -> String {
    "is too short; the file is damaged".to_owned()
}

pub(super) fn missing_bytes(declared: impl std::fmt::Display, found: usize) -> String {
    format!("announces {declared} bytes but has {found}; the file is damaged or truncated")
}
