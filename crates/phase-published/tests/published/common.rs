//! Scenes for the published mind.

use phase_model::{
    AgentId, AgentSpec, Attitude, Body, Entity, EventKind, Goal, Grip, LandmarkId, Layout, ObjectId,
    ObjectSpec, Scene, Side, Sign, Size, State, Strength, Vec2,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_published::{Aim, Mind, PublishedParameters};

pub(crate) const ME: AgentId = AgentId::ZERO;
pub(crate) const OTHER: AgentId = AgentId::ONE;
pub(crate) const BALL: ObjectId = ObjectId::ZERO;

pub(crate) fn random(seed: u64) -> Pcg64Mcg {
    stream(seed, Purpose::Search, 0)
}

pub(crate) fn on_landmark(agent: AgentId, landmark: LandmarkId) -> Goal {
    Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive }
}

pub(crate) fn ball_on(landmark: LandmarkId) -> Goal {
    Goal::ObjectOnLandmark { object: BALL, landmark, sign: Sign::Positive }
}

/// Two agents of the smallest size and two objects, at rest at these places (u) and angles (rad), by entity.
pub(crate) fn scene(base: u8, goals: [Goal; 2], attitude: Attitude, bodies: [(f32, f32, f32); 4]) -> Scene {
    let body = |entity: usize| {
        let (x, y, angle) = bodies[entity];
        Body::at_rest(Vec2::new(x, y), angle)
    };
    let agent = |agent: usize| AgentSpec {
        size: Size::Small,
        strength: Strength::Strong,
        goal: goals[agent],
        attitude: if agent == 0 { attitude } else { Attitude::Neutral },
        awareness: phase_model::Awareness::default(),
        start: body(agent),
    };
    let object = |object: usize| ObjectSpec { size: Size::Small, start: body(2 + object) };
    Scene {
        layout: Layout::new(base, None).unwrap(),
        agents: [agent(0), agent(1)],
        objects: vec![object(0), object(1)],
        kind: EventKind::Independent,
    }
}

/// Lets an agent hold the first object, which is put in front of its head.
pub(crate) fn hold(state: &mut State, agent: AgentId) {
    let holder = *state.body(Entity::Agent(agent));
    state.body_mut(Entity::Object(BALL)).position = holder.position + holder.forward() * 1.6;
    state.grips[agent] = Some(Grip { object: BALL, side: Side::Head, relative_angle: -holder.angle });
}

pub(crate) fn mind(scene: &Scene, agent: AgentId, simulations: usize) -> Mind {
    Mind::new(scene, agent, PublishedParameters { simulations, ..PublishedParameters::default() }).unwrap()
}

/// The subgoal of an agent that knows the state.
pub(crate) fn aim(scene: &Scene, agent: AgentId, state: &State) -> Aim {
    mind(scene, agent, 1).aim(state)
}
