//! Writing one `<DataArray>`.

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

/// Writes `values`, `head.count` of them, as one array.
pub(super) fn write_array<T: Scalar>(
    out: &mut dyn Write,
    encoding: Encoding,
    head: ArrayHead<'_>,
    values: impl Iterator<Item = T>,
) -> io::Result<()> {
    let format = match encoding {
        Encoding::Binary => "binary",
        Encoding::Ascii => "ascii",
    };
    write!(out, r#"<DataArray type="{}" Name="{}""#, T::TYPE, escape(head.name))?;
    if head.components > 1 {
        write!(out, r#" NumberOfComponents="{}""#, head.components)?;
    }
    writeln!(out, r#" format="{format}">"#)?;
    match encoding {
        Encoding::Binary => write_binary(out, head.count, values)?,
        Encoding::Ascii => write_ascii(out, head.per_line, values)?,
    }
    writeln!(out, "\n</DataArray>")
}

/// The number of bytes as u64, then the bytes, as one stream of base64.
fn write_binary<T: Scalar>(
    out: &mut dyn Write,
    count: usize,
    values: impl Iterator<Item = T>,
) -> io::Result<()> {
    let mut encoder = EncoderWriter::new(out, &STANDARD);
    {
        let mut buffer = BufWriter::with_capacity(3 << 14, &mut encoder);
        let bytes = (count as u64) * (T::BYTES as u64);
        buffer.write_all(&bytes.to_le_bytes())?;
        for value in values {
            value.write_bytes(&mut buffer)?;
        }
        buffer.flush()?;
    }
    encoder.finish()?;
    Ok(())
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
