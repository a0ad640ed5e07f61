//! Knowledge that agents have of objects without seeing them, inferred from where they go.

use crate::{
    Hypothesis, InversePlanningSettings, PreparedEvent,
    beliefs::EstimatedBeliefs,
    choice::{self, Chance},
};
use core::ops::ControlFlow;
use phase_belief::{AscribedBelief, Glance};
use phase_event::{BeliefOrder, Beliefs, PLACES, Whereabouts, others, whereabouts};
use phase_model::{AGENT_COUNT, AgentId, Awareness, Entity, Sight, Vec2};
use phase_perception::observed_set;
use phase_pomcp::PomcpError;
use phase_statistics::log_softmax;
use serde::{Deserialize, Serialize};

/// Distance within which an agent that has not begun to act stays (u), and the angle (rad).
const STAY: f32 = 0.1;

/// Kinds of knowledge of objects that an agent may have.
const SIGHTS: [Sight; 3] = [Sight::Own, Sight::Start, Sight::Objects];

/// Settings of the inference from what an agent does to what it knows.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct KnowledgeSettings {
    /// Inverse temperature of the likelihood of a decision, at least 0; 1, the default, takes decisions to be
    /// independent. `cargo xtask fit-beliefs` compares others.
    pub inverse_temperature: f64,
}

impl Default for KnowledgeSettings {
    fn default() -> Self {
        Self { inverse_temperature: 1.0 }
    }
}

/// Places for each kind of knowledge of an agent; of beliefs about beliefs for each of its own, and within
/// that for each of the other's.
type Alternatives = Vec<Whereabouts>;

/// The beliefs that each agent of an event would have with each kind of knowledge, and how well each explains
/// what the agent does. [`beliefs`](Self::beliefs) averages over them.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct BeliefEvidence {
    order: BeliefOrder,
    /// Log likelihoods of the decisions of each agent, by its knowledge: of objects what it sees, also where
    /// they were at the start, or where they are.
    log_likelihoods: [[f64; SIGHTS.len()]; AGENT_COUNT],
    /// After each step asked about, for each agent and entity.
    places: Vec<[Vec<Alternatives>; AGENT_COUNT]>,
}

impl BeliefEvidence {
    /// The probability of each kind of knowledge of an agent: of objects what it sees, also where they were
    /// at the start, or where they are. The prior is even.
    #[must_use]
    pub fn knowledge(&self, agent: AgentId, settings: &KnowledgeSettings) -> [f64; SIGHTS.len()] {
        let mut logs = self.log_likelihoods[agent].map(|log| settings.inverse_temperature * log);
        log_softmax(&mut logs);
        logs.map(libm::exp)
    }

    /// The beliefs after each of the steps.
    #[must_use]
    pub fn beliefs(&self, settings: &KnowledgeSettings) -> Vec<Beliefs> {
        let knows = AgentId::ALL.map(|agent| self.knowledge(agent, settings));
        let weights = AgentId::ALL.map(|agent| match self.order {
            BeliefOrder::First => knows[agent].to_vec(),
            BeliefOrder::Second => {
                let of_other = |own: f64| knows[agent.other()].map(|other| own * other);
                knows[agent].into_iter().flat_map(of_other).collect()
            }
        });
        let mean = |agent: AgentId, places: &Alternatives| -> Whereabouts {
            let of =
                |place: usize| weights[agent].iter().zip(places).map(|(weight, it)| weight * it[place]).sum();
            core::array::from_fn::<f64, PLACES, _>(of)
        };
        let after = |of: &[Vec<Alternatives>; AGENT_COUNT]| {
            AgentId::ALL.map(|agent| of[agent].iter().map(|places| mean(agent, places)).collect())
        };
        self.places.iter().map(after).collect()
    }
}

/// The evidence about the beliefs of an order after some steps, if a hypothesis about goals is true. `None`
/// if `tick` did not let it.
pub(crate) fn evidence(
    prepared: &PreparedEvent,
    hypothesis: &Hypothesis,
    (order, steps): (BeliefOrder, &[usize]),
    settings: &InversePlanningSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<BeliefEvidence>, PomcpError> {
    let mut log_likelihoods = [[0.0; SIGHTS.len()]; AGENT_COUNT];
    let mut places: Vec<[Vec<Alternatives>; AGENT_COUNT]> =
        steps.iter().map(|_| [const { Vec::new() }; AGENT_COUNT]).collect();
    for agent in AgentId::ALL {
        let telling = telling_steps(prepared, agent);
        let mut all = Vec::with_capacity(SIGHTS.len());
        for (log, sees) in log_likelihoods[agent].iter_mut().zip(SIGHTS) {
            let beliefs = beliefs_with(prepared, hypothesis, agent, sees);
            let mut run = prepared.run(hypothesis)?;
            for &step in &telling {
                if tick().is_break() {
                    return Ok(None);
                }
                let (action, thought) = prepared.decide_believing(&mut run, agent, step, &beliefs)?;
                let likelihoods = choice::likelihoods_in(prepared.motion(), step, settings.tolerance);
                let chance = Chance::of(&choice::policy_of(action, &thought), &likelihoods[agent]);
                *log += chance.log(settings.lapse_rate);
            }
            all.push(beliefs);
        }
        let of_agent = places_of(prepared, agent, &all, (order, steps));
        places.iter_mut().zip(of_agent).for_each(|(places, it)| places[agent] = it);
    }
    Ok(Some(BeliefEvidence { order, log_likelihoods, places }))
}

/// The beliefs of an agent with some senses.
fn beliefs_with(
    prepared: &PreparedEvent,
    hypothesis: &Hypothesis,
    agent: AgentId,
    sees: Sight,
) -> EstimatedBeliefs {
    let mut scene = hypothesis.scene(prepared.observed());
    scene.agents[agent].awareness = Awareness { sees, ..Awareness::default() };
    let minds = &prepared.agents().minds;
    EstimatedBeliefs::in_scene(&scene, &prepared.motion().states, &[], agent, minds, prepared.seed())
}

/// The decisions that an agent makes once it acts while an object is out of its sight; in the others beliefs
/// do not differ.
fn telling_steps(prepared: &PreparedEvent, agent: AgentId) -> Vec<usize> {
    let observed = prepared.observed();
    let physics = observed.physics([0.0; AGENT_COUNT]);
    let hidden = |&step: &usize| {
        let seen = observed_set(&physics, &prepared.motion().states[step], agent);
        observed.entities().skip(AGENT_COUNT).any(|object| !seen.contains(object))
    };
    (begins(prepared, agent)..observed.steps()).filter(hidden).collect()
}

/// The places where an agent believes each other entity to be after some steps, by its knowledge; or where it
/// believes the other to believe them to be, by the knowledge of both.
fn places_of(
    prepared: &PreparedEvent,
    agent: AgentId,
    beliefs: &[EstimatedBeliefs],
    (order, steps): (BeliefOrder, &[usize]),
) -> Vec<Vec<Alternatives>> {
    let observed = prepared.observed();
    let physics = observed.physics([0.0; AGENT_COUNT]);
    let ascribed = match order {
        BeliefOrder::First => Vec::new(),
        BeliefOrder::Second => beliefs.iter().flat_map(|it| ascribed_by(prepared, agent, it)).collect(),
    };
    let after = |&step: &usize| {
        let seen = observed_set(&physics, &prepared.motion().states[step], agent);
        let own = |it: &EstimatedBeliefs, entity: Entity| {
            whereabouts(it.after(step).particles(), entity, seen.contains(entity))
        };
        let of = |entity: Entity| match order {
            BeliefOrder::First => beliefs.iter().map(|it| own(it, entity)).collect(),
            BeliefOrder::Second => ascribed.iter().map(|it| it[step].places(entity)).collect(),
        };
        others(order.viewer(agent), observed.object_sizes().len()).map(of).collect()
    };
    steps.iter().map(after).collect()
}

/// The beliefs that an agent with these beliefs ascribes to the other at the start and after every step, for
/// each kind of knowledge that it may have.
fn ascribed_by(
    prepared: &PreparedEvent,
    agent: AgentId,
    beliefs: &EstimatedBeliefs,
) -> [Vec<AscribedBelief>; SIGHTS.len()] {
    let observed = prepared.observed();
    let physics = observed.physics([0.0; AGENT_COUNT]);
    let glance = |step: usize| Glance::of(&physics, beliefs.after(step).particles(), agent.other());
    let glances: Vec<Glance> = (0..=observed.steps()).map(glance).collect();
    SIGHTS.map(|sees| AscribedBelief::along(&glances, sees))
}

/// The step in which an agent begins to act: the first after which it is elsewhere, or turned.
fn begins(prepared: &PreparedEvent, agent: AgentId) -> usize {
    let rows = prepared.observed().rows();
    let own = Entity::Agent(agent);
    let (place, angle): (Vec2, f32) = (rows[0][own].position, rows[0][own].angle);
    let acts = |row: &[phase_model::Body; phase_model::MAX_ENTITIES]| {
        row[own].position.distance(place) > STAY || (row[own].angle - angle).abs() > STAY
    };
    rows.iter().position(acts).map_or(prepared.observed().steps(), |row| row.saturating_sub(1))
}
