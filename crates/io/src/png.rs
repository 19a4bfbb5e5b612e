//! Pictures (`.png`).

use std::io::Write;

use thiserror::Error;

/// Why a picture was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PngError {
    /// There are not three bytes for each pixel, or no pixel.
    #[error("{bytes} bytes are no picture of {width} by {height} pixels")]
    Size {
        /// Bytes given.
        bytes: usize,
        /// Pixels of a row.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] std::io::Error),
}

impl From<PngError> for std::io::Error {
    fn from(error: PngError) -> Self {
        match error {
            PngError::Io(cause) => cause,
            other => Self::new(std::io::ErrorKind::InvalidInput, other),
        }
    }
}

/// Writes red, green and blue of each pixel in sRGB, row by row from the top.
///
/// # Errors
///
/// [`PngError`].
pub fn write_png(
    out: &mut dyn Write,
    [width, height]: [usize; 2],
    rgb: &[u8],
) -> Result<(), PngError> {
    let refused = || PngError::Size { bytes: rgb.len(), width, height };
    let size = u32::try_from(width).ok().zip(u32::try_from(height).ok());
    let (columns, rows) = size.filter(|&(w, h)| w > 0 && h > 0).ok_or_else(refused)?;
    if width.checked_mul(height).and_then(|pixels| pixels.checked_mul(3)) != Some(rgb.len()) {
        return Err(refused());
    }
    let mut encoder = png::Encoder::new(out, columns, rows);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(io_error)?;
    writer.write_image_data(rgb).map_err(io_error)?;
    writer.finish().map_err(io_error)
}

/// The size was checked before, so that nothing else is left to go wrong.
fn io_error(error: png::EncodingError) -> PngError {
    match error {
        png::EncodingError::IoError(error) => PngError::Io(error),
        other => PngError::Io(std::io::Error::other(other)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_come_back() {
        let rgb: Vec<u8> = (0..5 * 4 * 3).map(|k| k * 4).collect();
        let mut file = Vec::new();
        write_png(&mut file, [5, 4], &rgb).expect("a picture");
        let mut reader =
            png::Decoder::new(std::io::Cursor::new(&file)).read_info().expect("a head");
        let mut read = vec![0; reader.output_buffer_size().expect("small")];
        let info = reader.next_frame(&mut read).expect("a frame");
        assert_eq!((info.width, info.height), (5, 4), "the size");
        assert_eq!(read, rgb, "the pixels");
    }

    #[test]
    fn other_sizes_are_refused() {
        for size in [[0, 4], [5, 4], [usize::MAX, usize::MAX]] {
            let error =
                write_png(&mut Vec::new(), size, &[0; 59]).expect_err("not that many bytes");
            assert!(matches!(error, PngError::Size { .. }), "{error}");
        }
    }
}
