//! Raising the cost of what the other agent is about to make true.
//!
//! A hinderer, an agent that flees, and an agent that keeps something off a landmark have the same task: a
//! condition that the other can make true is to become expensive for it. Every predicate that the agent can
//! make true or false is a candidate. Its worth is the cost of the other's best plan (A*) afterwards, less
//! the cost now, less the agent's own effort times
//! [`PlannerParameters::effort`](crate::PlannerParameters::effort). Helping has the opposite sign; there the
//! joint A* of [`Planner`](crate::Planner) finds the best sequence.

use crate::{
    plan::{self, Plan, is, not},
    problem::{Location, PlanningProblem},
    search,
    symbolic::{Node, Operator},
    task::{Effort, PlanningTask, TaskPlan},
};
use phase_model::{
    AgentId, BodySet, Entity, Goal, LandmarkId, ObjectId, Predicate, PredicateTarget, SlotId, Vec2,
    layout::room_of,
};
use phase_navigation::{Gaps, Route};
use phase_predicates::{achieved, is_true};

/// The plan that raises the other's cost of a condition most; the condition is a positive goal. The agent
/// stays only if the other cannot make the condition true at all; from a pursuer it keeps away even then. It
/// lays no hands on the object that it cedes.
#[must_use]
pub fn plan(problem: &PlanningProblem<'_>, agent: AgentId, condition: Goal, ceded: Option<ObjectId>) -> Plan {
    let interference = Interference::new(problem, agent, condition);
    let is_safe = interference.now >= problem.parameters.impassable;
    if is_safe && !interference.is_pursuit() {
        return interference.finish();
    }
    let mut candidates = Vec::with_capacity(16);
    interference.places(&mut candidates);
    interference.objects(ceded, &mut candidates);
    interference.doors(&mut candidates);
    interference.contact(&mut candidates);
    // The first of equals, so that the order above breaks ties.
    let mut best: Option<Candidate> = None;
    for candidate in candidates {
        if best.as_ref().is_none_or(|best| candidate.worth > best.worth) {
            best = Some(candidate);
        }
    }
    best.map_or(Plan::STAY, |candidate| candidate.plan)
}

/// A predicate that the agent can bring about, with the subgoals that lead to it.
struct Candidate {
    /// Increase of the other's cost less the weighted own effort (u).
    worth: f32,
    plan: Plan,
}

/// A door on the other's way.
struct DoorAhead {
    slot: SlotId,
    /// A landmark of the room behind it.
    next: LandmarkId,
    /// Cost of the other's way to the door (u).
    distance: f32,
}

struct Interference<'a> {
    problem: &'a PlanningProblem<'a>,
    agent: AgentId,
    other: AgentId,
    condition: Goal,
    /// The symbolic state now, with the agent's hands free: otherwise releasing would appear effective
    /// because holding is.
    start: Node,
    /// The other's cheapest plan from there.
    others_plan: Option<TaskPlan>,
    /// Its cost (u).
    now: f32,
}

impl<'a> Interference<'a> {
    fn new(problem: &'a PlanningProblem<'a>, agent: AgentId, condition: Goal) -> Self {
        let mut start = Node::start(problem);
        start.holds[agent] = None;
        let other = agent.other();
        let mut new = Self { problem, agent, other, condition, start, others_plan: None, now: 0.0 };
        if !achieved(problem.physics, problem.state, condition) || new.is_pursuit() {
            new.others_plan = search::solve(&new.others_task(None), start);
            new.now = new.capped(new.others_plan.as_ref(), &start);
        }
        new
    }

    /// The remaining plan when the other cannot make the condition true: to carry the object in hand to the
    /// nearest place and to leave it there.
    fn finish(&self) -> Plan {
        let release = plan::release(self.problem, self.agent);
        let mut candidates = Vec::new();
        if let Some(object) = self.problem.state.held_object(self.agent)
            && self.condition.subject() == Entity::Object(object)
        {
            self.object(object, &mut candidates);
        }
        candidates.pop().map_or(release.clone(), |Candidate { mut plan, .. }| {
            plan::drop_satisfied(self.problem, &mut plan.subgoals);
            plan.subgoals.extend(release.subgoals);
            plan
        })
    }

    /// Whether the condition is that the two agents touch.
    const fn is_pursuit(&self) -> bool {
        matches!(self.condition, Goal::Touch { .. })
    }

    /// The other acts alone, and the agent pulls against it.
    fn others_task(&self, narrowed: Option<Gaps>) -> PlanningTask<'a> {
        PlanningTask {
            problem: self.problem,
            goal: self.condition,
            actors: plan::only(self.other),
            efforts: [Effort::OWN; 2],
            cooperative: false,
            narrowed: narrowed.map(|gaps| (self.other, gaps)),
        }
    }

    /// Cost of the condition for the other from a symbolic state (u). Beyond the cost of the nearly
    /// impossible there is nothing to gain.
    fn cost(&self, node: &Node, narrowed: Option<Gaps>) -> f32 {
        self.capped(search::solve(&self.others_task(narrowed), *node).as_ref(), node)
    }

    fn capped(&self, plan: Option<&TaskPlan>, node: &Node) -> f32 {
        let cost = plan.map_or_else(|| self.pushing(node), |plan| plan.cost);
        cost.min(self.problem.parameters.impassable)
    }

    /// Without a plan the condition is about this agent, which the other can only push there.
    fn pushing(&self, node: &Node) -> f32 {
        let (Some(landmark), here) =
            (self.condition.landmark(), self.problem.position(node.agents[self.agent]))
        else {
            return f32::INFINITY;
        };
        self.way(self.other, here) + here.distance(self.problem.position(Location::Landmark(landmark)))
    }

    /// The cheapest path of an agent with free hands from where it is (u).
    fn way(&self, who: AgentId, to: Vec2) -> f32 {
        let from = self.problem.position(Location::Current(Entity::Agent(who)));
        let gaps = self.problem.gaps(who, BodySet::OBJECTS);
        self.problem.route_cost(from, to, self.problem.width(who, None), gaps)
    }

    fn route(&self, to: Vec2) -> Option<Route> {
        let from = self.problem.position(Location::Current(Entity::Agent(self.agent)));
        let gaps = self.problem.gaps(self.agent, BodySet::OBJECTS);
        self.problem.route(from, to, self.problem.width(self.agent, None), gaps)
    }

    fn candidate(&self, effect: f32, effort: f32, subgoals: Vec<phase_model::Subgoal>) -> Candidate {
        let worth = effect - self.problem.parameters.effort * effort;
        let is_feasible = effort < self.problem.parameters.impassable;
        Candidate { worth, plan: Plan { subgoals, distance: effort, is_feasible } }
    }

    /// Rooms to pass on the way to a place, hands free.
    fn go(&self, to: Vec2) -> Vec<phase_model::Subgoal> {
        let mut subgoals = plan::release(self.problem, self.agent).subgoals;
        let me = Entity::Agent(self.agent);
        if let Some(route) = self.route(to) {
            plan::rooms(&route, self.problem.position(Location::Current(me)), to, me, &mut subgoals);
        }
        subgoals
    }

    /// On(self, landmark), where the agent's own place matters: in each other room whose doors it reaches
    /// before the other, who comes by the shortest path.
    fn places(&self, candidates: &mut Vec<Candidate>) {
        let me = Entity::Agent(self.agent);
        if !self.is_pursuit() && self.condition.subject() != me {
            return;
        }
        let here = self.problem.position(Location::Current(me));
        for landmark in LandmarkId::ALL.into_iter().filter(|landmark| landmark.room() != room_of(here)) {
            let place = self.problem.position(Location::Landmark(landmark));
            let Some(route) = self.route(place) else { continue };
            let margin = self.problem.physics.agents[self.agent].radius;
            let is_intercepted = |&(_, door): &(SlotId, Vec2)| {
                self.way(self.agent, door) + margin >= self.way(self.other, door)
            };
            if route.impassable > 0 || route.doors().iter().any(is_intercepted) {
                continue;
            }
            let mut after = self.start;
            after.agents[self.agent] = Location::Landmark(landmark);
            let effect = self.cost(&after, None) - self.now;
            let mut subgoals = self.go(place);
            subgoals.push(if self.is_pursuit() {
                not(Predicate::Touch(self.agent, Entity::Agent(self.other)))
            } else {
                is(Predicate::On(me, landmark))
            });
            candidates.push(self.candidate(effect, route.length, subgoals));
        }
    }

    /// Attach and On(object, landmark) for each object that the condition depends on. While the agent holds
    /// the object, the other has to pull against it; where it puts it down, the other has to fetch it.
    fn objects(&self, ceded: Option<ObjectId>, candidates: &mut Vec<Candidate>) {
        let others_task = self.others_task(None);
        let may_take = |&object: &ObjectId| others_task.is_relevant(object) && Some(object) != ceded;
        for object in self.problem.physics.objects().filter(may_take) {
            self.object(object, candidates);
        }
    }

    fn object(&self, object: ObjectId, candidates: &mut Vec<Candidate>) {
        let problem = self.problem;
        let task = PlanningTask { actors: plan::only(self.agent), ..self.others_task(None) };
        let location = self.start.objects[object];
        let is_holding = problem.state.held_object(self.agent) == Some(object);
        let mut holding = self.start;
        holding.holds[self.agent] = Some(object);
        let mut fetch = 0.0;
        let mut fetching = Vec::new();
        if !is_holding {
            fetch = task.distance(&self.start, self.agent, None, location, Some(object))
                + problem.parameters.grasp;
            fetching = self.go(problem.position(location));
            let target = PredicateTarget::Entity(Entity::Object(object));
            fetching.push(is(Predicate::Close(Entity::Agent(self.agent), target)));
            fetching.push(is(Predicate::Attach(self.agent, object)));
            holding.agents[self.agent] = location;
        }
        let held = self.candidate(self.cost(&holding, None) - self.now, fetch, Vec::new()).worth;
        // The most effective place to carry it to. On the way there it is held, and who is too weak to carry
        // it away holds it and pulls.
        let mut best: Option<Candidate> = None;
        let unwanted =
            self.condition.landmark().filter(|_| self.condition.subject() == Entity::Object(object));
        for refuge in LandmarkId::ALL.into_iter().filter(|&refuge| Some(refuge) != unwanted) {
            let place = Location::Landmark(refuge);
            let mut after = self.start;
            after.objects[object] = place;
            after.holds[self.other] = after.holds[self.other].filter(|&held| held != object);
            let carry = task.carrying_cost(&holding, self.agent, object, place);
            let mut subgoals = fetching.clone();
            let from = problem.position(location);
            let to = problem.position(place);
            let gaps = task.gaps(&holding, self.agent, Some(object));
            let width = problem.width(self.agent, Some(object));
            if let Some(route) = problem.route(from, to, width, &gaps) {
                plan::rooms(&route, from, to, Entity::Object(object), &mut subgoals);
            }
            subgoals.push(is(Predicate::On(Entity::Object(object), refuge)));
            plan::drop_satisfied_but_last(problem, &mut subgoals);
            let effect = self.cost(&after, None) - self.now;
            let candidate = self.candidate(effect, fetch + carry, subgoals);
            if best.as_ref().is_none_or(|best| candidate.worth > best.worth) {
                best = Some(candidate);
            }
        }
        candidates.extend(best.map(|best| Candidate { worth: best.worth.max(held), ..best }));
    }

    /// Not Close(other, landmark of the next room): each door that the other has yet to pass and in which the
    /// two bodies meet at the latest.
    fn doors(&self, candidates: &mut Vec<Candidate>) {
        let half_width = 0.5 * self.problem.width(self.agent, None);
        let margin: f32 = self.problem.physics.agents.iter().map(|body| body.radius).sum();
        for DoorAhead { slot, next, distance } in self.doors_ahead() {
            let Some(middle) = self.problem.map.gaps().middle(slot) else { continue };
            let own = self.way(self.agent, middle);
            if own > distance + margin {
                continue;
            }
            let mut gaps = *self.problem.gaps(self.other, BodySet::OBJECTS);
            gaps.obstruct(middle, half_width, half_width);
            let effect = self.cost(&self.start, Some(gaps)) - self.now;
            if effect <= 0.0 {
                continue;
            }
            let mut subgoals = plan::release(self.problem, self.agent).subgoals;
            let room = PredicateTarget::Landmark(next);
            subgoals.push(not(Predicate::Close(Entity::Agent(self.other), room)));
            candidates.push(self.candidate(effect, own, subgoals));
        }
    }

    fn doors_ahead(&self) -> Vec<DoorAhead> {
        let problem = self.problem;
        let task = self.others_task(None);
        let mut doors = Vec::new();
        if self.is_pursuit() {
            return doors;
        }
        let mut so_far = 0.0;
        for (node, operator) in self.others_plan.iter().flat_map(|plan| &plan.steps) {
            let (held, from, to) = match *operator {
                Operator::Approach { object, .. } => (None, node.agents[self.other], node.objects[object]),
                Operator::Go { landmark, .. } => {
                    (None, node.agents[self.other], Location::Landmark(landmark))
                }
                Operator::Carry { object, landmark, .. } => {
                    (Some(object), node.objects[object], Location::Landmark(landmark))
                }
                _ => continue,
            };
            let from = problem.position(from);
            let to = problem.position(to);
            let gaps = task.gaps(node, self.other, held);
            let Some(route) = problem.route(from, to, problem.width(self.other, held), &gaps) else {
                continue;
            };
            let mut room = room_of(from);
            let mut last = from;
            for &(slot, crossing) in route.doors() {
                room = slot.beyond(room);
                so_far += last.distance(crossing);
                last = crossing;
                doors.push(DoorAhead { slot, next: room.landmark(), distance: so_far });
            }
            so_far += last.distance(to);
        }
        doors
    }

    /// Not On(subject, landmark) by standing between the two and pushing; not Touch(self, other) where
    /// touching is the condition. A body in the way costs the other a detour around both bodies, provided
    /// that it is there first.
    fn contact(&self, candidates: &mut Vec<Candidate>) {
        let problem = self.problem;
        let me = Entity::Agent(self.agent);
        let other = Entity::Agent(self.other);
        let Some(landmark) = self.condition.landmark() else {
            // Leaving the room has to gain more than the distance at which the two touch.
            let apart = problem.physics.radius(me) + problem.physics.radius(other);
            candidates.push(self.candidate(apart, 0.0, vec![not(Predicate::Touch(self.agent, other))]));
            return;
        };
        let subject = self.condition.subject();
        let avoid = not(Predicate::On(subject, landmark));
        if subject == me {
            let literal = phase_model::Literal::not(Predicate::On(subject, landmark));
            let is_avoided = is_true(problem.physics, problem.state, literal);
            candidates.push(self.candidate(0.0, 0.0, if is_avoided { Vec::new() } else { vec![avoid] }));
            return;
        }
        // A hand on the object does more than a body in its way.
        if problem.state.held_object(self.agent).is_some_and(|held| Entity::Object(held) == subject) {
            return;
        }
        let there = problem.position(Location::Current(subject));
        let target = problem.position(Location::Landmark(landmark));
        let apart = problem.physics.radius(me) + problem.physics.radius(subject);
        let between = target + (there - target).clamp_length_max(apart);
        let own = self.way(self.agent, between);
        let is_first = self.now == 0.0 || own <= self.now + problem.physics.radius(me);
        let mut subgoals = self.go(between);
        subgoals.push(avoid);
        candidates.push(self.candidate(if is_first { 2.0 * apart } else { 0.0 }, own, subgoals));
    }
}
