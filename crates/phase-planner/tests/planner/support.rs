//! Hand-made situations.

use phase_model::{
    AgentId, Attitude, Body, BodySet, Flip, Goal, LandmarkId, Layout, ObjectId, PhysicsConfig, Sign, Size,
    Size::Small, State, Strength, Strength::Strong, Vec2, physics::AgentBody,
};
use phase_planner::{Plan, Planner};

/// Agent 0 at the top left, agent 1 at the bottom right, no walls, no objects.
pub(crate) fn plain() -> Setup {
    Setup {
        layout: layout(0, None),
        agents: [(Small, Strong, Vec2::new(8.0, 18.0)), (Small, Strong, Vec2::new(24.0, 8.0))],
        objects: vec![],
        goals: [agent_on(0, 2), agent_on(1, 0)],
        attitudes: [Attitude::Neutral; 2],
        holds: [None; 2],
        observed: everything(),
    }
}

/// A description of a situation: layout, bodies, goals, attitudes.
pub(crate) struct Setup {
    pub(crate) layout: Layout,
    pub(crate) agents: [(Size, Strength, Vec2); 2],
    pub(crate) objects: Vec<(Size, Vec2)>,
    pub(crate) goals: [Goal; 2],
    pub(crate) attitudes: [Attitude; 2],
    pub(crate) holds: [Option<u8>; 2],
    pub(crate) observed: BodySet,
}

impl Setup {
    pub(crate) fn physics(&self) -> PhysicsConfig {
        let mut object_radii = [0.0; 2];
        for (radius, (size, _)) in object_radii.iter_mut().zip(&self.objects) {
            *radius = size.radius();
        }
        PhysicsConfig {
            walls: self.layout.walls(),
            agents: self.agents.map(|(size, strength, _)| AgentBody {
                radius: size.radius(),
                max_force: strength.max_force(),
            }),
            object_radii,
            object_count: self.objects.len(),
        }
    }

    pub(crate) fn state(&self) -> State {
        let mut bodies = [Body::default(); 4];
        for (k, (.., position)) in self.agents.iter().enumerate() {
            bodies[k] = Body::at_rest(*position, 0.0);
        }
        for (k, (_, position)) in self.objects.iter().enumerate() {
            bodies[2 + k] = Body::at_rest(*position, 0.0);
        }
        let mut state = State::new(bodies);
        for (grip, held) in state.grips.iter_mut().zip(self.holds) {
            *grip = held.map(|object| phase_model::Grip {
                object: ObjectId::ALL[usize::from(object)],
                side: phase_model::Side::Head,
                relative_angle: 0.0,
            });
        }
        state
    }

    pub(crate) fn plan(&self, agent: usize) -> Plan {
        Planner::new(self.physics(), self.layout, AgentId::ALL[agent], self.goals, self.attitudes[agent])
            .plan(&self.state(), self.observed)
    }

    /// The plan as text.
    pub(crate) fn words(&self, agent: usize) -> Vec<String> {
        self.plan(agent).subgoals.iter().map(ToString::to_string).collect()
    }
}

pub(crate) fn layout(base: u8, flip: Option<Flip>) -> Layout {
    Layout::new(base, flip).expect("a known layout")
}

pub(crate) fn agent_on(agent: u8, landmark: u8) -> Goal {
    Goal::AgentOnLandmark {
        agent: AgentId::ALL[usize::from(agent)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

pub(crate) fn object_on(object: u8, landmark: u8) -> Goal {
    Goal::ObjectOnLandmark {
        object: ObjectId::ALL[usize::from(object)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

/// All entities.
pub(crate) fn everything() -> BodySet {
    phase_model::Entity::ALL.into_iter().collect()
}
