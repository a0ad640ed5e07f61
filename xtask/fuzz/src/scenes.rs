//! Scenes to simulate, and what can be said of any motion in them.

use crate::draw::Draw;
use phase_model::{
    AGENT_COUNT, Action, AgentBody, Body, Entity, Grip, Layout, MAX_ENTITIES, ObjectId, PhysicsConfig, Side,
    Size, State, Strength, Vec2, arena,
    geometry::Outline,
    physics::{object_inertia, object_mass},
};

/// Clearance between bodies, and between bodies and walls, where they are apart (u).
const ROOM: f32 = 0.02;
/// Number of positions drawn for a body that is to be apart from the others.
const DRAWS: usize = 24;
/// Maximum speed along an axis (u/s) and turning rate (rad/s) of a fast start.
const FAST: (f32, f32) = (30.0, 8.0);
/// Maximum speed along an axis (u/s) and turning rate (rad/s) of an odd start.
const ODD: (f32, f32) = (70.0, 30.0);

/// Kind of start of a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Start {
    /// At rest, no two bodies and no body and wall overlapping: what the sampler makes.
    Apart,
    /// No two bodies and no body and wall overlapping, moving at up to 42 u/s.
    Fast,
    /// At rest, anywhere in the arena: in walls and in each other.
    Overlapping,
    /// Anywhere, some of the bodies at up to 100 u/s, holding objects that may be anywhere.
    Odd,
}

impl Start {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Apart, Self::Fast, Self::Overlapping, Self::Odd];

    /// The kind in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Apart => "apart, at rest",
            Self::Fast => "apart, fast",
            Self::Overlapping => "overlapping, at rest",
            Self::Odd => "odd",
        }
    }
}

/// Layout, sizes and strengths of any kind.
pub fn physique(draw: &mut impl Draw) -> PhysicsConfig {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let layout = draw.pick(&layouts);
    let agents = [(); AGENT_COUNT].map(|()| AgentBody {
        radius: draw.pick(&Size::ALL).radius(),
        max_force: draw.pick(&Strength::ALL).max_force(),
    });
    let object_radii = [(); 2].map(|()| draw.pick(&Size::ALL).radius());
    PhysicsConfig { walls: layout.walls(), agents, object_radii, object_count: draw.below(3) }
}

/// A start of some kind; `None` if there was no room for all.
pub fn start(physics: &PhysicsConfig, kind: Start, draw: &mut impl Draw) -> Option<State> {
    let mut state = match kind {
        Start::Apart | Start::Fast => apart(physics, draw)?,
        Start::Overlapping | Start::Odd => State::new([(); MAX_ENTITIES].map(|()| {
            let place = Vec2::new(draw.unit(), draw.unit());
            Body::at_rest(arena::MIN + arena::SIDE * place, draw.between(-7.0, 7.0))
        })),
    };
    let moving = match kind {
        Start::Apart | Start::Overlapping => return Some(state),
        Start::Fast => FAST,
        Start::Odd => ODD,
    };
    for body in &mut state.bodies {
        if kind == Start::Fast || draw.below(3) == 0 {
            let (speed, spin) = moving;
            body.velocity = Vec2::new(draw.between(-speed, speed), draw.between(-speed, speed));
            body.angular_velocity = draw.between(-spin, spin);
        }
    }
    if kind == Start::Odd {
        for grip in &mut state.grips {
            if physics.object_count > 0 && draw.below(3) == 0 {
                let object = ObjectId::ALL[draw.below(physics.object_count)];
                *grip = Some(Grip {
                    object,
                    side: draw.pick(&Side::ALL),
                    relative_angle: draw.between(-4.0, 4.0),
                });
            }
        }
    }
    Some(state)
}

/// Bodies at rest without overlaps, about half of them beside another.
fn apart(physics: &PhysicsConfig, draw: &mut impl Draw) -> Option<State> {
    let mut state = State::new([Body::default(); MAX_ENTITIES]);
    for entity in physics.entities() {
        let earlier = || physics.entities().take(entity.index());
        state = (0..DRAWS).find_map(|_| {
            let place = Vec2::new(draw.unit(), draw.unit());
            let position = match earlier().last() {
                Some(other) if draw.below(2) == 0 => state.position(other) + 6.0 * (place - 0.5),
                _ => arena::MIN + arena::SIDE * place,
            };
            let mut tried = state;
            *tried.body_mut(entity) = Body::at_rest(position, draw.between(-7.0, 7.0));
            let shape = outline(physics, &tried, entity, ROOM);
            let free = shape.inside_arena()
                && !physics.walls.iter().any(|&wall| shape.overlaps_wall(wall))
                && !earlier().any(|other| shape.overlaps(&outline(physics, &tried, other, ROOM)));
            free.then_some(tried)
        })?;
    }
    Some(state)
}

/// The outline of a body enlarged by about `margin` on all sides (u), or shrunk if that is negative.
#[must_use]
pub fn outline(physics: &PhysicsConfig, state: &State, entity: Entity, margin: f32) -> Outline {
    let mut other = physics.clone();
    other.agents.iter_mut().for_each(|agent| agent.radius += margin);
    other.object_radii.iter_mut().for_each(|radius| *radius += margin);
    Outline::of(&other, entity, state.body(entity))
}

/// Kind of actions that are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Doing {
    /// Any.
    Anything,
    /// None that does work: agents wait, stop, grab and release.
    Nothing,
}

/// Actions of both agents in each step, each held for one to five steps.
pub fn actions(doing: Doing, steps: usize, draw: &mut impl Draw) -> Vec<[Action; AGENT_COUNT]> {
    let mut actions = Vec::with_capacity(steps);
    while actions.len() < steps {
        let both = [(); AGENT_COUNT].map(|()| {
            // Grabbing is drawn more often, since it mostly reaches nothing.
            let action = if draw.below(6) == 0 { Action::Attach } else { draw.pick(&Action::ALL) };
            let works = action.push().is_some() || action.turn() != 0.0;
            if doing == Doing::Nothing && works { Action::NoForce } else { action }
        });
        let times = (1 + draw.below(5)).min(steps - actions.len());
        actions.extend(core::iter::repeat_n(both, times));
    }
    actions
}

/// Masses (kg) and moments of inertia (kg u²) by entity.
fn inertias(physics: &PhysicsConfig) -> impl Iterator<Item = (f32, f32)> {
    let agents = physics.agents.map(|agent| (agent.mass(), agent.inertia()));
    let radii = physics.object_radii.into_iter().take(physics.object_count);
    agents.into_iter().chain(radii.map(|radius| (object_mass(radius), object_inertia(radius))))
}

/// Kinetic energy of all bodies (J); a state's velocities are those of the centres of mass.
#[must_use]
pub fn energy(physics: &PhysicsConfig, state: &State) -> f32 {
    let of = |(body, (mass, inertia)): (&Body, (f32, f32))| {
        0.5 * (mass * body.velocity.length_squared()
            + inertia * body.angular_velocity * body.angular_velocity)
    };
    state.bodies.iter().zip(inertias(physics)).map(of).sum()
}

/// Two bodies that overlap.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Overlap {
    /// The bodies.
    pub pair: [Entity; 2],
    /// By how much the outlines overlap, by how much less both would have to be (u).
    pub depth: f32,
    /// The depth as a share of the smaller radius.
    pub share: f32,
}

/// The deepest overlap of two bodies of which none holds the other, if it is deeper than `least` (u).
#[must_use]
pub fn deepest_overlap(physics: &PhysicsConfig, state: &State, least: f32) -> Option<Overlap> {
    let entities: Vec<Entity> = physics.entities().collect();
    let mut deepest: Option<Overlap> = None;
    for (k, &a) in entities.iter().enumerate() {
        for &b in &entities[..k] {
            let held = |holder: Entity, held: Entity| match (holder, held) {
                (Entity::Agent(agent), Entity::Object(object)) => state.holds(agent, object),
                _ => false,
            };
            if held(a, b) || held(b, a) {
                continue;
            }
            let overlap = |depth: f32| {
                outline(physics, state, a, -depth / 2.0).overlaps(&outline(physics, state, b, -depth / 2.0))
            };
            if !overlap(least) {
                continue;
            }
            let smaller = physics.radius(a).min(physics.radius(b));
            let mut low = least;
            let mut high = smaller;
            for _ in 0..12 {
                let middle = f32::midpoint(low, high);
                if overlap(middle) { low = middle } else { high = middle }
            }
            if deepest.is_none_or(|other| low / smaller > other.share) {
                deepest = Some(Overlap { pair: [a, b], depth: low, share: low / smaller });
            }
        }
    }
    deepest
}
