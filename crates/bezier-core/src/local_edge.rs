//! Corners and edges of one triangle: the one place where they are numbered.

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Corner {
    /// Barycentric (1, 0, 0).
    First,
    /// Barycentric (0, 1, 0).
    Second,
    /// Barycentric (0, 0, 1).
    Third,
}

impl Corner {
    /// All corners, counter-clockwise.
    pub const ALL: [Self; 3] = [Self::First, Self::Second, Self::Third];

    /// Position of the corner in [`Corner::ALL`]: 0, 1 or 2.
    #[inline]
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The next corner, counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn next(self) -> Self {
        Self::ALL[(self as usize + 1) % 3]
    }

    /// The previous corner, counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn previous(self) -> Self {
        Self::ALL[(self as usize + 2) % 3]
    }
}

/// An edge of a triangle, directed counter-clockwise.
///
/// Papers disagree whether edge *k* starts at corner *k* or faces it, so there is a named
/// constructor for each and no conversion from an integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LocalEdge {
    start: Corner,
}

impl LocalEdge {
    /// The three edges, by starting corner.
    pub const ALL: [Self; 3] = [
        Self::starting_at(Corner::First),
        Self::starting_at(Corner::Second),
        Self::starting_at(Corner::Third),
    ];

    /// The edge from `corner` to the next corner.
    #[inline]
    #[must_use]
    pub const fn starting_at(corner: Corner) -> Self {
        Self { start: corner }
    }

    /// The edge that does not touch `corner`.
    #[inline]
    #[must_use]
    pub const fn opposite(corner: Corner) -> Self {
        Self { start: corner.next() }
    }

    /// Corner where the edge starts.
    #[inline]
    #[must_use]
    pub const fn start(self) -> Corner {
        self.start
    }

    /// Corner where the edge ends.
    #[inline]
    #[must_use]
    pub const fn end(self) -> Corner {
        self.start.next()
    }

    /// The corner that is not on the edge.
    #[inline]
    #[must_use]
    pub const fn apex(self) -> Corner {
        self.start.previous()
    }

    /// The next edge, counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn next(self) -> Self {
        Self { start: self.start.next() }
    }

    /// The previous edge, counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn previous(self) -> Self {
        Self { start: self.start.previous() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walking_around() {
        for edge in LocalEdge::ALL {
            assert_eq!(edge.next().next().next(), edge);
            assert_eq!(edge.next().previous(), edge);
            assert_eq!(edge.end(), edge.next().start());
            assert_eq!(LocalEdge::opposite(edge.apex()), edge);
        }
    }
}
