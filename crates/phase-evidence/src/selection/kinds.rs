//! Requirements of each kind of event where events end once they are settled.

use super::{
    CausalEffect, Counterfactual, MIN_VISIBLE_STEPS, RejectionReason,
    common::{object_of, pursued, reached, require, touches},
};
use crate::{GoalOutcome, Track, blocking, contact, holding, manner, pursuit::Pursuit};
use phase_model::{AgentId, Entity, EventKind, Goal, ObjectId, Scene, Sign};
use phase_navigation::Map;

/// Minimum number of steps for which both pull at an object that is fought over.
const MIN_CONTESTED_STEPS: usize = 5;
/// Minimum distance for an object to count as carried (u).
const MIN_CARRIED_DISTANCE: f32 = 1.0;
/// Minimum number of moving steps of a pursuit.
const MIN_PURSUIT_STEPS: usize = 8;
/// Independent agents may touch each other in one of this number of steps.
pub(super) const MAX_CONTACT_DIVISOR: usize = 5;

pub(super) fn judge(scene: &Scene, track: &Track) -> Result<Option<Counterfactual>, RejectionReason> {
    match scene.kind {
        EventKind::Helping => helping(scene, track).map(Some),
        EventKind::Hindering => hindering(scene, track).map(Some),
        EventKind::Chasing => chasing(scene, track).map(Some),
        EventKind::Competing => competing(scene, track).map(Some),
        EventKind::Collaborating => collaborating(scene, track).map(|()| None),
        EventKind::Independent => independent(scene, track).map(|()| None),
    }
}

/// The helpee's goal is reached, and the helper has held an object. If the goal is about an object, the
/// helpee pursued it visibly before the helper took it, and has held it as well; otherwise a viewer sees one
/// agent move an object and the other stand idle.
fn helping(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let helper = manner::social_agent(scene);
    let helpee = helper.other();
    reached(scene, track, helpee)?;
    let held = track.states.iter().filter(|state| state.grips[helper].is_some()).count();
    require(held >= MIN_VISIBLE_STEPS, RejectionReason::NoContact)?;
    if let Some(object) = object_of(scene.agents[helpee].goal) {
        let taken = track.states.iter().position(|state| state.holds(helper, object));
        pursued(scene, &track.until(taken.unwrap_or(track.steps())), helpee)?;
        let lent_a_hand = holding::carried(track, helpee, object).steps;
        require(lent_a_hand >= MIN_VISIBLE_STEPS, RejectionReason::Aimless)?;
    }
    Ok(Counterfactual { idle: helper, judged: helpee, change: CausalEffect::Helped, cut: false })
}

/// The victim pursues its goal, and the hinderer is at it, obstructs it or is at its object; where the goal
/// is about touching, one pursues the other, which escapes.
fn hindering(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let hinderer = manner::social_agent(scene);
    let victim = hinderer.other();
    match scene.agents[victim].goal {
        Goal::Touch { sign: Sign::Positive, .. } => chase(track, victim)?,
        Goal::Touch { sign: Sign::Negative, .. } => chase(track, hinderer)?,
        goal => {
            pursued(scene, track, victim)?;
            require(is_in_the_way(scene, track, hinderer, goal), RejectionReason::NoContact)?;
        }
    }
    Ok(Counterfactual { idle: hinderer, judged: victim, change: CausalEffect::Hindered, cut: false })
}

fn chasing(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let chaser = chaser(scene);
    if GoalOutcome::of(track, scene.agents[chaser].goal).reached {
        reached(scene, track, chaser)?;
    }
    chase(track, chaser)?;
    Ok(Counterfactual { idle: chaser.other(), judged: chaser, change: CausalEffect::Hindered, cut: false })
}

/// The agent without which an event would tell most about its kind: who helps or hinders, who flees, or who
/// wins, and agent 1 if nobody does. `None` for collaborating and independent agents.
#[must_use]
pub fn decisive_agent(scene: &Scene, track: &Track) -> Option<AgentId> {
    match scene.kind {
        EventKind::Helping | EventKind::Hindering => Some(manner::social_agent(scene)),
        EventKind::Chasing => Some(chaser(scene).other()),
        EventKind::Competing => Some(winner(scene, track).unwrap_or(AgentId::ONE)),
        EventKind::Collaborating | EventKind::Independent => None,
    }
}

/// The agent that reaches its goal; of two, the first.
fn winner(scene: &Scene, track: &Track) -> Option<AgentId> {
    AgentId::ALL.into_iter().find(|&it| GoalOutcome::of(track, scene.agents[it].goal).reached)
}

/// Both reach the object; one wins, or they fight over it. Without the winner the loser would have won.
pub(super) fn competing(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let object = object_of(scene.agents[0].goal).unwrap_or(ObjectId::ZERO);
    for agent in AgentId::ALL {
        pursued(scene, track, agent)?;
        require(touches(track, agent, object) > 0, RejectionReason::Uncontested)?;
    }
    let winner = winner(scene, track);
    let fought = holding::carried_together(track, object).steps;
    require(winner.is_some() || fought >= MIN_CONTESTED_STEPS, RejectionReason::Uncontested)?;
    let winner = winner.unwrap_or(AgentId::ONE);
    Ok(Counterfactual { idle: winner, judged: winner.other(), change: CausalEffect::Hindered, cut: false })
}

/// The object reaches its landmark, carried by both at once or by one after the other.
fn collaborating(scene: &Scene, track: &Track) -> Result<(), RejectionReason> {
    reached(scene, track, AgentId::ZERO)?;
    let object = object_of(scene.agents[0].goal).unwrap_or(ObjectId::ZERO);
    shared(track, object)
}

/// Both carry the object, at once or one after the other.
pub(super) fn shared(track: &Track, object: ObjectId) -> Result<(), RejectionReason> {
    let much =
        |it: holding::CarryStatistics| it.steps >= MIN_VISIBLE_STEPS && it.distance >= MIN_CARRIED_DISTANCE;
    let together = much(holding::carried_together(track, object));
    let in_turn = AgentId::ALL.into_iter().all(|agent| much(holding::carried_alone(track, agent, object)));
    require(together || in_turn, RejectionReason::NotTogether)
}

/// Both reach their goals without interfering with each other; meeting on the way is allowed.
fn independent(scene: &Scene, track: &Track) -> Result<(), RejectionReason> {
    for agent in AgentId::ALL {
        reached(scene, track, agent)?;
        if let Some(object) = object_of(scene.agents[agent.other()].goal) {
            let meddled = holding::carried(track, agent, object).steps;
            require(meddled == 0, RejectionReason::Interference)?;
        }
    }
    let met = contact::steps_touching(track, Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE)).len();
    require(met * MAX_CONTACT_DIVISOR <= track.steps(), RejectionReason::Interference)
}

/// One pursues the other for most of the time in which it moves, and the other stays away for a while and is
/// not in its grasp for more than half of the event.
pub(super) fn chase(track: &Track, chaser: AgentId) -> Result<(), RejectionReason> {
    let after = Pursuit::of(track, chaser);
    let away = Pursuit::of(track, chaser.other());
    require(
        after.moving >= MIN_PURSUIT_STEPS && 2 * after.towards >= after.moving,
        RejectionReason::NoPursuit,
    )?;
    require(away.away >= MIN_VISIBLE_STEPS && away.away > away.towards, RejectionReason::NoFlight)?;
    let caught =
        contact::steps_touching(track, Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE)).len();
    require(2 * caught <= track.steps(), RejectionReason::NoFlight)
}

/// Whether a hinderer was seen at the victim, at its object, or obstructing it.
pub(super) fn is_in_the_way(scene: &Scene, track: &Track, hinderer: AgentId, goal: Goal) -> bool {
    let victim = hinderer.other();
    let target = |state: &phase_model::State| blocking::next_place(goal, state);
    let met = contact::steps_touching(track, Entity::Agent(hinderer), Entity::Agent(victim)).len();
    let handled = object_of(goal).map_or(0, |object| holding::carried(track, hinderer, object).steps);
    let in_door = || blocking::steps_blocking_a_door(track, &Map::new(scene.layout), hinderer, target).len();
    let between = || blocking::steps_between(track, hinderer, target).len();
    met >= MIN_VISIBLE_STEPS
        || handled >= MIN_VISIBLE_STEPS
        || in_door() >= MIN_VISIBLE_STEPS
        || between() >= MIN_VISIBLE_STEPS
}

/// The agent of a chase that wants to touch the other.
pub(super) fn chaser(scene: &Scene) -> AgentId {
    let chases = |agent: &AgentId| scene.agents[*agent].goal.sign() == Sign::Positive;
    AgentId::ALL.into_iter().find(chases).unwrap_or(AgentId::ZERO)
}
