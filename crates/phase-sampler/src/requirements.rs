//! The requirements of a variant on a scene: it is valid, nothing is achieved yet, the agents can do what the
//! kind requires of them, and bodies are where the variant needs them.

use crate::{
    Variant,
    draft::{SELF_SUFFICIENT, agent_on, object_of, object_on},
    feasibility,
    hiding::Hiding,
};
use phase_model::{
    AgentId, Entity, EventKind, Goal, LandmarkId, ObjectId, RoomId, Scene, Sign, Strength, Vec2,
    arena::LANDMARKS, layout::room_of,
};
use phase_navigation::{IMPASSABLE_COST, Map};
use phase_perception::sees;
use phase_predicates::lead::{MIN_LANDMARK_LEAD, landmark_lead};

/// Minimum ratio of a goal's cost without the helper to its cost with the helper.
const MIN_COST_RATIO: f32 = 1.5;
/// Limit of the cost of a goal that is to be reached early enough to be undone (u).
const MAX_UNDONE_COST: f32 = 35.0;
/// Limit of the cost of a goal that is to be reached before another acts (u).
const MAX_MOVED_COST: f32 = 50.0;
/// Maximum distance from an object of an agent that is to come to it while there is still something to be
/// seen (u).
const MAX_ARRIVAL: f32 = 14.0;
/// Maximum distance from its landmark of an object that is to be taken away from it (u).
const MAX_BESIDE: f32 = 16.0;
/// Maximum distance from its landmark of an object that is to be hidden: the nearer, the more the hinderer
/// gains (u).
const MAX_HIDDEN: f32 = 13.0;
/// Maximum distance from an object of both who are to carry it together (u).
const MAX_SHARED: f32 = 8.0;
/// An agent this near to an object, in its room and facing it, sees it at the start (u).
const MAX_BY: f32 = 8.0;
/// Maximum distance from an object's way to its landmark of an agent that is to take it over there (u).
const MAX_ASIDE: f32 = 2.0;
/// Length of the beginning of an object's way that is to show where it is brought (u).
const SOON: f32 = 8.0;
/// The hinderer is that much nearer to the object that it is to take first, or farther from the one that it
/// is to take later, than the victim (u).
const MIN_HEAD_START: f32 = 4.0;

/// The strengths that roles 0 and 1 may have. They cannot be seen, but decide who can do what. Beyond that
/// they are the same for all variants, so that they do not reveal one.
pub(crate) const fn strengths(variant: Variant) -> [&'static [Strength]; 2] {
    const ALL: &[Strength] = &Strength::ALL;
    const ABLE: &[Strength] = &SELF_SUFFICIENT;
    match variant {
        // The weaker the helper, the more it gains by carrying together.
        Variant::Lift => [&[Strength::Fair, Strength::Strong], &[Strength::Weak]],
        // The helpee is unable to move the object, or to come to it.
        Variant::Fetch => [ABLE, ALL],
        Variant::Move | Variant::MakeWay => [ABLE, ALL],
        Variant::HinderPlace | Variant::Block | Variant::Mixed => [ABLE, ALL],
        Variant::Places | Variant::Cross => [ALL, ALL],
        // A weak agent does not get away.
        Variant::Chase => [ALL, ABLE],
        _ => [ABLE, ABLE],
    }
}

/// Whether the agents' strengths fit each other: one who takes an object from another is the stronger, and so
/// is one who takes it over from a helper.
fn are_matched(variant: Variant, scene: &Scene) -> bool {
    let [first, second] = scene.agents.map(|agent| agent.strength);
    match variant {
        Variant::Take | Variant::Hide => first > second,
        Variant::HandOver => first < second,
        _ => true,
    }
}

/// Whether a scene, in which role 0 is agent 0, can show its variant. The first edition's variants have
/// further requirements on a shared stage.
pub(crate) fn is_playable(variant: Variant, scene: &Scene, on_stage: bool) -> bool {
    // Cheap tests first.
    are_matched(variant, scene)
        && ((!on_stage && (variant.is_first_edition() || variant == Variant::Seek))
            || is_placed(variant, scene))
        && is_unsolved(scene)
        && scene.validate_without_overlap().is_ok()
        && is_feasible(variant, scene)
}

/// Whether a scene on a stage, in which role 0 is agent 0, can show its variant as far as its bodies' places
/// tell. Costs a small part of [`is_playable`], which searches for plans, and rejects most scenes that it
/// rejects.
pub(crate) fn may_be_playable(variant: Variant, scene: &Scene) -> bool {
    is_placed(variant, scene) && is_unsolved(scene)
}

/// Whether no goal holds at the start.
fn is_unsolved(scene: &Scene) -> bool {
    scene.goals().iter().all(|&goal| {
        let positive = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
        !feasibility::is_achieved(scene, positive)
    })
}

/// Whether the agents can do what the kind requires of them; role 0 is agent 0.
fn is_feasible(variant: Variant, scene: &Scene) -> bool {
    let [first, second] = scene.goals();
    match scene.kind {
        // It is the helper's body that obstructs, which the planner leaves out where the helper is not an
        // actor.
        EventKind::Helping if variant == Variant::MakeWay => feasibility::alone(scene, AgentId::ONE, second),
        EventKind::Helping => {
            let alone = feasibility::cost(scene, second, [false, true]);
            let both = feasibility::cost(scene, second, [true, true]);
            both < feasibility::INFEASIBLE_COST && alone > both * MIN_COST_RATIO
        }
        EventKind::Hindering => {
            let alone = feasibility::cost(scene, second, [false, true]);
            let limit = if variant == Variant::Undo { MAX_UNDONE_COST } else { feasibility::INFEASIBLE_COST };
            alone < limit && can_interfere(scene, second)
        }
        EventKind::Chasing => feasibility::alone(scene, AgentId::ZERO, first),
        EventKind::Competing if variant == Variant::Seek => {
            feasibility::alone(scene, AgentId::ZERO, first)
                && feasibility::cost(scene, second, [false, true]) < MAX_MOVED_COST
        }
        EventKind::Competing | EventKind::Independent => {
            feasibility::alone(scene, AgentId::ZERO, first) && feasibility::alone(scene, AgentId::ONE, second)
        }
        EventKind::Collaborating => feasibility::together(scene, first),
    }
}

/// Whether the hinderer, agent 0, can come to where the other wants to go, or to its object.
fn can_interfere(scene: &Scene, goal: Goal) -> bool {
    match goal {
        Goal::AgentOnLandmark { landmark, .. } => {
            feasibility::alone(scene, AgentId::ZERO, agent_on(AgentId::ZERO, landmark))
        }
        Goal::ObjectOnLandmark { object, .. } => LandmarkId::ALL
            .into_iter()
            .any(|landmark| feasibility::alone(scene, AgentId::ZERO, object_on(object, landmark))),
        Goal::Touch { .. } => true,
    }
}

/// Whether the bodies are where the variant needs them. Nothing is required of the first edition's variants,
/// and of seeking, beyond their drafts, except where they are cast on a stage that was drawn for another one.
fn is_placed(variant: Variant, scene: &Scene) -> bool {
    let [first, goal] = scene.goals();
    let [room, other_room] = [0, 1].map(|role: usize| room_of(scene.agents[role].start.position));
    let target = goal.landmark().map(LandmarkId::room);
    let Some(object) = object_of(goal) else {
        return match variant {
            Variant::Block | Variant::HinderPlace => target != Some(other_room),
            Variant::Chase | Variant::Evade | Variant::Pester => room != other_room,
            Variant::Cross => crosses(scene, [room, other_room]),
            Variant::MakeWay => obstructs(scene, goal),
            _ => true,
        };
    };
    let place = room_of(scene.objects[object.index()].start.position);
    let [near, far] = [0, 1].map(|role| start_distance(scene, role, object));
    let away = target != Some(place);
    // In a room beside the landmark's an object can be taken farther away.
    let beside = away && goal.distance(&scene.initial_state()) <= MAX_BESIDE;
    match variant {
        Variant::Lift => {
            let helpee = (MIN_HEAD_START..=MAX_BY).contains(&far);
            away && place != room && place == other_room && helpee && near <= MAX_ARRIVAL
        }
        Variant::Carry => away && near.max(far) <= MAX_SHARED,
        // An agent that is far from what it wants does not come near enough to show it.
        Variant::Fetch => away && near.max(far) <= MAX_ARRIVAL,
        Variant::Assist => away && near <= MAX_ARRIVAL,
        Variant::HandOver => away && is_handed_over_on_the_way(scene, object, goal),
        Variant::Drag => away && near <= MAX_ARRIVAL,
        Variant::Take => beside && far + MIN_HEAD_START <= near && near <= MAX_ARRIVAL,
        Variant::Hide => {
            let carried_farther = goal.distance(&scene.initial_state()) <= MAX_HIDDEN;
            away && carried_farther && near <= MAX_BY && MAX_BY + MIN_HEAD_START <= far && place == room
        }
        Variant::Undo => beside && far < near && near <= MAX_ARRIVAL,
        Variant::Seek => is_moved_soon(scene) && Hiding::of(scene).is_some_and(|it| it.hides()),
        Variant::Compete => {
            let rooms = [first, goal].map(|goal| goal.landmark().map(LandmarkId::room));
            !rooms.contains(&Some(place)) && near.max(far) <= MAX_ARRIVAL
        }
        _ => true,
    }
}

/// Whether two that compete for an object, or chase, have to do with each other soon. Of competitors the one
/// that comes to the object first has a short way there, and is no stronger than the other, so that both get
/// it their way. Always true for other variants.
pub(crate) fn meet_soon(variant: Variant, scene: &Scene) -> bool {
    let map = Map::new(scene.layout);
    let way = |role: usize, to: Vec2| {
        let physics = scene.physics();
        let from = scene.agents[role].start.position;
        map.route_cost(from, to, physics.agents[role].width(), map.gaps(), IMPASSABLE_COST)
    };
    match (variant, object_of(scene.agents[1].goal)) {
        (Variant::Chase, _) => way(0, scene.agents[1].start.position) <= MAX_ARRIVAL,
        (Variant::Compete, Some(object)) => {
            let ways = [0, 1].map(|role| way(role, scene.objects[object.index()].start.position));
            let first = usize::from(ways[1] < ways[0]);
            ways[first] <= MAX_BY && scene.agents[first].strength <= scene.agents[1 - first].strength
        }
        _ => true,
    }
}

/// Whether agent 1, if it wants an object somewhere, sees that and is by it, while agent 0 comes later. It is
/// then seen to try, and shows what it wants, before it is helped or hindered.
pub(crate) fn is_first_at_object(scene: &Scene) -> bool {
    let Some(object) = object_of(scene.agents[1].goal) else { return true };
    let place = room_of(scene.objects[object.index()].start.position);
    let [late, early] = [0, 1].map(|role| start_distance(scene, role, object));
    place == room_of(scene.agents[1].start.position)
        && early <= MAX_BY
        && early + MIN_HEAD_START <= late
        && late <= MAX_ARRIVAL
        && sees(&scene.physics(), &scene.initial_state(), AgentId::ONE, Entity::Object(object))
}

/// Whether the beginning of an object's way to the landmark of a goal shows the landmark, for a body as broad
/// as the object. True for goals about nothing else.
pub(crate) fn shows_its_landmark_soon(scene: &Scene, goal: Goal) -> bool {
    let (Some(object), Some(landmark)) = (object_of(goal), goal.landmark()) else { return true };
    let map = Map::new(scene.layout);
    let from = scene.objects[object.index()].start.position;
    let to = LANDMARKS[landmark];
    let width = 2.0 * scene.physics().object_radii[object.index()];
    let way = map.route(from, to, width, map.gaps(), IMPASSABLE_COST);
    way.is_some_and(|way| landmark_lead(from, way.at(from, to, SOON), landmark) >= MIN_LANDMARK_LEAD)
}

/// Whether agent 1 sees an object at the start that it is to carry to a room beside, and is near it.
pub(crate) fn is_moved_soon(scene: &Scene) -> bool {
    let goal = scene.agents[1].goal;
    let Some(object) = object_of(goal) else { return false };
    let place = room_of(scene.objects[object.index()].start.position);
    goal.landmark().map(LandmarkId::room) != Some(place)
        && start_distance(scene, 1, object) <= MAX_BY
        && goal.distance(&scene.initial_state()) <= MAX_BESIDE
        && sees(&scene.physics(), &scene.initial_state(), AgentId::ONE, goal.subject())
}

/// Whether agent 1 cannot come to the object that it wants, but stands by the way on which agent 0 brings it.
/// Elsewhere it has nothing to do until the object is there, or takes it itself.
fn is_handed_over_on_the_way(scene: &Scene, object: ObjectId, goal: Goal) -> bool {
    let physics = scene.physics();
    let map = Map::new(scene.layout);
    let state = scene.initial_state();
    let Some(landmark) = goal.landmark() else { return false };
    let from = state.position(Entity::Object(object));
    let to = LANDMARKS[landmark];
    let [helper, helpee] = [0, 1].map(|role: usize| physics.agents[role].width());
    let waits = scene.agents[1].start.position;
    if map.route_cost(waits, from, helpee, map.gaps(), IMPASSABLE_COST) < IMPASSABLE_COST {
        return false;
    }
    let width = helper.max(2.0 * physics.object_radii[object.index()]);
    let way = map.route(from, to, width, map.gaps(), IMPASSABLE_COST);
    way.is_some_and(|way| way.nearest(from, to, waits).distance(waits) <= MAX_ASIDE)
}

/// Whether each agent goes to the room in which the other starts.
fn crosses(scene: &Scene, rooms: [RoomId; 2]) -> bool {
    let targets = scene.goals().map(|goal| goal.landmark().map(LandmarkId::room));
    targets == [Some(rooms[1]), Some(rooms[0])] && rooms[0] != rooms[1]
}

/// Whether agent 0 stands in a door of agent 1's cheapest way, which agent 1 then does not fit through.
fn obstructs(scene: &Scene, goal: Goal) -> bool {
    let physics = scene.physics();
    let map = Map::new(scene.layout);
    let [blocker, blocked] = scene.agents.map(|agent| agent.start.position);
    let width = physics.agents[1].width();
    let Some(landmark) = goal.landmark() else { return false };
    let to = LANDMARKS[landmark];
    let Some(route) = map.route(blocked, to, width, map.gaps(), IMPASSABLE_COST) else { return false };
    let mut gaps = *map.gaps();
    let radius = physics.agents[0].radius;
    gaps.obstruct(blocker, radius, radius + physics.agents[1].radius);
    route.doors().iter().any(|&(slot, _)| map.gaps().width(slot) >= width && gaps.width(slot) < width)
}

/// Distance between an agent and an object at the start (u).
fn start_distance(scene: &Scene, role: usize, object: ObjectId) -> f32 {
    let object = scene.initial_state().position(Entity::Object(object));
    scene.agents[role].start.position.distance(object)
}
