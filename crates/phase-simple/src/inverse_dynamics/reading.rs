//! What the rows of an event stand for.
//!
//! Row 0 is the initial state. But in recordings of the published simulator that were mirrored afterwards, it is the
//! state after the first substep of the first step, and the motion obeys the physics of the arena that was not
//! mirrored. The physics themselves are not symmetric: contacts are solved in an order, and errors grow.

use core::f32::consts::TAU;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Action, Body, Flip, Grip, Layout, MAX_ENTITIES, Side, State, arena::SUBSTEPS};

/// Speed below which a body is at rest in row 0 (u/s); rows have five decimals.
const REST_SPEED: f32 = 1e-4;

/// What row 0 is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Start {
    /// The state at the beginning of the first step.
    OnTime,
    /// The same, one idle substep before it, in which overlapping bodies are pushed apart.
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
    /// The reflection by which it became what was observed.
    flip: Option<Flip>,
    /// The angle of each body is known modulo this (rad); `None` if it was not recorded.
    pub(super) angle_periods: [Option<f32>; MAX_ENTITIES],
}

impl Reading {
    /// All ways to read an event. One that moves in row 0 begins late; one with a mirrored layout may have been
    /// mirrored with it.
    pub(super) fn all(observed: &ObservedEvent) -> Vec<Self> {
        let own = |start| Self { start, event: observed.clone(), flip: None, angle_periods: [Some(TAU); MAX_ENTITIES] };
        let bodies = &observed.rows()[0];
        let moving = observed.entities().any(|entity| bodies[entity.index()].velocity.length() > REST_SPEED);
        let mut all = vec![own(Start::OnTime), own(Start::Settling)];
        match observed.layout().flip() {
            Some(flip) => all.extend(unmirrored(observed, flip)),
            None if moving => all.push(own(Start::Late)),
            None => {}
        }
        all
    }

    /// A state of this reading as it was observed.
    pub(super) fn observed_state(&self, state: &State) -> State {
        let Some(flip) = self.flip else { return *state };
        let mut mirrored = *state;
        mirrored.bodies = state.bodies.map(|body| body.mirrored(flip));
        mirrored.grips = state.grips.map(|grip| grip.map(mirrored_grip));
        mirrored
    }

    /// An action of this reading as it was observed, and the reverse.
    pub(super) const fn observed_action(&self, action: Action) -> Action {
        if self.flip.is_some() { mirrored_action(action) } else { action }
    }
}

/// The event before it was mirrored; `None` if there is no such layout.
fn unmirrored(observed: &ObservedEvent, flip: Flip) -> Option<Reading> {
    let mirrored = |row: &[Body; MAX_ENTITIES]| row.map(|body| body.mirrored(flip));
    let layout = Layout::new(observed.layout().base(), None).ok()?;
    let rows = observed.rows().iter().map(mirrored).collect();
    let event =
        ObservedEvent::new(layout, observed.agent_sizes(), observed.object_sizes().to_vec(), rows).ok()?;
    let period = match flip {
        Flip::UpDown | Flip::LeftRight => TAU,
        Flip::Diagonal | Flip::AntiDiagonal => TAU / SUBSTEPS as f32,
    };
    let mut angle_periods = [Some(period); MAX_ENTITIES];
    for object in AGENT_COUNT..MAX_ENTITIES {
        let recorded = observed.rows().iter().any(|row| row[object].angle != 0.0);
        angle_periods[object] = recorded.then_some(TAU);
    }
    Some(Reading { start: Start::Late, event, flip: Some(flip), angle_periods })
}

fn mirrored_grip(grip: Grip) -> Grip {
    let side = match grip.side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
        side => side,
    };
    Grip { side, relative_angle: -grip.relative_angle, ..grip }
}

const fn mirrored_action(action: Action) -> Action {
    match action {
        Action::TurnLeft => Action::TurnRight,
        Action::TurnRight => Action::TurnLeft,
        Action::Left => Action::Right,
        Action::Right => Action::Left,
        Action::UpLeft => Action::UpRight,
        Action::UpRight => Action::UpLeft,
        Action::DownLeft => Action::DownRight,
        Action::DownRight => Action::DownLeft,
        action => action,
    }
}
