//! A subgoal in the low-level planner: the distance to go Φ(s), and the way.
//!
//! An [`Objective`] is compiled from a subgoal once a decision. The reward of the search, its value at the
//! horizon and the rollout policy read it and nothing else.

mod carry;
mod guard;
mod own_way;
mod pursuit;
mod way;

use crate::PhaseParameters;
use own_way::OwnWay;
use phase_model::{
    AgentId, Entity, Layout, Literal, ObjectId, PhysicsConfig, Predicate, PredicateTarget, State, Subgoal,
    Vec2, arena,
};
use phase_navigation::{Disc, Mover, Navigator};
use pursuit::Pursuit;

/// Number of kinds of pursuits ([`Objective::kind`]).
pub(crate) const KINDS: usize = 8;

/// The next motion of a body.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Motion {
    /// The agent, or the object that it carries.
    pub entity: Entity,
    /// The point that the entity should head for (u); where it is if it need not move.
    pub waypoint: Vec2,
    /// Sense in which it has to turn: 1 to the left (counter-clockwise), −1 to the right, 0 if it need not.
    pub turn: f32,
}

impl Motion {
    pub(crate) const fn to(entity: Entity, waypoint: Vec2) -> Self {
        Self { entity, waypoint, turn: 0.0 }
    }
}

/// One agent's subgoal, compiled for the states near the one it was compiled in.
#[derive(Clone, Debug)]
pub struct Objective<'a> {
    physics: &'a PhysicsConfig,
    layout: Layout,
    agent: AgentId,
    subgoal: Subgoal,
    pursuit: Pursuit,
    parameters: PhaseParameters,
}

impl<'a> Objective<'a> {
    /// Compiles a subgoal. The bodies are obstacles where they are in `state`.
    #[must_use]
    pub fn new(
        physics: &'a PhysicsConfig,
        navigator: &mut Navigator,
        state: &State,
        agent: AgentId,
        subgoal: Subgoal,
        parameters: &PhaseParameters,
    ) -> Self {
        let layout = navigator.map().layout();
        let mut compiler = Compiler { physics, navigator, state, agent, parameters };
        let pursuit = compiler.pursuit(subgoal);
        Self { physics, layout, agent, subgoal, pursuit, parameters: *parameters }
    }

    /// The agent that pursues it.
    #[must_use]
    pub const fn agent(&self) -> AgentId {
        self.agent
    }

    /// The subgoal.
    #[must_use]
    pub const fn subgoal(&self) -> Subgoal {
        self.subgoal
    }

    /// The kind of pursuit that the subgoal asks for, by number, below [`KINDS`].
    pub(crate) const fn kind(&self) -> usize {
        let kind = match &self.pursuit {
            Pursuit::Rest => 0,
            Pursuit::BeAt(_) => 1,
            Pursuit::Meet(..) => 2,
            Pursuit::Grasp(..) => 3,
            Pursuit::Release(_) => 4,
            Pursuit::Bring(..) => 5,
            Pursuit::Escape(_) => 6,
            Pursuit::Guard(_) | Pursuit::ClearPath(_) => 7,
        };
        assert!(kind < KINDS);
        kind
    }

    /// The object that the subgoal is about.
    pub(crate) const fn object(&self) -> Option<ObjectId> {
        match &self.pursuit {
            Pursuit::Grasp(object, _) | Pursuit::Release(object) | Pursuit::Bring(object, ..) => {
                Some(*object)
            }
            _ => None,
        }
    }

    /// The parameters of the agent's mind.
    #[must_use]
    pub const fn parameters(&self) -> &PhaseParameters {
        &self.parameters
    }

    /// Bodies and walls.
    #[must_use]
    pub const fn physics(&self) -> &'a PhysicsConfig {
        self.physics
    }

    /// Φ: the distance to go (u); at least 0, and finite for every finite state.
    #[must_use]
    pub fn distance(&self, state: &State) -> f32 {
        let me = Entity::Agent(self.agent);
        let here = self.place(state, me);
        match &self.pursuit {
            Pursuit::Rest => 0.0,
            Pursuit::BeAt(way) => {
                let facing = way.closed_door().map_or(0.0, |door| self.facing_cost(state, door));
                way.distance(here) + facing
            }
            Pursuit::Meet(entity, way) => {
                let there = self.place(state, *entity);
                (way.distance(here, there) - self.gap(*entity)).max(0.0) + self.facing_cost(state, there)
            }
            Pursuit::Grasp(object, way) => self.to_grasp(state, *object, way),
            Pursuit::Release(object) => {
                if state.holds(self.agent, *object) {
                    self.parameters.grasp + self.sliding_distance(state, *object)
                } else {
                    self.sliding_distance(state, *object)
                }
            }
            Pursuit::Bring(object, way, carry) => {
                if state.holds(self.agent, *object) {
                    carry.distance(state)
                } else {
                    self.to_grasp(state, *object, way) + carry.load_distance(state)
                }
            }
            Pursuit::Escape(way) => {
                let from = self.place(state, Entity::Agent(self.agent.other()));
                (arena::DIAGONAL - pursuit::separation(way, from, here, self.parameters.impassable)).max(0.0)
            }
            Pursuit::Guard(guard) => guard.distance(here, self.place(state, guard.subject())),
            Pursuit::ClearPath(path) => path.distance(here),
        }
    }

    /// The next motion towards the subgoal.
    #[must_use]
    pub fn motion(&self, state: &State) -> Motion {
        let me = Entity::Agent(self.agent);
        let here = self.place(state, me);
        let look_ahead = self.parameters.look_ahead;
        let waypoint = match &self.pursuit {
            Pursuit::Rest | Pursuit::Release(_) => here,
            Pursuit::BeAt(way) => way.waypoint(here, look_ahead),
            Pursuit::Meet(entity, way) => way.waypoint(here, self.place(state, *entity), look_ahead),
            Pursuit::Grasp(object, way) => {
                way.waypoint(here, state.position(Entity::Object(*object)), look_ahead)
            }
            Pursuit::Bring(object, way, carry) => {
                if state.holds(self.agent, *object) {
                    return carry.motion(state, look_ahead);
                }
                way.waypoint(here, state.position(Entity::Object(*object)), look_ahead)
            }
            Pursuit::Escape(way) => {
                let from = self.place(state, Entity::Agent(self.agent.other()));
                pursuit::away(way, from, here, self.physics.radius(me), &self.parameters)
            }
            Pursuit::Guard(guard) => {
                guard.waypoint(here, self.place(state, guard.subject()), &self.parameters)
            }
            Pursuit::ClearPath(path) => path.waypoint(here),
        };
        Motion::to(me, waypoint)
    }

    /// The place of an entity on its way ([`Layout::place_of`]).
    fn place(&self, state: &State, entity: Entity) -> Vec2 {
        self.layout.place_of(self.physics, state, entity)
    }

    /// The object to hold on to next, if the agent does not hold it.
    #[must_use]
    pub fn wanted_object(&self, state: &State) -> Option<ObjectId> {
        match self.pursuit {
            Pursuit::Grasp(object, _) | Pursuit::Bring(object, ..) => {
                (!state.holds(self.agent, object)).then_some(object)
            }
            _ => None,
        }
    }

    /// Whether the subgoal is to release an object that the agent holds.
    #[must_use]
    pub fn releases(&self, state: &State) -> bool {
        matches!(self.pursuit, Pursuit::Release(object) if state.holds(self.agent, object))
    }

    /// Distance between the centres of the agent and an entity that touch (u).
    fn gap(&self, entity: Entity) -> f32 {
        self.physics.agents[self.agent].radius + self.physics.radius(entity)
    }

    /// Cost of not facing a point (u). It makes agents look where they go, and turn to where they believe an
    /// unobserved entity to be, which confirms or refutes it.
    fn facing_cost(&self, state: &State, target: Vec2) -> f32 {
        let body = state.body(Entity::Agent(self.agent));
        let way = (target - body.position).normalize_or_zero();
        0.5 * self.parameters.turning * (1.0 - way.dot(body.forward()))
    }
}

/// Compiles subgoals of one agent in one state.
struct Compiler<'a, 'n> {
    physics: &'a PhysicsConfig,
    navigator: &'n mut Navigator,
    state: &'a State,
    agent: AgentId,
    parameters: &'a PhaseParameters,
}

impl Compiler<'_, '_> {
    fn pursuit(&mut self, subgoal: Subgoal) -> Pursuit {
        let Subgoal::Achieve(Literal { predicate, holds }) = subgoal else { return Pursuit::Rest };
        let me = Entity::Agent(self.agent);
        match (predicate, holds) {
            (Predicate::On(entity, landmark), true) => self.bring(entity, pursuit::centre(landmark)),
            (Predicate::Close(entity, PredicateTarget::Landmark(landmark)), true) => {
                self.bring(entity, pursuit::room(landmark, self.parameters.room_depth))
            }
            (Predicate::Close(who, PredicateTarget::Entity(entity)), true) if who == me => self.meet(entity),
            (Predicate::Touch(who, entity), true) if Entity::Agent(who) == me => self.meet(entity),
            (Predicate::Attach(who, object), true) if Entity::Agent(who) == me => {
                Pursuit::Grasp(object, self.way_to(Entity::Object(object)))
            }
            (Predicate::Attach(who, object), false) if Entity::Agent(who) == me => Pursuit::Release(object),
            (Predicate::Touch(..), false) | (Predicate::Close(_, PredicateTarget::Entity(_)), false) => {
                self.escape()
            }
            (Predicate::On(entity, landmark), false) if entity == me => {
                self.clear_path(landmark).map_or(Pursuit::Rest, Pursuit::ClearPath)
            }
            (Predicate::On(entity, landmark), false) => {
                Pursuit::Guard(self.guard(entity, pursuit::centre(landmark)))
            }
            (Predicate::Close(entity, PredicateTarget::Landmark(landmark)), false) => {
                Pursuit::Guard(self.guard(entity, pursuit::room(landmark, self.parameters.room_depth)))
            }
            // What only the other agent can do.
            _ => Pursuit::Rest,
        }
    }

    /// Obstacles for a mover: every body but the agent, what it holds, and `target`.
    fn obstacles(&self, target: Option<Entity>) -> Vec<Disc> {
        let me = Entity::Agent(self.agent);
        let held = self.state.held_object(self.agent).map(Entity::Object);
        let is_free = |entity: &Entity| {
            *entity != me && Some(*entity) != held && Some(*entity) != target && !self.holds_with(*entity)
        };
        let disc = |entity: Entity| Disc {
            centre: self.state.position(entity),
            radius: self.physics.radius(entity),
        };
        self.physics.entities().filter(is_free).map(disc).collect()
    }

    /// Whether an entity is the other agent, holding what this one holds.
    fn holds_with(&self, entity: Entity) -> bool {
        let held = self.state.held_object(self.agent);
        entity == Entity::Agent(self.agent.other())
            && held.is_some()
            && held == self.state.held_object(self.agent.other())
    }

    /// The place of an entity on its way ([`Layout::place_of`]).
    fn place(&self, entity: Entity) -> Vec2 {
        self.navigator.map().layout().place_of(self.physics, self.state, entity)
    }

    fn mover(&self, entity: Entity) -> Mover {
        Mover::of(self.physics, entity)
    }

    fn way_to(&mut self, entity: Entity) -> way::Way {
        let me = Entity::Agent(self.agent);
        let obstacles = self.obstacles(Some(entity));
        let from = self.place(me);
        let to = self.place(entity);
        let mover = self.mover(me);
        way::Way::new(self.navigator, mover, from, to, &obstacles)
    }

    fn meet(&mut self, entity: Entity) -> Pursuit {
        Pursuit::Meet(entity, self.way_to(entity))
    }

    /// An entity is to be at a target: the agent itself, or something that it has to move there.
    fn bring(&mut self, entity: Entity, target: phase_navigation::Target) -> Pursuit {
        let me = Entity::Agent(self.agent);
        match entity {
            _ if entity == me => {
                let obstacles = self.obstacles(None);
                let mover = self.mover(me);
                let field = self.navigator.field(target, mover, &obstacles);
                let here = self.place(me);
                Pursuit::BeAt(OwnWay::new(
                    field,
                    self.navigator.map(),
                    mover,
                    here,
                    self.parameters.waiting_widths,
                ))
            }
            Entity::Object(object) => Pursuit::Bring(object, self.way_to(entity), self.carry(object, target)),
            Entity::Agent(_) => Pursuit::Guard(self.drive(entity, target)),
        }
    }

    fn escape(&mut self) -> Pursuit {
        let me = Entity::Agent(self.agent);
        let other = Entity::Agent(self.agent.other());
        let from = self.place(other);
        let to = self.place(me);
        let mover = self.mover(other);
        Pursuit::Escape(way::Way::new(self.navigator, mover, from, to, &[]))
    }
}
