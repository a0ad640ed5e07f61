//! What carrying and letting go add to an objective.

use crate::{
    course::Way,
    objective::{LONGEST, Objective},
};
use phase_model::{Entity, State, Vec2, arena, physique};
use phase_planner::Subgoal;
use phase_predicates::{Literal, Place, Predicate};

/// What a carrier's own way round a corner counts for beside the way of what it carries.
const CARRIERS_SHARE: f32 = 0.5;

impl Objective<'_> {
    /// How far an object would slide on if it were let go of now (u): what is let go of is to stay there.
    pub(crate) fn slide(&self, state: &State, object: usize) -> f32 {
        let mass = physique::object_mass(self.physique.object_radii[object]);
        let speed = state.body(Entity::object(object)).velocity.length();
        (0.5 * mass * speed * speed / physique::GROUND_FRICTION).min(LONGEST)
    }

    /// The distance left for a held object, with a share for its carrier: whoever carries something through a
    /// door has to come through it too, and may have to turn first.
    pub(crate) fn with_carrier(&self, state: &State, mover: Entity, leads: bool, remaining: f32) -> f32 {
        let me = Entity::agent(self.agent);
        let Some(target) = self.landmark() else { return remaining };
        let to_target = |entity: Entity| {
            let from = state.position(entity);
            self.routes.best(from, target, 0.0, self.routes.gaps()).map_or(0.0, |route| route.length)
        };
        let arm = self.physique.radius(me) + self.physique.radius(mover);
        let lag = to_target(me) - to_target(mover) - arm;
        // Who has to push the load through a door alone must get behind it.
        remaining + if leads { lag.abs() } else { CARRIERS_SHARE * lag.max(0.0) }
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
            }) => Some(arena::LANDMARKS[usize::from(landmark)]),
            _ => None,
        }
    }

    /// Whether the agent fits through every door on its way to a point.
    fn fits_along(&self, state: &State, target: Vec2) -> bool {
        let from = state.position(Entity::agent(self.agent));
        let width = self.physique.agents[self.agent].width();
        Way::find(self.routes, from, target, width).fits()
    }
}
