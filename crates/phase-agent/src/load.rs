//! What carrying and letting go add to an objective.

use crate::{
    convoy::Convoy,
    course::Way,
    objective::{LONGEST, Objective},
};
use phase_model::{Entity, Literal, ObjectId, Place, Predicate, State, Subgoal, Vec2, arena, physique};

/// What a carrier's own way round a corner counts for beside the way of what it carries.
const CARRIERS_SHARE: f32 = 0.5;
/// What the way round the end of a wall that a carrier and its load have between them counts for: more than the
/// load loses by going back along that wall.
const PARTED: f32 = 2.0;

impl Objective<'_> {
    /// How far an object would slide on if it were let go of now (u): what is let go of is to stay there.
    pub(crate) fn slide(&self, state: &State, object: ObjectId) -> f32 {
        let mass = physique::object_mass(self.physique.object_radii[object]);
        let speed = state.body(Entity::Object(object)).velocity.length();
        (0.5 * mass * speed * speed / physique::GROUND_FRICTION).min(LONGEST)
    }

    /// The distance left for a held object, with a share for its carrier: whoever carries something through a
    /// door has to come through it too, and may have to turn first.
    pub(crate) fn with_carrier(&self, state: &State, mover: Entity, leads: bool, remaining: f32) -> f32 {
        let me = Entity::Agent(self.agent);
        let Some(target) = self.landmark() else { return remaining };
        let to_target = |entity: Entity| {
            let from = state.position(entity);
            self.routes.best(from, target, 0.0, self.routes.gaps()).map_or(0.0, |route| route.length)
        };
        let arm = self.physique.radius(me) + self.physique.radius(mover);
        let lag = to_target(me) - to_target(mover) - arm;
        let remaining = remaining + PARTED * self.parted(state, mover);
        let remaining = remaining + self.no_room_behind(state, mover, target);
        // Who has to push the load through a door alone must get behind it.
        remaining + if leads { lag.abs() } else { CARRIERS_SHARE * lag.max(0.0) }
    }

    /// How far outside the arena the agent would be with its load on a landmark if it held it on the side that it
    /// does (u): a load pulled there by one who comes up against the wall behind does not arrive.
    fn no_room_behind(&self, state: &State, load: Entity, target: Vec2) -> f32 {
        let Subgoal::Achieve(Literal { predicate: Predicate::On(..), holds: true }) = self.subgoal else {
            return 0.0;
        };
        let me = Entity::Agent(self.agent);
        let inset = Vec2::splat(self.physique.radius(me));
        let place = target + state.position(me) - state.position(load);
        place.distance(place.max(arena::MIN + inset).min(arena::MAX - inset))
    }

    /// How much longer than straight the way from the agent to what it holds is (u): with a wall between them
    /// neither can go on before both have slid along it to the door.
    fn parted(&self, state: &State, load: Entity) -> f32 {
        let (me, load) = (state.position(Entity::Agent(self.agent)), state.position(load));
        let way = self.routes.best(me, load, 0.0, self.routes.gaps());
        way.map_or(0.0, |route| (route.length - me.distance(load)).max(0.0))
    }

    /// The way of what moves to a point. A load that its carrier fits through all doors with goes there with it.
    pub(crate) fn way_of(&self, state: &State, mover: Entity, to: Vec2) -> Way<'_> {
        let way = self.way(state, state.position(mover), to);
        match mover {
            Entity::Object(object) if !self.load_leads(state, mover) => {
                way.with_convoy(Convoy::of(self.physique, state, object))
            }
            _ => way,
        }
    }

    /// The way between two points, with room kept for as much as the agent, what it holds and who else
    /// holds that take side by side, if the doors allow it, or else what just passes, be it the object alone.
    pub(crate) fn way(&self, state: &State, from: Vec2, to: Vec2) -> Way<'_> {
        let find = |width| Way::find(self.routes, from, to, width);
        let own = self.physique.agents[self.agent].width();
        let Some(object) = state.held_object(self.agent) else { return find(own) };
        let tight = own.max(2.0 * self.physique.object_radii[object]);
        let mut radii = self.physique.object_radii[object] + self.physique.agents[self.agent].radius;
        if state.holds(self.agent.other(), object) {
            radii += self.physique.agents[self.agent.other()].radius;
        }
        let wide = tight.max(2.0 * radii);
        // What does not fit itself may still push through what it holds.
        let object_alone = 2.0 * self.physique.object_radii[object];
        let mut ways = [wide, tight, object_alone].into_iter().map(find);
        ways.find(Way::fits).unwrap_or_else(|| find(tight))
    }

    /// Whether what moves is a load that its carrier does not fit through a door with, so that it has to go first:
    /// round the carrier, if that is before it.
    pub(crate) fn load_leads(&self, state: &State, mover: Entity) -> bool {
        matches!(mover, Entity::Object(_))
            && self.landmark().is_some_and(|target| !self.fits_along(state, target))
    }

    /// The centre of the landmark that the subgoal is about.
    fn landmark(&self) -> Option<Vec2> {
        match self.subgoal {
            Subgoal::Achieve(Literal {
                predicate: Predicate::On(_, landmark) | Predicate::Close(_, Place::Landmark(landmark)),
                ..
            }) => Some(arena::LANDMARKS[landmark]),
            _ => None,
        }
    }

    /// Whether the agent fits through every door on its way to a point.
    fn fits_along(&self, state: &State, target: Vec2) -> bool {
        let from = state.position(Entity::Agent(self.agent));
        let width = self.physique.agents[self.agent].width();
        Way::find(self.routes, from, target, width).fits()
    }
}
