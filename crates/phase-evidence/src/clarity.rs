//! The clarity of an event: knots, and how it ends.

use crate::{Track, contact, outcome, rest};
use core::ops::Range;
use phase_model::{AGENT_COUNT, AgentId, Entity, Goal, ObjectId, Scene, Sign, State};
use phase_predicates::landmark_lead;

/// An object that both agents are at gets on where it leaves its place by this distance (u).
const PROGRESS: f32 = 1.0;
/// Least duration of a knot (steps; 1 s).
const MIN_KNOT: usize = 4;
/// Turning by this much within [`MIN_KNOT`] steps is spinning (rad): a quarter turn.
const SPIN: f32 = core::f32::consts::FRAC_PI_2;
/// Steps at the end in which trembling is looked for (2 s).
const END: usize = 8;
/// A body that stays within this distance of where it was trembles rather than moves (u).
const TREMBLING: f32 = 0.3;
/// Least way of a body in the last third of an event for something to change there (u).
const MIN_CHANGE: f32 = 1.0;

/// The clarity of an event, judged by outlines alone, so that recordings and simulations are measured alike.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Clarity {
    /// Share of the steps in knots, 0 to 1: both agents are at one object for a second or more, it stays
    /// within 1 u of its place, and the goal of neither of them holds.
    pub knotted: f64,
    /// Duration of the knot that the event ends in (steps); 0 if it ends in none.
    pub knot_at_end: usize,
    /// Share of the steps in which an agent at an object turns by a quarter or more within a second while
    /// the object stays within 1 u of its place, 0 to 1.
    pub spinning: f64,
    /// Share of the last 2 s in which something moves, though every body stays within 0.3 u of its place; 0
    /// if one leaves it.
    pub trembling: f64,
    /// Distance (u) of the subject of each agent's goal from where it is wanted, at the end; for goals to
    /// keep something from happening, from where it is not wanted.
    pub remaining: [f64; AGENT_COUNT],
    /// Whether each agent is at an object at the end.
    pub at_object: [bool; AGENT_COUNT],
    /// Whether a body goes 1 u or more in the last third.
    pub changes_late: bool,
    /// Duration of the rest at the end (steps): every body stays within 0.3 u of where it ends.
    pub rest_at_end: usize,
    /// Duration for which each agent [tries](steps_trying) (steps).
    pub trying: [usize; AGENT_COUNT],
    /// The lead by which motion [shows the landmark](landmark_shown) of each agent's goal (u); `None` for a
    /// goal about another body.
    pub shown: [Option<f64>; AGENT_COUNT],
}

impl Clarity {
    /// The clarity of a whole track; `None` if it has no steps.
    #[must_use]
    pub fn of(scene: &Scene, track: &Track) -> Option<Self> {
        let steps = track.steps();
        let last = track.states.last()?;
        if steps == 0 {
            return None;
        }
        let knots = knots(scene, track);
        let knotted: usize = knots.iter().map(Range::len).sum();
        let positive = |goal: Goal| if goal.sign() == Sign::Positive { goal } else { goal.negated() };
        let remaining = scene.goals().map(|goal| f64::from(positive(goal).distance(last)));
        let at_object = AgentId::ALL
            .map(|agent| track.physics.objects().any(|object| is_at(track, steps, agent, object)));
        let late = steps - steps / 3;
        let moves = |entity: Entity| {
            let place = track.states[late].position(entity);
            track.states[late..].iter().any(|state| state.position(entity).distance(place) >= MIN_CHANGE)
        };
        Some(Self {
            knotted: knotted as f64 / steps as f64,
            knot_at_end: knots.iter().filter(|knot| knot.end > steps).map(Range::len).max().unwrap_or(0),
            spinning: spinning(track),
            trembling: trembling(track),
            remaining,
            at_object,
            changes_late: track.physics.entities().any(moves),
            rest_at_end: rest_at_end(track),
            trying: AgentId::ALL.map(|agent| steps_trying(track, agent, scene.agents[agent].goal)),
            shown: scene.goals().map(|goal| landmark_shown(track, goal)),
        })
    }
}

/// Number of states in which an agent is seen to try, by outlines: it is at the object that it wants
/// somewhere, or, if it wants to be somewhere itself, at any object; or it is at the other agent.
#[must_use]
pub fn steps_trying(track: &Track, agent: AgentId, goal: Goal) -> usize {
    let is_wanted = |object: &ObjectId| match goal.subject() {
        Entity::Object(wanted) => wanted == *object,
        Entity::Agent(_) => true,
    };
    let objects = track.physics.objects().filter(is_wanted).map(Entity::Object);
    let others: Vec<Entity> = objects.chain([Entity::Agent(agent.other())]).collect();
    let is_at = |state: &&State| {
        others.iter().any(|&other| contact::near(&track.physics, state, Entity::Agent(agent), other))
    };
    track.states.iter().filter(is_at).count()
}

/// By how much more the subject of a goal has come closer to the goal's landmark than to every other one,
/// where that is most (u): so plainly motion shows the landmark. At least 0; `None` for a goal about another
/// body.
///
/// A goal that is thwarted from the start shows by 0: whichever landmark an agent wants, it is seen to do the
/// same.
#[must_use]
pub fn landmark_shown(track: &Track, goal: Goal) -> Option<f64> {
    let wanted = goal.landmark()?;
    let place = |state: &State| state.position(goal.subject());
    let start = place(track.states.first()?);
    let lead = |state: &State| landmark_lead(start, place(state), wanted);
    Some(f64::from(track.states.iter().map(lead).fold(0.0, f32::max)))
}

/// The steps of each knot, in order of time: the first of them, and the one after the last.
#[must_use]
pub fn knots(scene: &Scene, track: &Track) -> Vec<Range<usize>> {
    let of = |object: ObjectId| knots_at(scene, track, object);
    let mut knots: Vec<Range<usize>> = track.physics.objects().flat_map(of).collect();
    knots.sort_by_key(|knot| knot.start);
    knots
}

/// The steps of each knot at one object, in order of time.
fn knots_at(scene: &Scene, track: &Track, object: ObjectId) -> Vec<Range<usize>> {
    let mut knots = Vec::new();
    let place = |t: usize| track.states[t].position(Entity::Object(object));
    let mut from = None;
    for t in 0..=track.states.len() {
        let is_jammed = t < track.states.len()
            && AgentId::ALL.into_iter().all(|agent| is_at(track, t, agent, object))
            && !is_reached(scene, track, t);
        let goes_on = from.is_some_and(|from: usize| is_jammed && place(from).distance(place(t)) < PROGRESS);
        if goes_on {
            continue;
        }
        knots.extend(from.map(|from| from..t).filter(|knot| knot.len() >= MIN_KNOT));
        from = is_jammed.then_some(t);
    }
    knots
}

/// A knot and what comes of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Standstill {
    /// Its duration.
    pub duration: Duration,
    /// For how long an agent keeps off the object, if it leaves it to the other after the knot and before the
    /// next one.
    pub kept_off: Option<Duration>,
}

/// The time that something lasts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Duration {
    /// Number of steps.
    pub steps: usize,
    /// Whether the event ends before it does.
    pub is_cut: bool,
}

/// The knots of an event, and what comes of them.
#[must_use]
pub fn standstills(scene: &Scene, track: &Track) -> Vec<Standstill> {
    let mut standstills = Vec::new();
    let end = track.states.len();
    for object in track.physics.objects() {
        let at = |t: usize, agent: AgentId| is_at(track, t, agent, object);
        let knots = knots_at(scene, track, object);
        for (k, knot) in knots.iter().enumerate() {
            let next = knots.get(k + 1).map_or(end, |next| next.start);
            let left = (knot.end..next).find(|&t| at(t, AgentId::ZERO) != at(t, AgentId::ONE));
            let kept_off = left.map(|left| {
                let off = if at(left, AgentId::ZERO) { AgentId::ONE } else { AgentId::ZERO };
                let back = (left..end).find(|&t| at(t, off));
                Duration { steps: back.unwrap_or(end) - left, is_cut: back.is_none() }
            });
            let duration = Duration { steps: knot.len(), is_cut: knot.end >= end };
            standstills.push(Standstill { duration, kept_off });
        }
    }
    standstills
}

/// Whether the positive goal of an agent holds at a step.
fn is_reached(scene: &Scene, track: &Track, t: usize) -> bool {
    let wanted = scene.goals().into_iter().filter(|goal| goal.sign() == Sign::Positive);
    wanted.into_iter().any(|goal| outcome::condition(&track.physics, &track.states[t], goal))
}

/// Whether an agent touches an object at a step, as far as outlines show.
fn is_at(track: &Track, t: usize, agent: AgentId, object: ObjectId) -> bool {
    contact::near(&track.physics, &track.states[t], Entity::Agent(agent), Entity::Object(object))
}

fn rest_at_end(track: &Track) -> usize {
    let Some(last) = track.states.last() else { return 0 };
    let is_there = |state: &&State| {
        track.physics.entities().all(|it| state.position(it).distance(last.position(it)) < TREMBLING)
    };
    track.states.iter().rev().take_while(is_there).count() - 1
}

fn spinning(track: &Track) -> f64 {
    let angle = |t: usize, agent: AgentId| track.states[t].body(Entity::Agent(agent)).angle;
    let spins = |t: usize, agent: AgentId| {
        let before = t - MIN_KNOT;
        track.physics.objects().any(|object| {
            let place = |t: usize| track.states[t].position(Entity::Object(object));
            is_at(track, t, agent, object)
                && is_at(track, before, agent, object)
                && place(before).distance(place(t)) < PROGRESS
                && (angle(t, agent) - angle(before, agent)).abs() >= SPIN
        })
    };
    let steps = (MIN_KNOT..track.states.len()).filter(|&t| AgentId::ALL.into_iter().any(|it| spins(t, it)));
    steps.count() as f64 / track.steps() as f64
}

fn trembling(track: &Track) -> f64 {
    let from = track.steps().saturating_sub(END);
    let states = &track.states[from..];
    let stays = |entity: Entity| {
        states.iter().all(|state| state.position(entity).distance(states[0].position(entity)) < TREMBLING)
    };
    if !track.physics.entities().all(stays) {
        return 0.0;
    }
    let moving = (from + 1..track.states.len()).filter(|&t| !rest::is_still(track, t)).count();
    moving as f64 / (track.states.len() - 1 - from).max(1) as f64
}
