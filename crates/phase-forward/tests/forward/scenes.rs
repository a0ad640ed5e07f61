//! Random scenes and actions, for tests of properties that every scene satisfies.

use phase_model::{
    Action, AgentBody, Body, Entity, Layout, PhysicsConfig, Size, State, Strength, Vec2, arena,
    geometry::Outline,
};
use proptest::prelude::*;

/// Clearance between bodies, and between bodies and walls, at the start (u).
const ROOM: f32 = 0.02;
/// Number of positions drawn for each body; with this many, one is nearly always free.
const DRAWS: usize = 24;

/// Layouts, sizes and strengths of all kinds.
pub(crate) fn physiques() -> impl Strategy<Value = PhysicsConfig> {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let size = || prop::sample::select(Size::ALL.to_vec());
    let strength = || prop::sample::select(Strength::ALL.to_vec());
    (prop::sample::select(layouts), [size(), size(), size(), size()], [strength(), strength()], 0..=2_usize)
        .prop_map(|(layout, sizes, strengths, object_count)| PhysicsConfig {
            walls: layout.walls(),
            agents: [0, 1]
                .map(|k| AgentBody { radius: sizes[k].radius(), max_force: strengths[k].max_force() }),
            object_radii: [sizes[2].radius(), sizes[3].radius()],
            object_count,
        })
}

/// A scene whose bodies start at rest without overlaps; about half of them beside another.
pub(crate) fn separated_bodies() -> impl Strategy<Value = (PhysicsConfig, State)> {
    let place = (0.0..1.0_f32, 0.0..1.0_f32, -7.0..7.0_f32, any::<bool>());
    (physiques(), prop::collection::vec(place, 4 * DRAWS))
        .prop_filter_map("no room for all", |(physics, places)| {
            Some((place_all(&physics, &places)?, physics))
        })
        .prop_map(|(state, physics)| (physics, state))
}

/// Sequences of actions of both agents, each held for one to five steps. Grabbing is drawn more often than
/// other actions, since it mostly reaches nothing.
pub(crate) fn actions(runs: usize) -> impl Strategy<Value = Vec<[Action; 2]>> {
    let action = || prop_oneof![5 => prop::sample::select(Action::ALL.to_vec()), 1 => Just(Action::Attach)];
    prop::collection::vec(([action(), action()], 1..6_usize), runs)
        .prop_map(|runs| runs.into_iter().flat_map(|(actions, times)| vec![actions; times]).collect())
}

/// The outline of a body enlarged by about `margin` on all sides (u), or shrunk if that is negative.
pub(crate) fn outline(physics: &PhysicsConfig, state: &State, entity: Entity, margin: f32) -> Outline {
    let mut other = physics.clone();
    // An agent's flanks move outwards by more than its radius grows, its corners by more than that.
    other.agents.iter_mut().for_each(|agent| agent.radius += margin);
    other.object_radii.iter_mut().for_each(|radius| *radius += margin);
    Outline::of(&other, entity, state.body(entity))
}

/// Whether a body, enlarged by `margin`, is inside the arena and overlaps no wall.
pub(crate) fn clear_of_walls(physics: &PhysicsConfig, state: &State, entity: Entity, margin: f32) -> bool {
    let outline = outline(physics, state, entity, margin);
    outline.inside_arena() && !physics.walls.iter().any(|&wall| outline.overlaps_wall(wall))
}

fn place_all(physics: &PhysicsConfig, places: &[(f32, f32, f32, bool)]) -> Option<State> {
    let mut state = State::new([Body::default(); 4]);
    for (entity, draws) in physics.entities().zip(places.chunks(DRAWS)) {
        let earlier = || physics.entities().take(entity.index());
        let free = draws.iter().find_map(|&(x, y, angle, beside)| {
            let position = match earlier().last() {
                Some(other) if beside => state.position(other) + 6.0 * (Vec2::new(x, y) - 0.5),
                _ => arena::MIN + arena::SIDE * Vec2::new(x, y),
            };
            let mut tried = state;
            *tried.body_mut(entity) = Body::at_rest(position, angle);
            let shape = outline(physics, &tried, entity, ROOM);
            let free = clear_of_walls(physics, &tried, entity, ROOM)
                && !earlier().any(|other| shape.overlaps(&outline(physics, &tried, other, ROOM)));
            free.then_some(tried)
        });
        state = free?;
    }
    Some(state)
}
