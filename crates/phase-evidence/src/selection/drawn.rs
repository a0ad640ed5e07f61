//! Requirements of each kind of event where events end at a sampled step, before or after the outcome.
//!
//! Goals need not be reached: an agent is seen to pursue its goal and to come closer to it, and motion shows
//! which landmark it wants. Where the variant is about a manner of helping or hindering, that manner is seen.

use super::{
    CausalEffect, Counterfactual, RejectionReason,
    common::{object_of, pursued, reached, require},
    kinds,
};
use crate::{
    Clarity, GoalOutcome, Manner, Track, clarity, contact, contest, holding, manner,
    pursuit::Pursuit,
    rest,
    search::{self, FirstLook},
};
use phase_model::{AgentId, AgentSpec, Entity, EventKind, Goal, ObjectId, Scene, Sight, Sign, State};
use phase_predicates::lead::MIN_LANDMARK_LEAD;

/// Least approach of an agent to its goal (u).
const MIN_PROGRESS: f32 = 3.0;
/// Maximum share of an event in which nothing moves, in percent.
pub(super) const MAX_STILL_PERCENT: usize = 75;
/// Time after which an event is lifeless if every body has stayed in its place (steps; 6 s). In 47 of 50
/// recordings it is shorter.
pub(super) const MAX_STANDSTILL: usize = 24;
/// A body that is nearer than this to where it was stays in its place (u): agents that push each other
/// tremble.
const MAX_STAY: f32 = 0.3;
/// Greatest share of an event in knots. Of 50 recordings two have more.
pub(super) const MAX_KNOTTED: f64 = 0.25;
/// Shortest time for which an agent that is helped or hindered tries (steps; 2 s). In each of ten recordings
/// of helping it is that or longer.
pub(super) const MIN_ATTEMPT: usize = 8;
/// Least distance by which each of two competitors gets the object its way (u). In each of six recordings of
/// 25 s it is 14 u or more.
pub(super) const MIN_FAVOUR: f32 = 3.0;
/// Longest time for which a hinderer may, in all, carry an object to where the other wants it (steps).
const MAX_SERVICE: usize = 6;
/// Approach in a step that is seen as one (u).
const SEEN_APPROACH: f32 = 0.05;
/// Least approach of an agent to where it looks for an object, before it sees that (u).
const MIN_SEARCH: f32 = 2.0;
/// Steps of which a chase has pursuit in the last part: the last fourth.
const LASTING_PARTS: usize = 4;

pub(super) fn judge(
    scene: &Scene,
    track: &Track,
    manner: Option<Manner>,
) -> Result<Option<Counterfactual>, RejectionReason> {
    lively(track)?;
    untied(scene, track)?;
    let counterfactual = match scene.kind {
        EventKind::Helping => Some(helping(scene, track)?),
        EventKind::Hindering => Some(hindering(scene, track, manner)?),
        EventKind::Chasing => Some(chasing(scene, track)?),
        EventKind::Competing => match seeker(scene) {
            Some(seeker) => {
                searching(scene, track, seeker)?;
                None
            }
            None => Some(competing(scene, track)?),
        },
        EventKind::Collaborating => {
            collaborating(scene, track)?;
            None
        }
        EventKind::Independent => {
            independent(scene, track)?;
            None
        }
    };
    let seen = manner.is_none_or(|manner| manner.is_shown(scene, track));
    require(seen, RejectionReason::OtherManner)?;
    Ok(counterfactual.map(|it| Counterfactual { cut: true, ..it }))
}

/// Something moves in enough of the steps, and never does everything stay in its place for 6 s: nobody is
/// stuck, and what is done is followed by a rest, not by most of the event.
fn lively(track: &Track) -> Result<(), RejectionReason> {
    require(!is_lifeless_however_it_goes_on(track, track.steps()), RejectionReason::Lifeless)
}

/// Agents that hold on to an object and get nowhere let go of it in time, and are not cut off there.
fn untied(scene: &Scene, track: &Track) -> Result<(), RejectionReason> {
    let Some(clarity) = Clarity::of(scene, track) else { return Err(RejectionReason::Lifeless) };
    require(clarity.knotted <= MAX_KNOTTED && clarity.knot_at_end == 0, RejectionReason::Knotted)
}

/// Whether every event of at most so many steps that begins with this track is
/// [lifeless](RejectionReason::Lifeless).
pub(super) fn is_lifeless_however_it_goes_on(track: &Track, most_steps: usize) -> bool {
    let still = (1..track.states.len()).filter(|&step| rest::is_still(track, step)).count();
    let stuck = |from: usize| standstill(track, from) >= MAX_STANDSTILL;
    100 * still > MAX_STILL_PERCENT * most_steps || (0..track.states.len()).any(stuck)
}

/// Number of steps from a state on for which every body stays where it was.
pub(super) fn standstill(track: &Track, from: usize) -> usize {
    let start = &track.states[from];
    let stays = |state: &&State| {
        let distance = |entity: Entity| state.position(entity).distance(start.position(entity));
        track.physics.entities().all(|entity| distance(entity) < MAX_STAY)
    };
    track.states[from + 1..].iter().take_while(stays).count()
}

fn helping(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let helper = manner::social_agent(scene);
    let helpee = helper.other();
    pursued(scene, track, helpee)?;
    progressed(scene, track, helpee)?;
    require(tries(track, helpee, scene.agents[helpee].goal), RejectionReason::Aimless)?;
    shows_its_landmark(scene, track, helpee)?;
    Ok(Counterfactual { idle: helper, judged: helpee, change: CausalEffect::Helped, cut: true })
}

fn hindering(
    scene: &Scene,
    track: &Track,
    manner: Option<Manner>,
) -> Result<Counterfactual, RejectionReason> {
    let hinderer = manner::social_agent(scene);
    let victim = hinderer.other();
    match scene.agents[victim].goal {
        Goal::Touch { sign: Sign::Positive, .. } => lasting_chase(track, victim)?,
        Goal::Touch { sign: Sign::Negative, .. } => lasting_chase(track, hinderer)?,
        goal => {
            pursued(scene, track, victim)?;
            require(kinds::is_in_the_way(scene, track, hinderer, goal), RejectionReason::NoContact)?;
            let is_about_a_place = object_of(goal).is_none();
            require(is_about_a_place || tries(track, victim, goal), RejectionReason::NoContact)?;
            require(!serves(track, hinderer, goal), RejectionReason::Misleading)?;
            // Who hides an object keeps its goal from being seen: that is what such an event shows.
            if manner != Some(Manner::Hiding) {
                shows_its_landmark(scene, track, victim)?;
            }
        }
    }
    Ok(Counterfactual { idle: hinderer, judged: victim, change: CausalEffect::Hindered, cut: true })
}

/// Whether an agent is seen to try for a while. Otherwise a viewer sees one agent carry an object, and
/// another that minds its own business.
fn tries(track: &Track, agent: AgentId, goal: Goal) -> bool {
    clarity::steps_trying(track, agent, goal) >= MIN_ATTEMPT
}

/// Whether a hinderer alone carries the object to where the other wants it for longer than away from there,
/// and for so long that it looks like help.
fn serves(track: &Track, hinderer: AgentId, goal: Goal) -> bool {
    let Some(object) = object_of(goal) else { return false };
    let carries = |state: &State| state.holds(hinderer, object) && !state.holds(hinderer.other(), object);
    let gains: Vec<f32> = track
        .states
        .windows(2)
        .filter(|pair| carries(&pair[1]))
        .map(|pair| goal.distance(&pair[0]) - goal.distance(&pair[1]))
        .collect();
    let closer = gains.iter().filter(|&&gain| gain > SEEN_APPROACH).count();
    let farther = gains.iter().filter(|&&gain| gain < -SEEN_APPROACH).count();
    closer > MAX_SERVICE && closer > farther
}

/// Both get the object their way: a viewer sees two aims, not two who carry together.
fn competing(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let least = contest::favours(track, scene.goals()).into_iter().fold(f32::INFINITY, f32::min);
    let counterfactual = kinds::competing(scene, track)?;
    require(least >= MIN_FAVOUR, RejectionReason::Uncontested)?;
    for agent in AgentId::ALL {
        shows_its_landmark(scene, track, agent)?;
    }
    Ok(counterfactual)
}

/// The agent of a scene that waits while the other moves the object that it wants.
fn seeker(scene: &Scene) -> Option<AgentId> {
    AgentId::ALL.into_iter().find(|&agent| {
        scene.agents[agent].awareness.sees != Sight::Own && object_of(scene.agents[agent].goal).is_some()
    })
}

/// While an agent waits, the other moves the object that both want, unseen by it. Then it goes where it
/// believes the object to be: to the old place unless it was told of the move.
fn searching(scene: &Scene, track: &Track, seeker: AgentId) -> Result<(), RejectionReason> {
    let AgentSpec { goal, awareness, .. } = scene.agents[seeker];
    let (object, waits) = (goal.subject(), usize::from(awareness.waits));
    pursued(scene, track, seeker.other())?;
    let missed = search::was_moved(track, object, waits) && search::missed(track, seeker, object, waits);
    require(missed, RejectionReason::Unmoved)?;
    let looks =
        search::first_look(track, seeker, object, waits).is_some_and(|look| shows(look, scene, seeker));
    require(looks, RejectionReason::Unsearched)
}

/// Whether an agent has gone where it believes the object to be when it first sees the object or its old
/// place.
fn shows(look: FirstLook, scene: &Scene, seeker: AgentId) -> bool {
    let is_false = scene.agents[seeker].awareness.sees == Sight::Start;
    look.at_old_place == is_false && look.approach >= MIN_SEARCH
}

/// The reason for which the agent of a scene that waits, as far as the event goes, does not show its belief.
pub(super) fn is_searched_in_vain(scene: &Scene, track: &Track) -> Option<RejectionReason> {
    let seeker = seeker(scene)?;
    let AgentSpec { goal, awareness, .. } = scene.agents[seeker];
    let (object, waits, steps) = (goal.subject(), usize::from(awareness.waits), track.steps());
    if steps <= waits {
        let stayed = steps == waits && !search::was_moved(track, object, waits);
        return (stayed || search::notices(track, seeker, object, steps)).then_some(RejectionReason::Unmoved);
    }
    let look = search::first_look(track, seeker, object, waits)?;
    (!shows(look, scene, seeker)).then_some(RejectionReason::Unsearched)
}

fn chasing(scene: &Scene, track: &Track) -> Result<Counterfactual, RejectionReason> {
    let chaser = kinds::chaser(scene);
    if GoalOutcome::of(track, scene.agents[chaser].goal).reached {
        reached(scene, track, chaser)?;
    }
    lasting_chase(track, chaser)?;
    Ok(Counterfactual { idle: chaser.other(), judged: chaser, change: CausalEffect::Hindered, cut: true })
}

/// A chase in which pursuit and flight go on to the end.
fn lasting_chase(track: &Track, chaser: AgentId) -> Result<(), RejectionReason> {
    kinds::chase(track, chaser)?;
    let from = track.steps() - track.steps() / LASTING_PARTS;
    let last = Track { physics: track.physics.clone(), states: track.states[from..].to_vec() };
    let after = Pursuit::of(&last, chaser);
    let away = Pursuit::of(&last, chaser.other());
    require(after.towards > 0, RejectionReason::NoPursuit)?;
    require(2 * away.moving >= last.steps(), RejectionReason::NoFlight)
}

fn collaborating(scene: &Scene, track: &Track) -> Result<(), RejectionReason> {
    progressed(scene, track, AgentId::ZERO)?;
    shows_its_landmark(scene, track, AgentId::ZERO)?;
    let object = object_of(scene.agents[0].goal).unwrap_or(ObjectId::ZERO);
    kinds::shared(track, object)
}

fn independent(scene: &Scene, track: &Track) -> Result<(), RejectionReason> {
    for agent in AgentId::ALL {
        pursued(scene, track, agent)?;
        progressed(scene, track, agent)?;
        shows_its_landmark(scene, track, agent)?;
        if let Some(object) = object_of(scene.agents[agent.other()].goal) {
            let meddled = holding::carried(track, agent, object).steps;
            require(meddled == 0, RejectionReason::Interference)?;
        }
    }
    let met = contact::steps_touching(track, Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE)).len();
    require(met * kinds::MAX_CONTACT_DIVISOR <= track.steps(), RejectionReason::Interference)
}

/// An agent's goal is reached, not before its pursuit was visible, or its subject has come clearly closer.
fn progressed(scene: &Scene, track: &Track, agent: AgentId) -> Result<(), RejectionReason> {
    let goal = scene.agents[agent].goal;
    if GoalOutcome::of(track, goal).reached {
        return reached(scene, track, agent).map(|_| ());
    }
    let Some(start) = track.states.first().map(|state| goal.distance(state)) else {
        return Err(RejectionReason::NoProgress);
    };
    let nearest = track.states.iter().map(|state| goal.distance(state)).fold(f32::INFINITY, f32::min);
    require(start - nearest >= MIN_PROGRESS, RejectionReason::NoProgress)
}

/// Motion shows the landmark of an agent's goal, if the goal is about one.
fn shows_its_landmark(scene: &Scene, track: &Track, agent: AgentId) -> Result<(), RejectionReason> {
    let lead = clarity::landmark_shown(track, scene.agents[agent].goal);
    require(lead.is_none_or(|lead| lead >= f64::from(MIN_LANDMARK_LEAD)), RejectionReason::Unshown)
}
