//! The symbolic planning task that A* solves: locations, grips and operator costs.

use crate::{
    problem::{Location, PlanningProblem},
    search::{SymbolicPlan, SymbolicProblem},
    symbolic::{Node, Operator},
};
use phase_model::{
    AGENT_COUNT, AgentId, Entity, Goal, LandmarkId, ObjectId, SlotId,
    layout::{SLOT_ROOMS, room_of},
    physics::GROUND_FRICTION,
};
use phase_navigation::Gaps;

/// Effort weights of an agent: what 1 u of its travel costs (u).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Effort {
    /// With free hands; at most 1.
    pub walking: f32,
    /// With an object. If both agents hold it, the greater weight counts.
    pub carrying: f32,
}

impl Effort {
    /// The effort of an agent for its own goal: all travel counts in full.
    pub const OWN: Self = Self { walking: 1.0, carrying: 1.0 };

    /// The effort of a helper. It walks while the other walks or waits, so walking costs its effort only.
    /// While it carries the object of the other's goal, the other has to wait, and the time counts as well.
    /// Hence the helper carries what the other cannot carry, or is far from, and leaves the rest to it.
    #[must_use]
    pub fn helper(effort: f32) -> Self {
        Self { walking: effort, carrying: 1.0 + effort }
    }
}

/// A goal to be reached by some agents' actions from a symbolic state: the problem that
/// [`search::solve`](crate::search::solve) solves.
///
/// It differs from a [`PlanningProblem`], which is about a physical state, in whose actions count, what their
/// travel costs, and whether two agents that hold an object pull together.
#[derive(Clone, Copy, Debug)]
pub struct PlanningTask<'a> {
    /// The planning problem.
    pub problem: &'a PlanningProblem<'a>,
    /// The goal; its sign is taken as positive.
    pub goal: Goal,
    /// Whether each agent acts.
    pub actors: [bool; AGENT_COUNT],
    /// Cost of each agent's travel.
    pub efforts: [Effort; AGENT_COUNT],
    /// Whether both agents pull in the same direction when both hold an object.
    pub cooperative: bool,
    /// Doors narrowed for one agent by something that is not an object, such as the other agent's body.
    pub narrowed: Option<(AgentId, Gaps)>,
}

/// The plan of a [`PlanningTask`].
pub type TaskPlan = SymbolicPlan<Node, Operator>;

impl SymbolicProblem for PlanningTask<'_> {
    type State = Node;
    type Operator = Operator;

    /// Whether the goal holds in a symbolic state and no acting agent holds anything.
    fn is_goal(&self, node: &Node) -> bool {
        let reached = match self.goal {
            Goal::AgentOnLandmark { agent, landmark, .. } => {
                node.agents[agent] == Location::Landmark(landmark)
            }
            Goal::ObjectOnLandmark { object, landmark, .. } => {
                node.objects[object] == Location::Landmark(landmark)
            }
            Goal::Touch { agent, other, .. } => node.agents[agent] == node.agents[other],
        };
        reached && AgentId::ALL.into_iter().all(|agent| !self.actors[agent] || node.holds[agent].is_none())
    }

    /// A lower bound on the remaining cost (u): the straight distance that the subject has to move, at the
    /// lowest effort weight.
    ///
    /// It is consistent. The subject moves by `Approach`, `Meet`, `Go`, `Carry` and `Pass` only, each of
    /// which costs at least the lowest weight times the straight distance between its old and new location,
    /// since no route is shorter, slowness is at least 1 and penalties are not negative. The exception is an
    /// agent that holds an object from the start: it is still at arm's length, and carrying may be charged
    /// for the object's path only. Such an agent is therefore taken to be at its own location or at the
    /// object's, whichever is closer. Releasing the object removes the choice, so the bound only rises.
    fn heuristic(&self, node: &Node) -> f32 {
        let distance =
            |from: Location, to: Location| self.problem.position(from).distance(self.problem.position(to));
        let places = |agent: AgentId| {
            let held = node.holds[agent].map(|object| node.objects[object]);
            [node.agents[agent], held.unwrap_or(node.agents[agent])]
        };
        let nearest = |agent: AgentId, to: Location| places(agent).map(|from| distance(from, to));
        let lowest = |weight: fn(&Effort) -> f32| weight(&self.efforts[0]).min(weight(&self.efforts[1]));
        match self.goal {
            Goal::AgentOnLandmark { agent, landmark, .. } => {
                let [own, held] = nearest(agent, Location::Landmark(landmark));
                own.min(held) * lowest(|effort| effort.walking.min(effort.carrying))
            }
            Goal::ObjectOnLandmark { object, landmark, .. } => {
                distance(node.objects[object], Location::Landmark(landmark))
                    * lowest(|effort| effort.carrying)
            }
            Goal::Touch { agent, other, .. } => {
                let [a, b] = places(other).map(|to| nearest(agent, to)).map(|[own, held]| own.min(held));
                a.min(b) * lowest(|effort| effort.walking.min(effort.carrying))
            }
        }
    }

    /// All possible next actions of the acting agents: operator, symbolic state after it, cost (u).
    fn successors(&self, node: &Node) -> impl IntoIterator<Item = (Operator, Node, f32)> {
        let mut successors = Vec::with_capacity(12);
        for agent in AgentId::ALL.into_iter().filter(|&agent| self.actors[agent]) {
            match node.holds[agent] {
                Some(object) => self.with_full_hands(node, agent, object, &mut successors),
                None => self.with_free_hands(node, agent, &mut successors),
            }
        }
        successors
    }
}

impl PlanningTask<'_> {
    /// Path cost to a location (u), for an agent or for an object and its holders, with penalties for doors
    /// that one of them does not fit through. All holders have to come along, so the longest path counts. The
    /// object `ignored`, which the agent holds or heads for, is not an obstacle.
    #[must_use]
    pub fn distance(
        &self,
        node: &Node,
        agent: AgentId,
        held: Option<ObjectId>,
        to: Location,
        ignored: Option<ObjectId>,
    ) -> f32 {
        let problem = self.problem;
        let gaps = self.gaps(node, agent, ignored);
        let cost = |from: Location, width: f32| {
            problem.route_cost(problem.position(from), problem.position(to), width, &gaps)
        };
        let Some(object) = held else { return cost(node.agents[agent], problem.width(agent, None)) };
        let radius = |who: AgentId| problem.physics.agents[who].radius;
        let diameter = 2.0 * problem.physics.object_radii[object];
        let holders = node.holders(object);
        // Two carriers are not aligned, so together they need more width than the wider one.
        let extra = if holders == [true; AGENT_COUNT] {
            radius(AgentId::ZERO).min(radius(AgentId::ONE))
        } else {
            0.0
        };
        AgentId::ALL
            .into_iter()
            .filter(|&holder| holders[holder] || holder == agent)
            .map(|holder| {
                // When the load arrives, its holder is still at arm's length.
                let way = cost(node.agents[holder], problem.width(holder, None) + extra);
                way - problem.arm(holder, object)
            })
            .fold(cost(node.objects[object], diameter), f32::max)
    }

    fn with_free_hands(&self, node: &Node, agent: AgentId, successors: &mut Vec<(Operator, Node, f32)>) {
        for object in self.problem.physics.objects() {
            if !self.is_relevant(object) {
                continue;
            }
            let location = node.objects[object];
            let mut after = *node;
            if node.agents[agent] == location {
                after.holds[agent] = Some(object);
                successors.push((Operator::Grab { agent, object }, after, self.problem.parameters.grasp));
            } else {
                after.agents[agent] = location;
                let cost = self.walking_cost(node, agent, location, Some(object));
                successors.push((Operator::Approach { agent, object }, after, cost));
            }
        }
        match self.goal {
            Goal::AgentOnLandmark { agent: who, landmark, .. } if who == agent => {
                let location = Location::Landmark(landmark);
                let mut after = *node;
                after.agents[agent] = location;
                let cost = self.walking_cost(node, agent, location, None);
                successors.push((Operator::Go { agent, landmark }, after, cost));
            }
            Goal::Touch { .. } => {
                let location = node.agents[agent.other()];
                let mut after = *node;
                after.agents[agent] = location;
                let cost = self.walking_cost(node, agent, location, None);
                successors.push((Operator::Meet { agent }, after, cost));
            }
            _ => {}
        }
    }

    fn with_full_hands(
        &self,
        node: &Node,
        agent: AgentId,
        object: ObjectId,
        successors: &mut Vec<(Operator, Node, f32)>,
    ) {
        let mut after = *node;
        after.holds[agent] = None;
        successors.push((Operator::Release { agent, object }, after, self.problem.parameters.grasp));
        for landmark in LandmarkId::ALL {
            let location = Location::Landmark(landmark);
            if node.objects[object] == location || !self.may_place(object, landmark) {
                continue;
            }
            let mut after = *node;
            after.objects[object] = location;
            for holder in AgentId::ALL.into_iter().filter(|&holder| node.holds[holder] == Some(object)) {
                after.agents[holder] = location;
            }
            let cost = self.carrying_cost(node, agent, object, location);
            successors.push((Operator::Carry { agent, object, landmark }, after, cost));
        }
        if self.actors == [true; AGENT_COUNT] {
            self.passing(node, agent, object, successors);
        }
    }

    /// Handing an object over through each door that it fits through and its holder does not.
    fn passing(
        &self,
        node: &Node,
        agent: AgentId,
        object: ObjectId,
        successors: &mut Vec<(Operator, Node, f32)>,
    ) {
        let own = self.problem.width(agent, None);
        let diameter = 2.0 * self.problem.physics.object_radii[object];
        for (slot, (a, b)) in SlotId::ALL.into_iter().zip(SLOT_ROOMS) {
            let gap = self.problem.map.gaps().width(slot);
            if gap < diameter || gap >= own {
                continue;
            }
            let here = room_of(self.problem.position(node.objects[object]));
            for (near, neighbour_across) in [(a, b), (b, a)] {
                // An object already beyond the door only has to be released.
                if here == neighbour_across {
                    continue;
                }
                let before = Location::Inside { slot, room: near };
                let passed = Location::Inside { slot, room: neighbour_across };
                let mut after = *node;
                after.agents[agent] = before;
                after.objects[object] = passed;
                after.holds[agent] = None;
                // Pushed on through the door, released, and grasped again by the other.
                let through = self.problem.position(before).distance(self.problem.position(passed));
                let cost = self.carrying_cost(node, agent, object, before)
                    + self.efforts[agent].carrying * through
                    + 2.0 * self.problem.parameters.grasp;
                successors.push((
                    Operator::Pass { agent, object, slot, room: neighbour_across },
                    after,
                    cost,
                ));
            }
        }
    }

    /// The object of the goal is carried to its landmark, or, when both agents act, anywhere to be handed
    /// over; an obstructing object is carried away.
    fn may_place(&self, object: ObjectId, landmark: LandmarkId) -> bool {
        match self.goal {
            Goal::ObjectOnLandmark { object: wanted, landmark: goal, .. } if wanted == object => {
                landmark == goal || self.actors == [true; AGENT_COUNT]
            }
            _ => true,
        }
    }

    /// Relevant objects: the goal's own, those that block a door, and those held.
    pub(crate) fn is_relevant(&self, object: ObjectId) -> bool {
        self.goal.subject() == Entity::Object(object) || self.problem.blocks_a_door(object)
    }

    /// Cost of moving a held object to a location (u). The time relative to walking is the ratio of the net
    /// forces without and with the load's friction.
    pub(crate) fn carrying_cost(&self, node: &Node, agent: AgentId, object: ObjectId, to: Location) -> f32 {
        let holders = node.holders(object);
        let net = if self.cooperative || holders != [true; AGENT_COUNT] {
            self.problem.net_force(holders)
        } else {
            // The other agent pulls in the opposite direction.
            let mut alone = [false; AGENT_COUNT];
            alone[agent] = true;
            self.problem.net_force(alone) - self.problem.physics.agents[agent.other()].max_force
        };
        let weight = AgentId::ALL
            .into_iter()
            .filter(|&holder| holders[holder])
            .map(|holder| self.efforts[holder].carrying)
            .fold(self.efforts[agent].carrying, f32::max);
        let travel = weight * self.distance(node, agent, Some(object), to, Some(object));
        if net > 0.0 {
            travel * (1.0 + GROUND_FRICTION / net)
        } else {
            travel + self.problem.parameters.impassable
        }
    }

    /// Cost of walking to a location (u).
    pub(crate) fn walking_cost(
        &self,
        node: &Node,
        agent: AgentId,
        to: Location,
        ignored: Option<ObjectId>,
    ) -> f32 {
        let cost = self.efforts[agent].walking * self.distance(node, agent, None, to, ignored);
        if self.is_at_blocking_object(node, agent) || self.is_stopped_in_door(node, agent, to, ignored) {
            cost + self.problem.parameters.impassable
        } else {
            cost
        }
    }

    /// Whether an agent stands at an object that still blocks a door. It may be on either side of it, so
    /// continuing as if past it would be a path through the blocked door.
    fn is_at_blocking_object(&self, node: &Node, agent: AgentId) -> bool {
        self.problem.physics.objects().any(|object| {
            let location = Location::Current(Entity::Object(object));
            self.problem.blocks_a_door(object)
                && node.agents[agent] == location
                && node.objects[object] == location
        })
    }

    /// Whether an agent stands in a door with an object before it that blocks the door.
    fn is_stopped_in_door(
        &self,
        node: &Node,
        agent: AgentId,
        to: Location,
        ignored: Option<ObjectId>,
    ) -> bool {
        node.agents[agent] == Location::Current(Entity::Agent(agent))
            && self.problem.physics.objects().any(|object| {
                Some(object) != ignored
                    && node.objects[object] == Location::Current(Entity::Object(object))
                    && self.problem.stops_in_door(agent, object, self.problem.position(to))
            })
    }

    /// The doors as they are for an agent in a symbolic state; an object it holds or heads for is not an
    /// obstacle.
    pub(crate) fn gaps(&self, node: &Node, agent: AgentId, ignored: Option<ObjectId>) -> Gaps {
        if let Some((narrowed, gaps)) = self.narrowed
            && narrowed == agent
        {
            return gaps;
        }
        let mut unmoved = node.unmoved();
        for object in ignored.into_iter().chain(node.holds[agent]) {
            unmoved.remove(Entity::Object(object));
        }
        *self.problem.gaps(agent, unmoved)
    }
}
