//! Evading the other agent.

use crate::{
    plan::{self, Plan},
    situation::{Situation, Spot},
};
use phase_model::{AgentId, BodySet, Entity, LandmarkId, Predicate, layout::room_of};

/// Minimum gain in separation, over staying, for which a room is chosen (u).
const WORTHWHILE: f32 = 2.0;
/// Weight of the evader's own travel relative to the separation gained.
const EFFORT: f32 = 0.5;
/// Path length to the pursuer beyond which the evader stays (u).
const SAFE: f32 = 20.0;

/// The refuge: of the four rooms and the present position, the one with the greatest separation, provided
/// the evader reaches every door on its path before the pursuer.
#[must_use]
pub fn plan(situation: &Situation<'_>, agent: AgentId) -> Plan {
    let (me, other) = (Entity::Agent(agent), Entity::Agent(agent.other()));
    let (here, there) = (situation.state.position(me), situation.state.position(other));
    let apart = |from, to, who: AgentId| {
        situation.routes.cost(from, to, situation.width(who, None), situation.gaps(who, BodySet::OBJECTS))
    };
    let present = apart(there, here, agent.other());
    let mut best = Plan { subgoals: vec![plan::not(Predicate::Touch(agent, other))], distance: 0.0 };
    if present > SAFE && room_of(here) != room_of(there) {
        return plan::let_go(situation, agent);
    }
    let mut best_gain = present + WORTHWHILE;
    let width = situation.width(agent, None);
    for landmark in LandmarkId::ALL {
        let refuge = situation.position(Spot::Landmark(landmark));
        if room_of(here) == landmark.room() {
            continue;
        }
        let Some(route) = situation.routes.best(here, refuge, width, situation.gaps(agent, BodySet::OBJECTS))
        else {
            continue;
        };
        let reachable = route.impassable == 0
            && route
                .doors()
                .iter()
                .all(|&(_, door)| apart(here, door, agent) + 1.0 < apart(there, door, agent.other()));
        let gain = apart(there, refuge, agent.other()) - EFFORT * route.length;
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
