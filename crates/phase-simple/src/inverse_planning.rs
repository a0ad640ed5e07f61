//! Inverse planning: how well each thing that an agent may want explains what it did.
//!
//! Who decides at the same moment, each from the state of the world, does not depend on what the other is about to
//! do. So P(motion | Y) is a product of two factors, one an agent, and instead of 14 · 14 + 2 · 28 hypotheses it is enough
//! to simulate 42 wants of either agent by themselves, the other doing what it was found to do.

use crate::{
    Hypothesis, PlanningSettings, Posterior, Proposal,
    generative::{Decided, Stage},
    strength::AnyStrength,
    want::Want,
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, Action, Attitude, ObservedEvent};
use phase_pomcp::PomcpError;

/// How often the search tried an action stands for how likely it is to be taken. Which way an agent turns says
/// little about what it wants, and nothing in recordings of the published simulator, where all turns go one way:
/// turning left stands for both.
const CHOICES: usize = Action::ALL.len() - 1;

/// P(Y | motion) of every hypothesis, strengths being those that the physics tells; `None` if `tick`, which is
/// called once a want, broke it off.
///
/// # Errors
/// Settings of minds that cannot be searched with.
pub(crate) fn posterior(
    stage: &Stage<'_>,
    settings: &PlanningSettings,
    gamma: f64,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Posterior>, PomcpError> {
    let observed = stage.observed();
    let objects = observed.object_sizes().len();
    let strengths = stage.motion().strengths();
    let likely_actions = found(observed, stage, settings.tolerance);
    let guess = Proposal::new(observed, 0..=observed.steps(), gamma, &AnyStrength);
    let mut logs: [Vec<(Want, f64)>; AGENT_COUNT] = [Vec::new(), Vec::new()];
    for (agent, logs) in logs.iter_mut().enumerate() {
        let others = guess.likeliest_goal(1 - agent);
        for want in Want::all(agent, objects) {
            if tick().is_break() {
                return Ok(None);
            }
            let hypothesis = want.hypothesis(agent, others, strengths);
            let decided = stage.simulate_one(&hypothesis, agent, 1)?;
            let chosen: f64 = decided
                .iter()
                .zip(&likely_actions)
                .map(|(decided, found)| chance(decided, &found[agent], settings.slips))
                .sum();
            let strayed: f64 = stage
                .simulate_one(&hypothesis, agent, settings.anchor)?
                .iter()
                .map(|step| step.deviation)
                .sum();
            logs.push((want, settings.temper * chosen - settings.beta * strayed));
        }
    }
    let goals = guess.goals(0).len();
    let weigh = |hypothesis: Hypothesis, log: f64| (hypothesis, log + hypothesis.log_prior(goals));
    let neutral = |agent: usize| logs[agent].iter().filter(|(want, _)| want.attitude == Attitude::Neutral);
    let mut particles = Vec::new();
    for (first, first_log) in neutral(0) {
        for (second, second_log) in neutral(1) {
            let hypothesis = first.hypothesis(0, second.goal, strengths);
            particles.push(weigh(hypothesis, first_log + second_log));
        }
    }
    for social in 0..AGENT_COUNT {
        for (want, log) in logs[social].iter().filter(|(want, _)| want.attitude != Attitude::Neutral) {
            let other = neutral(1 - social).find(|(other, _)| other.goal == want.goal);
            let Some((_, other_log)) = other else { continue };
            particles.push(weigh(want.hypothesis(social, want.goal, strengths), log + other_log));
        }
    }
    Ok(Some(Posterior::new(particles)))
}

/// How likely each choice is to be what an agent did, for each step and agent: e^{−residual/σ}, adding up to 1.
fn found(observed: &ObservedEvent, stage: &Stage<'_>, tolerance: f64) -> Vec<[[f64; CHOICES]; AGENT_COUNT]> {
    let alternatives = stage.motion().alternatives(observed);
    let one = |residuals: &[f32; Action::ALL.len()]| {
        let mut least = [f64::INFINITY; CHOICES];
        for action in Action::ALL {
            let place = choice(action);
            least[place] = least[place].min(f64::from(residuals[action.index()]));
        }
        let best = least.iter().copied().fold(f64::INFINITY, f64::min);
        let weights = least.map(|residual| libm::exp((best - residual) / tolerance));
        let sum: f64 = weights.iter().sum();
        weights.map(|weight| weight / sum)
    };
    alternatives.iter().map(|agents| agents.each_ref().map(one)).collect()
}

/// ln of the chance that a mind's choice and what was done are the same.
fn chance(decided: &Decided, found: &[f64; CHOICES], slips: f64) -> f64 {
    let mut policy = [0.0; CHOICES];
    let visits: f64 = decided.thought.actions.iter().map(|value| f64::from(value.visits)).sum();
    if visits > 0.0 {
        for value in &decided.thought.actions {
            policy[choice(value.action)] += f64::from(value.visits) / visits;
        }
    } else {
        policy[choice(decided.action)] = 1.0;
    }
    let slip = slips / CHOICES as f64;
    let same = policy.iter().zip(found).map(|(policy, found)| ((1.0 - slips) * policy + slip) * found);
    libm::log(same.sum::<f64>().max(f64::MIN_POSITIVE))
}

/// Where an action stands among the choices.
const fn choice(action: Action) -> usize {
    match action {
        Action::TurnLeft | Action::TurnRight => 0,
        other => other.index() - 1,
    }
}
