//! Knowledge that agents have of objects without seeing them, inferred from where they go.

use crate::{
    Hypothesis, InversePlanningSettings, PreparedEvent,
    beliefs::EstimatedBeliefs,
    choice::{self, Chance},
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, AgentId, Awareness, Entity, Sight, Vec2};
use phase_perception::observed_set;
use phase_pomcp::PomcpError;
use phase_statistics::log_softmax;

/// Distance within which an agent that has not begun to act stays (u), and the angle (rad).
const STAY: f32 = 0.1;

/// Kinds of knowledge of objects that an agent may have.
pub(crate) const SIGHTS: [Sight; 3] = [Sight::Own, Sight::Start, Sight::Objects];

/// An agent's beliefs under each of the [`SIGHTS`], with its probability.
pub(crate) type WeightedBeliefs = Vec<(EstimatedBeliefs, f64)>;

/// Weighs what an agent may know of objects by how well its mind then explains what it does, if a hypothesis
/// about goals is true. The prior is even. Looked at are the decisions that the agent makes once it acts
/// while an object is out of its sight; in the others beliefs do not differ. `None` if `tick` did not let it.
pub(crate) fn weigh(
    prepared: &PreparedEvent,
    hypothesis: &Hypothesis,
    agent: AgentId,
    settings: &InversePlanningSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<WeightedBeliefs>, PomcpError> {
    let observed = prepared.observed();
    let states = &prepared.motion().states;
    let physics = observed.physics([0.0; AGENT_COUNT]);
    let objects = || observed.entities().skip(AGENT_COUNT);
    let hidden = |step: usize| {
        let seen = observed_set(&physics, &states[step], agent);
        objects().any(|object| !seen.contains(object))
    };
    let steps: Vec<usize> =
        (begins(prepared, agent)..observed.steps()).filter(|&step| hidden(step)).collect();
    let mut all = Vec::with_capacity(SIGHTS.len());
    let mut logs = Vec::with_capacity(SIGHTS.len());
    for sees in SIGHTS {
        let mut scene = hypothesis.scene(observed);
        scene.agents[agent].awareness = Awareness { sees, ..Awareness::default() };
        let beliefs =
            EstimatedBeliefs::in_scene(&scene, states, agent, &prepared.agents().minds, prepared.seed());
        let mut run = prepared.run(hypothesis)?;
        let mut log = 0.0;
        for &step in &steps {
            if tick().is_break() {
                return Ok(None);
            }
            let (action, thought) = prepared.decide_believing(&mut run, agent, step, &beliefs)?;
            let likelihoods = choice::likelihoods_in(prepared.motion(), step, settings.tolerance);
            let chance = Chance::of(&choice::policy_of(action, &thought), &likelihoods[agent]);
            log += chance.log(settings.lapse_rate);
        }
        logs.push(settings.inverse_temperature * log);
        all.push(beliefs);
    }
    log_softmax(&mut logs);
    Ok(Some(all.into_iter().zip(logs.into_iter().map(libm::exp)).collect()))
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
