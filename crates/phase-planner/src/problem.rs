//! A physical state as represented in the high-level planner: a few named locations and what lies between
//! them.

use crate::parameters::PlannerParameters;
use phase_model::{
    AGENT_COUNT, AgentId, BodySet, Entity, LandmarkId, MAX_OBJECTS, ObjectId, PhysicsConfig, RoomId, SlotId,
    State, Vec2, arena, layout::SLOT_DIRECTIONS, physics::GROUND_FRICTION,
};
use phase_navigation::{Gaps, Map, Route};

/// A location that a plan can refer to: where an entity is now, or a landmark's centre.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Location {
    /// The place of an entity in the physical state that the plan starts from.
    Current(Entity),
    /// A landmark's centre.
    Landmark(LandmarkId),
    /// In a room, just inside the door in a slot.
    Inside {
        /// The slot of the door.
        slot: SlotId,
        /// The room.
        room: RoomId,
    },
}

/// A physical state as the high level sees it: named locations, widths of doors, forces and costs.
///
/// Everything that several searches from one state share is computed once, by [`new`](Self::new): above all
/// the part of each door that objects leave passable, for every set of objects that may have been moved.
#[derive(Clone, Copy, Debug)]
pub struct PlanningProblem<'a> {
    /// Bodies and forces. Walls are those of `map`.
    pub physics: &'a PhysicsConfig,
    /// Rooms, doors and the ways between them.
    pub map: &'a Map,
    /// The physical state.
    pub state: &'a State,
    /// The numbers that shape plans.
    pub parameters: PlannerParameters,
    /// The passable part of each door for each agent while a set of objects, the bits of the index, are still
    /// where they are now.
    gaps: [[Gaps; 1 << MAX_OBJECTS]; AGENT_COUNT],
    /// For each object, whether it blocks a door for some agent at its current position.
    blockers: [bool; MAX_OBJECTS],
}

impl<'a> PlanningProblem<'a> {
    /// Computes which doors the objects obstruct.
    #[must_use]
    pub fn new(
        physics: &'a PhysicsConfig,
        map: &'a Map,
        state: &'a State,
        parameters: PlannerParameters,
    ) -> Self {
        let gaps = AgentId::ALL.map(|agent| {
            core::array::from_fn(|mask| {
                let mut gaps = *map.gaps();
                for object in physics.objects().filter(|object| mask & 1 << object.index() != 0) {
                    let radius = physics.object_radii[object];
                    // A held object is not put down before there is room to turn between it and the door.
                    let in_hand = AgentId::ALL.into_iter().any(|holder| state.holds(holder, object));
                    let own = physics.agents[agent];
                    let reach = radius + if in_hand { own.width() } else { own.radius };
                    gaps.obstruct(state.position(Entity::Object(object)), radius, reach);
                }
                gaps
            })
        });
        let mut problem = Self { physics, map, state, parameters, gaps, blockers: [false; MAX_OBJECTS] };
        for object in physics.objects() {
            problem.blockers[object] =
                AgentId::ALL.into_iter().any(|agent| problem.narrows_a_door(object, agent));
        }
        problem
    }

    /// Whether an object, where it is now, narrows some door too much for an agent that would otherwise fit
    /// through it.
    #[must_use]
    pub const fn blocks_a_door(&self, object: ObjectId) -> bool {
        self.blockers[object.index()]
    }

    /// Position of a location (u).
    #[must_use]
    pub fn position(&self, location: Location) -> Vec2 {
        match location {
            Location::Current(entity) => self.map.layout().place_of(self.physics, self.state, entity),
            Location::Landmark(landmark) => arena::LANDMARKS[landmark],
            Location::Inside { slot, room } => {
                let middle = self.map.gaps().middle(slot).unwrap_or(arena::CENTRE);
                let across = SLOT_DIRECTIONS[slot].perp();
                let inwards = across.dot(arena::LANDMARKS[room.landmark()] - middle).signum();
                middle + across * inwards * self.parameters.passing_depth
            }
        }
    }

    /// The cheapest route for a body of some width (u) through doors with these gaps, at the price
    /// [`PlannerParameters::impassable`] of a door that is too narrow; `None` if walls separate the two
    /// points.
    #[must_use]
    pub fn route(&self, from: Vec2, to: Vec2, width: f32, gaps: &Gaps) -> Option<Route> {
        self.map.route(from, to, width, gaps, self.parameters.impassable)
    }

    /// Cost of that route (u), finite even where there is none; see [`Map::route_cost`].
    #[must_use]
    pub fn route_cost(&self, from: Vec2, to: Vec2, width: f32, gaps: &Gaps) -> f32 {
        self.map.route_cost(from, to, width, gaps, self.parameters.impassable)
    }

    /// The doors as they are for an agent while the objects in `unmoved` are still where they are now. Agents
    /// in the set are ignored.
    #[must_use]
    pub const fn gaps(&self, agent: AgentId, unmoved: BodySet) -> &Gaps {
        &self.gaps[agent.index()][object_bits(unmoved)]
    }

    /// Width of an agent, with or without a held object (u).
    #[must_use]
    pub fn width(&self, agent: AgentId, held: Option<ObjectId>) -> f32 {
        let own = self.physics.agents[agent].width();
        held.map_or(own, |object| own.max(2.0 * self.physics.object_radii[object]))
    }

    /// Distance between the centres of an agent and an object that touch (u).
    #[must_use]
    pub fn arm(&self, agent: AgentId, object: ObjectId) -> f32 {
        self.physics.agents[agent].radius + self.physics.radius(Entity::Object(object))
    }

    /// Net force for moving an object when these agents hold it and pull in the same direction, each body's
    /// ground friction subtracted (N). The load moves only if it is positive.
    #[must_use]
    pub fn net_force(&self, holders: [bool; AGENT_COUNT]) -> f32 {
        let mut net = -GROUND_FRICTION;
        for agent in AgentId::ALL.into_iter().filter(|&agent| holders[agent]) {
            net += self.physics.agents[agent].max_force - GROUND_FRICTION;
        }
        net
    }
}

/// The objects of a set as bits from the lowest on.
const fn object_bits(set: BodySet) -> usize {
    (set.bits() >> AGENT_COUNT) as usize & ((1 << MAX_OBJECTS) - 1)
}

impl PlanningProblem<'_> {
    /// Whether an agent stands in a door that an object on the side of the point `to` blocks for it.
    pub(crate) fn stops_in_door(&self, agent: AgentId, object: ObjectId, to: Vec2) -> bool {
        if !self.blocks_a_door(object) {
            return false;
        }
        let width = self.width(agent, None);
        let narrowed = self.gaps(agent, BodySet::from_iter([Entity::Object(object)]));
        let here = self.state.position(Entity::Agent(agent)) - arena::CENTRE;
        let there = self.state.position(Entity::Object(object)) - arena::CENTRE;
        SlotId::ALL.into_iter().zip(SLOT_DIRECTIONS).any(|(slot, direction)| {
            let across = |offset: Vec2| direction.perp_dot(offset);
            let is_in_door = across(here).abs() < 0.5 * width
                && self.map.gaps().0[slot].is_some_and(|(low, high)| {
                    let along = direction.dot(here);
                    low < along && along < high
                });
            is_in_door
                && self.map.gaps().width(slot) >= width
                && narrowed.width(slot) < width
                && across(there).signum() == across(to - arena::CENTRE).signum()
        })
    }

    fn narrows_a_door(&self, object: ObjectId, agent: AgentId) -> bool {
        let width = self.width(agent, None);
        SlotId::ALL.into_iter().any(|slot| {
            let narrowed = self.gaps(agent, BodySet::from_iter([Entity::Object(object)]));
            self.map.gaps().width(slot) >= width && narrowed.width(slot) < width
        })
    }
}
