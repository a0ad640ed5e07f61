//! Terms of the objective for carrying and releasing.

use crate::{
    assembly::CarriedAssembly,
    objective::{ARENA_DIAGONAL, Objective},
    steering::PlannedPath,
};
use phase_model::{
    Entity, Literal, ObjectId, Predicate, PredicateTarget, State, Subgoal, Vec2, arena, physics,
};

/// Weight of the carrier's remaining path relative to the load's.
const CARRIER_LAG_WEIGHT: f32 = 0.5;
/// Weight of the detour between a carrier and its load when a wall separates them. It exceeds the load's loss
/// from moving back along that wall.
const DETOUR_WEIGHT: f32 = 2.0;

impl Objective<'_> {
    /// Stopping distance of an object if it were released now (u); a released object should stay in place.
    pub(crate) fn sliding_distance(&self, state: &State, object: ObjectId) -> f32 {
        let mass = physics::object_mass(self.physics.object_radii[object]);
        let speed = state.body(Entity::Object(object)).velocity.length();
        (0.5 * mass * speed * speed / physics::GROUND_FRICTION).min(ARENA_DIAGONAL)
    }

    /// Remaining distance of a held object, with a share of its carrier's: the carrier has to pass the door
    /// too and may have to turn first.
    pub(crate) fn with_carrier_terms(
        &self,
        state: &State,
        moved_entity: Entity,
        leads: bool,
        remaining: f32,
    ) -> f32 {
        let me = Entity::Agent(self.agent);
        let Some(target) = self.landmark() else { return remaining };
        let to_target = |entity: Entity| {
            let from = state.position(entity);
            self.routes.best(from, target, 0.0, self.routes.gaps()).map_or(0.0, |route| route.length)
        };
        let arm = self.physics.radius(me) + self.physics.radius(moved_entity);
        let lag = to_target(me) - to_target(moved_entity) - arm;
        let remaining = remaining + DETOUR_WEIGHT * self.detour(state, moved_entity);
        let remaining = remaining + self.carrier_overhang(state, moved_entity, target);
        // A carrier that does not fit through the door must get behind the load to push it through.
        remaining + if leads { lag.abs() } else { CARRIER_LAG_WEIGHT * lag.max(0.0) }
    }

    /// Distance by which the agent would lie outside the arena with its load on the landmark, in its present
    /// grip (u). A carrier stopped by the wall behind it cannot pull the load onto the landmark.
    fn carrier_overhang(&self, state: &State, load: Entity, target: Vec2) -> f32 {
        let Subgoal::Achieve(Literal { predicate: Predicate::On(..), holds: true }) = self.subgoal else {
            return 0.0;
        };
        let me = Entity::Agent(self.agent);
        let inset = Vec2::splat(self.physics.radius(me));
        let place = target + state.position(me) - state.position(load);
        place.distance(place.max(arena::MIN + inset).min(arena::MAX - inset))
    }

    /// Detour between the agent and its load (u): path length minus straight distance. With a wall between
    /// them, neither can proceed before both have moved along it to the door.
    fn detour(&self, state: &State, load: Entity) -> f32 {
        let (me, load) = (state.position(Entity::Agent(self.agent)), state.position(load));
        let way = self.routes.best(me, load, 0.0, self.routes.gaps());
        way.map_or(0.0, |route| (route.length - me.distance(load)).max(0.0))
    }

    /// The path of the moved entity to a point, as an assembly if the carrier fits through all doors on it.
    pub(crate) fn path_of(&self, state: &State, moved_entity: Entity, to: Vec2) -> PlannedPath<'_> {
        let way = self.way(state, state.position(moved_entity), to);
        match moved_entity {
            Entity::Object(object) if !self.load_goes_first(state, moved_entity) => {
                way.with_assembly(CarriedAssembly::of(self.physics, state, object))
            }
            _ => way,
        }
    }

    /// The path between two points for the full width of the assembly if the doors allow it, else for the
    /// narrowest width that passes, down to the object's own.
    pub(crate) fn way(&self, state: &State, from: Vec2, to: Vec2) -> PlannedPath<'_> {
        let find = |width| PlannedPath::find(self.routes, from, to, width);
        let own = self.physics.agents[self.agent].width();
        let Some(object) = state.held_object(self.agent) else { return find(own) };
        let tight = own.max(2.0 * self.physics.object_radii[object]);
        let mut radii = self.physics.object_radii[object] + self.physics.agents[self.agent].radius;
        if state.holds(self.agent.other(), object) {
            radii += self.physics.agents[self.agent.other()].radius;
        }
        let wide = tight.max(2.0 * radii);
        // An agent that does not fit may still push its object through.
        let object_alone = 2.0 * self.physics.object_radii[object];
        let mut ways = [wide, tight, object_alone].into_iter().map(find);
        ways.find(PlannedPath::fits).unwrap_or_else(|| find(tight))
    }

    /// Whether the moved entity is a load that has to pass a door before its carrier, which does not fit.
    pub(crate) fn load_goes_first(&self, state: &State, moved_entity: Entity) -> bool {
        matches!(moved_entity, Entity::Object(_))
            && self.landmark().is_some_and(|target| !self.fits_along(state, target))
    }

    /// The centre of the landmark that the subgoal is about.
    fn landmark(&self) -> Option<Vec2> {
        match self.subgoal {
            Subgoal::Achieve(Literal {
                predicate:
                    Predicate::On(_, landmark) | Predicate::Close(_, PredicateTarget::Landmark(landmark)),
                ..
            }) => Some(arena::LANDMARKS[landmark]),
            _ => None,
        }
    }

    /// Whether the agent fits through every door on its way to a point.
    fn fits_along(&self, state: &State, target: Vec2) -> bool {
        let from = state.position(Entity::Agent(self.agent));
        let width = self.physics.agents[self.agent].width();
        PlannedPath::find(self.routes, from, target, width).fits()
    }
}
