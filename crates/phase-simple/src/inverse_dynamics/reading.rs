//! The states that the rows of an event stand for.
//!
//! Row 0 is the initial state. But in recordings of the published simulator that were mirrored afterwards, it
//! is the state after the first substep of the first step, and the motion obeys the physics of the arena as
//! it was before. That makes a difference: contacts are solved in an order, so the solver is not symmetric,
//! and bodies that push each other amplify what is different.

use core::f32::consts::TAU;
use phase_event::{ObservedError, ObservedEvent};
use phase_model::{
    AGENT_COUNT, Action, Body, Entity, Flip, Grip, Layout, MAX_ENTITIES, Side, State, arena::SUBSTEPS,
};

/// Speed below which a body is at rest in row 0 (u/s). Rows have five decimals.
const REST_SPEED: f32 = 1e-4;
/// Cost of a late start where nothing moves in row 0, in logarithms: most agents act at once, and a mirrored
/// event and its original can then hardly be told apart.
const RESTING_LATE_COST: f64 = 5.0;

/// The state that row 0 shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Start {
    /// The state at the beginning of the first step.
    OnTime,
    /// The state one idle substep before that, in which overlapping bodies are pushed apart.
    Settling,
    /// The state after the first substep of the first step.
    Late,
}

/// One way to read the rows.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    pub(super) start: Start,
    /// The event in the arena in which it happened.
    pub(super) event: ObservedEvent,
    /// The angle of each body is known modulo this (rad); `None` if it was not recorded.
    pub(super) angle_periods: [Option<f32>; MAX_ENTITIES],
    /// Cost of reading it so, in logarithms.
    pub(super) cost: f64,
    /// The reflection by which it became what was observed.
    flip: Option<Flip>,
}

impl Reading {
    /// All ways to read an event. In a mirrored layout, an event may have been mirrored with it.
    pub(super) fn all(observed: &ObservedEvent) -> Vec<Self> {
        let cost = if moves_at_once(observed) { 0.0 } else { RESTING_LATE_COST };
        let as_observed = |start, cost| Self {
            start,
            event: observed.clone(),
            angle_periods: core::array::from_fn(|body| {
                // Discs look the same however they are turned.
                (body < AGENT_COUNT || observed.noise().is_none()).then_some(TAU)
            }),
            cost,
            flip: None,
        };
        let original = observed.layout().flip().and_then(|flip| Self::before_mirroring(observed, flip, cost));
        let late = original.unwrap_or_else(|| as_observed(Start::Late, cost));
        vec![as_observed(Start::OnTime, 0.0), as_observed(Start::Settling, 0.0), late]
    }

    /// The event before it was mirrored; `None` if there is no such layout.
    ///
    /// The recorder computed the angles of agents anew if it exchanged the axes: wrapped in every substep,
    /// and then averaged, so that they are off by multiples of a fifth of a turn from the moment when they
    /// first wrapped. It did not record the angles of objects at all.
    fn before_mirroring(observed: &ObservedEvent, flip: Flip, cost: f64) -> Option<Self> {
        let layout = Layout::new(observed.layout().base(), None).ok()?;
        let mirrored = |row: &[Body; MAX_ENTITIES]| row.map(|body| body.mirrored(flip));
        let rows = observed.rows().iter().map(mirrored).collect();
        let agents = observed.agent_sizes();
        let objects = observed.object_sizes().to_vec();
        let event = ObservedEvent::new(layout, agents, objects, rows).ok()?.with_noise(observed.noise());
        let period = match flip {
            Flip::UpDown | Flip::LeftRight => TAU,
            Flip::Diagonal | Flip::AntiDiagonal => TAU / SUBSTEPS as f32,
        };
        let angle_periods = core::array::from_fn(|body| {
            let turned = || observed.rows().iter().any(|row| row[body].angle != 0.0);
            if body < AGENT_COUNT { Some(period) } else { turned().then_some(TAU) }
        });
        Some(Self { start: Start::Late, event, angle_periods, cost, flip: Some(flip) })
    }

    /// Adds the next row, as it was observed; whether what is known of the angles of earlier rows changes
    /// with it.
    pub(super) fn push(&mut self, row: &[Body; MAX_ENTITIES]) -> Result<bool, ObservedError> {
        let Some(flip) = self.flip else { return self.event.push(*row).map(|()| false) };
        self.event.push(row.map(|body| body.mirrored(flip)))?;
        let mut bodies = self.event.entities().map(Entity::index);
        Ok(bodies.any(|body| self.angle_periods[body].is_none() && row[body].angle != 0.0))
    }

    /// Whether this is the event before it was mirrored.
    pub(super) const fn is_mirrored(&self) -> bool {
        self.flip.is_some()
    }

    /// A state of this reading as it was observed.
    pub(super) fn observed_state(&self, state: &State) -> State {
        let Some(flip) = self.flip else { return *state };
        State {
            bodies: state.bodies.map(|body| body.mirrored(flip)),
            grips: state.grips.map(|grip| grip.map(mirrored_grip)),
            ..*state
        }
    }

    /// An action of this reading as it was observed, and the reverse.
    pub(super) const fn observed_action(&self, action: Action) -> Action {
        if self.flip.is_some() { action.mirrored() } else { action }
    }
}

/// Whether anything moves in row 0.
fn moves_at_once(observed: &ObservedEvent) -> bool {
    let bodies = &observed.rows()[0];
    observed.entities().any(|entity| bodies[entity.index()].velocity.length() > REST_SPEED)
}

fn mirrored_grip(grip: Grip) -> Grip {
    let side = match grip.side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
        Side::Head | Side::Tail => grip.side,
    };
    Grip { side, relative_angle: -grip.relative_angle, ..grip }
}
