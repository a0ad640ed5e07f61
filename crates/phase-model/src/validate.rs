//! Validity of scenes, and the errors of invalid ones.

use crate::{
    AGENT_COUNT, AgentId, Attitude, Entity, EventKind, Goal, MAX_OBJECTS, ObjectId, Scene, arena,
    geometry::Outline,
    physics::{MAX_ANGLE, MAX_SPEED, MAX_SPIN},
    scene::AgentSpec,
};
use thiserror::Error;

/// A body whose speed was limited may have a little more, by rounding.
const ROUNDING: f32 = 1.0001;

/// A rule that a scene violates. The text names the field and the rule.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum SceneError {
    /// There are more objects than the maximum.
    #[error("objects must number 0 to 2, not {0}")]
    TooManyObjects(usize),
    /// A number of a start state is NaN or infinite.
    #[error("{field} must hold finite numbers")]
    NotFinite {
        /// The field, such as `agents[0].start`.
        field: String,
    },
    /// A start has an angle that engines cannot tell from its neighbours.
    #[error("{field}.angle must be {} to {MAX_ANGLE} rad, not {angle}", -MAX_ANGLE)]
    Angle {
        /// The start, such as `agents[0].start`.
        field: String,
        /// Its angle (rad).
        angle: f32,
    },
    /// A body is faster than engines move it.
    #[error(
        "{field} must not be faster than {MAX_SPEED:.0} u/s and {MAX_SPIN:.1} rad/s, not {speed} u/s and {spin} rad/s"
    )]
    Fast {
        /// The start, such as `agents[0].start`.
        field: String,
        /// Its speed (u/s).
        speed: f32,
        /// Its angular velocity (rad/s).
        spin: f32,
    },
    /// A body's origin lies outside the arena.
    #[error("{field} must lie inside the arena (x 6 to 26, y 2 to 22), not at ({x}, {y})")]
    OutsideArena {
        /// The field.
        field: String,
        /// Its position (u).
        x: f32,
        /// Its position (u).
        y: f32,
    },
    /// A goal is about an object that the scene does not have.
    #[error("agents[{agent}].goal refers to object {object}, but the scene has only {count}")]
    GoalOfAbsentObject {
        /// Whose goal.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// Number of objects of the scene.
        count: usize,
    },
    /// A goal is about an agent touching itself.
    #[error("agents[{agent}].goal: an agent cannot touch itself")]
    SelfTouch {
        /// Whose goal.
        agent: AgentId,
    },
    /// The kind of event requires that one agent helps or hinders the other, but neither does.
    #[error("event is {:?}, but no agent has the attitude `alpha` {alpha}", .kind.name())]
    NobodySocial {
        /// The kind.
        kind: EventKind,
        /// α that the kind requires of one agent.
        alpha: i8,
    },
    /// Both agents are social.
    #[error("at most one agent may have an attitude `alpha` other than 0")]
    BothSocial,
    /// A helper's or hinderer's goal is not derived from the other's.
    #[error("agents[{agent}].goal of a {role} agent must be the other agent's goal{sign}")]
    SocialGoal {
        /// The social agent.
        agent: AgentId,
        /// `helping` or `hindering`.
        role: &'static str,
        /// Text that follows in the message, where the sign has to be the other one.
        sign: &'static str,
    },
    /// Two bodies overlap at the start.
    #[error("{first} and {second} overlap at the start")]
    Overlap {
        /// The one body.
        first: String,
        /// The other body, or a wall.
        second: String,
    },
}

impl Scene {
    /// Checks everything a scene must satisfy to be simulated: finite starts inside the arena, angles up to
    /// [`MAX_ANGLE`], no body faster than engines move it, goals about entities that exist, at most one
    /// social agent, with a goal derived from the other's. Overlapping starts are valid: the physics pushes
    /// the bodies apart, and some measured recordings begin like this.
    ///
    /// # Errors
    /// The first rule that is violated.
    pub fn validate(&self) -> Result<(), SceneError> {
        if self.objects.len() > MAX_OBJECTS {
            return Err(SceneError::TooManyObjects(self.objects.len()));
        }
        self.check_finite()?;
        let state = self.initial_state();
        for entity in self.physics().entities() {
            let body = state.body(entity);
            let field = format!("{}.start", field_name(entity));
            if body.angle.abs() > MAX_ANGLE {
                return Err(SceneError::Angle { field, angle: body.angle });
            }
            let (speed, spin) = (body.velocity.length(), body.angular_velocity);
            if speed > MAX_SPEED * ROUNDING || spin.abs() > MAX_SPIN * ROUNDING {
                return Err(SceneError::Fast { field, speed, spin });
            }
            if !arena::contains(body.position) {
                return Err(SceneError::OutsideArena { field, x: body.position.x, y: body.position.y });
            }
        }
        for (agent, spec) in AgentId::ALL.into_iter().zip(&self.agents) {
            check_goal(agent, spec.goal, self.objects.len())?;
        }
        check_attitudes(&self.agents)
    }

    /// Checks that one agent helps in a scene labelled as helping, and that one hinders in a scene labelled
    /// as hindering. The label does not affect a simulation, so only readers of files check it.
    ///
    /// # Errors
    /// [`SceneError::NobodySocial`].
    pub fn check_kind(&self) -> Result<(), SceneError> {
        let attitude = match self.kind {
            EventKind::Helping => Attitude::Help,
            EventKind::Hindering => Attitude::Hinder,
            _ => return Ok(()),
        };
        if self.attitudes().contains(&attitude) {
            Ok(())
        } else {
            Err(SceneError::NobodySocial { kind: self.kind, alpha: attitude.alpha() })
        }
    }

    /// Checks that all numbers of the starts are finite.
    pub(crate) fn check_finite(&self) -> Result<(), SceneError> {
        let state = self.initial_state();
        match self.physics().entities().find(|&entity| !state.body(entity).is_finite()) {
            Some(entity) => Err(SceneError::NotFinite { field: format!("{}.start", field_name(entity)) }),
            None => Ok(()),
        }
    }

    /// The stricter check for generated scenes: [`Scene::validate`], and no body overlaps a wall, the
    /// boundary or another body.
    ///
    /// # Errors
    /// The first rule that is violated.
    pub fn validate_without_overlap(&self) -> Result<(), SceneError> {
        self.validate()?;
        let physics = self.physics();
        let state = self.initial_state();
        let outlines: Vec<(Entity, Outline)> = physics
            .entities()
            .map(|entity| (entity, Outline::of(&physics, entity, state.body(entity))))
            .collect();
        for (k, (entity, outline)) in outlines.iter().enumerate() {
            let overlap = |second: String| SceneError::Overlap { first: field_name(*entity), second };
            if !outline.inside_arena() || physics.walls.iter().any(|&wall| outline.overlaps_wall(wall)) {
                return Err(overlap("a wall".into()));
            }
            if let Some((other, _)) = outlines[..k].iter().find(|(_, other)| outline.overlaps(other)) {
                return Err(overlap(field_name(*other)));
            }
        }
        Ok(())
    }
}

/// The path of an entity in files, such as `agents[0]`.
pub(crate) fn field_name(entity: Entity) -> String {
    match entity {
        Entity::Agent(agent) => format!("agents[{agent}]"),
        Entity::Object(object) => format!("objects[{object}]"),
    }
}

fn check_goal(agent: AgentId, goal: Goal, count: usize) -> Result<(), SceneError> {
    match goal {
        Goal::ObjectOnLandmark { object, .. } if object.index() >= count => {
            Err(SceneError::GoalOfAbsentObject { agent, object, count })
        }
        Goal::Touch { agent: who, other, .. } if who == other => Err(SceneError::SelfTouch { agent }),
        Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } | Goal::Touch { .. } => Ok(()),
    }
}

fn check_attitudes(agents: &[AgentSpec; AGENT_COUNT]) -> Result<(), SceneError> {
    if agents.iter().all(|agent| agent.attitude != Attitude::Neutral) {
        return Err(SceneError::BothSocial);
    }
    for (agent, spec) in AgentId::ALL.into_iter().zip(agents) {
        let other = agents[agent.other()].goal;
        let (expected, role, sign) = match spec.attitude {
            Attitude::Neutral => continue,
            Attitude::Help => (other, "helping", ""),
            Attitude::Hinder => (other.negated(), "hindering", " with the opposite sign"),
        };
        if spec.goal != expected {
            return Err(SceneError::SocialGoal { agent, role, sign });
        }
    }
    Ok(())
}
