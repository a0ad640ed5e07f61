//! The symbolic planning task that A* solves: locations, grips and operator costs.

use crate::{
    problem::{Location, PlanningProblem},
    routes::{Gaps, IMPASSABLE_COST},
    symbolic::{Node, Operator},
};
use phase_model::{
    AGENT_COUNT, AgentId, Entity, Goal, LandmarkId, ObjectId, SlotId,
    layout::{SLOT_ROOMS, room_of},
};

/// Cost of grabbing or releasing (u of travel).
const GRASP_COST: f32 = 1.0;
/// Added when the holders are too weak to move an object, so that carrying it is the last resort.
const IMMOVABLE_COST: f32 = 60.0;
/// Upper bound of the carrying-time factor, reached as the net force approaches zero.
const MAX_CARRYING_FACTOR: f32 = 5.0;
/// Net force at which carrying takes twice as long as walking (N).
const CARRYING_FORCE_SCALE: f32 = 100.0;

/// A goal to be reached by some agents' actions.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The planning problem.
    pub problem: &'a PlanningProblem<'a>,
    /// The goal; its sign is taken as positive.
    pub goal: Goal,
    /// Which agents act.
    pub actors: [bool; AGENT_COUNT],
    /// Effort weight of each agent's travel: 1 in full, less for an agent willing to travel more.
    pub effort_weights: [f32; AGENT_COUNT],
    /// Whether both agents pull in the same direction when both hold an object.
    pub cooperative: bool,
    /// Doors narrowed for one agent by something that is not an object, such as the other agent's body.
    pub narrowed: Option<(AgentId, Gaps)>,
}

impl Task<'_> {
    /// Whether the goal holds in a symbolic state and no acting agent holds anything.
    #[must_use]
    pub fn is_done(&self, node: &Node) -> bool {
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

    /// An estimate of the remaining cost (u): the straight distance that the subject has to move, at the
    /// lowest effort weight among the agents. [`Task::heuristic_is_admissible`] states whether it is a lower
    /// bound.
    #[must_use]
    pub fn heuristic(&self, node: &Node) -> f32 {
        let distance =
            |from: Location, to: Location| self.problem.position(from).distance(self.problem.position(to));
        let straight = match self.goal {
            Goal::AgentOnLandmark { agent, landmark, .. } => {
                distance(node.agents[agent], Location::Landmark(landmark))
            }
            Goal::ObjectOnLandmark { object, landmark, .. } => {
                distance(node.objects[object], Location::Landmark(landmark))
            }
            Goal::Touch { agent, other, .. } => distance(node.agents[agent], node.agents[other]),
        };
        straight * self.effort_weights[0].min(self.effort_weights[1])
    }

    /// Whether [`Task::heuristic`] never exceeds the cost of the cheapest plan from a symbolic state.
    ///
    /// It never does for an object that is to be on a landmark. Let e be the lesser effort weight. Only two
    /// operators move the object. `Carry` costs at least e times the length of a route between the object's
    /// locations, since the longest path of object and holders counts, the slowness factor is at least 1 and
    /// penalties are not negative; so it costs at least the decrease of the heuristic. `Pass` is charged for
    /// the path to the near side of a door and leaves the object on the far side, 2.4 u further on, for 2 u
    /// of handling; so it falls short by at most 0.4 u, as e ≤ 1. It also ends its agent's grip. A pass never
    /// ends a plan, so after k ≥ 1 of them there have been at least k + 1 grips of the object. At most two of
    /// these existed at the start; each other one costs 1 u for grasping, and the last costs 1 u for
    /// releasing, as only agents with free hands are done and `Pass` exists only when both agents act. The
    /// total is k u, which is more than 0.4 k u. Costs are rounded up and the heuristic down, both to whole
    /// units of the search.
    ///
    /// It may for an agent that is to be somewhere. Approaching an object costs the path less the arm's
    /// length between agent and object when they touch, yet leaves the agent at the object's own location;
    /// carrying credits holders likewise. A path via one or two objects, or with one held, can therefore cost
    /// several units less than the straight line.
    #[must_use]
    pub const fn heuristic_is_admissible(&self) -> bool {
        matches!(self.goal, Goal::ObjectOnLandmark { .. })
    }

    /// All possible next actions of the acting agents: operator, symbolic state after it, cost (u).
    #[must_use]
    pub fn successors(&self, node: &Node) -> Vec<(Operator, Node, f32)> {
        let mut successors = Vec::with_capacity(12);
        for agent in AgentId::ALL.into_iter().filter(|&agent| self.actors[agent]) {
            match node.holds[agent] {
                Some(object) => self.with_full_hands(node, agent, object, &mut successors),
                None => self.with_free_hands(node, agent, &mut successors),
            }
        }
        successors
    }

    /// Path cost to a location (u), for an agent or for an object and its holders, with penalties for doors
    /// that one of them does not fit through. All holders have to come along, so the longest path counts.
    #[must_use]
    pub fn distance(&self, node: &Node, agent: AgentId, held: Option<ObjectId>, to: Location) -> f32 {
        self.longest_path(node, agent, held, to, held)
    }

    fn longest_path(
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
            problem.routes.cost(problem.position(from), problem.position(to), width, &gaps)
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
                successors.push((Operator::Grab { agent, object }, after, GRASP_COST));
            } else {
                after.agents[agent] = location;
                let way = self.travel_cost(node, agent, None, location, Some(object));
                let spared = self.effort_weights[agent] * self.problem.arm(agent, object);
                let cost = (way - spared).max(0.0);
                successors.push((Operator::Approach { agent, object }, after, cost));
            }
        }
        match self.goal {
            Goal::AgentOnLandmark { agent: who, landmark, .. } if who == agent => {
                let location = Location::Landmark(landmark);
                let mut after = *node;
                after.agents[agent] = location;
                let cost = self.travel_cost(node, agent, None, location, None);
                successors.push((Operator::Go { agent, landmark }, after, cost));
            }
            Goal::Touch { .. } => {
                let location = node.agents[agent.other()];
                let mut after = *node;
                after.agents[agent] = location;
                let cost = self.travel_cost(node, agent, None, location, None);
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
        successors.push((Operator::Release { agent, object }, after, GRASP_COST));
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
            let gap = self.problem.routes.gaps().width(slot);
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
                let cost = self.carrying_cost(node, agent, object, before) + 2.0 * GRASP_COST;
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
    fn is_relevant(&self, object: ObjectId) -> bool {
        self.goal.subject() == Entity::Object(object) || self.problem.blocks_a_door(object)
    }

    fn carrying_cost(&self, node: &Node, agent: AgentId, object: ObjectId, to: Location) -> f32 {
        let holders = node.holders(object);
        let net = if self.cooperative || holders != [true; AGENT_COUNT] {
            self.problem.net_force(holders)
        } else {
            // The other agent pulls in the opposite direction.
            let mut alone = [false; AGENT_COUNT];
            alone[agent] = true;
            self.problem.net_force(alone) - self.problem.physics.agents[agent.other()].max_force
        };
        let slowness = if net > 0.0 {
            (1.0 + CARRYING_FORCE_SCALE / net).min(MAX_CARRYING_FACTOR)
        } else {
            MAX_CARRYING_FACTOR
        };
        let travel = self.travel_cost(node, agent, Some(object), to, Some(object));
        travel * slowness + if net > 0.0 { 0.0 } else { IMMOVABLE_COST }
    }

    fn travel_cost(
        &self,
        node: &Node,
        agent: AgentId,
        held: Option<ObjectId>,
        to: Location,
        ignored: Option<ObjectId>,
    ) -> f32 {
        let cost = self.effort_weights[agent] * self.longest_path(node, agent, held, to, ignored);
        if held.is_none() && self.is_at_blocking_object(node, agent) { cost + IMPASSABLE_COST } else { cost }
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
