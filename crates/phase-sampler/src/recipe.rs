//! Rejection sampling of scenes that can show their label.

use crate::{
    Variant, adversarial,
    draft::{Objects, SceneDraft, Starts, choose},
    friendly, neutral,
    requirements::is_playable,
};
use phase_model::{AgentSpec, Entity, EventKind, Goal, Layout, Scene};
use rand::{Rng, RngExt};
use thiserror::Error;

/// Maximum number of draws before a variant fails; in practice some dozens suffice.
pub(crate) const MAX_DRAWS: usize = 20_000;

/// A request of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The variant.
    pub variant: Variant,
    /// Index of the pair of goals; see [`Variant::goals`].
    pub goal_index: usize,
    /// The layouts to draw from.
    pub layouts: &'a [Layout],
    /// Places of bodies.
    pub starts: Starts,
}

/// No scene of the variant was found.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[error(
    "no {} scene ({}) was found in at least {MAX_DRAWS} draws; its layouts may not allow any",
    .0.kind().name(),
    .0.name()
)]
pub struct SampleError(pub Variant);

/// Draws a scene. No body overlaps another or a wall, no goal holds at the start, and the agents can do what
/// the variant requires of them. The assignment of roles to agents is random too, so that an agent's number
/// reveals nothing.
///
/// # Errors
/// [`SampleError`] if the draws are exhausted, for example because no layout fits the variant.
pub fn sample(request: &Request<'_>, random: &mut dyn Rng) -> Result<Scene, SampleError> {
    for _ in 0..MAX_DRAWS {
        if request.layouts.is_empty() {
            break;
        }
        let proposed = propose(request, Objects::Varied, random);
        if let Some(scene) = proposed.filter(|scene| is_playable(request.variant, scene, false)) {
            return Ok(if random.random_bool(0.5) { exchanged(&scene) } else { scene });
        }
    }
    Err(SampleError(request.variant))
}

/// One draw of a scene with role 0 as agent 0, which may be unable to show its variant; `None` if there is no
/// place for its bodies.
pub(crate) fn propose(request: &Request<'_>, count: Objects, random: &mut dyn Rng) -> Option<Scene> {
    let Request { variant, goal_index, layouts, starts } = *request;
    let layout = choose(layouts, random);
    let draft = draft(variant, layout, variant.goals(goal_index), random)?;
    Some(draft.into_scene(variant.kind(), layout, (count, starts), random))
}

/// Draws a scene of a variant in any of the 90 layouts, with any of its goals.
///
/// # Errors
/// As [`sample`].
pub fn sample_variant(variant: Variant, random: &mut dyn Rng) -> Result<Scene, SampleError> {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let goal_index = random.random_range(0..variant.goal_count());
    sample(&Request { variant, goal_index, layouts: &layouts, starts: Starts::Near }, random)
}

/// Draws a scene of a kind in any of the 90 layouts; one of the first edition's variants and goals are drawn
/// as well.
///
/// # Errors
/// As [`sample`].
pub fn sample_kind(kind: EventKind, random: &mut dyn Rng) -> Result<Scene, SampleError> {
    let mut variants = Variant::of(kind);
    variants.retain(|variant| variant.is_first_edition());
    sample_variant(choose(&variants, random), random)
}

fn draft(variant: Variant, layout: Layout, goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    match variant {
        Variant::Lift | Variant::Assist => friendly::lift(goals, random),
        Variant::Fetch if random.random_bool(0.5) => friendly::lift(goals, random),
        Variant::Blocked | Variant::Fetch => friendly::blocked(layout, goals, random),
        Variant::HandOver => friendly::passed_on(layout, goals, random),
        Variant::MakeWay => friendly::in_the_way(layout, goals, random),
        Variant::Move => friendly::clear(layout, goals, random),
        Variant::Carry => friendly::carry(goals, random),
        Variant::HinderPlace
        | Variant::HinderObject
        | Variant::Block
        | Variant::Take
        | Variant::Drag
        | Variant::Hide
        | Variant::Undo => adversarial::hinder(goals, random),
        Variant::Evade | Variant::Pester => adversarial::hinder_touch(goals, random),
        Variant::Chase => adversarial::chase(goals, random),
        Variant::Compete => adversarial::compete(goals, random),
        Variant::Seek => adversarial::seek(goals, random),
        Variant::Places | Variant::Mixed | Variant::Objects | Variant::Cross => {
            neutral::independent(goals, random)
        }
    }
}

/// A scene with the agents' numbers exchanged.
pub(crate) fn exchanged(scene: &Scene) -> Scene {
    let [first, second] = scene.agents;
    let renamed = |agent: AgentSpec| AgentSpec { goal: renumbered(agent.goal), ..agent };
    Scene { agents: [renamed(second), renamed(first)], ..scene.clone() }
}

fn renumbered(goal: Goal) -> Goal {
    match (goal, goal.subject()) {
        (Goal::AgentOnLandmark { landmark, sign, .. }, Entity::Agent(agent)) => {
            Goal::AgentOnLandmark { agent: agent.other(), landmark, sign }
        }
        (Goal::Touch { agent, other, sign }, _) => Goal::Touch { agent: other, other: agent, sign },
        _ => goal,
    }
}
