//! Whether what one agent does can affect the other within a step.

use super::replay::Replay;
use phase_model::{Entity, MAX_ENTITIES, State, arena::STEP_SECONDS};

/// Distance that two bodies may cover in a step in addition to what they cover at their present speeds (u).
const LEEWAY: f32 = 1.2;
/// Greatest distance of an agent's outline from its origin, in radii: that of its rear corners.
const OUTLINE: f32 = 1.81;

/// Whether the agents may act on each other in the coming step, directly or through objects.
pub(super) fn coupled(replay: &Replay, state: &State) -> bool {
    let entities = || replay.reading.event.entities();
    let mut linked = [true, false, false, false];
    for _ in 0..MAX_ENTITIES {
        for a in entities().filter(|a| linked[a.index()]).collect::<Vec<_>>() {
            for b in entities() {
                linked[b.index()] |= near(replay, state, a, b);
            }
        }
    }
    linked[1]
}

/// Whether two bodies may meet in the coming step.
fn near(replay: &Replay, state: &State, a: Entity, b: Entity) -> bool {
    let reach = |entity: Entity| {
        let outline = if matches!(entity, Entity::Agent(_)) { OUTLINE } else { 1.0 };
        outline * replay.radii[entity.index()] + STEP_SECONDS as f32 * state.body(entity).velocity.length()
    };
    state.touching(a, b) || state.position(a).distance(state.position(b)) < reach(a) + reach(b) + LEEWAY
}
