//! An event in words: what each agent wants, and what happens, moment by moment.

use crate::{GoalOutcome, Manner, Track, contact, holding, outcome::is_on};
use phase_model::{
    AgentId, Attitude, Entity, Goal, LandmarkId, RoomId, Scene, Sign,
    arena::STEP_VIDEO_SECONDS,
    layout::room_of,
    words::{Names, corner, wants_to},
};

/// Steps for which something has to last to be told, and within which the same thing is not told again.
const LASTING_STEPS: usize = 4;

/// Something that is seen at a moment of an event, whatever anybody wants.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Happening {
    /// The step at whose end it is first so; 0 for the initial state.
    pub step: usize,
    /// A sentence, such as `The red agent takes hold of the pink object.`
    pub text: String,
}

/// A description of an event at three lengths. Goals and attitudes are the scene's, everything else is judged
/// from the motion.
///
/// [`Narrative::seen`] has no intents in it, so that it can be shown to somebody who has to infer them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Narrative {
    /// One sentence: what the agents are up to, and whether it succeeds.
    pub short: String,
    /// The short description, each agent's goal with its outcome, and the manner of help or hindrance.
    pub medium: String,
    /// The medium description and all happenings with their times.
    pub long: String,
    /// The places of everything at first, all happenings with their times, and the places at last, without
    /// goals, attitudes and outcomes.
    pub seen: String,
}

impl Narrative {
    /// Describes an event in the words of a palette. Without grips, which measured recordings lack, nothing
    /// is said of holding.
    #[must_use]
    pub fn of(scene: &Scene, track: &Track, names: &Names) -> Self {
        let short = summary(scene, track, names);
        let mut medium = vec![short.clone()];
        medium.extend(AgentId::ALL.map(|agent| intent(scene, track, names, agent)));
        let manners: Vec<&str> =
            Manner::shown(scene, track).into_iter().map(|manner| manner_in_words(manner)).collect();
        if !manners.is_empty() {
            medium.push(format!("What is seen: {}.", manners.join("; ")));
        }
        let medium = medium.join(" ");
        let mut seen = vec![places(track, names, 0, "At first")];
        seen.extend(happenings(track, names).into_iter().map(|it| format!("{} {}", time(it.step), it.text)));
        seen.push(places(
            track,
            names,
            track.steps(),
            &format!("At the end, after {}", seconds(track.steps())),
        ));
        let seen = seen.join("\n");
        Self { long: format!("{medium}\n{seen}"), short, medium, seen }
    }
}

/// Everything that is seen to happen, in order of time: agents go from room to room, take hold of objects and
/// let go of them, touch each other, and entities come to landmarks and leave them.
#[must_use]
pub fn happenings(track: &Track, names: &Names) -> Vec<Happening> {
    let mut found: Vec<Happening> = Vec::new();
    for agent in AgentId::ALL {
        found.extend(rooms_entered(track, names, agent));
    }
    let steps = track.steps();
    for hold in holding::holds(track) {
        let (who, what) =
            (names.entity(Entity::Agent(hold.agent)), names.entity(Entity::Object(hold.object)));
        found.push(Happening { step: hold.from, text: format!("The {who} takes hold of the {what}.") });
        if hold.to < steps {
            found.push(Happening { step: hold.to + 1, text: format!("The {who} lets go of the {what}.") });
        }
    }
    let met = contact::steps_touching(track, Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE));
    let is_new = |k: &usize| *k == 0 || met[*k] > met[*k - 1] + LASTING_STEPS;
    let begun = (0..met.len()).filter(is_new).map(|k| met[k]);
    found.extend(begun.map(|step| Happening { step, text: "The two agents touch.".to_owned() }));
    for entity in track.physics.entities() {
        for landmark in LandmarkId::ALL {
            let on: Vec<bool> = track.states.iter().map(|state| is_on(state, entity, landmark)).collect();
            let what = format!("The {}", names.entity(entity));
            let place = names.landmark_and_place(landmark);
            found.extend(changes(&on).into_iter().map(|(step, on)| {
                let verb = if on { "comes to be on" } else { "leaves" };
                Happening { step, text: format!("{what} {verb} the {place}.") }
            }));
        }
    }
    // The sort is stable: what happens at once is told in the order above.
    found.sort_by_key(|happening| happening.step);
    found
}

/// The steps after the first at which something changes for at least [`LASTING_STEPS`], or until the end.
fn changes(holds: &[bool]) -> Vec<(usize, bool)> {
    let Some(mut current) = holds.first().copied() else { return Vec::new() };
    let mut changes = Vec::new();
    for step in 1..holds.len() {
        let lasting = holds[step..].iter().take(LASTING_STEPS).all(|&now| now == holds[step]);
        if holds[step] != current && lasting {
            current = holds[step];
            changes.push((step, current));
        }
    }
    changes
}

/// The rooms that an agent enters, with the object that it holds then.
fn rooms_entered(track: &Track, names: &Names, agent: AgentId) -> Vec<Happening> {
    let entity = Entity::Agent(agent);
    let rooms: Vec<RoomId> = track.states.iter().map(|state| room_of(state.position(entity))).collect();
    let Some(mut current) = rooms.first().copied() else { return Vec::new() };
    let mut found = Vec::new();
    for step in 1..rooms.len() {
        let lasting = rooms[step..].iter().take(LASTING_STEPS).all(|&room| room == rooms[step]);
        if rooms[step] == current || !lasting {
            continue;
        }
        current = rooms[step];
        let with = track.states[step].held_object(agent);
        let with = with
            .map_or_else(String::new, |object| format!(" with the {}", names.entity(Entity::Object(object))));
        let text = format!("The {} enters the {} room{with}.", names.entity(entity), room(current));
        found.push(Happening { step, text });
    }
    found
}

/// A room by its corner, such as `top left`.
fn room(room: RoomId) -> &'static str {
    corner(LandmarkId::ALL[room.index()])
}

/// Seconds of video, such as `2.5 s`.
fn seconds(step: usize) -> String {
    format!("{} s", step as f64 * STEP_VIDEO_SECONDS)
}

fn time(step: usize) -> String {
    format!("{}:", seconds(step))
}

/// The rooms of all entities at a step.
fn places(track: &Track, names: &Names, step: usize, when: &str) -> String {
    let Some(state) = track.states.get(step) else { return String::new() };
    let each = track.physics.entities().map(|entity| {
        format!("the {} is in the {} room", names.entity(entity), room(room_of(state.position(entity))))
    });
    format!("{when}, {}.", list(&each.collect::<Vec<_>>()))
}

/// `a`, `a and b`, `a, b and c`.
fn list(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The aim of an agent with a goal, such as `put the pink object on the blue landmark (top left)`.
fn aim(names: &Names, goal: Goal, agent: AgentId) -> String {
    names.plain(&wants_to(goal, agent))
}

/// A sentence on both agents.
fn summary(scene: &Scene, track: &Track, names: &Names) -> String {
    let agents = AgentId::ALL.map(|agent| format!("the {}", names.entity(Entity::Agent(agent))));
    let aims = AgentId::ALL.map(|agent| aim(names, scene.agents[agent].goal, agent));
    let reached = AgentId::ALL.map(|agent| GoalOutcome::of(track, scene.agents[agent].goal).reached);
    let social = AgentId::ALL.into_iter().find(|&it| scene.agents[it].attitude != Attitude::Neutral);
    let text = if let Some(one) = social {
        let other = one.other();
        let end = if reached[other] { "succeeds" } else { "does not succeed" };
        let [who, whom] = [&agents[one], &agents[other]];
        match scene.agents[one].attitude {
            Attitude::Hinder => {
                format!("{who} hinders {whom}, which wants to {} and {end}", aims[other])
            }
            _ => format!("{who} helps {whom}, which wants to {} and {end}", aims[other]),
        }
    } else if matches!(scene.agents[0].goal, Goal::Touch { .. })
        && scene.agents[0].goal.sign() != scene.agents[1].goal.sign()
    {
        let chaser = AgentId::ALL.into_iter().find(|&it| scene.agents[it].goal.sign() == Sign::Positive);
        let chaser = chaser.unwrap_or(AgentId::ZERO);
        let end = if reached[chaser] { "catches it" } else { "does not catch it" };
        format!("{} chases {} and {end}", agents[chaser], agents[chaser.other()])
    } else if scene.agents[0].goal == scene.agents[1].goal {
        let end = if reached[0] { "succeed" } else { "do not succeed" };
        format!("the two agents both want to {} and {end}", aims[0])
    } else {
        let one = |k: usize| {
            let end = if reached[k] { "does" } else { "does not" };
            format!("{} wants to {} and {end}", agents[k], aims[k])
        };
        format!("{}; {}", one(0), one(1))
    };
    sentence(&text)
}

/// The goal of one agent and its outcome.
fn intent(scene: &Scene, track: &Track, names: &Names, agent: AgentId) -> String {
    let spec = &scene.agents[agent];
    let me = format!("the {}", names.entity(Entity::Agent(agent)));
    let other = names.entity(Entity::Agent(agent.other()));
    let others_aim = aim(names, scene.agents[agent.other()].goal, agent.other());
    let text = match spec.attitude {
        Attitude::Help => format!("{me} wants the {other} to {others_aim}"),
        Attitude::Hinder => format!("{me} wants the {other} not to {others_aim}"),
        Attitude::Neutral => {
            let outcome = GoalOutcome::of(track, spec.goal);
            let end = match (outcome.reached, outcome.steps) {
                (true, Some(step)) => format!("this is so from {} on", seconds(step)),
                (true, None) => "this is so at the end".to_owned(),
                (false, _) => "this is not so at the end".to_owned(),
            };
            let end = match (spec.goal, outcome.steps) {
                (Goal::Touch { sign: Sign::Positive, .. }, Some(step)) => {
                    format!("this is first so at {}", seconds(step))
                }
                (Goal::Touch { sign: Sign::Positive, .. }, None) => "this is never so".to_owned(),
                _ => end,
            };
            format!("{me} wants to {}; {end}", aim(names, spec.goal, agent))
        }
    };
    sentence(&text)
}

/// A text with a capital and a full stop.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).chain(['.']).collect()
}

/// A manner as the end of the sentence "what is seen:".
#[must_use]
pub const fn manner_in_words(manner: Manner) -> &'static str {
    match manner {
        Manner::Fetching => "the helper brings the object",
        Manner::HandingOver => "the helper brings the object part of the way, and the other takes it on",
        Manner::CarryingAlong => "both carry the object at once",
        Manner::Clearing => "the helper moves another object away",
        Manner::MakingWay => "the helper makes way",
        Manner::Blocking => "the hinderer stands in the way",
        Manner::Taking => "the hinderer takes the object from the other and carries it off",
        Manner::Dragging => "both pull at the object",
        Manner::Hiding => "the hinderer carries the object off before the other has touched it",
        Manner::Undoing => "the hinderer undoes what the other has achieved",
        Manner::HiddenHindering => "the hinderer carries the object off while the other does not see it",
        Manner::Crossing => "the two cross each other's way",
        Manner::WatchingFirst => "one watches until it knows what the other wants",
        Manner::Correcting => "one is wrong about what the other wants at first, and corrects itself",
        Manner::MistakenHelp => "the helper is wrong for a while about what the other wants",
        Manner::LeadingByShowing => "by moving, the other shows the helper what it wants",
    }
}
