//! Whether motion shows how two agents relate. The label alone does not tell: a helper that does everything
//! alone seems to mind its own business.

use crate::query::{Query, agent_value};
use phase_evidence::{Track, contact, selection::MIN_VISIBLE_STEPS};
use phase_model::{AgentId, Attitude, Entity, EventKind, ObjectId, Scene};

/// Least distance by which an agent moves an object for that to be seen (u).
const MOVED: f32 = 1.0;

/// Whether an agent touches an entity for long enough to be seen, and how far that goes meanwhile (u).
fn touch(track: &Track, agent: AgentId, entity: Entity) -> (bool, f32) {
    let steps = contact::steps_touching(track, Entity::Agent(agent), entity);
    let way = steps.iter().map(|&step| track.distance_in_step(entity, step)).sum();
    (steps.len() >= MIN_VISIBLE_STEPS, way)
}

/// The object that an agent wants somewhere.
fn wanted(scene: &Scene, agent: AgentId) -> Option<ObjectId> {
    match scene.agents[agent].goal.subject() {
        Entity::Object(object) => Some(object),
        Entity::Agent(_) => None,
    }
}

/// Whether an agent is seen to move an object in which the other has a hand, too.
fn moves_shared(track: &Track, mover: AgentId, object: ObjectId) -> bool {
    let [moving, other] = [mover, mover.other()].map(|agent| touch(track, agent, Entity::Object(object)));
    moving.0 && moving.1 >= MOVED && other.0
}

/// Whether a viewer can tell who acts upon whom where an agent helps or hinders: it moves the object that the
/// other wants, and the other was there first. Of two that carry something, or meet, without such an order
/// either may be the helper or the hinderer.
pub(crate) fn shows_role(scene: &Scene, track: &Track, social: AgentId) -> bool {
    wanted(scene, social.other()).is_some_and(|object| {
        let first = Query::FirstTouch { object }.seen(track);
        first == Some(agent_value(social.other())) && moves_shared(track, social, object)
    })
}

/// Whether a viewer has evidence of the relation that the scene has, in what the agents touch and move:
///
/// - who is helped has a hand in what the helper moves, and so have two that want the same;
/// - a hinderer moves what the other has touched, or meets the other, and so do two that compete;
/// - independent agents have nothing to do with each other.
///
/// A chase is seen as such.
pub(crate) fn shows_relation(scene: &Scene, track: &Track) -> bool {
    let meet = touch(track, AgentId::ZERO, Entity::Agent(AgentId::ONE)).0;
    let social = AgentId::ALL.into_iter().find(|&it| scene.agents[it].attitude != Attitude::Neutral);
    let object = wanted(scene, social.unwrap_or(AgentId::ZERO).other());
    let moved_by = |agent: AgentId| object.is_some_and(|object| moves_shared(track, agent, object));
    match scene.kind {
        EventKind::Helping => social.is_some_and(moved_by),
        EventKind::Hindering => social.is_some_and(moved_by) || meet,
        EventKind::Collaborating => AgentId::ALL.into_iter().all(moved_by),
        EventKind::Competing => AgentId::ALL.into_iter().any(moved_by) || meet,
        EventKind::Chasing => true,
        EventKind::Independent => {
            let mut objects = ObjectId::ALL.into_iter().take(scene.objects.len());
            let both =
                |object| AgentId::ALL.into_iter().all(|agent| touch(track, agent, Entity::Object(object)).0);
            !meet && !objects.any(both)
        }
    }
}
