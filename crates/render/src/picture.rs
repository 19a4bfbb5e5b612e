//! Pixels.

use crate::colour::Colour;

/// A picture; the first row is the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<Colour>,
}

impl Picture {
    /// A picture of one colour.
    #[must_use]
    pub fn new([width, height]: [usize; 2], colour: Colour) -> Self {
        Self { width, height, pixels: vec![colour; width * height] }
    }

    /// Pixels row by row.
    ///
    /// # Panics
    ///
    /// If there are not as many pixels as the size says.
    #[must_use]
    pub fn from_pixels([width, height]: [usize; 2], pixels: Vec<Colour>) -> Self {
        assert_eq!(pixels.len(), width * height, "a colour for each pixel");
        Self { width, height, pixels }
    }

    /// Width and height.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The colour of a pixel.
    ///
    /// # Panics
    ///
    /// Outside the picture.
    #[must_use]
    pub fn pixel(&self, column: usize, row: usize) -> Colour {
        assert!(column < self.width, "outside the picture");
        self.pixels[row * self.width + column]
    }

    /// Red, green and blue of each pixel in sRGB, row by row.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|colour| colour.bytes()).collect()
    }

    /// Puts another picture into this one, with its upper left corner at this pixel; what does not fit
    /// is left out.
    pub fn paste(&mut self, other: &Self, [column, row]: [usize; 2]) {
        let width = other.width.min(self.width.saturating_sub(column));
        let height = other.height.min(self.height.saturating_sub(row));
        for y in 0..height {
            let target = (row + y) * self.width + column;
            let source = y * other.width;
            self.pixels[target..target + width]
                .copy_from_slice(&other.pixels[source..source + width]);
        }
    }

    /// Mixes a colour into a pixel; outside the picture nothing happens.
    pub(crate) fn blend(&mut self, column: usize, row: usize, colour: Colour, part: f64) {
        if column < self.width && row < self.height {
            let pixel = &mut self.pixels[row * self.width + column];
            *pixel = pixel.mix(colour, part);
        }
    }
}
