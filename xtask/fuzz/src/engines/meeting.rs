//! Two agents that meet: the world beside the kernel, which reproduces recordings of such meetings to a
//! thousandth of a unit.

use super::{Kind, Quantiles, Running, apart, quantiles};
use crate::{
    draw::Draw,
    scenes::{Doing, actions, outline, physique},
};
use phase_model::{
    Body, Contacts, PhysicsConfig, State, Vec2, arena,
    random::{Purpose, stream},
};

/// Steps of a meeting, as many as a long probe has.
const STEPS: usize = 15;
/// By how much the start of a disturbed kernel differs (u): what a recording's rounding is.
const DISTURBANCE: f32 = 1.0e-5;
/// The world's median error at the first contact (u), as measured.
const ERROR_AT_CONTACT: f32 = 3.0e-3;

/// The world beside the kernel with its cache, in meetings of two agents without objects or inner walls.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Meetings {
    /// Meetings.
    pub count: usize,
    /// After steps before the first contact.
    pub before: Quantiles,
    /// After the step of the first contact.
    pub contact: Quantiles,
    /// After the three steps that follow.
    pub soon: Quantiles,
    /// After later ones.
    pub later: Quantiles,
    /// After all steps.
    pub all: Quantiles,
    /// After one step of touching agents, both engines from the kernel's state.
    pub one_step: Quantiles,
    /// After all steps: the kernel beside one whose start is disturbed by the size of a recording's rounding.
    pub disturbed: Quantiles,
    /// After all steps: the kernel beside one disturbed by the world's median error at the first contact.
    pub disturbed_as_world: Quantiles,
}

/// Compares the engines in meetings drawn with `seeds`; draws without a meeting do not count.
#[must_use]
pub fn meetings(seeds: core::ops::Range<u64>) -> Meetings {
    let mut found = Meetings::default();
    let mut errors: [Vec<f32>; 7] = Default::default();
    for seed in seeds {
        let mut random = stream(seed, Purpose::Scene, 0);
        let Some((physics, start)) = two_agents(&mut random) else { continue };
        let actions = actions(Doing::Anything, STEPS, &mut random);
        let run = |kind, start: &State| {
            let mut engine = Running::new(kind, &physics, start);
            actions.iter().map(|&actions| engine.step(actions)).collect::<Vec<_>>()
        };
        let kernel = run(Kind::KernelWithCache, &start);
        let touches = |step: &[State; 5]| step.iter().any(|state| state.contacts != Contacts::NONE);
        let Some(first) = kernel.iter().position(touches) else { continue };
        found.count += 1;
        let world = run(Kind::World, &start);
        let moved = |by: f32| {
            let mut start = start;
            start.bodies[0].position.x += by;
            run(Kind::KernelWithCache, &start)
        };
        let [rounded, as_far] = [DISTURBANCE, ERROR_AT_CONTACT].map(moved);
        for (step, states) in kernel.iter().enumerate() {
            let distance = |other: &[[State; 5]]| apart(&physics, &states[4], &other[step][4]);
            let phase = match step.checked_sub(first) {
                None => 0,
                Some(0) => 1,
                Some(1..4) => 2,
                Some(_) => 3,
            };
            errors[phase].push(distance(&world));
            errors[5].push(distance(&rounded));
            errors[6].push(distance(&as_far));
            if step > 0 && touches(states) {
                let begin = &kernel[step - 1][4];
                let [a, b] = [Kind::World, Kind::Kernel]
                    .map(|kind| Running::new(kind, &physics, begin).step(actions[step])[4]);
                errors[4].push(apart(&physics, &a, &b));
            }
        }
    }
    found.all = quantiles(&errors[..4].concat());
    let [before, contact, soon, later, one_step, rounded, as_far] = errors.map(|errors| quantiles(&errors));
    Meetings {
        before,
        contact,
        soon,
        later,
        one_step,
        disturbed: rounded,
        disturbed_as_world: as_far,
        ..found
    }
}

/// Two agents at rest, 2.5 to 6 u apart, inside the arena, turned anywhere.
fn two_agents(draw: &mut impl Draw) -> Option<(PhysicsConfig, State)> {
    let mut physics = physique(draw);
    physics.object_count = 0;
    physics.walls.clear();
    let first = arena::CENTRE + Vec2::new(draw.between(-6.0, 6.0), draw.between(-6.0, 6.0));
    let second = first + Vec2::from_angle(draw.between(-3.2, 3.2)) * draw.between(2.5, 6.0);
    let [a, b] = [first, second].map(|place| Body::at_rest(place, draw.between(-3.2, 3.2)));
    let start = State::new([a, b, Body::default(), Body::default()]);
    /// Clearance at the start (u).
    const ROOM: f32 = 0.05;
    let mut outlines = physics.entities().map(|entity| outline(&physics, &start, entity, ROOM));
    let a = outlines.next()?;
    let b = outlines.next()?;
    (!a.overlaps(&b) && a.inside_arena() && b.inside_arena()).then_some((physics, start))
}
