//! One event of a `phase-events/1` file, in memory.

use phase_evidence::Track;
use phase_model::{AGENT_COUNT, Action, Body, ObservedError, ObservedEvent, Relation, Scene, State};
use phase_sim::Event;
use serde_json::Value;

/// Names of the columns of a [`Row`].
pub const COLUMNS: [&str; 5] = ["x", "y", "vx", "vy", "angle"];
/// Names of the columns of the substeps of simulated events.
pub const SUBSTEP_COLUMNS: [&str; 6] = ["x", "y", "vx", "vy", "angle", "angular_velocity"];

/// Position (u), velocity (u/s) and angle (rad) of one entity at one step, in the order of [`COLUMNS`].
pub type Row = [f32; COLUMNS.len()];

/// The same and the angular velocity (rad/s), in the order of [`SUBSTEP_COLUMNS`].
pub(crate) type SubstepRow = [f32; SUBSTEP_COLUMNS.len()];

/// Where every entity was: `agents[i][t]` and `objects[k][t]`, all of one length, which is at least 1.
/// Row 0 is the initial state; row t ≥ 1 is the mean over the five substeps of step t.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Trajectory {
    /// Rows of the two agents.
    pub agents: [Vec<Row>; AGENT_COUNT],
    /// Rows of the objects.
    pub objects: Vec<Vec<Row>>,
}

impl Trajectory {
    /// The rows of a simulated event: the initial state, then for each step the mean over its substeps.
    #[must_use]
    pub fn means(event: &Event) -> Self {
        let track = Track::of_event(event);
        let rows = |entity: usize| track.states.iter().map(|state| row_of(&state.bodies[entity])).collect();
        let objects = track.physique.object_count;
        Self {
            agents: core::array::from_fn(rows),
            objects: (AGENT_COUNT..AGENT_COUNT + objects).map(rows).collect(),
        }
    }

    /// Steps after the initial state.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.agents[0].len().saturating_sub(1)
    }

    /// Every row as a state, for judging what a trajectory shows.
    #[must_use]
    pub fn states(&self) -> Vec<State> {
        (0..=self.steps()).map_while(|t| self.state(t)).collect()
    }

    /// Rows of every entity, agents first.
    pub fn entities(&self) -> impl Iterator<Item = &Vec<Row>> {
        self.agents.iter().chain(&self.objects)
    }

    /// The bodies at row `t` as a state without contacts and grips, which a trajectory does not tell.
    /// `None` past the last row.
    #[must_use]
    pub fn state(&self, t: usize) -> Option<State> {
        let mut state = State::new([Body::default(); phase_model::MAX_ENTITIES]);
        for (body, rows) in state.bodies.iter_mut().zip(self.entities()) {
            *body = body_of(rows.get(t)?);
        }
        Some(state)
    }
}

/// The exact actions of the first steps of a recording, where they are known.
#[derive(Clone, PartialEq, Debug)]
pub struct Recovered {
    /// The actions of both agents, by step.
    pub steps: Vec<[Action; AGENT_COUNT]>,
    /// What the recording says about them.
    pub note: Option<String>,
}

/// What a simulated event knows beyond a recording: all substeps, actions and thoughts.
#[derive(Clone, PartialEq, Debug)]
pub struct Simulation {
    /// The event, whole.
    pub event: Event,
    /// The program that made it, such as `phase 0.1.0`.
    pub generator: String,
    /// The settings it was made with.
    pub settings: Value,
}

/// One event: its scene, what its labels say, and where everybody went.
#[derive(Clone, PartialEq, Debug)]
pub struct Recording {
    /// Name, different for every event of a file.
    pub id: String,
    /// The scene, starting at row 0.
    pub scene: Scene,
    /// The relation the scene was made to show.
    pub relation: Relation,
    /// The relation that human viewers saw.
    pub relation_human: Option<Relation>,
    /// What row 0 is, in the recording's words.
    pub row_0: Option<String>,
    /// Steps the recorder ran, which may be more than there are rows.
    pub recorded_steps: Option<u32>,
    /// Where everybody went.
    pub trajectory: Trajectory,
    /// The first actions, where they are known of a measured event.
    pub recovered_actions: Option<Recovered>,
    /// Everything else, of a simulated event.
    pub simulation: Option<Simulation>,
}

impl Recording {
    /// A simulated event as a recording: the rows are means over its substeps.
    #[must_use]
    pub fn of_event(id: impl Into<String>, event: Event, generator: String, settings: Value) -> Self {
        Self {
            id: id.into(),
            scene: event.scene.clone(),
            relation: event.scene.relation(),
            relation_human: None,
            row_0: Some("initial state".into()),
            recorded_steps: Some(event.steps.len() as u32),
            trajectory: Trajectory::means(&event),
            recovered_actions: None,
            simulation: Some(Simulation { event, generator, settings }),
        }
    }

    /// What a viewer has of the event: none of its labels, and no more of a simulated event than of a measured one.
    ///
    /// # Errors
    /// [`ObservedError`] for recordings that no file can hold.
    pub fn observed(&self) -> Result<ObservedEvent, ObservedError> {
        let rows = self.trajectory.states().iter().map(|state| state.bodies).collect();
        let objects = self.scene.objects.iter().map(|object| object.size).collect();
        ObservedEvent::new(self.scene.layout, self.scene.agents.map(|agent| agent.size), objects, rows)
    }
}

/// The columns of a body.
fn row_of(body: &Body) -> Row {
    [body.position.x, body.position.y, body.velocity.x, body.velocity.y, body.angle]
}

/// The columns of a body in a substep.
pub(crate) fn substep_row(body: &Body) -> SubstepRow {
    let [x, y, vx, vy, angle] = row_of(body);
    [x, y, vx, vy, angle, body.angular_velocity]
}

/// The body of a row; its angular velocity is unknown and taken to be 0.
pub(super) fn body_of(&[x, y, vx, vy, angle]: &Row) -> Body {
    let (position, velocity) = (phase_model::Vec2::new(x, y), phase_model::Vec2::new(vx, vy));
    Body { position, velocity, angle, angular_velocity: 0.0 }
}
