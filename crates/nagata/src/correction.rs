//! The correction of one edge that makes the tangent planes of neighbours agree.
//!
//! Adding `h_i Γ_i` ([`Blend`](crate::blend::Blend)) to a patch changes the derivative across its edge
//! `i` by `b_j b_k Γ_i` and nothing else on the boundary. `Γ_i` is chosen so that this derivative
//! becomes orthogonal to a normal which both neighbours know, as it follows from the edge curve and
//! the normals at its ends.

use bezier_core::{Corner, LocalEdge};
use glam::DVec3;

use crate::along::Along;
use crate::base_patch::BasePatch;
use crate::settings::{CorrectionSettings, TangentPlanes};
use crate::triangle::{corner_direction, ends_opposite};
use crate::turning_normal::TurningNormal;

/// `Γ_i` as a function of the parameter along the edge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "three of them live in a patch, side by side")]
pub(crate) enum Correction {
    /// Published: one vector.
    Constant(DVec3),
    /// Robust: parallel to the interpolated normal.
    Turning(TurningNormal),
}

/// How the correction of an edge was found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CorrectionStatus {
    /// The normals at both ends point to the same side of the chord: the edge has an inflection.
    /// Published tangent planes fail there.
    pub inflection: bool,
    /// The correction was longer than
    /// [`CorrectionSettings::max_length`](crate::CorrectionSettings::max_length) and was left out or,
    /// published, reduced.
    pub rejected: bool,
    /// The patch has no normal at an end of the edge, because the tangents of two edges are parallel
    /// there; that of the other end was taken for both. At the apex of an exact cone, where the
    /// tangents vanish, that is right and not reported.
    pub singular_end: bool,
    /// Rank of the system \[Nagata10 (2.74)\] that was solved: two in general, one for parallel normals,
    /// zero without solution. Robust corrections have rank two.
    pub rank: u8,
}

/// What both corrections are made of, for the edge from `P_j` to `P_k`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeData {
    /// Patch normals at `P_j` and `P_k`.
    pub(crate) normals: [DVec3; 2],
    chord: DVec3,
    /// Bézier coefficients of the tangent `t = D_k - D_j`.
    pub(crate) tangent: [DVec3; 3],
    /// Bézier coefficients of `s = D_k - D_i`, another derivative, not along the edge.
    pub(crate) across: [DVec3; 3],
    /// `c_i` and `d_i` \[Nagata10 (2.41)\].
    slopes: [f64; 2],
    straight: bool,
}

impl Correction {
    pub(crate) const NONE: Self = Self::Constant(DVec3::ZERO);

    /// Becomes the correction of the edge opposite `corner` of a patch with these corner normals; it must be
    /// none before. In place, because it is large.
    #[inline(always)]
    pub(crate) fn fill(
        &mut self,
        base: &BasePatch,
        corner: Corner,
        corner_normals: &[Option<DVec3>; 3],
        planes: TangentPlanes,
        settings: &CorrectionSettings,
    ) -> CorrectionStatus {
        let [j, k] = ends_opposite(corner);
        let (start, end) = (corner_normals[j], corner_normals[k]);
        let singular_end = ends_opposite(corner)
            .into_iter()
            .any(|end| corner_normals[end].is_none() && !is_apex(base, Corner::ALL[end]));
        let Some((start, end)) = start.or(end).zip(end.or(start)) else {
            return CorrectionStatus { singular_end, ..Default::default() };
        };
        let data = EdgeData::new(base, corner, [start, end], settings);
        let [c, d] = data.slopes;
        let inflection = !data.straight && c * d <= 0.0;
        let (rejected, rank) = match planes {
            TangentPlanes::Published => {
                let (gamma, rejected, rank) = published(&data, settings);
                *self = Self::Constant(gamma);
                (rejected, rank)
            }
            TangentPlanes::Robust => {
                let turning = TurningNormal::new(&data);
                let limit = settings.max_length * settings.max_length;
                let accepted = turning.is_within(limit * data.chord.length_squared());
                if accepted {
                    *self = Self::Turning(turning);
                }
                (!accepted, if accepted { 2 } else { 0 })
            }
        };
        CorrectionStatus { inflection, rejected, singular_end, rank }
    }

    /// `Γ` at parameter `u` of its edge, with `K - 1` derivatives.
    #[inline]
    pub(crate) fn at<const K: usize>(&self, u: f64) -> Along<DVec3, K> {
        match self {
            Self::Constant(gamma) => Along::constant(*gamma),
            Self::Turning(turning) => turning.at(u),
        }
    }

    /// Bounds of `|Γ|`, `|Γ'|` and `|Γ''|` along the edge; `None` if the normal along it (nearly) vanishes.
    pub(crate) fn bounds(&self) -> Option<[f64; 3]> {
        match self {
            Self::Constant(gamma) => Some([gamma.length(), 0.0, 0.0]),
            Self::Turning(turning) => turning.bounds(),
        }
    }
}

impl EdgeData {
    #[inline(always)]
    fn new(
        base: &BasePatch,
        corner: Corner,
        normals: [DVec3; 2],
        settings: &CorrectionSettings,
    ) -> Self {
        let i = corner.index();
        let [j, k] = ends_opposite(corner);
        let (own, next, previous) = (base.edges[i], base.edges[j], base.edges[k]);
        let chord = base.chord(corner);
        let [t_start, t_end] = own.end_tangents(chord);
        let from_apex = base.corners[k] - base.corners[i];
        let across = [
            from_apex - own.curvature - own.skew + previous.curvature - previous.skew,
            from_apex + (next.curvature + previous.curvature - own.curvature) * 0.5 + own.skew,
            from_apex + next.curvature + next.skew,
        ];
        let slopes = [normals[1].dot(t_start), -normals[0].dot(t_end)];
        // far from the origin the positions themselves are that uncertain
        let far = base.corners[j].abs().max(base.corners[k].abs()).max_element();
        let steepest = slopes[0].abs().max(slopes[1].abs());
        let is_noise = |size: f64| steepest * steepest <= settings.straight.powi(2) * size;
        Self {
            normals,
            chord,
            tangent: [t_start, chord + own.skew * 2.0, t_end],
            across,
            slopes,
            straight: steepest <= settings.straight * far || is_noise(chord.length_squared()),
        }
    }
}

/// `γ_i` of \[Nagata10 (2.74), (2.79), (2.80)\]; whether its length was refused, and the rank.
fn published(data: &EdgeData, settings: &CorrectionSettings) -> (DVec3, bool, u8) {
    let [n_j, n_k] = data.normals;
    let [c, d] = data.slopes;
    let sum = c.abs() + d.abs();
    let (c, d) = if data.straight || sum == 0.0 { (1.0, 1.0) } else { (c / sum, d / sum) };
    let right = n_j.dot(data.across[2]) * c + n_k.dot(data.across[0]) * d;
    let limit = settings.max_length * data.chord.length();
    let mut rejected = false;
    let determinant = c * c * d * d * n_j.cross(n_k).length_squared();
    if determinant > settings.rank {
        let (u, v) = (n_j + n_k, n_k - n_j);
        let (at_start, at_end) = (right / c, right / d);
        let gamma = u * ((at_start + at_end) / u.length_squared())
            + v * ((at_end - at_start) / v.length_squared());
        if gamma.length() <= limit {
            return (gamma, false, 2);
        }
        rejected = true;
    }
    let gamma = (n_j * c + n_k * d) * (right / (c * c + d * d));
    if gamma.length() <= limit { (gamma, rejected, 1) } else { (DVec3::ZERO, true, 0) }
}

/// The normals at the corners from the tangents of the edges there \[Nagata10 (2.36)\]; where these are
/// parallel, the given normal if it is orthogonal to them.
pub(crate) fn corner_normals(
    base: &BasePatch,
    given: &[Option<DVec3>; 3],
    settings: &CorrectionSettings,
) -> [Option<DVec3>; 3] {
    let from_tangents = |corner| {
        let ([a, b], chords) = tangents_at(base, corner);
        corner_direction(a.cross(b), chords)
    };
    let [a, b, c] = Corner::ALL;
    let mut normals = [from_tangents(a), from_tangents(b), from_tangents(c)];
    if normals.iter().all(Option::is_some) {
        return normals;
    }
    // given normals may all point inward
    let agreement = |(own, given): (&Option<DVec3>, &Option<DVec3>)| Some((*own)?.dot((*given)?));
    let same_side = normals.iter().zip(given).filter_map(agreement).sum::<f64>() >= 0.0;
    for corner in Corner::ALL {
        let i = corner.index();
        if let (None, Some(given)) = (normals[i], given[i])
            && is_met(base, corner, given, settings)
        {
            normals[i] = Some(if same_side { given } else { -given });
        }
    }
    normals
}

/// Whether the tangents at a corner are orthogonal to the given normal, and not zero.
fn is_met(base: &BasePatch, corner: Corner, given: DVec3, settings: &CorrectionSettings) -> bool {
    let (tangents, chords) = tangents_at(base, corner);
    tangents.into_iter().zip(chords).all(|(tangent, chord)| {
        let tolerance = settings.max_misfit * chord.length();
        tangent.length() > tolerance && given.dot(tangent).abs() <= tolerance
    })
}

/// Whether the tangents at a corner vanish, up to round-off.
fn is_apex(base: &BasePatch, corner: Corner) -> bool {
    /// What round-off leaves of a tangent, in chords.
    const VANISHED: f64 = 1e-12;
    let (tangents, chords) = tangents_at(base, corner);
    tangents
        .into_iter()
        .zip(chords)
        .all(|(tangent, chord)| tangent.length() <= VANISHED * chord.length())
}

/// The tangents of the two edges at a corner, pointing away from it, and the chords.
#[inline]
fn tangents_at(base: &BasePatch, corner: Corner) -> ([DVec3; 2], [DVec3; 2]) {
    let leaving = LocalEdge::starting_at(corner);
    let arriving = leaving.previous();
    let tangents = [base.end_tangents(leaving)[0], base.end_tangents(arriving)[1]];
    (tangents, [leaving, arriving].map(|edge| base.chord(edge.apex())))
}
