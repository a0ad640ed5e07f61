//! Everything that can be asked about an event, or about two that differ in one social variable.

mod shown;
mod social;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use shown::shows_relation;

use crate::{
    Alternative, Facts, Query, SimulatedFutures,
    facts::nearer,
    query::{clear_room, room_value},
};
use phase_evidence::{Effect, GoalOutcome, Track, selection::decisive_agent};
use phase_model::{AgentId, Entity, Goal, ObjectId, RoomId, Scene, Sight, Sign, State, layout::room_of};
use phase_perception::observed_set;
use serde_json::{Value, json};

/// Moments (steps) at which it is asked where something is.
const PLACE_STEPS: [usize; 2] = [20, 32];
/// Moments at which it is asked what has been seen.
const SEEN_STEPS: [usize; 3] = [12, 24, 36];
/// Least number of steps for which an object has to be in view to count as seen, and for which it has to stay
/// out of view after the moment to count as not seen.
const LOOK_STEPS: usize = 3;
/// Moments at which it is asked what is believed.
const BELIEF_STEPS: [usize; 3] = [16, 28, 40];
/// Least share of the particles for a belief.
pub(crate) const SURE: f64 = 0.8;
/// Least distance from its landmark at which a goal's subject has clearly not arrived (u): half the side of a
/// landmark, and two units more.
const MISSED: f32 = 4.5;

/// A question before its options are ordered and its words chosen.
#[derive(Clone, Debug)]
pub(crate) struct Draft {
    pub(crate) query: Query,
    pub(crate) events: Vec<String>,
    pub(crate) set: Option<String>,
    pub(crate) until: Option<usize>,
    /// All values among which one has to choose.
    pub(crate) values: Vec<String>,
    /// The right one.
    pub(crate) value: String,
    /// Whatever could give the answer away without motion.
    pub(crate) stratum: String,
    pub(crate) proof: Value,
    pub(crate) p_human: Option<Vec<f64>>,
}

/// Collects drafts about one event.
struct Asker<'a> {
    facts: &'a Facts,
    drafts: Vec<Draft>,
}

pub(crate) fn texts<const N: usize>(values: [&str; N]) -> Vec<String> {
    values.map(str::to_owned).to_vec()
}

fn rooms_but(room: RoomId) -> Vec<String> {
    RoomId::ALL.into_iter().filter(|&it| it != room).map(room_value).collect()
}

/// The rooms that share a side with a room; they are numbered in a circle.
fn rooms_beside(room: RoomId) -> impl Iterator<Item = RoomId> {
    RoomId::ALL.into_iter().filter(move |&it| it.index().abs_diff(room.index()) % 2 == 1)
}

/// Whether an agent of a scene knows more of objects than its senses tell. Such events are made for questions
/// about beliefs, and may end before they show anything else.
#[must_use]
pub fn is_about_beliefs(scene: &Scene) -> bool {
    scene.agents.iter().any(|agent| agent.awareness.sees != Sight::Own)
}

/// All drafts about one event.
pub(crate) fn about_event(facts: &Facts) -> Vec<Draft> {
    let mut asker = Asker { facts, drafts: Vec::new() };
    if is_about_beliefs(&facts.scene) {
        asker.minds();
        return asker.drafts;
    }
    asker.social();
    asker.places();
    asker.handling();
    asker.minds();
    asker.alternatives();
    asker.drafts
}

impl Asker<'_> {
    fn ask(&mut self, query: Query, values: Vec<String>, value: String, stratum: String, proof: Value) {
        let Facts { id, set, .. } = self.facts;
        self.drafts.push(Draft {
            query,
            events: vec![id.clone()],
            set: set.clone(),
            until: None,
            values,
            value,
            stratum,
            proof,
            p_human: None,
        });
    }

    fn objects(&self) -> impl Iterator<Item = ObjectId> + use<> {
        ObjectId::ALL.into_iter().take(self.facts.scene.objects.len())
    }

    fn entities(&self) -> Vec<Entity> {
        self.facts.track.physics.entities().collect()
    }

    fn first(&self) -> Option<&State> {
        self.facts.track.states.first()
    }

    fn nearer_to_first_object(&self) -> String {
        match self.first().filter(|_| !self.facts.scene.objects.is_empty()) {
            Some(first) => format!("agent {} nearer to an object", nearer(first, ObjectId::ZERO)),
            None => "no object".to_owned(),
        }
    }

    /// Rooms of entities that have changed rooms.
    fn places(&mut self) {
        let Some(first) = self.first().copied() else { return };
        for entity in self.entities() {
            let Some(start) = clear_room(&first, entity) else { continue };
            let what = if matches!(entity, Entity::Agent(_)) { "agent" } else { "object" };
            let mut queries = vec![Query::EndRoom { entity }];
            queries.extend(PLACE_STEPS.map(|step| Query::RoomAt { entity, step }));
            if let Entity::Agent(agent) = entity {
                queries.push(Query::EntersFirst { agent });
            }
            for query in queries {
                let Some(value) = query.seen(&self.facts.track) else { continue };
                // Nobody enters the opposite room first, but on the way through the centre.
                let values = match query {
                    Query::EntersFirst { .. } => rooms_beside(start).map(room_value).collect(),
                    _ => rooms_but(start),
                };
                let when = match query {
                    Query::RoomAt { step, .. } => format!(", step {step}"),
                    _ => String::new(),
                };
                if values.contains(&value) {
                    let proof = json!({ "rule": "trajectory", "first_room": start });
                    self.ask(query, values, value, format!("{what} first in room {start}{when}"), proof);
                }
            }
        }
    }

    /// Agents that touch and carry objects.
    fn handling(&mut self) {
        for object in self.objects() {
            let stratum = self.nearer_to(object);
            let query = Query::FirstTouch { object };
            if let Some(value) = query.seen(&self.facts.track) {
                let rule = "touched for at least 3 steps, the other agent apart until at least 4 steps later";
                let proof = json!({ "rule": rule });
                self.ask(query, texts(["0", "1"]), value, stratum.clone(), proof);
            }
            // Without grips nothing is known of holding.
            let query = Query::Carrier { object };
            if let (Some(value), true) = (query.seen(&self.facts.track), self.facts.inside.is_some()) {
                let proof = json!({ "rule": "held for at least 3 steps and moved at least 1 u meanwhile" });
                self.ask(query, texts(["0", "1", "both", "neither"]), value, stratum, proof);
            }
        }
    }

    fn nearer_to(&self, object: ObjectId) -> String {
        let Some(first) = self.first() else { return String::new() };
        let room = room_of(first.position(Entity::Object(object)));
        let inside = AgentId::ALL.map(|agent| room_of(first.position(Entity::Agent(agent))) == room);
        format!("agent {} nearer, in its room {inside:?}", nearer(first, object))
    }

    /// Objects that agents have seen, and their beliefs, by their observations and particles. It is not asked
    /// what an agent believes that knows more than it sees, or whose particles went on without it: those of
    /// an object that was carried when it was last seen may follow it, and nothing shows how far.
    fn minds(&mut self) {
        let Some(inside) = &self.facts.inside else { return };
        let mut asked = Vec::new();
        for agent in AgentId::ALL {
            for object in self.objects() {
                let entity = Entity::Object(object);
                let observes =
                    |state: &State| observed_set(&self.facts.track.physics, state, agent).contains(entity);
                let observed: Vec<bool> = inside.states.iter().map(observes).collect();
                for step in SEEN_STEPS.into_iter().filter(|&step| step < observed.len()) {
                    let seen = observed[..=step].iter().any(|&seen| seen);
                    // Neither a glimpse nor a moment just before the first look is asked about.
                    let looks = observed[..=step].iter().filter(|&&seen| seen).count();
                    let soon = observed.iter().skip(step + 1).take(LOOK_STEPS).any(|&seen| seen);
                    if seen && looks < LOOK_STEPS || !seen && soon {
                        continue;
                    }
                    let value = if seen { "yes" } else { "no" }.to_owned();
                    let query = Query::Seen { agent, object, step };
                    // What is seen between two frames is left out: it has to be visible in them.
                    if query.seen(&self.facts.track).as_ref() != Some(&value) || observed[0] {
                        continue;
                    }
                    let at = observed.iter().position(|&seen| seen);
                    let proof = json!({ "rule": "observations of the agent's mind", "first_seen_step": at });
                    let place = |entity| room_of(inside.states[0].position(entity));
                    let near = place(Entity::Agent(agent)) == place(entity);
                    let stratum = format!("step {step}, {} room", if near { "same" } else { "other" });
                    asked.push((query, texts(["yes", "no"]), value, stratum, proof));
                }
                if self.facts.scene.agents[agent].awareness.sees != Sight::Own {
                    continue;
                }
                for step in BELIEF_STEPS.into_iter().filter(|&step| step < observed.len()) {
                    let Some(last) = observed[..=step].iter().rposition(|&seen| seen) else { continue };
                    let belief = inside.beliefs[agent].get(step).and_then(|rooms| rooms.get(object.index()));
                    let Some(&(room, share)) = belief else { continue };
                    let seen = &inside.states[last];
                    let rested = AgentId::ALL.iter().all(|&agent| !seen.holds(agent, object));
                    let query = Query::Believes { agent, object, step };
                    if observed[step]
                        || share < SURE
                        || !rested
                        || clear_room(seen, entity) != Some(room)
                        || query.seen(&self.facts.track) != Some(room_value(room))
                    {
                        continue;
                    }
                    let start = room_of(inside.states[0].position(entity));
                    let truth = room_of(inside.states[step].position(entity));
                    let proof = json!({
                        "rule": "particles of the agent's belief, which are where it saw the object last",
                        "share_of_particles": share, "last_seen_step": last,
                        "true_room": truth, "false_belief": truth != room,
                    });
                    let values = RoomId::ALL.into_iter().map(room_value).collect();
                    asked.push((
                        query,
                        values,
                        room_value(room),
                        format!("step {step}, object first in room {start}"),
                        proof,
                    ));
                }
            }
        }
        for (query, values, value, stratum, proof) in asked {
            self.ask(query, values, value, stratum, proof);
        }
    }

    /// The course of events without an agent, and the next seconds.
    fn alternatives(&mut self) {
        let Some(inside) = &self.facts.inside else { return };
        let mut asked = Vec::new();
        if let Some(without) = &inside.without {
            let judged = self.facts.scene.agents[without.idle.other()].goal;
            if let Some((value, outcomes)) = change(&self.facts.track, judged, without) {
                let proof = json!({
                    "rule": "the same scene and seed, simulated with the agent neutral and idle",
                    "idle": without.idle, "with": outcomes.with, "without": outcomes.without,
                });
                let query = Query::Without { idle: without.idle, judged };
                let values = texts(["better", "worse", "same"]);
                asked.push((query, values, value.to_owned(), self.nearer_to_first_object(), proof, None));
            }
        }
        if let Some(futures) = &inside.futures {
            let (cut, after) = (futures.step, futures.steps);
            for (entity, now, room) in foreseen(self.facts, &inside.states, futures) {
                let values = rooms_beside(now).chain([now]).map(room_value).collect();
                let what = if matches!(entity, Entity::Agent(_)) { "agent" } else { "object" };
                let proof = json!({
                    "rule": "futures simulated from the last state of the video, and the event itself",
                    "futures": futures.ends.len(), "p": 1.0, "room_at_the_cut": now,
                });
                let query = Query::Ahead { entity, step: cut, after };
                let stratum = format!("{what} last in room {now}");
                asked.push((query, values, room_value(room), stratum, proof, Some(cut)));
            }
        }
        for (query, values, value, stratum, proof, until) in asked {
            self.ask(query, values, value, stratum, proof);
            if let Some(draft) = self.drafts.last_mut() {
                draft.until = until;
            }
        }
    }
}

/// Whether a goal is reached only without the idle agent (`better`), only with it (`worse`), or equally soon
/// (`same`); `None` where it is missed both times, or nearly reached once, or sooner once.
fn change(track: &Track, judged: Goal, without: &Alternative) -> Option<(&'static str, Effect)> {
    if !tells(track, judged) {
        return None;
    }
    let effect =
        Effect { with: GoalOutcome::of(track, judged), without: GoalOutcome::of(&without.track, judged) };
    let missed = |track: &Track| track.states.last().is_some_and(|state| is_missed(state, judged));
    let value = match (effect.with.reached, effect.without.reached) {
        (true, true) => (!effect.helped() && !effect.hindered()).then_some("same"),
        (true, false) => missed(&without.track).then_some("worse"),
        (false, true) => missed(track).then_some("better"),
        (false, false) => None,
    };
    value.map(|value| (value, effect))
}

/// Whether a goal has an outcome that can be compared with another: something is to be at a landmark, and is
/// there at some time, or clearly away from it at the end.
fn tells(track: &Track, judged: Goal) -> bool {
    let is_clear = || {
        GoalOutcome::of(track, judged).reached
            || track.states.last().is_some_and(|state| is_missed(state, judged))
    };
    judged.sign() == Sign::Positive && judged.landmark().is_some() && is_clear()
}

/// Whether a question can follow from the course of an event without an agent. If not, that course need not
/// be simulated.
#[must_use]
pub fn asks_without(facts: &Facts, idle: AgentId) -> bool {
    tells(&facts.track, facts.scene.agents[idle.other()].goal)
}

/// The entities that end in one room in the event and in all its futures: for each its room when the futures
/// begin, and that at their end, which is the same or beside it. `states` are those of the event. With more
/// futures there can only be fewer.
#[must_use]
pub fn foreseen(
    facts: &Facts,
    states: &[State],
    futures: &SimulatedFutures,
) -> Vec<(Entity, RoomId, RoomId)> {
    let SimulatedFutures { step, steps, ends } = futures;
    let (Some(state), Some(end)) = (states.get(*step), states.get(step + steps)) else { return Vec::new() };
    let of = |entity: Entity| {
        let (now, room) = (clear_room(state, entity)?, clear_room(end, entity)?);
        let is_near = room == now || rooms_beside(now).any(|it| it == room);
        let is_agreed = ends.iter().all(|end| clear_room(end, entity) == Some(room));
        (is_near && is_agreed).then_some((entity, now, room))
    };
    facts.track.physics.entities().filter_map(of).collect()
}

fn is_missed(state: &State, goal: Goal) -> bool {
    goal.distance(state) >= MISSED
}

/// The agent whose absence an event is compared with: the decisive one of its kind, or agent 1.
#[must_use]
pub fn idle_of(facts: &Facts) -> AgentId {
    decisive_agent(&facts.scene, &facts.track).unwrap_or(AgentId::ONE)
}
