//! Helping and collaborating.

use crate::draft::{
    self, LARGE_SIZES, SELF_SUFFICIENT, SceneDraft, agent, any_room, any_size, choose, helping, object,
};
use phase_model::{Goal, Layout, Size, Strength, Vec2, arena, layout::SLOT_DIRECTIONS};
use rand::Rng;

/// Distance of a blocking object's centre from a door's line, beyond its radius (u).
const BLOCKING_GAP: f32 = 0.3;
/// Distance it keeps from the boundary (u).
const CLEARANCE: f32 = 0.05;

/// The helpee is too weak for the object it wants moved.
pub(crate) fn lift(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let room = draft::other_room(&[goals[1].landmark()?.room()], random)?;
    // The helper starts in another room, so that the helpee's goal is visible before it arrives.
    let elsewhere = draft::other_room(&[room], random)?;
    let helper =
        helping(agent(any_size(random), choose(&SELF_SUFFICIENT, random), goals[0], elsewhere, random));
    let helpee = agent(any_size(random), Strength::Weak, goals[1], room, random);
    SceneDraft::about(goals, [helper, helpee], vec![object(any_size(random), room, random)])
}

/// The helpee is too big for the door behind which its object lies.
pub(crate) fn blocked(layout: Layout, goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let outside = goals[1].landmark()?.room();
    let (_, inside) = draft::narrow_door_of(layout, outside, random)?;
    let helper = helping(agent(any_size(random), choose(&SELF_SUFFICIENT, random), goals[0], inside, random));
    let helpee =
        agent(choose(&LARGE_SIZES, random), choose(&SELF_SUFFICIENT, random), goals[1], outside, random);
    SceneDraft::about(goals, [helper, helpee], vec![object(Size::Small, inside, random)])
}

/// A big object stands behind the door that the helpee has to go through.
pub(crate) fn clear(layout: Layout, goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let beyond = goals[1].landmark()?.room();
    let (slot, here) = draft::narrow_door_of(layout, beyond, random)?;
    let helper = helping(agent(any_size(random), Strength::Mighty, goals[0], beyond, random));
    let weak = choose(&[Strength::Weak, Strength::Fair], random);
    let helpee = agent(Size::Small, weak, goals[1], here, random);
    let mut blocker = object(Size::Huge, beyond, random);
    let middle = layout.opening(slot)?.middle();
    let across = SLOT_DIRECTIONS[slot].perp();
    let towards = across * across.dot(arena::LANDMARKS[beyond] - middle).signum();
    // The door is narrower than the object is wide, so the object stands off its centre, clear of the
    // boundary.
    let margin = Vec2::splat(Size::Huge.radius() + CLEARANCE);
    let position = middle + towards * (Size::Huge.radius() + BLOCKING_GAP);
    blocker.start.position = position.clamp(arena::MIN + margin, arena::MAX - margin);
    SceneDraft::about(goals, [helper, helpee], vec![blocker])
}

/// Both want the same object on the same landmark. Equal strengths, as the published scripts draw them; two
/// of the weakest cannot move anything together.
pub(crate) fn carry(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let room = draft::other_room(&[goals[1].landmark()?.room()], random)?;
    let strength = choose(&SELF_SUFFICIENT, random);
    let agents = goals.map(|goal| agent(any_size(random), strength, goal, any_room(random), random));
    SceneDraft::about(goals, agents, vec![object(any_size(random), room, random)])
}

/// The helpee is too big for the door behind which its object lies, and its landmark is in a third room: once
/// the object is outside, the helpee can take it on.
pub(crate) fn passed_on(layout: Layout, goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let target = goals[1].landmark()?.room();
    let outside = draft::other_room(&[target], random)?;
    let (_, inside) = draft::narrow_door_of(layout, outside, random)?;
    if inside == target {
        return None;
    }
    let helper = helping(agent(any_size(random), choose(&SELF_SUFFICIENT, random), goals[0], inside, random));
    let helpee =
        agent(choose(&LARGE_SIZES, random), choose(&SELF_SUFFICIENT, random), goals[1], outside, random);
    SceneDraft::about(goals, [helper, helpee], vec![object(Size::Small, inside, random)])
}

/// The helper stands in the narrow door that the helpee has to go through.
pub(crate) fn in_the_way(layout: Layout, goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let beyond = goals[1].landmark()?.room();
    let (slot, here) = draft::narrow_door_of(layout, beyond, random)?;
    let mut helper =
        helping(agent(any_size(random), choose(&SELF_SUFFICIENT, random), goals[0], beyond, random));
    let middle = layout.opening(slot)?.middle();
    let across = SLOT_DIRECTIONS[slot].perp();
    let towards = across * across.dot(arena::LANDMARKS[beyond] - middle).signum();
    helper.start.position = middle + towards * (helper.size.radius() + BLOCKING_GAP);
    let weak = choose(&[Strength::Weak, Strength::Fair], random);
    let helpee = agent(Size::Small, weak, goals[1], here, random);
    SceneDraft::about(goals, [helper, helpee], Vec::new())
}
