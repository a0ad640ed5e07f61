//! Facts of an event from the inside, and the judgement of a method about it.

use phase_event::Event;
use phase_evidence::Track;
use phase_model::{AGENT_COUNT, AgentId, Entity, Judgement, ObjectId, RoomId, Scene, State};
use phase_sim::BeliefSnapshot;

/// An event with everything from which answers are proved.
#[derive(Clone, Debug)]
pub struct Facts {
    /// Its name, which is also that of its video.
    pub id: String,
    /// The set of events that differ from it in one social variable, if it is in one.
    pub set: Option<String>,
    /// Its scene, with goals and attitudes.
    pub scene: Scene,
    /// Its motion, with grips where it was simulated.
    pub track: Track,
    /// Facts that only a simulated event has.
    pub inside: Option<Inside>,
    /// Numbers of people who called it friendly, adversarial and neutral.
    pub ratings: Option<[usize; 3]>,
}

/// Facts of a simulated event beside its motion.
#[derive(Clone, Debug)]
pub struct Inside {
    /// The state before the first step and after every one.
    pub states: Vec<State>,
    /// By agent and state: the room in which it believes each object to be, and the share of its particles
    /// that say so.
    pub beliefs: [Vec<Vec<(RoomId, f64)>>; 2],
    /// The motion of the scene with one agent neutral and idle, if that was simulated.
    pub without: Option<Alternative>,
    /// Futures from a state in the middle, if they were simulated.
    pub futures: Option<SimulatedFutures>,
}

/// An event in which one agent did nothing.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// The agent that did nothing.
    pub idle: AgentId,
    /// The motion.
    pub track: Track,
}

/// Futures that were simulated from one state of an event with the same scene and other random numbers.
#[derive(Clone, Debug)]
pub struct SimulatedFutures {
    /// The step after which they begin.
    pub step: usize,
    /// Steps that they last.
    pub steps: usize,
    /// The last state of each.
    pub ends: Vec<State>,
}

impl Inside {
    /// The states of a simulated event before the first step and after every one.
    #[must_use]
    pub fn states_of(event: &Event) -> Vec<State> {
        let ends = event.steps.iter().filter_map(|step| step.substeps.last().copied());
        core::iter::once(event.initial).chain(ends).collect()
    }
}

/// Rooms in which an agent believes every object to be, by state: [`phase_sim::beliefs`] in few bytes.
#[must_use]
pub fn believed_rooms(snapshots: &[BeliefSnapshot], objects: usize) -> Vec<Vec<(RoomId, f64)>> {
    let objects = || Entity::ALL.into_iter().skip(AGENT_COUNT).take(objects);
    let of =
        |it: &BeliefSnapshot| objects().filter_map(|object| believed_room(&it.particles, object)).collect();
    snapshots.iter().map(of).collect()
}

/// The room of an entity in most particles of a belief, and their share.
fn believed_room(particles: &[State], entity: Entity) -> Option<(RoomId, f64)> {
    let rooms = particles.iter().map(|state| phase_model::layout::room_of(state.position(entity)));
    let rooms: Vec<RoomId> = rooms.collect();
    let share = |room: RoomId| rooms.iter().filter(|&&it| it == room).count() as f64 / rooms.len() as f64;
    RoomId::ALL.into_iter().map(|room| (room, share(room))).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The number of the agent that is nearer to an object.
pub(crate) fn nearer(state: &State, object: ObjectId) -> usize {
    let place = state.position(Entity::Object(object));
    let distances = AgentId::ALL.map(|agent| state.position(Entity::Agent(agent)).distance(place));
    usize::from(distances[1] < distances[0])
}

/// A video as somebody has watched it.
#[derive(Clone, Debug)]
pub struct Watched {
    /// The motion that was seen, where bodies go straight from one frame to the next.
    pub track: Track,
    /// The motion that the frames alone prove, see [`stills`](crate::stills).
    pub stills: Track,
    /// The judgement of a method about it.
    pub judgement: Option<Judgement>,
}
