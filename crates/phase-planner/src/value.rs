//! Choosing one subgoal from the plans of all particles.

use crate::Plan;
use phase_model::Subgoal;

/// λ of the paper: weight of the cost against the share of particles.
pub const LAMBDA: f64 = 0.05;

/// A subgoal that is the first of the plans of some particles of a belief, with its value V.
#[derive(Clone, PartialEq, Debug)]
pub struct Candidate {
    /// The subgoal h.
    pub subgoal: Subgoal,
    /// V(B, h, gᵢ, gⱼ, αᵢⱼ).
    pub value: f64,
    /// Indices of the particles whose best subgoal it is.
    pub particles: Vec<usize>,
}

/// V for every subgoal that is the first of some particle's plan, the most valuable first:
///
/// V = (1/K) Σₖ 1(h = hₖ) − λ / (Σₖ 1(h = hₖ)) · Σₖ 1(h = hₖ) Ĉ(bₖ, s_g)
///
/// (section "Hierarchical Planner"), with Ĉ in world units and λ, [`LAMBDA`] in the paper, at least 0 (1/u).
/// Equal values keep the order of the subgoals. Without plans there are no candidates.
///
/// ```
/// use phase_planner::{Plan, value};
///
/// let plans = [Plan::STAY, Plan::STAY];
/// let candidates = value::candidates(&plans.each_ref(), value::LAMBDA);
/// assert_eq!(candidates[0].value, 1.0);
/// assert_eq!(candidates[0].particles, [0, 1]);
/// ```
#[must_use]
pub fn candidates(plans: &[&Plan], lambda: f64) -> Vec<Candidate> {
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut costs: Vec<f64> = Vec::new();
    for (k, plan) in plans.iter().enumerate() {
        let subgoal = plan.first();
        let position = candidates.iter().position(|candidate| candidate.subgoal == subgoal);
        let position = position.unwrap_or_else(|| {
            candidates.push(Candidate { subgoal, value: 0.0, particles: Vec::new() });
            costs.push(0.0);
            candidates.len() - 1
        });
        candidates[position].particles.push(k);
        costs[position] += f64::from(plan.distance);
    }
    for (candidate, cost) in candidates.iter_mut().zip(costs) {
        let count = candidate.particles.len() as f64;
        candidate.value = count / plans.len() as f64 - lambda * cost / count;
    }
    candidates.sort_by(|a, b| b.value.total_cmp(&a.value).then(a.subgoal.cmp(&b.subgoal)));
    candidates
}
