//! Inverse planning: the likelihood of each agent's motion under each of its possible intents.
//!
//! Both agents decide at the same time from the same state, so given the states their actions are conditionally
//! independent. P(motion | Y) is therefore a product of one factor per agent, and instead of 14 · 14 + 2 · 28
//! hypotheses it suffices to simulate 42 intents of each agent, with the other replaying its inferred actions.

use crate::{
    Hypothesis, PlanningSettings, Posterior, Proposal,
    generative::{Decided, Stage},
    strength::AnyStrength,
    want::Want,
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, Action, AgentId, Attitude, Goal, Strength};
use phase_pomcp::PomcpError;

/// Visit counts of the search serve as action probabilities. The direction of a turn carries little information,
/// and none in recordings of the published simulator, in which all turns are left turns; the two turns are
/// therefore one choice.
const CHOICES: usize = Action::ALL.len() - 1;

/// Intents of an agent with ln P(motion | intent) of its part of the motion.
type Weighed = Vec<(Want, f64)>;

/// Refinement passes: how often the intents are re-evaluated with an updated goal of the other agent.
const SECOND_THOUGHTS: usize = 2;

/// P(Y | motion) of every hypothesis, strengths being those that the physics tells; `None` if `tick`, which is
/// called once a want, broke it off.
///
/// # Errors Invalid parameters of the minds' search.
pub(crate) fn posterior(
    stage: &Stage<'_>,
    settings: &PlanningSettings,
    gamma: f64,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Posterior>, PomcpError> {
    let observed = stage.observed();
    let objects = observed.object_sizes().len();
    let evidence = Evidence {
        stage,
        settings,
        found: found(stage, settings.tolerance),
        strengths: stage.motion().strengths(),
    };
    let cue = Proposal::new(observed, 0..=observed.steps(), gamma, &AnyStrength);
    // The goal that each agent attributes to the other if it is not social.
    let mut seeming: [Goal; AGENT_COUNT] = AgentId::ALL.map(|agent| cue.likeliest_goal(agent));
    let mut weighed: [Weighed; AGENT_COUNT] = [Vec::new(), Vec::new()];
    for (agent, weighed) in AgentId::ALL.into_iter().zip(&mut weighed) {
        for want in Want::all(agent, objects) {
            if tick().is_break() {
                return Ok(None);
            }
            weighed.push((want, evidence.log_likelihood(agent, &want, seeming[agent.other()])?));
        }
    }
    let goals = cue.goals(AgentId::ZERO).len();
    let mut posterior = joint(&weighed, evidence.strengths, goals);
    for _ in 0..SECOND_THOUGHTS {
        let likeliest = posterior.hypotheses.first().map_or(seeming, |(hypothesis, _)| hypothesis.goals);
        for (agent, weighed) in AgentId::ALL.into_iter().zip(&mut weighed) {
            let other = agent.other();
            if likeliest[other] == seeming[other] {
                continue;
            }
            for (want, log) in weighed.iter_mut().filter(|(want, _)| want.attitude == Attitude::Neutral) {
                if tick().is_break() {
                    return Ok(None);
                }
                *log = evidence.log_likelihood(agent, want, likeliest[other])?;
            }
        }
        if likeliest == seeming {
            break;
        }
        seeming = likeliest;
        posterior = joint(&weighed, evidence.strengths, goals);
    }
    Ok(Some(posterior))
}

/// What wants are weighed by.
struct Evidence<'a> {
    stage: &'a Stage<'a>,
    settings: &'a PlanningSettings,
    found: Vec<[[f64; CHOICES]; AGENT_COUNT]>,
    strengths: [Strength; AGENT_COUNT],
}

impl Evidence<'_> {
    /// ln P(motion | want) of an agent's part of the motion, the other being after `others`.
    fn log_likelihood(&self, agent: AgentId, want: &Want, others: Goal) -> Result<f64, PomcpError> {
        let hypothesis = want.hypothesis(agent, others, self.strengths);
        let every_step = self.stage.simulate_one(&hypothesis, agent, 1)?;
        let chosen = every_step.iter().zip(&self.found);
        let chosen: f64 =
            chosen.map(|(decided, found)| log_chance(decided, &found[agent], self.settings.slips)).sum();
        let now_and_then = self.stage.simulate_one(&hypothesis, agent, self.settings.anchor)?;
        let strayed: f64 = now_and_then.iter().map(|step| step.deviation).sum();
        Ok(self.settings.temper * chosen - self.settings.beta * strayed)
    }
}

/// The joint posterior: prior times both agents' likelihoods.
fn joint(weighed: &[Weighed; AGENT_COUNT], strengths: [Strength; AGENT_COUNT], goals: usize) -> Posterior {
    let weigh = |hypothesis: Hypothesis, log: f64| (hypothesis, log + hypothesis.log_prior(goals));
    let neutral =
        |agent: AgentId| weighed[agent].iter().filter(|(want, _)| want.attitude == Attitude::Neutral);
    let mut hypotheses = Vec::new();
    for (first, first_log) in neutral(AgentId::ZERO) {
        for (second, second_log) in neutral(AgentId::ONE) {
            hypotheses
                .push(weigh(first.hypothesis(AgentId::ZERO, second.goal, strengths), first_log + second_log));
        }
    }
    for (social, wants) in AgentId::ALL.into_iter().zip(weighed) {
        for (want, log) in wants.iter().filter(|(want, _)| want.attitude != Attitude::Neutral) {
            let other = neutral(social.other()).find(|(other, _)| other.goal == want.goal);
            let Some((_, other_log)) = other else { continue };
            hypotheses.push(weigh(want.hypothesis(social, want.goal, strengths), log + other_log));
        }
    }
    Posterior::new(hypotheses)
}

/// Normalised likelihood of each choice for each step and agent, proportional to e^{−residual/σ}.
fn found(stage: &Stage<'_>, tolerance: f64) -> Vec<[[f64; CHOICES]; AGENT_COUNT]> {
    let alternatives = stage.motion().alternatives(stage.observed());
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

/// ln of the probability that the policy's action is the observed one, lapses included.
fn log_chance(decided: &Decided, found: &[f64; CHOICES], slips: f64) -> f64 {
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
