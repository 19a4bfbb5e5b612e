//! One edge: the curvature parameter from the normals at both ends.
//!
//! The edge from `P_j` to `P_k` is `x(u) = P_j (1-u) + P_k u - C u (1-u)`, `d = P_k - P_j`. Its
//! curvature parameter `C` is the shortest least-squares solution of
//!
//! ```text
//! n·C =  n·d   for every normal n at P_j          n·C = -n·d   for every normal n at P_k
//! ```
//!
//! [Nagata10 (2.1) to (2.6)]: the end tangents `d - C` and `d + C` are orthogonal to the normals. `C` is
//! a sum of terms, one for each singular direction of the system, which are dropped one by one, the
//! least certain first, until the sum is acceptable.

use glam::DVec3;

use crate::settings::EdgeSettings;
use crate::singular_terms::singular_terms;

/// The normals that an edge must respect, unit vectors: in general one at each end, two at a crease,
/// more where sheets meet, none where the surface has no tangent plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeNormals<'a> {
    /// Normals at the start.
    pub start: &'a [DVec3],
    /// Normals at the end.
    pub end: &'a [DVec3],
}

/// The curvature parameter of an edge, and how it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureParameter {
    /// C; a length vector, the same for the reversed edge.
    pub value: DVec3,
    /// How it was found.
    pub status: EdgeStatus,
}

/// How the curve of an edge was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EdgeStatus {
    /// Number of singular directions used, at most three: one for parallel normals, two for one
    /// normal at each end, zero for a straight edge without alternative.
    pub rank: u8,
    /// Why directions were left out that the normals determine; the last reason if several.
    pub lowered: Option<Lowering>,
    /// Whether a cubic curve replaced the quadratic one, of which the other fields tell.
    pub cubic: bool,
}

/// Why a direction was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Lowering {
    /// The curvature parameter was longer than
    /// [`EdgeSettings::max_curvature`](crate::EdgeSettings::max_curvature).
    Length,
    /// Its tangential part was longer than [`EdgeSettings::max_shear`](crate::EdgeSettings::max_shear).
    Shear,
    /// An end tangent pointed too far back: [`EdgeSettings::max_advance`](crate::EdgeSettings::max_advance).
    Advance,
}

/// Terms that add up to a curvature parameter, the most certain first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terms {
    pub(crate) values: [DVec3; 3],
    pub(crate) count: usize,
    /// Which of them is the tangential part.
    pub(crate) shear: Option<usize>,
}

/// The curvature parameter of the edge with this chord `P_k - P_j`.
///
/// Reversing the edge (`-chord`, ends exchanged) gives the same value; the same bits if there is one
/// normal at each end. Any finite chord, zero included, and any normals give a finite value. Whether
/// the normals are met is told by [`end_misfit`].
///
/// \[Nagata10 (2.3) to (2.6)\] in a form that does not lose digits on short edges; limits beyond
/// (2.6) are ours.
#[must_use]
pub fn curvature_parameter(
    chord: DVec3,
    normals: EdgeNormals<'_>,
    settings: &EdgeSettings,
) -> CurvatureParameter {
    match normals {
        EdgeNormals { start: &[start], end: &[end] } => one_each(chord, [start, end], settings),
        _ => {
            let terms = singular_terms(&equations(chord, normals), settings.rank);
            accepted(terms, chord, settings)
        }
    }
}

/// One normal at each end: `C` is a bow along `u = n_j + n_k` plus a shear along `v = n_k - n_j`.
#[inline(always)]
pub(crate) fn one_each(
    chord: DVec3,
    normals: [DVec3; 2],
    settings: &EdgeSettings,
) -> CurvatureParameter {
    let direct = bow_and_shear(chord, normals, &Limits::new(settings));
    if direct.accepted {
        let status = EdgeStatus::quadratic(direct.full_rank);
        return CurvatureParameter { value: direct.value, status };
    }
    one_each_lowered(chord, normals, settings)
}

/// What [`one_each`] finds without dropping terms for their length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direct {
    pub(crate) value: DVec3,
    /// Whether both terms are determined; if not, this is the bow.
    pub(crate) full_rank: bool,
    /// Whether nothing has to be dropped.
    pub(crate) accepted: bool,
}

/// The limits of [`EdgeSettings`], to be compared with squares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    rank: f64,
    curvature: f64,
    shear: f64,
    advance: f64,
}

impl Limits {
    #[inline]
    pub(crate) fn new(settings: &EdgeSettings) -> Self {
        let or_none = |limit: Option<f64>| limit.unwrap_or(f64::INFINITY);
        let squared = |limit: Option<f64>| or_none(limit) * or_none(limit);
        Self {
            rank: settings.rank,
            curvature: squared(settings.max_curvature),
            shear: squared(settings.max_shear),
            advance: or_none(settings.max_advance),
        }
    }
}

impl EdgeStatus {
    /// Of an edge with one normal at each end of which all terms are used.
    #[inline(always)]
    pub(crate) fn quadratic(full_rank: bool) -> Self {
        Self { rank: if full_rank { 2 } else { 1 }, lowered: None, cubic: false }
    }
}

/// Bow and shear, without branches: loops over this become vector instructions.
#[inline(always)]
pub(crate) fn bow_and_shear(d: DVec3, [n_j, n_k]: [DVec3; 2], limits: &Limits) -> Direct {
    let (u, v) = (n_j + n_k, n_k - n_j);
    let (a, b) = (n_j.dot(d), n_k.dot(d));
    let (uu, vv) = (u.length_squared(), v.length_squared());
    // twice the squared singular values are uu and vv
    let full_rank = lesser(uu, vv) > limits.rank * greater(uu, vv);
    let or_zero = |x: f64| if full_rank { x } else { 0.0 };
    // not finite without full rank, when there is no shear
    let slope = or_zero(-(a + b) / vv);
    let shear = DVec3::new(or_zero(v.x * slope), or_zero(v.y * slope), or_zero(v.z * slope));
    let value = u * ((a - b) / uu) + shear;
    let dd = d.length_squared();
    let violated = (value.length_squared() > limits.curvature * dd)
        | (vv * (slope * slope) > limits.shear * dd)
        | (value.dot(d).abs() > limits.advance * dd);
    Direct { value, full_rank, accepted: !violated & (uu > 0.0) & (full_rank | (uu >= vv)) }
}

/// The lesser of two numbers, in one instruction.
#[inline(always)]
pub(crate) fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers, in one instruction.
#[inline(always)]
pub(crate) fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The same where not both terms can be used.
#[cold]
#[inline(never)]
fn one_each_lowered(
    d: DVec3,
    [n_j, n_k]: [DVec3; 2],
    settings: &EdgeSettings,
) -> CurvatureParameter {
    let (u, v) = (n_j + n_k, n_k - n_j);
    let (a, b) = (n_j.dot(d), n_k.dot(d));
    let (uu, vv) = (u.length_squared(), v.length_squared());
    let bow_first = uu >= vv;
    let full_rank = uu.min(vv) > settings.rank * uu.max(vv);
    // a term of a singular direction is not finite
    let bow = if bow_first || full_rank { u * ((a - b) / uu) } else { DVec3::ZERO };
    let shear = if !bow_first || full_rank { v * (-(a + b) / vv) } else { DVec3::ZERO };
    let values = if bow_first { [bow, shear, DVec3::ZERO] } else { [shear, bow, DVec3::ZERO] };
    let count = if full_rank { 2 } else { 1 };
    let shear = Some(usize::from(bow_first)).filter(|at| *at < count);
    accepted(Terms { values, count, shear }, d, settings)
}

/// Rows `(normal, right side)` of the system.
fn equations(chord: DVec3, normals: EdgeNormals<'_>) -> Vec<(DVec3, f64)> {
    let start = normals.start.iter().map(|n| (*n, n.dot(chord)));
    start.chain(normals.end.iter().map(|n| (*n, -n.dot(chord)))).collect()
}

/// Drops terms until no limit is violated; without terms none is.
pub(crate) fn accepted(
    mut terms: Terms,
    chord: DVec3,
    settings: &EdgeSettings,
) -> CurvatureParameter {
    let mut lowered = None;
    loop {
        let value = terms.values[..terms.count].iter().fold(DVec3::ZERO, |sum, term| sum + *term);
        let shear = terms.shear.map(|at| terms.values[at]);
        let Some(reason) = violation(value, shear, chord, settings) else {
            let rank = u8::try_from(terms.count).expect("invariant: at most three terms");
            return CurvatureParameter {
                value,
                status: EdgeStatus { rank, lowered, cubic: false },
            };
        };
        lowered = Some(reason);
        terms.count -= 1;
        match terms.shear {
            // the tangential part goes, the other one stays
            Some(at) if reason == Lowering::Shear => {
                terms.values[at] = terms.values[terms.count];
                terms.shear = None;
            }
            Some(at) if at == terms.count => terms.shear = None,
            _ => {}
        }
    }
}

/// The first limit that `value` violates; a zero value violates none.
#[inline(always)]
fn violation(
    value: DVec3,
    shear: Option<DVec3>,
    chord: DVec3,
    settings: &EdgeSettings,
) -> Option<Lowering> {
    let dd = chord.length_squared();
    let exceeds =
        |x: DVec3, limit: Option<f64>| limit.is_some_and(|l| x.length_squared() > l * l * dd);
    if exceeds(value, settings.max_curvature) {
        return Some(Lowering::Length);
    }
    if shear.is_some_and(|shear| exceeds(shear, settings.max_shear)) {
        return Some(Lowering::Shear);
    }
    let backward = settings.max_advance.is_some_and(|rho| value.dot(chord).abs() > rho * dd);
    backward.then_some(Lowering::Advance)
}

/// How far the end tangents `start_tangent = x'(0)` and `end_tangent = x'(1)` are from being
/// orthogonal to the normals: the largest `|n·x'| / |d|`, for small values the angle in radians.
/// Zero for an edge without length.
#[must_use]
pub fn end_misfit(
    chord: DVec3,
    start_tangent: DVec3,
    end_tangent: DVec3,
    normals: EdgeNormals<'_>,
) -> f64 {
    let largest = |normals: &[DVec3], tangent: DVec3| {
        normals.iter().map(|n| n.dot(tangent).abs()).fold(0.0, f64::max)
    };
    let length = chord.length();
    if length > 0.0 {
        largest(normals.start, start_tangent).max(largest(normals.end, end_tangent)) / length
    } else {
        0.0
    }
}
