//! Rejection sampling of scenes that can show their label.

use crate::{
    Variant, adversarial,
    draft::{SceneDraft, choose},
    feasibility, friendly, neutral,
};
use phase_model::{AgentId, AgentSpec, Entity, EventKind, Goal, Layout, Scene, Sign};
use rand::{Rng, RngExt};
use thiserror::Error;

/// Maximum number of draws before a variant fails; in practice some dozens suffice.
const MAX_DRAWS: usize = 20_000;
/// Minimum ratio of a goal's cost without the helper to its cost with the helper.
const MIN_COST_RATIO: f32 = 1.5;

/// Which scene is requested.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The variant.
    pub variant: Variant,
    /// Index of the pair of goals; see [`Variant::goals`].
    pub goal_index: usize,
    /// The layouts to draw from.
    pub layouts: &'a [Layout],
}

/// No scene of the variant was found.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[error("no {} scene ({}) was found in {MAX_DRAWS} draws; its layouts may not allow any", .0.kind().name(), .0.name())]
pub struct SampleError(pub Variant);

/// Draws a scene. No body overlaps another or a wall, no goal holds at the start, and the agents can do what
/// the variant requires of them. The assignment of roles to agents is random too, so that an agent's number
/// reveals nothing.
///
/// # Errors
/// [`SampleError`] if the draws are exhausted, for example because no layout fits the variant.
pub fn sample(request: &Request<'_>, random: &mut impl Rng) -> Result<Scene, SampleError> {
    let goals = request.variant.goals(request.goal_index);
    for _ in 0..MAX_DRAWS {
        if request.layouts.is_empty() {
            break;
        }
        let layout = choose(request.layouts, random);
        let Some(draft) = draft(request.variant, layout, goals, random) else { continue };
        let scene = draft.into_scene(request.variant.kind(), layout, random);
        if scene.validate_without_overlap().is_ok() && is_unsolved(&scene) && is_feasible(&scene) {
            return Ok(if random.random_bool(0.5) { exchanged(&scene) } else { scene });
        }
    }
    Err(SampleError(request.variant))
}

/// Draws a scene of a kind in any of the 90 layouts; variant and goals are drawn as well.
///
/// # Errors
/// As [`sample`].
pub fn sample_kind(kind: EventKind, random: &mut impl Rng) -> Result<Scene, SampleError> {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let variant = choose(&Variant::of(kind), random);
    let goal_index = random.random_range(0..variant.goal_count());
    sample(&Request { variant, goal_index, layouts: &layouts }, random)
}

fn draft(variant: Variant, layout: Layout, goals: [Goal; 2], random: &mut impl Rng) -> Option<SceneDraft> {
    match variant {
        Variant::Lift => friendly::lift(goals, random),
        Variant::Blocked => friendly::blocked(layout, goals, random),
        Variant::Move => friendly::clear(layout, goals, random),
        Variant::Carry => friendly::carry(goals, random),
        Variant::HinderPlace | Variant::HinderObject => adversarial::hinder(goals, random),
        Variant::Evade | Variant::Pester => adversarial::hinder_touch(goals, random),
        Variant::Chase => adversarial::chase(goals, random),
        Variant::Compete => adversarial::compete(goals, random),
        Variant::Places | Variant::Mixed | Variant::Objects => neutral::independent(goals, random),
    }
}

/// Whether no goal holds at the start.
fn is_unsolved(scene: &Scene) -> bool {
    scene.goals().iter().all(|&goal| {
        let positive = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
        !feasibility::is_achieved(scene, positive)
    })
}

/// Whether the agents can do what the kind requires of them; role 0 is agent 0.
fn is_feasible(scene: &Scene) -> bool {
    let [first, second] = scene.goals();
    match scene.kind {
        EventKind::Helping => {
            let alone = feasibility::cost(scene, second, [false, true]);
            let both = feasibility::cost(scene, second, [true, true]);
            both < feasibility::INFEASIBLE_COST && alone > both * MIN_COST_RATIO
        }
        EventKind::Hindering => feasibility::alone(scene, AgentId::ONE, second),
        EventKind::Chasing => feasibility::alone(scene, AgentId::ZERO, first),
        EventKind::Competing | EventKind::Independent => {
            feasibility::alone(scene, AgentId::ZERO, first) && feasibility::alone(scene, AgentId::ONE, second)
        }
        EventKind::Collaborating => feasibility::together(scene, first),
    }
}

/// The same scene with the agents' numbers exchanged.
fn exchanged(scene: &Scene) -> Scene {
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
