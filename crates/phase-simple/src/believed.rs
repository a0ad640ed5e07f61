//! Intents that each agent takes the other to have, from the observations that it can have made.

use crate::{
    Hypothesis, Inference, KnowledgeOfGoal, PreparedEvent, beliefs::EstimatedBeliefs, guide::intent_of,
    ignorance::PRIOR, uninformed::actions_of,
};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Awareness, Intent, Level};
use std::collections::BTreeMap;

/// For each agent the intents that it takes the other to have, with their probabilities.
pub(crate) type BelievedIntents = [BTreeMap<Intent, f64>; AGENT_COUNT];

/// The levels at which beliefs differ, as level 2 learns as level 1 does, and the prior probability of each.
const LEARNERS: [(Level, f64); 2] = [(Level::Zero, 1.0 / 3.0), (Level::One, 2.0 / 3.0)];

/// The intents that each agent takes the other to have after some steps. One that knows the other's goal
/// takes it to have its intent; another has the suppositions of its particles. Without latent knowledge all
/// agents know it. What a neutral agent knows hardly shows in what it does: it is as likely as not.
pub(crate) fn believed(
    prepared: &PreparedEvent,
    inference: &Inference,
    steps: &[usize],
) -> Vec<BelievedIntents> {
    let mut all: Vec<BelievedIntents> = steps.iter().map(|_| BelievedIntents::default()).collect();
    for agent in AgentId::ALL {
        let knowledge = inference.knowledge.as_ref().map(|knowledge| &knowledge[agent]);
        let mut known: BTreeMap<Intent, f64> = BTreeMap::new();
        for (hypothesis, weight) in &inference.posterior.hypotheses {
            let knows = match (knowledge, hypothesis.attitudes[agent]) {
                (None, _) => 1.0,
                (Some(_), Attitude::Neutral) => 1.0 - PRIOR,
                (Some(knowledge), _) => knowledge.knows,
            };
            *known.entry(intent_of(hypothesis, agent.other())).or_default() += weight * knows;
        }
        all.iter_mut().for_each(|believed| believed[agent] = known.clone());
        for (hypothesis, level, weight) in unknowing(inference, agent, knowledge) {
            let beliefs = beliefs_of(prepared, hypothesis, agent, level);
            for (&step, believed) in steps.iter().zip(&mut all) {
                let suppositions = beliefs.after(step).suppositions();
                let share = weight / suppositions.len().max(1) as f64;
                for supposition in suppositions {
                    *believed[agent].entry(supposition.intent).or_default() += share;
                }
            }
        }
    }
    all
}

/// The likeliest hypotheses in which an agent is neutral, and in which it is not, at each level at which it
/// may lack knowledge, with the probability of that.
fn unknowing<'a>(
    inference: &'a Inference,
    agent: AgentId,
    knowledge: Option<&KnowledgeOfGoal>,
) -> Vec<(&'a Hypothesis, Level, f64)> {
    let Some(knowledge) = knowledge else { return Vec::new() };
    let hypotheses = &inference.posterior.hypotheses;
    let mut all = Vec::new();
    for neutral in [true, false] {
        let is_such = |it: &&(Hypothesis, f64)| (it.0.attitudes[agent] == Attitude::Neutral) == neutral;
        let weight: f64 = hypotheses.iter().filter(is_such).map(|(_, weight)| weight).sum();
        let Some((likeliest, _)) = hypotheses.iter().find(is_such) else { continue };
        let [zero, one, two] = knowledge.levels;
        let shares = if neutral { LEARNERS.map(|(_, prior)| PRIOR * prior) } else { [zero, one + two] };
        let levels = LEARNERS.into_iter().zip(shares);
        all.extend(levels.map(|((level, _), share)| (likeliest, level, weight * share)));
    }
    all.retain(|(.., weight)| *weight > 0.0);
    all
}

/// The beliefs of an agent of a level that does not know the other's goal.
fn beliefs_of(
    prepared: &PreparedEvent,
    hypothesis: &Hypothesis,
    agent: AgentId,
    level: Level,
) -> EstimatedBeliefs {
    let mut scene = hypothesis.scene(prepared.observed());
    scene.agents[agent].awareness = Awareness::ignorant(level);
    let motion = prepared.motion();
    let actions = actions_of(motion, agent);
    let minds = &prepared.agents().minds;
    EstimatedBeliefs::in_scene(&scene, &motion.states, &actions, agent, minds, prepared.seed())
}
