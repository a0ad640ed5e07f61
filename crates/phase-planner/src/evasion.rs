//! Evading the other agent.

use crate::{
    plan::{self, Plan},
    problem::{Location, PlanningProblem},
};
use phase_model::{AgentId, BodySet, Entity, LandmarkId, Predicate, layout::room_of};

/// Minimum gain in separation, over staying, for which a room is chosen (u).
const MIN_GAIN: f32 = 2.0;
/// Weight of the evader's own travel relative to the separation gained.
const EFFORT_WEIGHT: f32 = 0.5;
/// Path length to the pursuer beyond which the evader stays (u).
const SAFE_DISTANCE: f32 = 20.0;

/// The refuge: of the four rooms and the present position, the one with the maximum separation, provided the
/// evader reaches every door on its path before the pursuer.
#[must_use]
pub fn plan(problem: &PlanningProblem<'_>, agent: AgentId) -> Plan {
    let (me, other) = (Entity::Agent(agent), Entity::Agent(agent.other()));
    let (here, there) = (problem.state.position(me), problem.state.position(other));
    let apart = |from, to, who: AgentId| {
        problem.routes.cost(from, to, problem.width(who, None), problem.gaps(who, BodySet::OBJECTS))
    };
    let present = apart(there, here, agent.other());
    let mut best = Plan { subgoals: vec![plan::not(Predicate::Touch(agent, other))], distance: 0.0 };
    if present > SAFE_DISTANCE && room_of(here) != room_of(there) {
        return plan::release(problem, agent);
    }
    let mut best_gain = present + MIN_GAIN;
    let width = problem.width(agent, None);
    for landmark in LandmarkId::ALL {
        let refuge = problem.position(Location::Landmark(landmark));
        if room_of(here) == landmark.room() {
            continue;
        }
        let Some(route) = problem.routes.best(here, refuge, width, problem.gaps(agent, BodySet::OBJECTS))
        else {
            continue;
        };
        let reachable = route.impassable == 0
            && route
                .doors()
                .iter()
                .all(|&(_, door)| apart(here, door, agent) + 1.0 < apart(there, door, agent.other()));
        let gain = apart(there, refuge, agent.other()) - EFFORT_WEIGHT * route.length;
        if reachable && gain > best_gain {
            best_gain = gain;
            let mut subgoals = Vec::new();
            plan::rooms(&route, here, refuge, me, &mut subgoals);
            subgoals.push(plan::not(Predicate::Touch(agent, other)));
            best = Plan { subgoals, distance: route.length };
        }
    }
    best
}
