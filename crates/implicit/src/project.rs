//! Onto the zero set along the gradient.

use glam::DVec3;

use crate::field::ImplicitField;

/// When a projection stops.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProjectionSettings {
    /// Stop when |f|/|∇f| ≤ `tolerance` · length. Dimensionless, default 1e-13: two or three
    /// Newton steps more than 1e-6, for feet that are exact for all purposes.
    pub tolerance: f64,
    /// Give up after this many steps; default 60. From a point nearer than the radius of
    /// curvature about five are enough, and where the gradient vanishes on the surface, so that
    /// convergence is only linear, 60 halvings still use up every bit.
    pub max_iterations: usize,
}

impl Default for ProjectionSettings {
    fn default() -> Self {
        Self { tolerance: 1e-13, max_iterations: 60 }
    }
}

/// Why a point has no projection.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProjectionError {
    /// The gradient vanishes or is not finite, or the value is not finite.
    #[error("the field has no usable gradient at {point}")]
    Singular {
        /// Where the iteration was.
        point: DVec3,
    },
    /// The steps were not enough.
    #[error("no convergence to the surface: about {distance} away at {point}")]
    NotConverged {
        /// Where the iteration was.
        point: DVec3,
        /// The estimate |f|/|∇f| there.
        distance: f64,
    },
}

/// Projects `p` onto the zero set by Newton steps along the gradient, p ← p − f ∇f/|∇f|².
///
/// Stops when |f|/|∇f| ≤ [`tolerance`](ProjectionSettings::tolerance) × `length`; `length` is the
/// size of the feature the caller works on (usually the edge length).
/// If the field's round-off is coarser than that, it stops at the round-off: once the estimate is
/// below √ε · `length`, where a Newton step would halve it many times over, a step that does not
/// reduce it at all ends the iteration, and the better of the two points is the result.
/// (A length below some 10⁻⁷ of the coordinates is itself near round-off, and may not converge.)
/// Converges quadratically from points closer than the smallest radius of curvature.
///
/// The result is near the closest point but not equal to it: the offset is of second order in the
/// distance.
///
/// # Errors
/// If the gradient vanishes or something is not finite on the way, or
/// [`max_iterations`](ProjectionSettings::max_iterations) steps were not enough.
///
/// \[TK09 (4)\], whose stopping rule ε/length has the wrong dimension; the step cap and the rule for
/// round-off are ours.
pub fn project(
    field: &dyn ImplicitField,
    p: DVec3,
    length: f64,
    settings: &ProjectionSettings,
) -> Result<DVec3, ProjectionError> {
    project_with_gradient(field, p, length, settings).map(|(foot, _)| foot)
}

/// [`project`] together with the unit normal ∇f/|∇f| at the foot, which costs nothing more.
///
/// # Errors
/// As for [`project`].
pub fn project_with_gradient(
    field: &dyn ImplicitField,
    p: DVec3,
    length: f64,
    settings: &ProjectionSettings,
) -> Result<(DVec3, DVec3), ProjectionError> {
    let mut descent = Descent::new(p, length, settings);
    loop {
        let (value, gradient) = field.value_gradient(descent.point);
        if let Some(outcome) = descent.step(value, gradient) {
            return outcome;
        }
    }
}

/// Projects many points in place, evaluating the points still on their way in batches.
///
/// `result[i]` is the unit normal at the foot, or the reason why `points[i]` was left where it
/// was. Feet and normals equal those of [`project_with_gradient`] bit for bit if the field's batch
/// methods equal its single ones.
pub fn project_many(
    field: &dyn ImplicitField,
    points: &mut [DVec3],
    length: f64,
    settings: &ProjectionSettings,
) -> Vec<Result<DVec3, ProjectionError>> {
    let mut results = vec![Ok(DVec3::ZERO); points.len()];
    for (points, results) in points.chunks_mut(BATCH).zip(results.chunks_mut(BATCH)) {
        project_batch(field, points, length, settings, results);
    }
    results
}

/// Points that are projected together: enough to keep a batch busy, and they need no heap.
const BATCH: usize = 16;

/// [`project_many`] for at most [`BATCH`] points.
fn project_batch(
    field: &dyn ImplicitField,
    points: &mut [DVec3],
    length: f64,
    settings: &ProjectionSettings,
    results: &mut [Result<DVec3, ProjectionError>],
) {
    let mut descents = [Descent::new(DVec3::ZERO, length, settings); BATCH];
    let mut positions = [DVec3::ZERO; BATCH];
    let mut jets = [(0.0, DVec3::ZERO); BATCH];
    // the points still on their way, their positions side by side
    let mut moving: [usize; BATCH] = std::array::from_fn(|i| i);
    let mut count = points.len();
    positions[..count].copy_from_slice(points);
    for (descent, &point) in descents.iter_mut().zip(&*points) {
        descent.point = point;
    }
    while count > 0 {
        field.value_gradients(&positions[..count], &mut jets[..count]);
        let mut left = 0;
        for k in 0..count {
            let i = moving[k];
            let (value, gradient) = jets[k];
            let Some(outcome) = descents[i].step(value, gradient) else {
                moving[left] = i;
                positions[left] = descents[i].point;
                left += 1;
                continue;
            };
            results[i] = outcome.map(|(foot, normal)| {
                points[i] = foot;
                normal
            });
        }
        count = left;
    }
}

/// One point on its way to the surface.
#[derive(Clone, Copy, Debug)]
struct Descent {
    point: DVec3,
    steps_left: usize,
    /// The distance that is good enough.
    goal: f64,
    /// Below this distance only round-off can keep a step from helping.
    quadratic: f64,
    /// Distance, foot and normal before the last step.
    before: Option<(f64, DVec3, DVec3)>,
}

impl Descent {
    fn new(point: DVec3, length: f64, settings: &ProjectionSettings) -> Self {
        Self {
            point,
            steps_left: settings.max_iterations,
            goal: settings.tolerance * length,
            quadratic: f64::EPSILON.sqrt() * length,
            before: None,
        }
    }

    /// Moves on with value and gradient at `self.point`, or says how it ended.
    fn step(
        &mut self,
        value: f64,
        gradient: DVec3,
    ) -> Option<Result<(DVec3, DVec3), ProjectionError>> {
        let point = self.point;
        let slope = gradient.length();
        if !(slope > 0.0 && slope.is_finite() && value.is_finite()) {
            return Some(Err(ProjectionError::Singular { point }));
        }
        let normal = gradient / slope;
        let signed_distance = value / slope;
        let distance = signed_distance.abs();
        if distance <= self.goal {
            return Some(Ok((point, normal)));
        }
        if let Some((distance_before, foot, normal_before)) = self.before
            && distance_before <= self.quadratic
            && distance >= distance_before
        {
            return Some(Ok((foot, normal_before)));
        }
        if self.steps_left == 0 {
            return Some(Err(ProjectionError::NotConverged { point, distance }));
        }
        self.steps_left -= 1;
        self.before = Some((distance, point, normal));
        self.point = point - normal * signed_distance;
        None
    }
}
