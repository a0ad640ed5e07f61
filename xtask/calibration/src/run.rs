//! Runs: many steps of varied actions, recorded step by step.

use crate::{
    Deviation, Engine, ReadError,
    deviation::held,
    read::{self, BodyRow},
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Entity, Grip, MAX_ENTITIES, ObjectId, PhysicsConfig, Side, State, Vec2,
    arena::SUBSTEPS,
};
use serde_json::Value;

/// One run. One idle substep lies between its first state and its first step.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// Its name.
    pub name: String,
    /// Walls, radii, forces.
    pub physics: PhysicsConfig,
    /// The state before the idle substep, and after each step, with grips as [`grip_of`] reconstructs them.
    pub states: Vec<State>,
    /// Both agents' actions, by step; at least one step.
    pub actions: Vec<[Action; AGENT_COUNT]>,
}

impl Run {
    /// Reads all runs of a file.
    ///
    /// # Errors
    /// A [`ReadError`] that names field and rule.
    pub fn parse(text: &str) -> Result<Vec<Self>, ReadError> {
        Self::from_value(&read::json(text)?)
    }

    /// Reads runs from a JSON tree.
    ///
    /// # Errors
    /// A [`ReadError`] that names field and rule.
    pub fn from_value(file: &Value) -> Result<Vec<Self>, ReadError> {
        read::entries(file, "runs")?.map(|(entry, name)| run(&entry, name)).collect()
    }

    /// Simulates the run from a recorded state for some steps: the errors after each, and after how many of
    /// them an agent's grip differs from the recorded one. A start at state 0 has the idle substep before it.
    /// Ends where the run ends.
    #[must_use]
    pub fn follow<E: Engine>(&self, start: usize, steps: usize) -> (Vec<Deviation>, usize) {
        let Some(state) = self.states.get(start) else { return (Vec::new(), 0) };
        let mut engine = E::set_up(&self.physics, state);
        if start == 0 {
            engine.settle();
        }
        let mut grip_mismatches = 0;
        let records = self.actions.iter().zip(self.states.iter().skip(1)).skip(start).take(steps);
        let deviations = records.map(|(&actions, recorded)| {
            let found = engine.step(actions)[SUBSTEPS - 1];
            grip_mismatches += usize::from(held(&found) != held(recorded));
            Deviation::between(&self.physics, &found.bodies, &recorded.bodies)
        });
        (deviations.collect(), grip_mismatches)
    }
}

/// The grip of an agent on an object that it is known to hold: on the side where the object lies, at their
/// relative angle.
#[must_use]
pub fn grip_of(state: &State, agent: AgentId, object: ObjectId) -> Grip {
    let holder = state.body(Entity::Agent(agent));
    let object_body = state.body(Entity::Object(object));
    let right = Vec2::from_angle(holder.angle);
    let between = object_body.position - holder.position;
    let local = Vec2::new(between.dot(right), between.dot(right.perp()));
    let along = |side: Side| side.direction().dot(local);
    let nearer = |best: Side, side: Side| if along(side) > along(best) { side } else { best };
    Grip {
        object,
        side: Side::ALL.into_iter().fold(Side::Head, nearer),
        relative_angle: object_body.angle - holder.angle,
    }
}

fn run(entry: &read::Entry<'_>, name: String) -> Result<Run, ReadError> {
    let physics = entry.physics("walls", "radii", "max_force")?;
    let actions = entry.actions()?;
    let shape = "a list of four rows [x, y, vx, vy, angle, angular velocity]";
    let rows: Vec<[BodyRow; MAX_ENTITIES]> = entry.take("states", shape)?;
    entry.check_length("states", rows.len(), 1 + actions.len(), "the start and one state for each step")?;
    let rows = rows.into_iter().enumerate();
    let states = rows.map(|(step, rows)| entry.state("states", &format!("[{step}]"), rows));
    let mut states = states.collect::<Result<Vec<_>, _>>()?;
    for (state, held) in states.iter_mut().skip(1).zip(entry.held(actions.len())?) {
        let grips = AgentId::ALL.map(|agent| held[agent].map(|object| grip_of(state, agent, object)));
        state.grips = grips;
    }
    Ok(Run { name, physics, states, actions })
}
