//! An event as observed by a viewer: walls, sizes and motion, without labels.

use crate::{
    Missing, Noise, Tracking,
    trajectory::{Trajectory, row_of},
};
use phase_model::{
    AGENT_COUNT, AgentBody, AgentId, Body, Entity, Layout, MAX_ENTITIES, MAX_OBJECTS, PhysicsConfig, Scene,
    Size, State, Vec2, arena, physics::MAX_ANGLE,
};
use thiserror::Error;

/// Why something is not a valid observed event.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum ObservedError {
    /// There are no rows.
    #[error("an observed event needs at least one row")]
    Empty,
    /// More objects than a scene can have.
    #[error("an observed event has at most {MAX_OBJECTS} objects")]
    TooManyObjects,
    /// A position, velocity or angle is not finite.
    #[error("row {0} of an observed event has a number that is not finite")]
    NotFinite(usize),
    /// A body is faster or turned farther than any can be.
    #[error(
        "row {0} of an observed event has a body faster than {MAX_ROW_SPEED:.0} u/s or an angle beyond \
         {MAX_ANGLE} rad"
    )]
    Beyond(usize),
}

/// Greatest speed in a row (u/s of physics): that of a body that crosses the arena in one step.
pub(crate) const MAX_ROW_SPEED: f32 = arena::DIAGONAL / arena::STEP_SECONDS as f32;

/// Whether speed and angle of a row are such as a body can have.
pub(crate) fn is_possible(velocity: Vec2, angle: f32) -> bool {
    velocity.length() <= MAX_ROW_SPEED && angle.abs() <= MAX_ANGLE
}

fn check(index: usize, row: &[Body]) -> Result<(), ObservedError> {
    if !row.iter().all(Body::is_finite) {
        Err(ObservedError::NotFinite(index))
    } else if !row.iter().all(|body| is_possible(body.velocity, body.angle)) {
        Err(ObservedError::Beyond(index))
    } else {
        Ok(())
    }
}

/// The observable part of an event up to some moment: the layout with its landmarks, the sizes of all bodies,
/// and their motion.
///
/// Goals, attitudes, strengths, the kind of event and its remaining length are not
/// included, so inference from it cannot access them.
#[derive(Clone, PartialEq, Debug)]
pub struct ObservedEvent {
    layout: Layout,
    agent_sizes: [Size; AGENT_COUNT],
    object_sizes: Vec<Size>,
    rows: Vec<[Body; MAX_ENTITIES]>,
    noise: Option<Noise>,
    missing: Missing,
}

impl ObservedEvent {
    /// An event of which rows 0 to t have been observed. Row 0 is the initial state, row t ≥ 1 the mean over
    /// the substeps of step t, bodies by [`Entity::index`]. Bodies past the last object are meaningless.
    ///
    /// # Errors
    /// [`ObservedError`] for no rows, too many objects, or numbers that no row may have.
    pub fn new(
        layout: Layout,
        agent_sizes: [Size; AGENT_COUNT],
        object_sizes: Vec<Size>,
        rows: Vec<[Body; MAX_ENTITIES]>,
    ) -> Result<Self, ObservedError> {
        if rows.is_empty() {
            return Err(ObservedError::Empty);
        }
        if object_sizes.len() > MAX_OBJECTS {
            return Err(ObservedError::TooManyObjects);
        }
        let bodies = AGENT_COUNT + object_sizes.len();
        rows.iter().enumerate().try_for_each(|(index, row)| check(index, &row[..bodies]))?;
        Ok(Self { layout, agent_sizes, object_sizes, rows, noise: None, missing: Missing::default() })
    }

    /// An event of which these rows have been observed in a scene, whose layout and sizes are all that is
    /// read of it. See [`ObservedEvent::new`] for rows.
    ///
    /// # Errors
    /// [`ObservedError`] for no rows, too many objects, or numbers that no row may have.
    pub fn in_scene(scene: &Scene, rows: Vec<[Body; MAX_ENTITIES]>) -> Result<Self, ObservedError> {
        let objects = scene.objects.iter().map(|object| object.size).collect();
        Self::new(scene.layout, scene.agents.map(|agent| agent.size), objects, rows)
    }

    /// The event with the errors of its rows, if they were measured; without, rows are exact to their last
    /// digit, and so are angles of objects.
    #[must_use]
    pub fn with_noise(self, noise: Option<Noise>) -> Self {
        Self { noise, ..self }
    }

    /// The event as it was measured: with the errors of its rows, and what was not to be seen.
    #[must_use]
    pub fn with_tracking(self, tracking: &Tracking) -> Self {
        self.with_noise(Some(tracking.noise)).with_missing(tracking.missing)
    }

    /// The event with what was not to be seen.
    #[must_use]
    pub fn with_missing(self, missing: Missing) -> Self {
        Self { missing, ..self }
    }

    /// The parts that were not to be seen; none for events that were not read from a video.
    #[must_use]
    pub const fn missing(&self) -> Missing {
        self.missing
    }

    /// The errors of rows, if they were measured.
    #[must_use]
    pub const fn noise(&self) -> Option<Noise> {
        self.noise
    }

    /// Adds the next row, as in [`ObservedEvent::new`].
    ///
    /// # Errors
    /// [`ObservedError`] for numbers that no row may have; the event is then what it was.
    pub fn push(&mut self, row: [Body; MAX_ENTITIES]) -> Result<(), ObservedError> {
        check(self.rows.len(), &row[..AGENT_COUNT + self.object_sizes.len()])?;
        self.rows.push(row);
        Ok(())
    }

    /// The first steps of the event; the whole event if it has no more.
    #[must_use]
    pub fn prefix(&self, steps: usize) -> Self {
        let rows = self.rows.iter().take(steps.saturating_add(1)).copied().collect();
        Self { rows, object_sizes: self.object_sizes.clone(), ..*self }
    }

    /// The wall layout.
    #[must_use]
    pub const fn layout(&self) -> Layout {
        self.layout
    }

    /// Sizes of the two agents.
    #[must_use]
    pub const fn agent_sizes(&self) -> [Size; AGENT_COUNT] {
        self.agent_sizes
    }

    /// Sizes of the objects.
    #[must_use]
    pub fn object_sizes(&self) -> &[Size] {
        &self.object_sizes
    }

    /// The bodies at row 0 and after each step, by [`Entity::index`]; never empty. Angular velocities are 0
    /// where they were not measured.
    #[must_use]
    pub fn rows(&self) -> &[[Body; MAX_ENTITIES]] {
        &self.rows
    }

    /// Steps after row 0.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.rows.len() - 1
    }

    /// The entities present, agents first.
    pub fn entities(&self) -> impl Iterator<Item = Entity> + use<> {
        Entity::ALL.into_iter().take(AGENT_COUNT + self.object_sizes.len())
    }

    /// The physics of the event if its agents had these maximum forces (N).
    #[must_use]
    pub fn physics(&self, max_forces: [f32; AGENT_COUNT]) -> PhysicsConfig {
        let mut object_radii = [0.0; MAX_OBJECTS];
        for (radius, size) in object_radii.iter_mut().zip(&self.object_sizes) {
            *radius = size.radius();
        }
        PhysicsConfig {
            walls: self.layout.walls(),
            agents: AgentId::ALL.map(|agent| AgentBody {
                radius: self.agent_sizes[agent].radius(),
                max_force: max_forces[agent],
            }),
            object_radii,
            object_count: self.object_sizes.len(),
        }
    }

    /// The state of every frame of a video of the event: the initial state, then five states a step. Bodies
    /// go straight from row to row.
    #[must_use]
    pub fn frames(&self) -> Vec<State> {
        let track = |entity: usize| self.rows.iter().map(|row| row_of(&row[entity])).collect();
        let objects = AGENT_COUNT..AGENT_COUNT + self.object_sizes.len();
        let trajectory =
            Trajectory { agents: core::array::from_fn(track), objects: objects.map(track).collect() };
        trajectory.interpolated().collect()
    }

    /// Row `t` as a state without grips and contacts, which trajectories do not contain; `None` past the last
    /// row.
    #[must_use]
    pub fn state(&self, t: usize) -> Option<State> {
        self.rows.get(t).copied().map(State::new)
    }
}
