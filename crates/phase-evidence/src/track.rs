//! One state for each step: what all judgements are made on.

use phase_model::{Body, Contacts, Entity, Physique, State, arena::SUBSTEPS};
use phase_sim::{Event, Step};

/// Where everybody was at every step of one event.
#[derive(Clone, PartialEq, Debug)]
pub struct Track {
    /// Walls, radii and forces.
    pub physique: Physique,
    /// State 0 is where the event starts; state t ≥ 1 stands for step t. Recordings know no grips and contacts.
    pub states: Vec<State>,
}

impl Track {
    /// The track of a simulated event: the initial state, then one [`mean_state`] a step, just as the rows of
    /// trajectories in files.
    #[must_use]
    pub fn of_event(event: &Event) -> Self {
        let steps = event.steps.iter().map(mean_state);
        Self {
            physique: event.scene.physique(),
            states: core::iter::once(event.initial).chain(steps).collect(),
        }
    }

    /// Steps after the initial state.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.states.len().saturating_sub(1)
    }

    /// The track as it was up to a step, that included.
    #[must_use]
    pub fn until(&self, step: usize) -> Self {
        let states = self.states.iter().take(step.saturating_add(1)).copied().collect();
        Self { physique: self.physique.clone(), states }
    }

    /// Distance an entity travelled in the steps of a range, from state to state (u). What lies past the end
    /// counts nothing.
    #[must_use]
    pub fn distance_travelled(&self, entity: Entity, steps: core::ops::Range<usize>) -> f32 {
        steps.map(|step| self.distance_in_step(entity, step)).sum()
    }

    /// Distance an entity travelled in step t ≥ 1 (u); 0 for step 0 and past the end.
    #[must_use]
    pub fn distance_in_step(&self, entity: Entity, step: usize) -> f32 {
        let before = step.checked_sub(1).and_then(|before| self.states.get(before));
        match (before, self.states.get(step)) {
            (Some(before), Some(after)) => before.position(entity).distance(after.position(entity)),
            _ => 0.0,
        }
    }
}

/// What stands for a whole step: bodies are means over its five substeps (angles are unbounded, so theirs is
/// plain), grips are those at its end, and contacts are all there were in it.
#[must_use]
pub fn mean_state(step: &Step) -> State {
    let mut state = step.substeps[SUBSTEPS - 1];
    for entity in Entity::ALL {
        state.bodies[entity] = mean(step.substeps.map(|substep| substep.bodies[entity]));
    }
    state.contacts = step.substeps.iter().fold(Contacts::NONE, |all, substep| all.union(substep.contacts));
    state
}

fn mean(bodies: [Body; SUBSTEPS]) -> Body {
    let over = |number: fn(&Body) -> f32| {
        let sum: f64 = bodies.iter().map(|body| f64::from(number(body))).sum();
        (sum / SUBSTEPS as f64) as f32
    };
    let mut mean = Body::default();
    mean.position.x = over(|body| body.position.x);
    mean.position.y = over(|body| body.position.y);
    mean.velocity.x = over(|body| body.velocity.x);
    mean.velocity.y = over(|body| body.velocity.y);
    mean.angle = over(|body| body.angle);
    mean.angular_velocity = over(|body| body.angular_velocity);
    mean
}
