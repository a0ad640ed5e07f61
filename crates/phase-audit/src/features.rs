//! The features of an event that are known without looking at its motion.

use crate::target::TARGETS;
use phase_dataset::labels::goal_label;
use phase_event::Recording;
use phase_model::{AgentId, Awareness, Entity, MAX_ENTITIES, MAX_OBJECTS, Scene, SlotId, State};

/// A group of features.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Feature {
    /// Number of steps.
    Length,
    /// Number of objects.
    Objects,
    /// Radii of agents and objects.
    Sizes,
    /// The walls: where each of the four that may have an opening begins and ends, and the layout.
    Layout,
    /// Places of all bodies at the start, directions of the agents, and distances between bodies.
    FirstPositions,
    /// All groups above together.
    All,
    /// Strengths of the agents, which cannot be seen.
    Strengths,
    /// Places of all bodies at the end: motion, but none that a viewer should need.
    FinalPositions,
    /// Length of each body's path: motion, too.
    Paths,
}

impl Feature {
    /// All groups, in the order of tables.
    pub const ALL: [Self; 9] = [
        Self::Length,
        Self::Objects,
        Self::Sizes,
        Self::Layout,
        Self::FirstPositions,
        Self::All,
        Self::Strengths,
        Self::FinalPositions,
        Self::Paths,
    ];

    /// The name of the group in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Objects => "number of objects",
            Self::Sizes => "sizes",
            Self::Layout => "layout",
            Self::FirstPositions => "first positions",
            Self::All => "all of these",
            Self::Strengths => "strengths (cannot be seen)",
            Self::FinalPositions => "final positions (for information)",
            Self::Paths => "path lengths (for information)",
        }
    }
}

/// One event as the audit sees it.
#[derive(Clone, PartialEq, Debug)]
pub struct AuditItem {
    /// Classes in the order of [`Target::ALL`](crate::Target::ALL).
    pub(crate) classes: [String; TARGETS],
    /// Numbers by group, in the order of [`Feature::ALL`].
    pub(crate) features: [Vec<f64>; 9],
    /// Events with the same key share their bodies.
    pub(crate) stage: Vec<u32>,
}

impl AuditItem {
    /// The features and labels of an event.
    #[must_use]
    pub fn of(recording: &Recording) -> Self {
        let scene = &recording.scene;
        let states = recording.trajectory.states();
        let goal =
            |agent: AgentId| goal_label(scene.agents[agent].goal, scene.agents[agent].attitude.alpha());
        let classes = [
            recording.relation.name().to_owned(),
            scene.kind.name().to_owned(),
            goal(AgentId::ZERO),
            goal(AgentId::ONE),
            scene.agents.each_ref().map(|agent| knowledge(agent.awareness)).join("; "),
        ];
        let start = scene.initial_state();
        let last = states.last().copied().unwrap_or(start);
        let entities: Vec<Entity> = scene.physics().entities().collect();
        let length = vec![recording.trajectory.steps() as f64];
        let objects = vec![scene.objects.len() as f64];
        let FirstFrame { sizes, layout, places: first, stage } = FirstFrame::of(scene);
        let strengths = scene.agents.iter().map(|agent| f64::from(agent.strength.level())).collect();
        let mut paths: Vec<f64> = entities
            .iter()
            .map(|&it| states.windows(2).map(|pair| moved(&pair[0], &pair[1], it)).sum())
            .collect();
        paths.resize(MAX_ENTITIES, 0.0);
        Self {
            classes,
            stage,
            features: [
                length.clone(),
                objects.clone(),
                sizes.clone(),
                layout.clone(),
                first.clone(),
                [length, objects, sizes, layout, first].concat(),
                strengths,
                places(&last, &entities),
                paths,
            ],
        }
    }
}

/// Features of a scene that its first frame shows.
#[derive(Clone, PartialEq, Debug)]
pub struct FirstFrame {
    /// Radii of all bodies (u), 0 for objects that do not exist.
    pub sizes: Vec<f64>,
    /// Numbers of the layout and the ends of its walls (u).
    pub layout: Vec<f64>,
    /// Places (u), headings (rad), and distances between all bodies (u).
    pub places: Vec<f64>,
    /// Scenes with the same key share their bodies.
    pub stage: Vec<u32>,
}

impl FirstFrame {
    /// The features of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let start = scene.initial_state();
        let entities: Vec<Entity> = scene.physics().entities().collect();
        let mut sizes: Vec<f64> = scene.agents.iter().map(|agent| agent.size.radius().into()).collect();
        sizes.extend(scene.objects.iter().map(|object| f64::from(object.size.radius())));
        sizes.resize(MAX_ENTITIES, 0.0);
        let mut layout = vec![
            f64::from(scene.layout.base()),
            scene.layout.flip().map_or(-1.0, |flip| f64::from(u8::from(flip))),
        ];
        for slot in SlotId::ALL {
            let ends = scene.layout.opening(slot).map_or([0.0; 4], |it| [it.a.x, it.a.y, it.b.x, it.b.y]);
            layout.extend(ends.map(f64::from));
        }
        let mut first = places(&start, &entities);
        first.extend(AgentId::ALL.map(|agent| f64::from(start.body(Entity::Agent(agent)).angle)));
        for (k, &one) in entities.iter().enumerate() {
            first.extend(entities[..k].iter().map(|&other| distance(&start, one, other)));
        }
        first.resize(2 * MAX_ENTITIES + 2 + MAX_ENTITIES * (MAX_ENTITIES - 1) / 2, 0.0);
        let stage = first[..2 * MAX_ENTITIES].iter().chain(&sizes).chain(&layout);
        let stage = unordered(stage.map(|&number| (number as f32).to_bits()).collect());
        Self { sizes, layout, places: first, stage }
    }
}

/// Objects may have exchanged their numbers on a stage, so the key does not depend on the order of its
/// numbers.
fn unordered(mut numbers: Vec<u32>) -> Vec<u32> {
    numbers.sort_unstable();
    numbers
}

/// x and y of all bodies, 0 for objects that do not exist.
fn places(state: &State, entities: &[Entity]) -> Vec<f64> {
    let mut places: Vec<f64> = entities
        .iter()
        .map(|&it| state.position(it))
        .flat_map(|place| [place.x, place.y].map(f64::from))
        .collect();
    places.resize(2 * (MAX_ENTITIES - MAX_OBJECTS) + 2 * MAX_OBJECTS, 0.0);
    places
}

fn distance(state: &State, one: Entity, other: Entity) -> f64 {
    state.position(one).distance(state.position(other)).into()
}

fn moved(before: &State, after: &State, entity: Entity) -> f64 {
    before.position(entity).distance(after.position(entity)).into()
}

/// An agent's knowledge without finding it out, as a class.
fn knowledge(Awareness { knows, sees, .. }: Awareness) -> String {
    format!("{knows:?}, {sees:?}")
}
