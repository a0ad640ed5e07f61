//! A drawn scene and the measures that decide whether it is kept: distances, openings, forces, view.

use super::walk::{Walk, walk};
use phase_evidence::outcome;
use phase_model::{
    AgentId, Entity, EventKind, Flip, Goal, ObjectId, RoomId, Scene, Segment, Vec2, arena, layout::room_of,
};
use phase_navigation::Crossing;

/// Width of the gap that an agent of radius R needs, over R: its base is 3R wide.
const BASE: f32 = 3.0;

/// Distance from the middle of an opening, along both axes, to a point inside a room (u).
const BESIDE_OPENING: f32 = 0.1;

/// A drawn scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate<'a>(pub &'a Scene);

/// Walks of an agent for its goal: the way to an object, if the goal is about one, and on to the target.
#[derive(Clone, Debug)]
pub(super) struct Errand {
    /// Rooms through which the ways lead.
    pub rooms: Vec<RoomId>,
    /// The way to the object, if the goal is about one.
    pub approach: Option<Walk>,
    /// The way to the target, with the object if there is one.
    pub delivery: Walk,
}

impl Errand {
    /// All crossings, in order.
    pub(super) fn crossings(&self) -> impl Iterator<Item = &Crossing> {
        let approach = self.approach.iter().flat_map(|walk| &walk.crossings);
        approach.chain(&self.delivery.crossings)
    }

    /// The openings that a wall narrows, in order.
    pub(super) fn doors(&self) -> impl Iterator<Item = &Crossing> {
        self.crossings().filter(|crossing| crossing.is_door())
    }
}

impl Candidate<'_> {
    /// Whether the scene can be simulated in every reflection, has the kind it is labelled as, and no goal's
    /// condition holds at the start.
    #[must_use]
    pub(super) fn is_sound(&self) -> bool {
        let scene = self.0;
        let mirrored = Flip::ALL.into_iter().filter_map(|flip| scene.mirrored(flip));
        let valid = |scene: &Scene| scene.validate_without_overlap().is_ok();
        let physics = scene.physics();
        let state = scene.initial_state();
        scene.layout.flip().is_none()
            && valid(scene)
            && mirrored.into_iter().all(|mirrored| valid(&mirrored))
            && EventKind::of(scene.goals(), scene.attitudes()) == scene.kind
            && !scene.goals().into_iter().any(|goal| outcome::condition(&physics, &state, goal))
    }

    pub(super) fn position(&self, agent: AgentId) -> Vec2 {
        self.0.agents[agent].start.position
    }

    pub(super) fn room(&self, agent: AgentId) -> RoomId {
        room_of(self.position(agent))
    }

    /// Radius R (u).
    pub(super) fn radius(&self, agent: AgentId) -> f32 {
        self.0.agents[agent].size.radius()
    }

    /// Width of the openings the agent fits through (u).
    pub(super) fn width(&self, agent: AgentId) -> f32 {
        BASE * self.radius(agent)
    }

    /// Maximum force (N).
    pub(super) fn force(&self, agent: AgentId) -> f32 {
        self.0.agents[agent].strength.max_force()
    }

    /// The object that an agent's goal is about: position and radius (u).
    pub(super) fn object(&self, agent: AgentId) -> Option<(Vec2, f32)> {
        let object = object_of(self.0.agents[agent].goal)?;
        self.0.objects.get(object.index()).map(|object| (object.start.position, object.size.radius()))
    }

    /// An agent's way to a point.
    pub(super) fn way(&self, agent: AgentId, to: Vec2) -> Option<Walk> {
        walk(self.0.layout, self.position(agent), to, self.width(agent))
    }

    /// Length of an agent's way to the object of a goal (u).
    pub(super) fn distance_to_object(&self, agent: AgentId) -> Option<f32> {
        let (object, _) = self.object(agent)?;
        Some(self.way(agent, object)?.length)
    }

    /// Errand of an agent for its own goal, whatever the goal's sign. `None` if it does not fit through
    /// the openings on any way.
    pub(super) fn errand(&self, agent: AgentId) -> Option<Errand> {
        let target = match self.0.agents[agent].goal {
            Goal::AgentOnLandmark { landmark, .. } | Goal::ObjectOnLandmark { landmark, .. } => {
                arena::LANDMARKS[landmark]
            }
            Goal::Touch { .. } => self.position(agent.other()),
        };
        let (approach, delivery) = match self.object(agent) {
            Some((object, radius)) => {
                let width = self.width(agent).max(2.0 * radius);
                (Some(self.way(agent, object)?), walk(self.0.layout, object, target, width)?)
            }
            None => (None, self.way(agent, target)?),
        };
        let mut rooms = vec![self.room(agent)];
        let walks = approach.iter().chain([&delivery]);
        rooms.extend(walks.flat_map(|walk| &walk.crossings).map(|crossing| crossing.to));
        Some(Errand { rooms, approach, delivery })
    }

    /// Whether an errand leads through no room in which the other agent starts.
    pub(super) fn avoids_other(&self, errand: &Errand, agent: AgentId) -> bool {
        !errand.rooms.contains(&self.room(agent.other()))
    }

    /// Whether an errand leads through no room with an object that no goal is about.
    pub(super) fn avoids_distractors(&self, errand: &Errand) -> bool {
        let wanted: Vec<ObjectId> = self.0.goals().into_iter().filter_map(object_of).collect();
        let distractors = ObjectId::ALL.into_iter().zip(&self.0.objects);
        distractors
            .filter(|(object, _)| !wanted.contains(object))
            .all(|(_, object)| !errand.rooms.contains(&room_of(object.start.position)))
    }

    /// Length of an agent's way to the middle of an opening (u), infinite if there is none.
    pub(super) fn distance_to_opening(&self, agent: AgentId, opening: Segment) -> f32 {
        // The middle is on the border of two rooms. A point beside it in each tells which side is nearer.
        let sides = [Vec2::splat(BESIDE_OPENING), Vec2::splat(-BESIDE_OPENING)];
        let ways = sides.into_iter().filter_map(|side| self.way(agent, opening.middle() + side));
        ways.map(|walk| walk.length).fold(f32::INFINITY, f32::min)
    }
}

/// The object that a goal is about.
pub(super) const fn object_of(goal: Goal) -> Option<ObjectId> {
    match goal.subject() {
        Entity::Object(object) => Some(object),
        Entity::Agent(_) => None,
    }
}
