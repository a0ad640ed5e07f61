//! Conditions that a drawn scene must satisfy, by geometry and force alone, to be a scene of its part.
//!
//! Agent 0 is the one who helps, hinders or chases, or the one that a scene for one agent is about.

use super::candidate::{Candidate, Errand};
use phase_evidence::Track;
use phase_evidence::exploration;
use phase_model::{AgentId, Entity, Goal, ObjectId, RoomId, Strength, layout::room_of};
use phase_navigation::Map;
use phase_perception::{Cell, observe};

const FIRST: AgentId = AgentId::ZERO;
const SECOND: AgentId = AgentId::ONE;

/// An agent is clearly nearer than another if its way is at most this share of the other's.
const NEARER: f32 = 0.6;
/// Two ways are about equal if the shorter is at least this share of the longer.
const ABOUT_EQUAL: f32 = 0.75;
/// Two agents meet in a door if their ways to it differ by at most this much (u).
const MEETING_DIFFERENCE: f32 = 3.0;
/// Maximum way to an object that is carried together (u).
const GATHERING_DISTANCE: f32 = 12.0;
/// Minimum width of the openings through which an object is carried together (u): half-open slots.
const PAIR_WIDTH: f32 = 5.0;
/// Maximum share of a region's cells that is visible at the start of a search.
const VISIBLE_AT_START: f32 = 0.25;

/// The first agent goes to its target, with its object if it has one; nobody and nothing else is on the way.
pub(super) fn errand_alone(scene: &Candidate<'_>) -> bool {
    scene
        .errand(FIRST)
        .is_some_and(|errand| scene.avoids_other(&errand, FIRST) && scene.avoids_distractors(&errand))
}

/// The first agent goes to its target alone, through a door.
pub(super) fn errand_through_door(scene: &Candidate<'_>) -> bool {
    errand_alone(scene) && scene.errand(FIRST).is_some_and(|errand| errand.doors().count() > 0)
}

/// The object is out of sight; of the two regions next to the agent's room, hardly visible at the start, the
/// smaller is clearly nearer; the idle agent does not stand in a door.
pub(super) fn search(scene: &Candidate<'_>) -> bool {
    let room = scene.room(FIRST);
    let map = Map::new(scene.0.layout);
    let regions = map.regions_around(room);
    let ([near, larger], Some((object, _))) = (&regions[..], scene.object(FIRST)) else { return false };
    if near.len() != 1 || larger.len() != 2 || room_of(object) == room {
        return false;
    }
    let physics = scene.0.physics();
    let state = scene.0.initial_state();
    let view = observe(&physics, &state, FIRST);
    let wanted = super::candidate::object_of(scene.0.agents[FIRST].goal).unwrap_or(ObjectId::ZERO);
    let hidden = |rooms: &[RoomId]| {
        let cells: Vec<Cell> = Cell::all().filter(|cell| rooms.contains(&room_of(cell.centre()))).collect();
        let seen = cells.iter().filter(|&&cell| view.sees_cell(cell)).count();
        (seen as f32) < VISIBLE_AT_START * cells.len() as f32
    };
    let start = Track { physics: physics.clone(), states: vec![state] };
    let undecided = exploration::searched_first(&start, FIRST, &[near, larger]).is_none();
    let entrance = |rooms: &[RoomId]| {
        let ways = rooms.iter().filter_map(|&to| map.way(room, to, scene.width(FIRST)));
        ways.filter_map(|way| way.first().map(|crossing| crossing.opening.distance(scene.position(FIRST))))
            .fold(f32::INFINITY, f32::min)
    };
    let fits = RoomId::ALL.iter().all(|&to| map.way(room, to, scene.width(FIRST)).is_some());
    // Room for the searching agent to pass.
    let clearance = 0.5 * scene.width(SECOND) + scene.width(FIRST);
    let unobstructed = RoomId::ALL
        .iter()
        .filter_map(|&to| map.way(room, to, 0.0))
        .flatten()
        .all(|crossing| crossing.opening.distance(scene.position(SECOND)) >= clearance);
    view.body(Entity::Object(wanted)).is_none()
        && undecided
        && hidden(near)
        && hidden(larger)
        && fits
        && unobstructed
        && entrance(near) <= NEARER * entrance(larger)
}

/// Either can move the object alone, but only just; both are near it, and a pair fits through the openings.
pub(super) fn carry_together(scene: &Candidate<'_>) -> bool {
    let near = |agent: AgentId| {
        scene.distance_to_object(agent).is_some_and(|distance| distance <= GATHERING_DISTANCE)
    };
    let fits = |agent: AgentId| {
        scene.errand(agent).is_some_and(|errand| {
            let wide = errand.delivery.crossings.iter().all(|it| it.opening.length() >= PAIR_WIDTH);
            wide && scene.avoids_distractors(&errand)
        })
    };
    let fair = |agent: AgentId| scene.0.agents[agent].strength == Strength::Fair;
    AgentId::ALL.into_iter().all(|agent| fair(agent) && near(agent) && fits(agent))
}

/// The second agent does not fit to its object; the first does, and can move it.
pub(super) fn out_of_reach(scene: &Candidate<'_>) -> bool {
    let Some((object, _)) = scene.object(SECOND) else { return false };
    scene.way(SECOND, object).is_none() && is_free_to_carry(scene)
}

/// The second agent is too weak for its object; the first is not, and fits to the landmark with it.
pub(super) fn too_heavy(scene: &Candidate<'_>) -> bool {
    scene.0.agents[SECOND].strength == Strength::Weak && is_free_to_carry(scene)
}

fn is_free_to_carry(scene: &Candidate<'_>) -> bool {
    scene.0.agents[FIRST].strength != Strength::Weak
        && scene.errand(FIRST).is_some_and(|errand| scene.avoids_distractors(&errand))
}

/// A door on the second agent's way has an object in or before it that leaves too little room to pass. In
/// layouts with doors the rooms form a chain, so there is no other way.
pub(super) fn door_to_clear(scene: &Candidate<'_>) -> bool {
    let Some(errand) = scene.errand(SECOND) else { return false };
    errand.doors().any(|door| {
        let obstructs =
            |position, radius: f32| door.opening.distance(position) < radius + scene.radius(SECOND);
        scene.0.objects.iter().any(|it| obstructs(it.start.position, it.size.radius()))
    })
}

/// The second agent reaches its goal alone, on a way that avoids the first; where it carries, it is strong.
pub(super) fn no_need(scene: &Candidate<'_>) -> bool {
    let strong = scene.object(SECOND).is_none() || scene.force(SECOND) >= Strength::Strong.max_force();
    strong
        && scene
            .errand(SECOND)
            .is_some_and(|errand| scene.avoids_other(&errand, SECOND) && scene.avoids_distractors(&errand))
}

/// A door on the second agent's way is clearly nearer to the first, whose body closes it.
pub(super) fn door_to_block(scene: &Candidate<'_>) -> bool {
    let closes = |errand: &Errand| {
        let needed = scene.width(SECOND);
        errand.doors().any(|door| {
            let left = door.opening.length() - 2.0 * scene.radius(FIRST);
            let way = |agent| scene.distance_to_opening(agent, door.opening);
            left < needed && way(FIRST) <= NEARER * way(SECOND)
        })
    };
    scene.errand(SECOND).is_some_and(|errand| closes(&errand) && scene.avoids_distractors(&errand))
}

/// The first agent is clearly nearer to the second's object.
pub(super) fn object_to_take(scene: &Candidate<'_>) -> bool {
    contest(scene).is_some_and(|(first, second)| first <= NEARER * second)
}

/// Both are about equally near to the object, and the first is at least as strong.
pub(super) fn object_to_drag(scene: &Candidate<'_>) -> bool {
    scene.force(FIRST) >= scene.force(SECOND) && is_even_contest(scene)
}

/// The first agent is clearly nearer to the second's object ([`object_to_take`]), and can bring it to a room
/// into which the second does not fit.
pub(super) fn object_to_hide(scene: &Candidate<'_>) -> bool {
    let Some((object, radius)) = scene.object(SECOND) else { return false };
    let map = Map::new(scene.0.layout);
    let carrying = scene.width(FIRST).max(2.0 * radius);
    object_to_take(scene)
        && RoomId::ALL.into_iter().any(|hideout| {
            map.way(room_of(object), hideout, carrying).is_some()
                && map.way(scene.room(SECOND), hideout, scene.width(SECOND)).is_none()
        })
}

/// The first agent, which flees, is the stronger and not the larger.
pub(super) fn fleer_is_faster(scene: &Candidate<'_>) -> bool {
    scene.force(FIRST) > scene.force(SECOND) && scene.radius(FIRST) <= scene.radius(SECOND)
}

/// The first agent can bring about what the second does not want: it fits there; in a pursuit it is the
/// stronger and not the larger; it is not farther from the object, if there is one.
pub(super) fn undoing(scene: &Candidate<'_>) -> bool {
    let Some(errand) = scene.errand(FIRST) else { return false };
    let nearer = match scene.object(FIRST) {
        Some(_) => contest(scene).is_some_and(|(first, second)| first <= second),
        None => true,
    };
    let pursues = matches!(scene.0.agents[FIRST].goal, Goal::Touch { .. });
    nearer && scene.avoids_distractors(&errand) && (!pursues || fleer_is_faster(scene))
}

/// The chaser fits through the doors; the fleer is not weaker and not larger than it.
pub(super) fn chase(scene: &Candidate<'_>) -> bool {
    scene.errand(FIRST).is_some()
        && scene.force(SECOND) >= scene.force(FIRST)
        && scene.radius(SECOND) <= scene.radius(FIRST)
}

/// Both are about equally near to the object, and their strengths differ by at most one level.
pub(super) fn compete(scene: &Candidate<'_>) -> bool {
    let [first, second] = scene.0.agents.map(|agent| agent.strength.level());
    first.abs_diff(second) <= 1 && is_even_contest(scene)
}

/// The two come through one door from opposite sides at about the same time.
pub(super) fn doorway(scene: &Candidate<'_>) -> bool {
    let (Some(first), Some(second)) = (scene.errand(FIRST), scene.errand(SECOND)) else { return false };
    let meets = first.doors().any(|door| {
        let opposite = second.doors().any(|other| other.slot == door.slot && other.from == door.to);
        let way = |agent| scene.distance_to_opening(agent, door.opening);
        opposite && (way(FIRST) - way(SECOND)).abs() <= MEETING_DIFFERENCE
    });
    meets && scene.avoids_distractors(&first) && scene.avoids_distractors(&second)
}

/// Both have ways to their goals that do not lead through the room of the other's landmark.
pub(super) fn separate_errands(scene: &Candidate<'_>) -> bool {
    AgentId::ALL.into_iter().all(|agent| {
        let other = scene.0.agents[agent.other()].goal.landmark();
        scene.errand(agent).is_some_and(|errand| {
            scene.avoids_distractors(&errand) && other.is_none_or(|it| !errand.rooms.contains(&it.room()))
        })
    })
}

/// Lengths of the two agents' ways to the second's object (u), if both have errands and nothing is on the
/// way.
fn contest(scene: &Candidate<'_>) -> Option<(f32, f32)> {
    for agent in AgentId::ALL {
        let errand = scene.errand(agent)?;
        if !scene.avoids_distractors(&errand) {
            return None;
        }
    }
    Some((scene.distance_to_object(FIRST)?, scene.distance_to_object(SECOND)?))
}

fn is_even_contest(scene: &Candidate<'_>) -> bool {
    contest(scene).is_some_and(|(first, second)| first.min(second) >= ABOUT_EQUAL * first.max(second))
}
