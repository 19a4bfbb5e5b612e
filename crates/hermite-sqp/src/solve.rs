//! The method: sequential quadratic programming on one edge [TK09, section 5.3].

use nalgebra::SVector;

use crate::outcome::{EdgeOutcome, EdgeStatus, FallbackReason};
use crate::problem::{EdgeProblem, Unknowns};
use crate::settings::Settings;
use crate::{kkt, start};

/// Fits the quartic of one edge.
///
/// Starts from the unconstrained least-squares fit with zero multipliers and takes full
/// Lagrange–Newton steps. A curve that does not converge, or whose end tangents are shorter or
/// longer than the settings allow, is replaced by the fallback: lengths clamped, then moved as
/// little as possible so that both curvature conditions still hold. The end points are exact in
/// either case.
#[must_use]
pub fn solve(problem: &EdgeProblem, settings: &Settings) -> EdgeOutcome {
    let unconstrained = start::unconstrained(problem);
    let solved = match unconstrained {
        Some(x) => iterate(problem, x, settings),
        None => Err(FallbackReason::NoStart),
    };
    match solved.and_then(|solution| solution.accept(settings)) {
        Ok(Solution { x, iterations, published_iterations }) => EdgeOutcome {
            curve: problem.curve(&x),
            status: EdgeStatus::Converged { iterations, published_iterations },
        },
        Err(reason) => EdgeOutcome {
            curve: start::fallback(problem, unconstrained, settings),
            status: EdgeStatus::Fallback(reason),
        },
    }
}

struct Solution {
    x: Unknowns,
    iterations: usize,
    published_iterations: usize,
}

impl Solution {
    fn accept(self, settings: &Settings) -> Result<Self, FallbackReason> {
        let lengths = [self.x[0], self.x[1]];
        if lengths.iter().all(|l| (settings.min_length..=settings.max_length).contains(l)) {
            Ok(self)
        } else {
            Err(FallbackReason::LengthOutOfRange { lengths })
        }
    }
}

fn iterate(
    problem: &EdgeProblem,
    mut x: Unknowns,
    settings: &Settings,
) -> Result<Solution, FallbackReason> {
    let mut multipliers = SVector::<f64, 2>::zeros();
    let mut published_iterations = None;
    for iteration in 1..=settings.max_iterations {
        let step = kkt::step(problem, &x, &multipliers).ok_or(FallbackReason::Singular)?;
        let change = step.unknowns.norm() + (step.multipliers - multipliers).norm();
        x += step.unknowns;
        multipliers = step.multipliers;
        if change < Settings::PUBLISHED_TOLERANCE {
            published_iterations.get_or_insert(iteration);
        }
        if change < settings.tolerance {
            let published_iterations = published_iterations.unwrap_or(iteration);
            return Ok(Solution { x, iterations: iteration, published_iterations });
        }
    }
    Err(FallbackReason::NotConverged)
}
