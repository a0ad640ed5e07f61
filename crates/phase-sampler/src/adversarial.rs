//! Hindering, chasing and competing.

use crate::draft::{
    self, SELF_SUFFICIENT, SceneDraft, agent, any_room, any_size, choose, hindering, object, object_of,
};
use phase_model::{Awareness, Goal, Sight, Size, Strength};
use rand::{Rng, RngExt};
use std::ops::RangeInclusive;

/// Steps for which an agent waits that is not to see how the other moves the object: about as long as that
/// takes.
pub(crate) const WAITS: RangeInclusive<u16> = 40..=48;

/// The victim wants itself or an object on a landmark.
pub(crate) fn hinder(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let target = goals[1].landmark()?.room();
    let hinderer = hindering(agent(
        any_size(random),
        choose(&SELF_SUFFICIENT, random),
        goals[0],
        any_room(random),
        random,
    ));
    let about_object = object_of(goals[1]).is_some();
    // Moving without an object takes no strength.
    let strengths = if about_object { &SELF_SUFFICIENT[..] } else { &Strength::ALL[..] };
    let room = draft::other_room(&[target], random)?;
    let victim = agent(any_size(random), choose(strengths, random), goals[1], room, random);
    let place = draft::other_room(&[target], random)?;
    let objects = if about_object { vec![object(any_size(random), place, random)] } else { Vec::new() };
    SceneDraft::about(goals, [hinderer, victim], objects)
}

/// The victim wants to touch the hinderer, or to get away from it.
pub(crate) fn hinder_touch(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let mut draft = chase(goals, random)?;
    draft.agents[0] = hindering(draft.agents[0]);
    Some(draft)
}

/// In different rooms, both strong enough to move.
pub(crate) fn chase(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let room = any_room(random);
    let rooms = [room, draft::other_room(&[room], random)?];
    let one = |k: usize, random: &mut dyn Rng| {
        agent(choose(&Size::ALL, random), choose(&SELF_SUFFICIENT, random), goals[k], rooms[k], random)
    };
    let agents = [one(0, random), one(1, random)];
    SceneDraft::about(goals, agents, Vec::new())
}

/// One object, in neither of the landmarks' rooms.
pub(crate) fn compete(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let room = draft::other_room(&[goals[0].landmark()?.room(), goals[1].landmark()?.room()], random)?;
    let agents = goals.map(|goal| {
        agent(any_size(random), choose(&SELF_SUFFICIENT, random), goal, any_room(random), random)
    });
    SceneDraft::about(goals, agents, vec![object(any_size(random), room, random)])
}

/// As [`compete`], but the first waits, and knows of the object where it was at the start.
pub(crate) fn seek(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let mut draft = compete(goals, random)?;
    let waits = random.random_range(WAITS);
    draft.agents[0].awareness = Awareness { sees: Sight::Start, waits, ..Awareness::default() };
    Some(draft)
}
