//! Probes: a few steps of one effect, recorded substep by substep.

use crate::{
    Deviation, Engine, ReadError,
    deviation::held,
    read::{self, BodyRow},
};
use phase_model::{AGENT_COUNT, Action, MAX_ENTITIES, ObjectId, PhysicsConfig, State, Vec2, arena::SUBSTEPS};
use serde_json::Value;

/// One probe. It starts in `start`, runs one idle substep, then some bodies are given velocities, which
/// results in `initial`; then both agents act.
#[derive(Clone, PartialEq, Debug)]
pub struct Probe {
    /// Its name, which begins with its [`crate::family`].
    pub name: String,
    /// Walls, radii, forces.
    pub physics: PhysicsConfig,
    /// The state before the idle substep.
    pub start: State,
    /// Velocities (u/s) that bodies are given after the idle substep.
    pub velocities: [Option<Vec2>; MAX_ENTITIES],
    /// The state before the first step.
    pub initial: State,
    /// Both agents' actions, by step; at least one step.
    pub actions: Vec<[Action; AGENT_COUNT]>,
    /// The state after each step, without grips.
    pub steps: Vec<State>,
    /// The state after each substep, without grips and angular velocities; five for each step.
    pub substeps: Vec<State>,
    /// The object each agent holds after each step.
    pub held: Vec<[Option<ObjectId>; AGENT_COUNT]>,
}

/// Errors of an engine on a probe.
#[derive(Clone, PartialEq, Debug)]
pub struct ProbeErrors {
    /// Before the first step, after the engine's own idle substep; nonzero only where bodies overlap at the
    /// start.
    pub start: Deviation,
    /// After each step.
    pub steps: Vec<Deviation>,
    /// After each substep.
    pub substeps: Vec<Deviation>,
    /// Steps after which an agent's grip differs from the recorded one.
    pub grip_mismatches: usize,
}

impl Probe {
    /// Reads all probes of a file.
    ///
    /// # Errors
    /// A [`ReadError`] that names field and rule.
    pub fn parse(text: &str) -> Result<Vec<Self>, ReadError> {
        Self::from_value(&read::json(text)?)
    }

    /// Reads probes from a JSON tree.
    ///
    /// # Errors
    /// A [`ReadError`] that names field and rule.
    pub fn from_value(file: &Value) -> Result<Vec<Self>, ReadError> {
        read::entries(file, "probes")?.map(|(entry, name)| probe(&entry, name)).collect()
    }

    /// Replays the probe with an engine.
    #[must_use]
    pub fn follow<E: Engine>(&self) -> ProbeErrors {
        let mut engine = E::set_up(&self.physics, &self.start);
        engine.settle();
        for (body, velocity) in self.velocities.into_iter().enumerate() {
            if let Some(velocity) = velocity {
                engine.set_velocity(body, velocity);
            }
        }
        let far = |state: &State, recorded: &State| {
            Deviation::between(&self.physics, &state.bodies, &recorded.bodies)
        };
        let start = far(&engine.state(), &self.initial);
        if !E::RUNS_IDLE_SUBSTEP {
            engine = E::set_up(&self.physics, &self.initial);
        }
        let mut followed = ProbeErrors {
            start,
            steps: Vec::with_capacity(self.steps.len()),
            substeps: Vec::with_capacity(self.substeps.len()),
            grip_mismatches: 0,
        };
        let records = self.steps.iter().zip(self.substeps.chunks(SUBSTEPS)).zip(&self.held);
        for (&actions, ((step, substeps), recorded)) in self.actions.iter().zip(records) {
            let states = engine.step(actions);
            let last = states[SUBSTEPS - 1];
            followed.steps.push(far(&last, step));
            followed
                .substeps
                .extend(states.iter().zip(substeps).map(|(state, recorded)| far(state, recorded)));
            followed.grip_mismatches += usize::from(held(&last) != *recorded);
        }
        followed
    }
}

fn probe(entry: &read::Entry<'_>, name: String) -> Result<Probe, ReadError> {
    const SUBSTEP_ROWS: &str = "four lists of rows [x, y, vx, vy, angle]";
    const STATE: &str = "four rows [x, y, vx, vy, angle, angular velocity]";
    let physics = entry.physics("wall_segs", "sizes", "max_force")?;
    let actions = entry.actions()?;
    let initial = entry.state("initial", "", entry.take("initial", STATE)?)?;
    let rows: Vec<[BodyRow; MAX_ENTITIES]> = entry.take("steps", &format!("a list of {STATE}"))?;
    entry.check_length("steps", rows.len(), actions.len(), "one state for each step")?;
    let steps = rows.into_iter().enumerate();
    let steps = steps.map(|(step, rows)| entry.state("steps", &format!("[{step}]"), rows));
    let steps = steps.collect::<Result<Vec<_>, _>>()?;

    let rows: [Vec<[f32; 5]>; MAX_ENTITIES] = entry.take("substeps", SUBSTEP_ROWS)?;
    let moments = 1 + SUBSTEPS * actions.len();
    for rows in &rows {
        let what = "for each body one row before the idle substep and five for each step";
        entry.check_length("substeps", rows.len(), moments, what)?;
    }
    let moment = |k: usize| {
        let bodies = core::array::from_fn(|entity| {
            let [x, y, vx, vy, angle] = rows[entity][k];
            [x, y, vx, vy, angle, 0.0]
        });
        entry.state("substeps", &format!("[..][{k}]"), bodies)
    };
    let velocities: Option<[Option<[f32; 2]>; MAX_ENTITIES]> =
        entry.optional("init_velocities", "null or a pair of numbers or null for each of four bodies")?;
    let velocities = velocities.unwrap_or_default().map(|velocity| velocity.map(Vec2::from));
    if velocities.iter().flatten().any(|velocity| !velocity.is_finite()) {
        return Err(entry.error("init_velocities", "must be finite"));
    }
    Ok(Probe {
        name,
        physics,
        start: moment(0)?,
        velocities,
        initial,
        steps,
        substeps: (1..moments).map(moment).collect::<Result<_, _>>()?,
        held: entry.held(actions.len())?,
        actions,
    })
}
