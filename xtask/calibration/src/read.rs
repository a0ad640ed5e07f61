//! Fields of a JSON tree, with the path that leads to them in every error.

use crate::{ReadError, deviation::body};
use phase_model::{
    AGENT_COUNT, AgentBody, Body, MAX_ENTITIES, ObjectId, PhysicsConfig, Segment, State, Vec2, arena,
};
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeSet;

/// Numbers of one body in a recorded state: x, y, vx, vy, angle, angular velocity.
pub(crate) type BodyRow = [f32; 6];

/// Maximum number of inner walls of a layout.
const MAX_WALLS: usize = 4;
/// Maximum valid radius: half the arena (u).
const MAX_RADIUS: f32 = 0.5 * arena::SIDE;

/// Parses a whole file.
pub(crate) fn json(text: &str) -> Result<Value, ReadError> {
    Ok(serde_json::from_str(text)?)
}

/// One entry of the list a file consists of.
pub(crate) struct Entry<'a> {
    value: &'a Value,
    path: String,
}

/// The entries of the list `key`, of which there must be at least one, each an object with a unique `name`.
pub(crate) fn entries<'a>(
    file: &'a Value,
    key: &str,
) -> Result<impl Iterator<Item = (Entry<'a>, String)> + use<'a>, ReadError> {
    let root = Entry { value: file, path: String::new() };
    let list = root.member(key)?.as_array().ok_or_else(|| root.error(key, "must be a list"))?;
    if list.is_empty() {
        return Err(root.error(key, "must hold at least one entry"));
    }
    let mut names = BTreeSet::new();
    let mut found = Vec::with_capacity(list.len());
    for (k, value) in list.iter().enumerate() {
        let entry = Entry { value, path: format!("{key}[{k}]") };
        let name: String = entry.take("name", "a text")?;
        if name.is_empty() || name.chars().any(char::is_control) {
            return Err(entry.error("name", "must be one line of text"));
        }
        if !names.insert(name.clone()) {
            return Err(entry.error("name", "must differ from that of every other entry"));
        }
        found.push((entry, name));
    }
    Ok(found.into_iter())
}

impl<'a> Entry<'a> {
    pub(crate) fn error(&self, key: &str, rule: impl Into<String>) -> ReadError {
        ReadError::Field { field: self.field(key), rule: rule.into() }
    }

    fn field(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    fn member(&self, key: &str) -> Result<&'a Value, ReadError> {
        if !self.value.is_object() {
            let field = if self.path.is_empty() { "the file".into() } else { self.path.clone() };
            return Err(ReadError::Field { field, rule: "must be an object".into() });
        }
        self.value.get(key).ok_or_else(|| self.error(key, "is missing"))
    }

    /// A member of some shape, described in words.
    pub(crate) fn take<T: Deserialize<'a>>(&self, key: &str, shape: &str) -> Result<T, ReadError> {
        let value = self.member(key)?;
        T::deserialize(value).map_err(|source| ReadError::Shape {
            field: self.field(key),
            shape: shape.into(),
            source,
        })
    }

    /// Reads a member that may be absent or null.
    pub(crate) fn optional<T: Deserialize<'a>>(
        &self,
        key: &str,
        shape: &str,
    ) -> Result<Option<T>, ReadError> {
        let value = self.value.get(key).filter(|value| !value.is_null());
        value.map(|_| self.take(key, shape)).transpose()
    }

    /// Walls, the radii of agents and objects, and the agents' forces.
    pub(crate) fn physics(&self, walls: &str, radii: &str, forces: &str) -> Result<PhysicsConfig, ReadError> {
        let segments: Vec<[[f32; 2]; 2]> = self.take(walls, "a list of pairs of points [x, y]")?;
        if segments.len() > MAX_WALLS {
            return Err(
                self.error(walls, format!("must hold at most {MAX_WALLS} walls, not {}", segments.len()))
            );
        }
        let ends = segments.iter().flatten().copied();
        if !ends.map(Vec2::from).all(arena::contains) || segments.iter().any(|[a, b]| a == b) {
            return Err(
                self.error(walls, "must have two different ends inside the arena (x 6 to 26, y 2 to 22)")
            );
        }
        let sizes: [f32; MAX_ENTITIES] = self.take(radii, "four numbers")?;
        if !sizes.iter().all(|radius| *radius > 0.0 && *radius <= MAX_RADIUS) {
            return Err(self.error(radii, format!("must be greater than 0 and at most {MAX_RADIUS}")));
        }
        let max_force: [f32; AGENT_COUNT] = self.take(forces, "two numbers")?;
        if !max_force.iter().all(|force| *force >= 0.0 && force.is_finite()) {
            return Err(self.error(forces, "must be finite and not negative"));
        }
        Ok(PhysicsConfig {
            walls: segments.into_iter().map(|[a, b]| Segment { a: a.into(), b: b.into() }).collect(),
            agents: core::array::from_fn(|k| AgentBody { radius: sizes[k], max_force: max_force[k] }),
            object_radii: [sizes[2], sizes[3]],
            object_count: 2,
        })
    }

    /// Both agents' actions by step, from one list for each agent.
    pub(crate) fn actions(&self) -> Result<Vec<[phase_model::Action; AGENT_COUNT]>, ReadError> {
        let lists: [Vec<phase_model::Action>; AGENT_COUNT] =
            self.take("actions", "two lists of names of actions")?;
        let [first, second] = &lists;
        if first.is_empty() || first.len() != second.len() {
            let first = first.len();
            let second = second.len();
            let rule = format!("must be two lists of one length, at least 1, not {first} and {second}");
            return Err(self.error("actions", rule));
        }
        Ok(first.iter().zip(second).map(|(&first, &second)| [first, second]).collect())
    }

    /// Object that each agent holds after each step.
    pub(crate) fn held(&self, steps: usize) -> Result<Vec<[Option<ObjectId>; AGENT_COUNT]>, ReadError> {
        const KEY: &str = "attached_after_step";
        let held: Vec<[Option<ObjectId>; AGENT_COUNT]> = self.take(KEY, "a list of pairs of 0, 1 or null")?;
        self.check_length(KEY, held.len(), steps, "one entry for each step")?;
        Ok(held)
    }

    pub(crate) fn check_length(
        &self,
        key: &str,
        found: usize,
        expected: usize,
        what: &str,
    ) -> Result<(), ReadError> {
        if found == expected {
            return Ok(());
        }
        Err(self.error(key, format!("must hold {what}, {expected} in all, not {found}")))
    }

    /// A state without grips from a row for each body; `at` is its location in the member `key`.
    pub(crate) fn state(
        &self,
        key: &str,
        at: &str,
        rows: [BodyRow; MAX_ENTITIES],
    ) -> Result<State, ReadError> {
        let bodies = rows.map(body);
        let good = |body: &Body| body.is_finite() && arena::contains(body.position);
        match bodies.iter().position(|body| !good(body)) {
            None => Ok(State::new(bodies)),
            Some(entity) => {
                let rule = "must be finite, with x from 6 to 26 and y from 2 to 22";
                Err(self.error(&format!("{key}{at}"), format!("holds a bad body {entity}: it {rule}")))
            }
        }
    }
}
