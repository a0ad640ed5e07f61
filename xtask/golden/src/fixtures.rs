//! Physical scenes and random actions for golden values.

use phase_model::{
    AGENT_COUNT, Action, AgentBody, Body, Flip, Layout, PhysicsConfig, Size, State, Strength, Vec2,
    random::{Pcg64Mcg, Purpose, stream},
};
use rand::RngExt;

/// Steps in each golden run (0.25 s of video each).
pub const STEPS: usize = 500;

/// Six scenes in which bodies start close to each other and to walls, so that random actions lead to
/// contacts, grips and hand-overs: zero to two objects, all sizes and strengths, open and divided arenas,
/// mirrored ones.
#[must_use]
pub fn scenes() -> Vec<(PhysicsConfig, State)> {
    use Size::{Huge, Large, Medium, Small};
    use Strength::{Fair, Mighty, Strong, Weak};
    vec![
        scene(0, None, [(Small, Mighty), (Medium, Fair)], &[], &[(15.0, 12.0), (17.0, 12.5)]),
        scene(
            2,
            None,
            [(Large, Strong), (Small, Fair)],
            &[Small],
            &[(9.0, 17.0), (12.0, 17.0), (10.6, 18.0)],
        ),
        scene(
            7,
            Some(Flip::Diagonal),
            [(Medium, Mighty), (Medium, Mighty)],
            &[Medium, Small],
            &[(19.0, 15.5), (22.0, 15.5), (20.5, 17.5), (20.5, 14.0)],
        ),
        scene(
            13,
            Some(Flip::LeftRight),
            [(Small, Strong), (Huge, Mighty)],
            &[Large],
            &[(8.5, 6.0), (13.0, 7.5), (10.5, 5.0)],
        ),
        scene(
            18,
            None,
            [(Small, Weak), (Small, Mighty)],
            &[Small, Huge],
            &[(22.0, 6.5), (24.0, 6.5), (23.0, 8.5), (20.0, 5.0)],
        ),
        scene(
            21,
            Some(Flip::AntiDiagonal),
            [(Large, Fair), (Medium, Strong)],
            &[Medium, Medium],
            &[(18.0, 18.0), (22.0, 18.0), (19.2, 20.0), (22.0, 20.3)],
        ),
    ]
}

/// Actions of both agents for [`STEPS`] steps. Each agent keeps an action for one to eight steps, because
/// actions resampled at every step cancel each other.
#[must_use]
pub fn actions(scene: u64) -> Vec<[Action; AGENT_COUNT]> {
    let mut random = stream(2021, Purpose::Search, scene);
    let mut held = [(Action::NoForce, 0_u32); AGENT_COUNT];
    let next = |held: &mut (Action, u32), random: &mut Pcg64Mcg| {
        if held.1 == 0 {
            *held = (Action::ALL[random.random_range(0..Action::ALL.len())], random.random_range(1..=8));
        }
        held.1 -= 1;
        held.0
    };
    (0..STEPS).map(|_| held.each_mut().map(|held| next(held, &mut random))).collect()
}

fn scene(
    base: u8,
    flip: Option<Flip>,
    agents: [(Size, Strength); AGENT_COUNT],
    objects: &[Size],
    places: &[(f32, f32)],
) -> (PhysicsConfig, State) {
    let walls = Layout::new(base, flip).map(Layout::walls).unwrap_or_default();
    let agents =
        agents.map(|(size, strength)| AgentBody { radius: size.radius(), max_force: strength.max_force() });
    let mut object_radii = [0.0; phase_model::MAX_OBJECTS];
    for (radius, size) in object_radii.iter_mut().zip(objects) {
        *radius = size.radius();
    }
    let mut bodies = [Body::default(); phase_model::MAX_ENTITIES];
    for (k, (body, &(x, y))) in bodies.iter_mut().zip(places).enumerate() {
        *body = Body::at_rest(Vec2::new(x, y), k as f32);
    }
    (PhysicsConfig { walls, agents, object_radii, object_count: objects.len() }, State::new(bodies))
}
