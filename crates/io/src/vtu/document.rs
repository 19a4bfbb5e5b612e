//! From XML to arrays that are still text.

use std::borrow::Cow;

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::appended::AppendedEncoding;
use super::error::VtuReadError;

/// How numbers are stored as bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct BinaryLayout {
    pub(super) big_endian: bool,
    /// The byte count before each array has 8 bytes instead of 4.
    pub(super) long_header: bool,
    pub(super) compressed: bool,
    pub(super) appended: AppendedEncoding,
}

impl BinaryLayout {
    /// The size of the byte count before each array.
    pub(super) fn header_bytes(self) -> usize {
        if self.long_header { 8 } else { 4 }
    }
}

/// Where the numbers of an array are.
#[derive(Clone, Debug)]
pub(super) enum Format<'a> {
    /// Decimal digits in the element.
    Ascii(Cow<'a, str>),
    /// Base64 in the element.
    Binary(Cow<'a, str>),
    /// Behind the XML, so many bytes after the underscore.
    Appended(usize),
}

/// One `<DataArray>`.
#[derive(Clone, Debug)]
pub(super) struct RawArray<'a> {
    pub(super) name: String,
    pub(super) type_name: String,
    pub(super) components: usize,
    pub(super) format: Format<'a>,
}

/// The parts of a file with one piece.
#[derive(Debug, Default)]
pub(super) struct Document<'a> {
    pub(super) layout: BinaryLayout,
    pub(super) point_count: usize,
    pub(super) cell_count: usize,
    pub(super) points: Vec<RawArray<'a>>,
    pub(super) cells: Vec<RawArray<'a>>,
    pub(super) cell_data: Vec<RawArray<'a>>,
    pub(super) point_data: Vec<RawArray<'a>>,
    /// The blocks behind the XML.
    pub(super) appended: Option<&'a [u8]>,
    /// Name of the point data array that makes the cells rational.
    pub(super) rational_weights: Option<String>,
}

/// Reads the structure of a file, or of what comes before the contents of its `<AppendedData>`; the
/// numbers stay text.
pub(super) fn parse(text: &str) -> Result<Document<'_>, VtuReadError> {
    let mut reader = Reader::from_str(text);
    reader.config_mut().expand_empty_elements = true;
    let mut parser = Parser::default();
    loop {
        let event = reader.read_event().map_err(|error| {
            let before = usize::try_from(reader.error_position()).unwrap_or(usize::MAX);
            xml_error(text, before, error.to_string())
        })?;
        let here = usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX);
        match event {
            Event::Start(element) => {
                parser.open(&element).map_err(|open| open.at(text, here))?;
            }
            Event::End(_) => parser.close(),
            Event::Text(part) => parser.append(part.into_inner()),
            Event::CData(part) => parser.append(part.into_inner()),
            Event::GeneralRef(entity) if parser.in_array() => {
                let message = format!("unexpected '&{};' among numbers", &*entity);
                return Err(xml_error(text, here, message));
            }
            Event::Eof => return parser.finish(),
            _ => {}
        }
    }
}

fn xml_error(text: &str, offset: usize, message: String) -> VtuReadError {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
    VtuReadError::Xml { line, message }
}

/// Why an opening tag was refused.
enum OpenError {
    Malformed(String),
    Refused(VtuReadError),
}

impl OpenError {
    fn at(self, text: &str, offset: usize) -> VtuReadError {
        match self {
            Self::Malformed(message) => xml_error(text, offset, message),
            Self::Refused(error) => error,
        }
    }
}

impl From<VtuReadError> for OpenError {
    fn from(error: VtuReadError) -> Self {
        Self::Refused(error)
    }
}

#[derive(Default)]
struct Parser<'a> {
    open: Vec<String>,
    document: Document<'a>,
    has_grid: bool,
    pieces: usize,
}

impl<'a> Parser<'a> {
    fn open(&mut self, element: &BytesStart<'_>) -> Result<(), OpenError> {
        let name = element.name().as_ref().to_owned();
        check_attributes(element)?;
        match (self.open.last().map_or("", String::as_str), name.as_str()) {
            ("", "VTKFile") => self.open_file(element)?,
            ("VTKFile", "UnstructuredGrid") => self.has_grid = true,
            ("VTKFile", "AppendedData") => {
                self.document.layout.appended = appended_encoding(element)?;
            }
            ("UnstructuredGrid", "Piece") => self.open_piece(element)?,
            ("Piece", "PointData") => {
                self.document.rational_weights = attribute(element, "RationalWeights")?;
            }
            (_, "DataArray" | "Array") => {
                let array = open_array(element)?;
                if let Some(arrays) = self.arrays() {
                    arrays.push(array);
                }
            }
            _ => {}
        }
        self.open.push(name);
        Ok(())
    }

    fn open_file(&mut self, element: &BytesStart<'_>) -> Result<(), OpenError> {
        choice(element, "type", &["UnstructuredGrid"], "UnstructuredGrid", "UnstructuredGrid")?;
        let layout = &mut self.document.layout;
        let orders = ["LittleEndian", "BigEndian"];
        layout.big_endian =
            choice(element, "byte_order", &orders, "LittleEndian", "LittleEndian or BigEndian")?
                == "BigEndian";
        layout.long_header =
            choice(element, "header_type", &["UInt32", "UInt64"], "UInt32", "UInt32 or UInt64")?
                == "UInt64";
        layout.compressed = attribute(element, "compressor")?.is_some();
        Ok(())
    }

    fn open_piece(&mut self, element: &BytesStart<'_>) -> Result<(), OpenError> {
        self.pieces += 1;
        if self.pieces > 1 {
            let what = "several pieces are";
            let instead = "one piece (in ParaView: Merge Blocks, then Clean to Grid)";
            return Err(VtuReadError::Unsupported { what, instead }.into());
        }
        self.document.point_count = count(element, "NumberOfPoints")?;
        self.document.cell_count = count(element, "NumberOfCells")?;
        Ok(())
    }

    /// The arrays of the open section of the piece, if one is open.
    fn arrays(&mut self) -> Option<&mut Vec<RawArray<'a>>> {
        match self.open.get(3).map(String::as_str) {
            _ if self.open.get(2).map(String::as_str) != Some("Piece") => None,
            Some("Points") => Some(&mut self.document.points),
            Some("Cells") => Some(&mut self.document.cells),
            Some("CellData") => Some(&mut self.document.cell_data),
            Some("PointData") => Some(&mut self.document.point_data),
            _ => None,
        }
    }

    /// Directly inside an array, not inside an element of it.
    fn in_array(&self) -> bool {
        self.open.len() == 5 && matches!(self.open[4].as_str(), "DataArray" | "Array")
    }

    fn append(&mut self, part: Cow<'a, str>) {
        if self.in_array()
            && let Some(array) = self.arrays().and_then(|arrays| arrays.last_mut())
        {
            let (Format::Ascii(text) | Format::Binary(text)) = &mut array.format else { return };
            if text.trim_ascii().is_empty() {
                *text = part;
            } else if !part.trim_ascii().is_empty() {
                text.to_mut().push_str(&part);
            }
        }
    }

    fn close(&mut self) {
        self.open.pop();
    }

    fn finish(mut self) -> Result<Document<'a>, VtuReadError> {
        // what follows this tag is no XML and was cut off
        if self.open == ["VTKFile", "AppendedData"] {
            self.open.clear();
        }
        if let Some(element) = self.open.pop() {
            return Err(VtuReadError::Truncated { element });
        }
        if !self.has_grid {
            return Err(VtuReadError::Missing { what: "<UnstructuredGrid>" });
        }
        if self.pieces == 0 {
            return Err(VtuReadError::Missing { what: "<Piece>" });
        }
        Ok(self.document)
    }
}

fn open_array<'a>(element: &BytesStart<'_>) -> Result<RawArray<'a>, OpenError> {
    let components = attribute(element, "NumberOfComponents")?;
    let format = match attribute(element, "format")?.as_deref() {
        None | Some("ascii") => Format::Ascii(Cow::Borrowed("")),
        Some("binary") => Format::Binary(Cow::Borrowed("")),
        Some("appended") => Format::Appended(count(element, "offset")?),
        Some(value) => {
            let (attribute, value) = ("format", value.to_owned());
            let expected = "ascii, binary or appended";
            return Err(VtuReadError::Attribute { attribute, value, expected }.into());
        }
    };
    Ok(RawArray {
        name: attribute(element, "Name")?.unwrap_or_default(),
        type_name: attribute(element, "type")?.unwrap_or_default(),
        components: components.and_then(|text| text.parse().ok()).unwrap_or(1),
        format,
    })
}

fn appended_encoding(element: &BytesStart<'_>) -> Result<AppendedEncoding, OpenError> {
    let allowed = ["raw", "base64"];
    let encoding = choice(element, "encoding", &allowed, "base64", "raw or base64")?;
    Ok(if encoding == "raw" { AppendedEncoding::Raw } else { AppendedEncoding::Base64 })
}

/// Looks at the attributes that nobody asks for, too: a damaged one is a damaged file.
fn check_attributes(element: &BytesStart<'_>) -> Result<(), OpenError> {
    let malformed = |message: String| OpenError::Malformed(message);
    element
        .attributes()
        .try_for_each(|found| found.map(drop).map_err(|error| malformed(error.to_string())))
}

fn attribute(element: &BytesStart<'_>, name: &str) -> Result<Option<String>, OpenError> {
    let malformed = |message: String| OpenError::Malformed(message);
    let found = element.try_get_attribute(name).map_err(|error| malformed(error.to_string()))?;
    let Some(found) = found else { return Ok(None) };
    let value = found.normalized_value(XmlVersion::Implicit1_0);
    Ok(Some(value.map_err(|error| malformed(error.to_string()))?.into_owned()))
}

fn choice(
    element: &BytesStart<'_>,
    name: &'static str,
    allowed: &[&str],
    default: &str,
    expected: &'static str,
) -> Result<String, OpenError> {
    let value = attribute(element, name)?.unwrap_or_else(|| default.to_owned());
    if !allowed.contains(&value.as_str()) {
        return Err(VtuReadError::Attribute { attribute: name, value, expected }.into());
    }
    Ok(value)
}

fn count(element: &BytesStart<'_>, name: &'static str) -> Result<usize, OpenError> {
    let value = attribute(element, name)?.unwrap_or_default();
    let expected = "a whole number";
    value
        .trim()
        .parse()
        .map_err(|_| VtuReadError::Attribute { attribute: name, value, expected }.into())
}
