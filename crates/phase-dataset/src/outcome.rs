//! Whether and when an agent's goal was reached, judged on the rows of a trajectory.
//!
//! Rows are all that measured recordings have, so simulated events are judged on theirs too: the same rule
//! for both, blind to what happened between rows.

use crate::phase_events::Trajectory;
use phase_model::{Entity, Goal, Physique, Segment, Sign, State, Vec2, arena, geometry::Outline};
use phase_predicates::threshold::{ON_AGENT, ON_OBJECT};
use serde::{Deserialize, Serialize};

/// Two agents touch when their outlines are no farther apart than this (u). A row is a mean over five
/// substeps, in which bodies that bounce off each other are already apart again.
pub const TOUCH_GAP: f32 = 0.1;

/// What became of one agent's goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outcome {
    /// Whether it was reached. To be (or to keep someone off) somewhere counts at the end of the event, to
    /// touch someone at any time, and to get away from someone at the end again.
    pub reached: bool,
    /// Steps until a positive goal was reached: for good, or for the first time if it is to touch someone.
    pub steps: Option<usize>,
}

impl Outcome {
    /// Judges a goal on a trajectory of the scene with this physique.
    #[must_use]
    pub fn of(physique: &Physique, trajectory: &Trajectory, goal: Goal) -> Self {
        let states = (0..=trajectory.steps()).map_while(|t| trajectory.state(t));
        let holds: Vec<bool> = states.map(|state| condition(physique, &state, goal)).collect();
        let at_the_end = holds.last().copied().unwrap_or(false);
        match (goal, goal.sign()) {
            (_, Sign::Negative) => Self { reached: !at_the_end, steps: None },
            (Goal::Touch { .. }, Sign::Positive) => {
                let first = holds.iter().position(|&holds| holds);
                Self { reached: first.is_some(), steps: first }
            }
            (_, Sign::Positive) => {
                let since = holds.iter().rposition(|&holds| !holds).map_or(0, |last_not| last_not + 1);
                Self { reached: at_the_end, steps: at_the_end.then_some(since) }
            }
        }
    }
}

/// Whether what the goal speaks of is the case, whatever the goal's sign.
fn condition(physique: &Physique, state: &State, goal: Goal) -> bool {
    let near = |entity: Entity, landmark: u8, limit: f32| {
        let centre = arena::LANDMARKS.get(usize::from(landmark));
        centre.is_some_and(|&centre| state.position(entity).distance(centre) < limit)
    };
    match goal {
        Goal::AgentOnLandmark { agent, landmark, .. } => near(Entity::Agent(agent), landmark, ON_AGENT),
        Goal::ObjectOnLandmark { object, landmark, .. } => near(Entity::Object(object), landmark, ON_OBJECT),
        Goal::Touch { agent, other, .. } => {
            let outline = |agent: u8| {
                let entity = Entity::Agent(agent);
                Outline::of(physique, entity, state.body(entity))
            };
            gap(&outline(agent), &outline(other)) <= TOUCH_GAP
        }
    }
}

/// Distance between two trapezoids, 0 if they overlap (u). The nearest points of two convex polygons that
/// are apart include a corner of one of them.
fn gap(a: &Outline, b: &Outline) -> f32 {
    match (a, b) {
        _ if a.overlaps(b) => 0.0,
        (Outline::Trapezoid(a), Outline::Trapezoid(b)) => corner_gap(a, b).min(corner_gap(b, a)),
        _ => f32::INFINITY,
    }
}

fn corner_gap(corners: &[Vec2; 4], polygon: &[Vec2; 4]) -> f32 {
    let edges = || (0..4).map(|k| Segment { a: polygon[k], b: polygon[(k + 1) % 4] });
    let distances = corners.iter().flat_map(|&corner| edges().map(move |edge| edge.distance(corner)));
    distances.fold(f32::INFINITY, f32::min)
}
