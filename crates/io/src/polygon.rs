//! Faces of three or four corners.

/// Something for each of the three or four corners of a face, such as its vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polygon<T> {
    /// A triangle repeats its last corner.
    corners: [T; 4],
    is_quad: bool,
}

impl<T: Copy> Polygon<T> {
    /// A triangle.
    #[must_use]
    pub const fn triangle([a, b, c]: [T; 3]) -> Self {
        Self { corners: [a, b, c, c], is_quad: false }
    }

    /// A quadrilateral.
    #[must_use]
    pub const fn quad(corners: [T; 4]) -> Self {
        Self { corners, is_quad: true }
    }

    /// A triangle or quadrilateral; `None` for other numbers of corners.
    #[must_use]
    pub fn new(corners: &[T]) -> Option<Self> {
        match *corners {
            [a, b, c] => Some(Self::triangle([a, b, c])),
            [a, b, c, d] => Some(Self::quad([a, b, c, d])),
            _ => None,
        }
    }

    /// The corners, counter-clockwise seen from outside.
    #[must_use]
    pub fn corners(&self) -> &[T] {
        if self.is_quad { &self.corners } else { &self.corners[..3] }
    }
}

impl<T: Copy> AsRef<[T]> for Polygon<T> {
    fn as_ref(&self) -> &[T] {
        self.corners()
    }
}
