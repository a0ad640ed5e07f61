//! The motion of a recorded event, stepped again from its actions.

use crate::{Environment, SimulationSettings};
use phase_event::Event;
use phase_model::{AgentId, State, arena::SUBSTEPS};

/// The states that an event's actions lead to from its first state, step by step, without asking any mind.
///
/// Engine and rules (`engine`, `one_way_turns`, `strongest_coasts`, `stop_between_steps`) are those of
/// `settings`; if the event was simulated with them by this version, the states are those of the event, bit
/// for bit. `phase verify` compares them.
pub fn replay<'a>(
    event: &'a Event,
    settings: &'a SimulationSettings,
) -> impl Iterator<Item = [State; SUBSTEPS]> + 'a {
    let physics = event.scene.physics();
    let mut world = Environment::new(settings.engine, &physics, &event.initial);
    let recorder = settings.recorder();
    event.steps.iter().map(move |step| {
        let layout = event.scene.layout;
        let mut states = world.step(
            AgentId::ALL
                .map(|agent| recorder.carried_out(step.actions[agent], &physics.agents[agent], layout)),
        );
        if settings.stop_between_steps {
            states[SUBSTEPS - 1] = world.stop_agents();
        }
        states
    })
}
