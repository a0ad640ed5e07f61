//! In what manner an agent helped or hindered the other, or met it.

use crate::{
    Discovery, GoalOutcome, Track, blocking, contact,
    holding::{self, CarryStatistics},
    outcome,
};
use phase_event::Event;
use phase_model::{AgentId, Attitude, Entity, EventKind, Goal, ObjectId, Scene, State};
use phase_navigation::Map;
use serde::{Deserialize, Serialize};

/// Behaviour that makes the kind of a social event visible. Judged by motion and grips, whatever was
/// intended; only the last four, in which an agent finds out what the other wants, are judged by its
/// thoughts.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Manner {
    /// The helper brings the object; the helpee may lend a hand.
    Fetching,
    /// The helper brings the object part of the way, and the helpee takes it on.
    HandingOver,
    /// Both carry the object at once.
    CarryingAlong,
    /// The helper moves an object that the goal is not about.
    Clearing,
    /// The helper, with empty hands, leaves a place at which it obstructed the helpee.
    MakingWay,
    /// The hinderer stands in the victim's door or path and meets it there.
    Blocking,
    /// The hinderer takes the object after the victim has touched it, and carries it off.
    Taking,
    /// Both hold the object, and it moves.
    Dragging,
    /// The hinderer carries the object off before the victim has touched it.
    Hiding,
    /// The victim's goal has been reached and, through the hinderer, holds no longer.
    Undoing,
    /// The hinderer carries the object off while the victim perceives neither of them.
    HiddenHindering,
    /// Two with goals of their own pass the same place within two seconds.
    Crossing,
    /// The helper or hinderer does not know the other's goal and watches for two seconds before it acts.
    WatchingFirst,
    /// The helper or hinderer acts on a wrong idea of what the other wants, and then on the right one.
    Correcting,
    /// The helper acts for a second while it is rather sure of a wrong goal, whatever it does then.
    MistakenHelp,
    /// The helper watches the other move and so learns what that wants, then acts on it.
    LeadingByShowing,
}

/// Minimum duration for something to be seen (steps).
const MIN_STEPS: usize = 3;
/// Minimum distance for an object to count as carried (u).
const MIN_CARRIED: f32 = 1.0;
/// Minimum distance for an object to count as fetched or carried off (u).
const MIN_FETCHED: f32 = 3.0;
/// Least growth of the distance from its landmark for an object to count as taken away (u).
const MIN_TAKEN: f32 = 2.0;
/// Minimum distance for an object to count as cleared, and for an agent to have left its place (u).
const MIN_CLEARED: f32 = 1.0;
/// Minimum time in the way of another that counts as blocking (steps).
const MIN_BLOCKING: usize = 8;
/// Time within which two paths count as crossing (steps).
const CROSSING_WINDOW: usize = 8;
/// Minimum path of both agents around a crossing (u).
const MIN_CROSSING_PATH: f32 = 2.0;

impl Manner {
    /// All manners, by kind of event.
    pub const ALL: [Self; 16] = [
        Self::Fetching,
        Self::HandingOver,
        Self::CarryingAlong,
        Self::Clearing,
        Self::MakingWay,
        Self::Blocking,
        Self::Taking,
        Self::Dragging,
        Self::Hiding,
        Self::Undoing,
        Self::HiddenHindering,
        Self::Crossing,
        Self::WatchingFirst,
        Self::Correcting,
        Self::MistakenHelp,
        Self::LeadingByShowing,
    ];

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fetching => "fetching",
            Self::HandingOver => "handing-over",
            Self::CarryingAlong => "carrying-along",
            Self::Clearing => "clearing",
            Self::MakingWay => "making-way",
            Self::Blocking => "blocking",
            Self::Taking => "taking",
            Self::Dragging => "dragging",
            Self::Hiding => "hiding",
            Self::Undoing => "undoing",
            Self::HiddenHindering => "hidden-hindering",
            Self::Crossing => "crossing",
            Self::WatchingFirst => "watching-first",
            Self::Correcting => "correcting",
            Self::MistakenHelp => "mistaken-help",
            Self::LeadingByShowing => "leading-by-showing",
        }
    }

    /// The manners that a simulated event shows: those of its motion, and those of an agent that finds out
    /// what the other wants.
    #[must_use]
    pub fn of_event(event: &Event, track: &Track) -> Vec<Self> {
        let mut manners = Self::shown(&event.scene, track);
        if let Some(discovery) = Discovery::of(event) {
            manners.extend(discovery.watches_first().then_some(Self::WatchingFirst));
            manners.extend(discovery.corrects_itself().then_some(Self::Correcting));
            if event.scene.kind == EventKind::Helping {
                manners.extend(discovery.is_misled().then_some(Self::MistakenHelp));
                let helper = social_agent(&event.scene);
                manners.extend(discovery.is_shown(track, helper).then_some(Self::LeadingByShowing));
            }
        }
        manners
    }

    /// The manners that motion shows; several may apply, and none where the kind of event has no manners.
    #[must_use]
    pub fn shown(scene: &Scene, track: &Track) -> Vec<Self> {
        Self::ALL.into_iter().filter(|manner| manner.is_shown(scene, track)).collect()
    }

    /// Whether motion shows this manner; never for those that only thoughts tell.
    #[must_use]
    pub fn is_shown(self, scene: &Scene, track: &Track) -> bool {
        if self.kind() != Some(scene.kind) {
            return false;
        }
        let social = social_agent(scene);
        let other = social.other();
        let goal = scene.agents[other].goal;
        let object = goal_object(goal);
        let about =
            |test: fn(&Track, AgentId, ObjectId) -> bool| object.is_some_and(|it| test(track, social, it));
        match self {
            Self::Fetching => about(fetched),
            Self::HandingOver => about(handed_over),
            Self::CarryingAlong => about(|track, _, object| carried_by_both(track, object)),
            Self::Clearing => cleared(scene, track, social, object),
            Self::MakingWay => made_way(scene, track, social, goal),
            Self::Blocking => blocked(scene, track, social, goal),
            Self::Taking => object.is_some_and(|it| taken(track, social, it, goal)),
            Self::Dragging => about(|track, _, object| carried_by_both(track, object)),
            Self::Hiding => object.is_some_and(|it| hidden(track, social, it, goal)),
            Self::Undoing => undone(track, social, goal),
            Self::HiddenHindering => {
                object.is_some_and(|it| is_off(holding::carried_unseen(track, social, it), goal, 0.0))
            }
            Self::Crossing => crossed(track),
            Self::WatchingFirst | Self::Correcting | Self::MistakenHelp | Self::LeadingByShowing => false,
        }
    }

    /// The kind of event that it is a manner of; `None` for those both of helping and of hindering.
    #[must_use]
    pub const fn kind(self) -> Option<EventKind> {
        Some(match self {
            Self::Fetching
            | Self::HandingOver
            | Self::CarryingAlong
            | Self::Clearing
            | Self::MakingWay
            | Self::MistakenHelp
            | Self::LeadingByShowing => EventKind::Helping,
            Self::Blocking
            | Self::Taking
            | Self::Dragging
            | Self::Hiding
            | Self::Undoing
            | Self::HiddenHindering => EventKind::Hindering,
            Self::Crossing => EventKind::Independent,
            Self::WatchingFirst | Self::Correcting => return None,
        })
    }
}

/// The agent with a social utility weight; agent 0 where there is none.
pub(crate) fn social_agent(scene: &Scene) -> AgentId {
    let is_social = |agent: &AgentId| scene.agents[*agent].attitude != Attitude::Neutral;
    AgentId::ALL.into_iter().find(is_social).unwrap_or(AgentId::ZERO)
}

/// The goal's object, if it is about one.
pub(crate) const fn goal_object(goal: Goal) -> Option<ObjectId> {
    match goal {
        Goal::ObjectOnLandmark { object, .. } => Some(object),
        Goal::AgentOnLandmark { .. } | Goal::Touch { .. } => None,
    }
}

fn fetched(track: &Track, helper: AgentId, object: ObjectId) -> bool {
    let alone = holding::carried_alone(track, helper, object);
    alone.steps >= MIN_STEPS && alone.distance >= MIN_FETCHED
}

fn handed_over(track: &Track, helper: AgentId, object: ObjectId) -> bool {
    let first = |agent: AgentId| track.states.iter().position(|state| state.holds(agent, object));
    let in_order = matches!((first(helper), first(helper.other())), (Some(one), Some(other)) if one < other);
    in_order && carried_far(track, helper, object) && carried_far(track, helper.other(), object)
}

fn carried_far(track: &Track, agent: AgentId, object: ObjectId) -> bool {
    let alone = holding::carried_alone(track, agent, object);
    alone.steps >= MIN_STEPS && alone.distance >= MIN_CARRIED
}

pub(crate) fn carried_by_both(track: &Track, object: ObjectId) -> bool {
    let both = holding::carried_together(track, object);
    both.steps >= MIN_STEPS && both.distance >= MIN_CARRIED
}

/// The helper holds or pushes an object that is not the goal's, and the helpee does not touch it meanwhile.
fn cleared(scene: &Scene, track: &Track, helper: AgentId, object: Option<ObjectId>) -> bool {
    let others = ObjectId::ALL.into_iter().take(scene.objects.len()).filter(|&it| Some(it) != object);
    let moved_by = |other: ObjectId| {
        let one = Entity::Agent(helper);
        let it = Entity::Object(other);
        let at = |state: &State, agent| contact::touching(&track.physics, state, Entity::Agent(agent), it);
        let steps = (1..track.states.len()).filter(|&t| {
            let state = &track.states[t];
            (state.holds(helper, other) || contact::touching(&track.physics, state, one, it))
                && !at(state, helper.other())
        });
        steps.map(|t| track.distance_in_step(it, t)).sum::<f32>()
    };
    others.map(moved_by).fold(0.0, f32::max) >= MIN_CLEARED
}

/// The helper obstructs the helpee at some time, holds nothing, and later has left that place while the
/// helpee has come closer.
fn made_way(scene: &Scene, track: &Track, helper: AgentId, goal: Goal) -> bool {
    let held = track.states.iter().filter(|state| state.grips[helper].is_some()).count();
    let Some(&last) = in_the_way(scene, track, helper, goal).last() else { return false };
    let place = |t: usize, agent| track.states[t].position(Entity::Agent(agent));
    let end = track.steps();
    held < MIN_STEPS
        && place(last, helper).distance(place(end, helper)) >= MIN_CLEARED
        && goal.distance(&track.states[end]) + MIN_CLEARED <= goal.distance(&track.states[last])
}

/// The hinderer is in the way, and meets the victim.
fn blocked(scene: &Scene, track: &Track, hinderer: AgentId, goal: Goal) -> bool {
    let one = Entity::Agent(hinderer);
    let other = Entity::Agent(hinderer.other());
    in_the_way(scene, track, hinderer, goal).len() >= MIN_BLOCKING
        && contact::steps_touching(track, one, other).len() >= MIN_STEPS
}

/// Steps in which an agent is in a door of the other's way, or between it and its next target.
pub(crate) fn in_the_way(scene: &Scene, track: &Track, blocker: AgentId, goal: Goal) -> Vec<usize> {
    let target = |state: &State| blocking::next_place(goal, state);
    let mut steps = blocking::steps_blocking_a_door(track, &Map::new(scene.layout), blocker, target);
    steps.extend(blocking::steps_between(track, blocker, target));
    steps.sort_unstable();
    steps.dedup();
    steps
}

/// After the victim has touched the object, the hinderer carries it away from the victim's landmark.
fn taken(track: &Track, hinderer: AgentId, object: ObjectId, goal: Goal) -> bool {
    let Some(&first) = touching(track, hinderer.other(), object).get(MIN_STEPS) else { return false };
    let later = Track { physics: track.physics.clone(), states: track.states[first..].to_vec() };
    is_off(holding::carried(&later, hinderer, object), goal, MIN_TAKEN)
}

/// Before the victim has touched the object, the hinderer carries it off, and not towards the victim's
/// landmark.
fn hidden(track: &Track, hinderer: AgentId, object: ObjectId, goal: Goal) -> bool {
    let first = touching(track, hinderer.other(), object).first().copied().unwrap_or(track.steps());
    is_off(holding::carried(&track.until(first), hinderer, object), goal, 0.0)
}

/// An object is carried clearly, and by so much away from the goal's landmark (u).
fn is_off(carried: CarryStatistics, goal: Goal, away: f32) -> bool {
    let closer = goal.landmark().map_or(0.0, |landmark| carried.approach[landmark.index()]);
    carried.steps >= MIN_STEPS && carried.distance >= MIN_FETCHED && closer <= -away
}

/// Steps in which an agent touches or holds an object.
fn touching(track: &Track, agent: AgentId, object: ObjectId) -> Vec<usize> {
    contact::steps_touching(track, Entity::Agent(agent), Entity::Object(object))
}

/// The goal holds at some time and later not, and the hinderer was at its subject in between.
fn undone(track: &Track, hinderer: AgentId, goal: Goal) -> bool {
    let holds: Vec<bool> =
        track.states.iter().map(|state| outcome::condition(&track.physics, state, goal)).collect();
    let hinderer = Entity::Agent(hinderer);
    let subject = goal.subject();
    let lost = (1..holds.len()).filter(|&t| holds[t - 1] && !holds[t]);
    let at = |t: usize| contact::touching(&track.physics, &track.states[t], hinderer, subject);
    let caused = lost.into_iter().any(|t| (t.saturating_sub(MIN_STEPS)..=t).any(at));
    let long_enough = holds.iter().filter(|holds| **holds).count() >= MIN_STEPS;
    caused && long_enough && !GoalOutcome::of(track, goal).reached
}

/// Both move, and pass the same place within the window.
fn crossed(track: &Track) -> bool {
    let reach = track.physics.agents[0].radius + track.physics.agents[1].radius;
    let end = track.states.len();
    let moved = |agent: AgentId, t: usize| {
        let window = t.saturating_sub(CROSSING_WINDOW)..(t + CROSSING_WINDOW).min(end);
        track.distance_travelled(Entity::Agent(agent), window) >= MIN_CROSSING_PATH
    };
    let place = |agent: AgentId, t: usize| track.states[t].position(Entity::Agent(agent));
    (0..end).any(|t| {
        moved(AgentId::ZERO, t)
            && (t.saturating_sub(CROSSING_WINDOW)..(t + CROSSING_WINDOW).min(end)).any(|other| {
                place(AgentId::ZERO, t).distance(place(AgentId::ONE, other)) <= reach
                    && moved(AgentId::ONE, other)
            })
    })
}
