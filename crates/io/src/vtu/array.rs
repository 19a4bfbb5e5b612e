//! Writing `<DataArray>`s.

use std::io::{self, BufWriter, Write};

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use quick_xml::escape::escape;

use super::Encoding;

/// A number type of VTK.
pub(super) trait Scalar: Copy {
    const TYPE: &'static str;
    const BYTES: usize;
    fn write_bytes(self, out: &mut dyn Write) -> io::Result<()>;
    /// Digits from which exactly this number is read back.
    fn write_digits(self, out: &mut dyn Write) -> io::Result<()>;
}

macro_rules! scalar {
    ($t:ty, $name:literal) => {
        impl Scalar for $t {
            const TYPE: &'static str = $name;
            const BYTES: usize = size_of::<$t>();
            fn write_bytes(self, out: &mut dyn Write) -> io::Result<()> {
                out.write_all(&self.to_le_bytes())
            }
            fn write_digits(self, out: &mut dyn Write) -> io::Result<()> {
                write!(out, "{self:?}")
            }
        }
    };
}

scalar!(f64, "Float64");
scalar!(i64, "Int64");
scalar!(u8, "UInt8");

/// What stands in the opening tag of an array.
#[derive(Clone, Copy)]
pub(super) struct ArrayHead<'a> {
    pub(super) name: &'a str,
    /// Numbers for each point or cell.
    pub(super) components: usize,
    /// Numbers in the whole array.
    pub(super) count: usize,
    /// Numbers in each line of an ASCII file.
    pub(super) per_line: usize,
}

impl<'a> ArrayHead<'a> {
    /// One number for each cell or index.
    pub(super) fn scalars(name: &'a str, count: usize) -> Self {
        Self { name, components: 1, count, per_line: 20 }
    }
}

/// Writes one array after the other.
pub(super) struct ArrayWriter {
    encoding: Encoding,
    /// What stands behind the XML in the end.
    appended: Vec<u8>,
}

impl ArrayWriter {
    pub(super) fn new(encoding: Encoding) -> Self {
        Self { encoding, appended: Vec::new() }
    }

    /// Writes `values`, `head.count` of them, as one array.
    pub(super) fn write<T: Scalar>(
        &mut self,
        out: &mut dyn Write,
        head: ArrayHead<'_>,
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        write!(out, r#"<DataArray type="{}" Name="{}""#, T::TYPE, escape(head.name))?;
        if head.components > 1 {
            write!(out, r#" NumberOfComponents="{}""#, head.components)?;
        }
        match self.encoding {
            Encoding::Binary => {
                writeln!(out, r#" format="binary">"#)?;
                write_base64(out, head.count, values)?;
                writeln!(out, "\n</DataArray>")
            }
            Encoding::Appended => {
                let offset = self.appended.len();
                writeln!(out, r#" format="appended" offset="{offset}"/>"#)?;
                write_block(&mut self.appended, head.count, values)
            }
            Encoding::Ascii => {
                writeln!(out, r#" format="ascii">"#)?;
                write_ascii(out, head.per_line, values)?;
                writeln!(out, "\n</DataArray>")
            }
        }
    }

    /// Writes what belongs behind the grid.
    pub(super) fn finish(self, out: &mut dyn Write) -> io::Result<()> {
        if self.encoding != Encoding::Appended {
            return Ok(());
        }
        writeln!(out, r#"<AppendedData encoding="raw">"#)?;
        out.write_all(b"_")?;
        out.write_all(&self.appended)?;
        writeln!(out, "\n</AppendedData>")
    }
}

/// The block of an array as one stream of base64.
fn write_base64<T: Scalar>(
    out: &mut dyn Write,
    count: usize,
    values: impl Iterator<Item = T>,
) -> io::Result<()> {
    let mut encoder = EncoderWriter::new(out, &STANDARD);
    {
        let mut buffer = BufWriter::with_capacity(3 << 14, &mut encoder);
        write_block(&mut buffer, count, values)?;
        buffer.flush()?;
    }
    encoder.finish()?;
    Ok(())
}

/// The number of bytes as u64, then the bytes.
fn write_block<T: Scalar>(
    out: &mut dyn Write,
    count: usize,
    mut values: impl Iterator<Item = T>,
) -> io::Result<()> {
    let bytes = (count as u64) * (T::BYTES as u64);
    out.write_all(&bytes.to_le_bytes())?;
    values.try_for_each(|value| value.write_bytes(out))
}

fn write_ascii<T: Scalar>(
    out: &mut dyn Write,
    per_line: usize,
    values: impl Iterator<Item = T>,
) -> io::Result<()> {
    for (at, value) in values.enumerate() {
        if at > 0 {
            out.write_all(if at % per_line == 0 { b"\n" } else { b" " })?;
        }
        value.write_digits(out)?;
    }
    Ok(())
}
