//! From the bytes of an OBJ file to its statements, and from words to numbers and corners.

use std::str::SplitWhitespace;

use glam::DVec3;

use super::error::ObjReadError;

/// Statements that say nothing about the faces of a mesh.
const SKIPPED: [&str; 17] = [
    "vt",
    "vp",
    "s",
    "mg",
    "l",
    "p",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "call",
];

/// A statement that a mesh reader looks at, with the words behind its keyword.
pub(super) enum Statement<'t> {
    Vertex(SplitWhitespace<'t>),
    Normal(SplitWhitespace<'t>),
    Face(SplitWhitespace<'t>),
    /// The name of the faces that follow.
    Group(SplitWhitespace<'t>),
}

/// Hands all statements of a file to `visit`, with their line; continued lines are put together.
///
/// Comments and [`SKIPPED`] are left out, statements that nobody knows are refused.
pub(super) fn for_each_statement(
    bytes: &[u8],
    mut visit: impl FnMut(usize, Statement<'_>) -> Result<(), ObjReadError>,
) -> Result<(), ObjReadError> {
    // names and comments may be in any encoding; statements are ASCII
    let text = String::from_utf8_lossy(bytes);
    let mut joined = String::new();
    let mut first_line = None;
    let mut whole = |line: usize, text: &str| match statement(line, text)? {
        Some(statement) => visit(line, statement),
        None => Ok(()),
    };
    for (number, line) in (1..).zip(text.lines()) {
        let line_number = *first_line.get_or_insert(number);
        if let Some(continued) = line.strip_suffix('\\') {
            joined.push_str(continued);
            joined.push(' ');
            continue;
        }
        joined.push_str(line);
        whole(line_number, &joined)?;
        joined.clear();
        first_line = None;
    }
    match first_line {
        Some(line) => whole(line, &joined),
        None => Ok(()),
    }
}

fn statement(line: usize, text: &str) -> Result<Option<Statement<'_>>, ObjReadError> {
    let text = text.split_once('#').map_or(text, |(before, _)| before);
    let mut words = text.split_whitespace();
    match words.next() {
        Some("v") => Ok(Some(Statement::Vertex(words))),
        Some("vn") => Ok(Some(Statement::Normal(words))),
        Some("f") => Ok(Some(Statement::Face(words))),
        Some("g" | "o") => Ok(Some(Statement::Group(words))),
        Some(other) if !SKIPPED.contains(&other) => {
            Err(ObjReadError::Statement { line, keyword: other.to_owned() })
        }
        _ => Ok(None),
    }
}

/// The numbers of a statement.
pub(super) fn numbers(line: usize, words: SplitWhitespace<'_>) -> Result<Vec<f64>, ObjReadError> {
    let number = |text: &str| {
        let text = text.to_owned();
        text.parse::<f64>().map_err(|_| ObjReadError::Number { line, text })
    };
    words.map(number).collect()
}

/// The position of vertex number `vertex`, counted from 1.
pub(super) fn position(
    line: usize,
    vertex: usize,
    words: SplitWhitespace<'_>,
) -> Result<DVec3, ObjReadError> {
    let numbers = numbers(line, words)?;
    let count = numbers.len();
    if !matches!(count, 3 | 4 | 6 | 7) {
        return Err(ObjReadError::CoordinateCount { line, count });
    }
    let position = DVec3::new(numbers[0], numbers[1], numbers[2]);
    if !position.is_finite() {
        return Err(ObjReadError::NotFinite { line, vertex, position });
    }
    Ok(position)
}

/// The indices of a corner as written: from 1, or negative and relative to the last one.
pub(super) struct CornerIndices {
    pub(super) vertex: i64,
    pub(super) normal: Option<i64>,
}

/// The indices of `v`, `v/vt`, `v//vn` or `v/vt/vn`.
pub(super) fn corner(line: usize, text: &str) -> Result<CornerIndices, ObjReadError> {
    let malformed = || ObjReadError::Corner { line, text: text.to_owned() };
    let index = |text: &str| nonzero(text).ok_or_else(malformed);
    let mut parts = text.split('/');
    let vertex = parts.next().ok_or_else(malformed).and_then(index)?;
    let others: Vec<&str> = parts.collect();
    // one part may be empty: `v//vn`
    let normal = match *others.as_slice() {
        [] => None,
        [texture] => index(texture).map(|_| None)?,
        ["", normal] => Some(index(normal)?),
        [texture, normal] => Some(index(texture).and(index(normal))?),
        _ => return Err(malformed()),
    };
    Ok(CornerIndices { vertex, normal })
}

fn nonzero(text: &str) -> Option<i64> {
    text.parse().ok().filter(|&index| index != 0)
}

/// The element that an index means, from 0, when `count` elements are known; `None` if a relative
/// index reaches before the first one. A positive index may be larger than the count.
pub(super) fn resolve(index: i64, count: usize) -> Option<usize> {
    let magnitude = usize::try_from(index.unsigned_abs()).ok()?;
    if index > 0 { Some(magnitude - 1) } else { count.checked_sub(magnitude) }
}

/// The index from 1 of an element counted from 0.
pub(super) fn from_one(element: usize) -> i64 {
    i64::try_from(element).unwrap_or(i64::MAX).saturating_add(1)
}
