//! Trajectories of all entities, step by step.

use crate::{Event, mean_state};
use phase_model::{AGENT_COUNT, Body, State, Vec2, arena::SUBSTEPS};

/// Names of the columns of a [`Row`].
pub const COLUMNS: [&str; 5] = ["x", "y", "vx", "vy", "angle"];
/// Names of the columns of the substeps of simulated events.
pub const SUBSTEP_COLUMNS: [&str; 6] = ["x", "y", "vx", "vy", "angle", "angular_velocity"];

/// Position (u), velocity (u/s) and angle (rad) of one entity at one step, in the order of [`COLUMNS`].
pub type Row = [f32; COLUMNS.len()];

/// Position (u), velocity (u/s), angle (rad) and angular velocity (rad/s) of one entity after one substep, in
/// the order of [`SUBSTEP_COLUMNS`].
pub type SubstepRow = [f32; SUBSTEP_COLUMNS.len()];

/// Trajectories of all entities: `agents[i][t]` and `objects[k][t]`, all of the same length, which is at
/// least 1. Row 0 is the initial state; row t ≥ 1 is the mean over the five substeps of step t.
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
        let means: Vec<State> = event.steps.iter().map(mean_state).collect();
        let states = || core::iter::once(&event.initial).chain(&means);
        let rows = |entity: usize| states().map(|state| row_of(&state.bodies[entity])).collect();
        let objects = event.scene.physics().object_count;
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

    /// Every row as a state, for evaluating goals and contacts along the trajectory.
    #[must_use]
    pub fn states(&self) -> Vec<State> {
        (0..=self.steps()).map_while(|t| self.state(t)).collect()
    }

    /// Rows of every entity, agents first.
    pub fn entities(&self) -> impl Iterator<Item = &Vec<Row>> {
        self.agents.iter().chain(&self.objects)
    }

    /// The bodies at row `t` as a state without contacts and grips, which a trajectory does not contain.
    /// `None` past the last row.
    #[must_use]
    pub fn state(&self, t: usize) -> Option<State> {
        let mut state = State::new([Body::default(); phase_model::MAX_ENTITIES]);
        for (body, rows) in state.bodies.iter_mut().zip(self.entities()) {
            *body = body_of(rows.get(t)?);
        }
        Some(state)
    }

    /// Five states a step, beside the initial one: the bodies go straight from row to row.
    pub(crate) fn interpolated(&self) -> impl Iterator<Item = State> + '_ {
        let between = |rows: &[Row], t: usize, share: f32| -> Row {
            core::array::from_fn(|column| {
                rows[t - 1][column] + share * (rows[t][column] - rows[t - 1][column])
            })
        };
        let moment = move |t: usize, substep: usize| {
            let share = substep as f32 / SUBSTEPS as f32;
            let row = |rows: &Vec<Row>| vec![between(rows, t, share)];
            let moment = Self {
                agents: self.agents.each_ref().map(row),
                objects: self.objects.iter().map(row).collect(),
            };
            moment.state(0)
        };
        let later = (1..=self.steps())
            .flat_map(move |t| (1..=SUBSTEPS).filter_map(move |substep| moment(t, substep)));
        self.state(0).into_iter().chain(later)
    }
}

/// The columns of a body.
pub(crate) const fn row_of(body: &Body) -> Row {
    [body.position.x, body.position.y, body.velocity.x, body.velocity.y, body.angle]
}

/// The columns of a body in a substep.
#[must_use]
pub const fn substep_row(body: &Body) -> SubstepRow {
    let [x, y, vx, vy, angle] = row_of(body);
    [x, y, vx, vy, angle, body.angular_velocity]
}

/// The body of a row; its angular velocity is unknown and set to 0.
pub(crate) const fn body_of(&[x, y, vx, vy, angle]: &Row) -> Body {
    let position = Vec2::new(x, y);
    let velocity = Vec2::new(vx, vy);
    Body { position, velocity, angle, angular_velocity: 0.0 }
}
