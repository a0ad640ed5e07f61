//! Keeping an entity away from a target, driving it to one, and staying out of its way.

use super::{Compiler, pursuit, way::Way};
use crate::PhaseParameters;
use phase_model::{Entity, LandmarkId, RoomId, Vec2, arena, layout::room_of};
use phase_navigation::{Field, Target};
use std::sync::Arc;

/// One agent influences where an entity goes, by standing in its way and pushing.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    subject: Entity,
    /// Of the entity, to the target.
    field: Arc<Field>,
    /// Whether the entity is to come to the target.
    drives: bool,
    /// The place at which the agent wants to stand, relative to the entity if it stands next to it (u).
    post: Vec2,
    /// Whether the post moves with the entity.
    is_next_to: bool,
    start: Vec2,
    way: Way,
}

impl Guard {
    /// The entity.
    pub(crate) const fn subject(&self) -> Entity {
        self.subject
    }

    fn post(&self, subject: Vec2) -> Vec2 {
        if self.is_next_to { self.post + subject - self.start } else { self.post }
    }

    /// Distance to the post, and what the entity is short of, for these places of the agent and the entity
    /// (u).
    pub(crate) fn distance(&self, here: Vec2, subject: Vec2) -> f32 {
        let to_target = self.field.distance(subject).min(arena::DIAGONAL);
        let missing = if self.drives { to_target } else { arena::DIAGONAL - to_target };
        self.way.distance(here, self.post(subject)) + missing
    }

    /// The post, or from there the entity itself.
    pub(crate) fn waypoint(&self, here: Vec2, subject: Vec2, parameters: &PhaseParameters) -> Vec2 {
        let post = self.post(subject);
        if self.is_next_to && here.distance(post) < parameters.post_distance {
            subject
        } else {
            self.way.waypoint(here, post, parameters.look_ahead)
        }
    }
}

/// The path of the other agent, or of its load, that an agent should not stand on.
#[derive(Clone, Debug)]
pub(crate) struct ClearPath {
    points: Vec<Vec2>,
    room: f32,
}

impl ClearPath {
    /// Distance (u) that the clearance from the path is short of.
    pub(crate) fn distance(&self, here: Vec2) -> f32 {
        (self.room - self.nearest(here).distance(here)).max(0.0)
    }

    /// A point directly away from the path.
    pub(crate) fn waypoint(&self, here: Vec2) -> Vec2 {
        let nearest = self.nearest(here);
        let missing = (self.room - nearest.distance(here)).max(0.0);
        let along = self.points.last().map_or(Vec2::X, |&end| (end - here).perp());
        here + (here - nearest).normalize_or(along.normalize_or(Vec2::X)) * missing
    }

    fn nearest(&self, here: Vec2) -> Vec2 {
        let mut best = self.points.first().copied().unwrap_or(here);
        for pair in self.points.windows(2) {
            let foot = phase_model::Segment { a: pair[0], b: pair[1] }.nearest(here);
            if foot.distance(here) < best.distance(here) {
                best = foot;
            }
        }
        best
    }
}

/// The point (u) at which a path from a point enters a room; `None` if it starts there.
fn entrance(field: &Field, start: Vec2, room: RoomId) -> Option<Vec2> {
    let mut last = start;
    for end in field.path(start) {
        if room_of(last) != room && room_of(end + (end - last).normalize_or_zero() * PAST_DOOR) == room {
            return Some(end);
        }
        last = end;
    }
    None
}

/// Distance (u) past a door at which a point lies inside the room. It allows for rounding and shapes no
/// behaviour.
const PAST_DOOR: f32 = 0.1;

impl Compiler<'_, '_> {
    /// Keeping an entity away from a target: the post is the first point of its path that the agent reaches
    /// before it, or directly before it.
    pub(crate) fn guard(&mut self, subject: Entity, target: Target) -> Guard {
        let mover = self.mover(subject);
        let field = self.navigator.field(target, mover, &[]);
        let me = Entity::Agent(self.agent);
        let here = self.place(me);
        let start = self.place(subject);
        let own = self.mover(me);
        let obstacles = self.obstacles(Some(subject));
        let to_me = self.navigator.field(Target::Point(here), own, &obstacles);
        let touching = self.physics.radius(me) + self.physics.radius(subject);
        let length = field.distance(start).min(2.0 * arena::DIAGONAL);
        if let Target::Room { room, .. } = target
            && let Some(door) = entrance(&field, start, room)
        {
            let way = Way::new(self.navigator, own, here, door, &obstacles);
            return Guard { subject, field, drives: false, post: door, is_next_to: false, start, way };
        }
        if length <= touching {
            return self.push_away(subject, field);
        }
        let mut ahead = touching.min(length);
        let mut post = field.waypoint(start, ahead);
        let mut is_next_to = true;
        while to_me.distance(post) > ahead && ahead < length {
            ahead = (ahead + self.parameters.interception_spacing).min(length);
            post = field.waypoint(start, ahead);
            is_next_to = false;
        }
        let way = Way::new(self.navigator, own, here, post, &obstacles);
        Guard { subject, field, drives: false, post, is_next_to, start, way }
    }

    /// Pushing an entity off a target at which it is, where nobody gets in between any more: the post is on
    /// the side from which it can be pushed far at a short way there.
    fn push_away(&mut self, subject: Entity, field: Arc<Field>) -> Guard {
        let me = Entity::Agent(self.agent);
        let here = self.place(me);
        let start = self.place(subject);
        let touching = self.physics.radius(me) + self.physics.radius(subject);
        let obstacles = self.obstacles(None);
        let own = self.mover(me);
        let to_me = self.navigator.field(Target::Point(here), own, &obstacles);
        let mut best = (f32::NEG_INFINITY, here);
        for direction in pursuit::directions(self.parameters.directions) {
            let post = start - direction * touching;
            if !self.is_free(me, post, Some(subject)) {
                continue;
            }
            let end = self.pushed(subject, start, direction);
            let gain = field.distance(end) - field.distance(start) - to_me.distance(post);
            if gain > best.0 {
                best = (gain, post);
            }
        }
        let way = Way::new(self.navigator, own, here, best.1, &obstacles);
        Guard { subject, field, drives: false, post: best.1, is_next_to: true, start, way }
    }

    /// The place at which an entity comes to a stop that is pushed straight on for at most the length of a
    /// push.
    fn pushed(&self, entity: Entity, start: Vec2, direction: Vec2) -> Vec2 {
        let mut end = start;
        while end.distance(start) < self.parameters.push_length {
            let next = end + direction * self.parameters.interception_spacing;
            if !self.is_free(entity, next, None) {
                break;
            }
            end = next;
        }
        end
    }

    /// Whether an entity would overlap no wall at a place, and no body but the agent itself and `besides`.
    fn is_free(&self, entity: Entity, place: Vec2, besides: Option<Entity>) -> bool {
        let inset = Vec2::splat(self.mover(entity).half_width);
        let overlaps = |other: Entity| {
            let apart = self.physics.radius(entity) + self.physics.radius(other);
            self.state.position(other).distance(place) < apart
        };
        let mut others = self
            .physics
            .entities()
            .filter(|&other| other != entity && other != Entity::Agent(self.agent) && Some(other) != besides);
        arena::contains(place - inset)
            && arena::contains(place + inset)
            && self.navigator.map().walls().iter().all(|wall| wall.distance(place) >= inset.x)
            && !others.any(overlaps)
    }

    /// Driving an entity to a target: the post is on its far side.
    pub(crate) fn drive(&mut self, subject: Entity, target: Target) -> Guard {
        let mover = self.mover(subject);
        let field = self.navigator.field(target, mover, &[]);
        let me = Entity::Agent(self.agent);
        let here = self.place(me);
        let start = self.place(subject);
        let own = self.mover(me);
        let forward = (field.waypoint(start, self.parameters.look_ahead) - start).normalize_or(Vec2::Y);
        let post = start - forward * (self.physics.radius(me) + self.physics.radius(subject));
        let way = Way::new(self.navigator, own, here, post, &[]);
        Guard { subject, field, drives: true, post, is_next_to: true, start, way }
    }

    /// The other's path to a landmark, if the agent is in its way; with its load if it has one.
    pub(crate) fn clear_path(&mut self, landmark: LandmarkId) -> Option<ClearPath> {
        let other = self.agent.other();
        let mover = self.state.held_object(other).map_or(Entity::Agent(other), Entity::Object);
        let wide = self.mover(Entity::Agent(other)).half_width.max(self.mover(mover).half_width);
        let width = phase_navigation::Mover { half_width: wide };
        let field = self.navigator.field(pursuit::centre(landmark), width, &[]);
        let start = self.place(mover);
        let points: Vec<Vec2> = core::iter::once(start).chain(field.path(start)).collect();
        let own = self.mover(Entity::Agent(self.agent)).half_width;
        let path = ClearPath { points, room: own + wide + self.parameters.clearance };
        (path.distance(self.state.position(Entity::Agent(self.agent))) > 0.0).then_some(path)
    }
}
