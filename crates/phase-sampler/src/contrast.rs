//! Minimal pairs and triples: scenes that differ in one social variable.
//!
//! In all scenes of a [`Contrast`] layout, bodies, strengths, directions and the goal of one agent are the
//! same. They differ in the [`Stance`] of the other agent alone, which is its goal and attitude. What a
//! viewer sees differently can therefore be due to the stance only.

use crate::{
    SampleError, Variant, adversarial,
    draft::{Objects, Starts, agent_on, choose, object_on},
    hiding::Hiding,
    recipe::{self, MAX_DRAWS},
    requirements::{is_first_at_object, is_moved_soon, is_playable, shows_its_landmark_soon},
};
use phase_model::{
    AgentId, Attitude, Awareness, EventKind, Goal, LandmarkId, Layout, ObjectId, Relation, Scene, Sight,
};
use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

/// Maximum number of draws of the bodies of a set: few suit all its stances.
const SET_DRAWS: usize = 100 * MAX_DRAWS;
/// Draws in a layout before another is taken, of scenes in which an agent is to miss how an object is moved.
const DRAWS_PER_LAYOUT: usize = 2000;

/// The stance of an agent towards the other, or its knowledge of what the other does.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stance {
    /// To help it: α = 1.
    Help,
    /// To hinder it: α = −1.
    Hinder,
    /// Something that has nothing to do with it, α = 0: to be on another landmark.
    Indifferent,
    /// It wants the other's goal for itself, α = 0: the two collaborate.
    Same,
    /// It wants the object of the other on another landmark, α = 0: the two compete.
    Rival,
    /// As `Rival`, but it first waits where it does not see the object, and knows where that was at the
    /// start: once the other has moved it, its belief is false.
    Unaware,
    /// As `Unaware`, but it is told of every move: its belief is true.
    Told,
}

/// The subject of the goal of the agent that does not change between the scenes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum About {
    /// An object on a landmark.
    Object,
    /// Itself on a landmark.
    Place,
}

/// A request of scenes.
#[derive(Clone, Copy, Debug)]
pub struct ContrastRequest<'a> {
    /// The stances of the changed agent, one scene each.
    pub stances: &'a [Stance],
    /// The subject of the other's goal.
    pub about: About,
    /// Index of the other's goal: landmark, then object.
    pub goal_index: usize,
    /// The layouts to draw from.
    pub layouts: &'a [Layout],
    /// Places of bodies.
    pub starts: Starts,
}

/// Scenes that differ in the stance of one agent.
#[derive(Clone, PartialEq, Debug)]
pub struct Contrast {
    /// The agent whose stance differs.
    pub changed: AgentId,
    /// The scenes, in the order of the stances requested.
    pub scenes: Vec<Scene>,
}

impl Stance {
    /// All stances.
    pub const ALL: [Self; 7] =
        [Self::Help, Self::Hinder, Self::Indifferent, Self::Same, Self::Rival, Self::Unaware, Self::Told];

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Help => "help",
            Self::Hinder => "hinder",
            Self::Indifferent => "indifferent",
            Self::Same => "same",
            Self::Rival => "rival",
            Self::Unaware => "unaware",
            Self::Told => "told",
        }
    }

    /// The variant of a scene with this stance.
    #[must_use]
    pub const fn variant(self, about: About) -> Variant {
        match (self, about) {
            (Self::Help, _) => Variant::Assist,
            (Self::Hinder, About::Object) => Variant::HinderObject,
            (Self::Hinder, About::Place) => Variant::HinderPlace,
            (Self::Indifferent, About::Object) => Variant::Mixed,
            (Self::Indifferent, About::Place) => Variant::Places,
            (Self::Same, _) => Variant::Carry,
            (Self::Rival, _) => Variant::Compete,
            (Self::Unaware | Self::Told, _) => Variant::Seek,
        }
    }

    /// The relation that it makes.
    #[must_use]
    pub const fn relation(self) -> Relation {
        match self {
            Self::Help | Self::Same => Relation::Friendly,
            Self::Hinder | Self::Rival | Self::Unaware | Self::Told => Relation::Adversarial,
            Self::Indifferent => Relation::Neutral,
        }
    }

    /// Of which objects the agent knows the place, if the stance is about this knowledge. Scenes of such
    /// stances differ in it alone.
    #[must_use]
    pub const fn sight(self) -> Option<Sight> {
        match self {
            Self::Unaware => Some(Sight::Start),
            Self::Told => Some(Sight::Objects),
            _ => None,
        }
    }

    /// Whether it is possible where the other's goal is of this type: an agent that wants to be somewhere can
    /// be neither joined nor outdone, and helping it takes special circumstances.
    #[must_use]
    pub const fn suits(self, about: About) -> bool {
        matches!((self, about), (_, About::Object) | (Self::Hinder | Self::Indifferent, About::Place))
    }

    /// Goal and attitude of agent 0, given those of agent 1 and another landmark.
    const fn of_agent(self, goal: Goal, elsewhere: LandmarkId) -> (Goal, Attitude) {
        match (self, goal) {
            (Self::Help, _) => (goal, Attitude::Help),
            (Self::Hinder, _) => (goal.negated(), Attitude::Hinder),
            (Self::Rival | Self::Unaware | Self::Told, Goal::ObjectOnLandmark { object, .. }) => {
                (object_on(object, elsewhere), Attitude::Neutral)
            }
            (Self::Same, _) => (goal, Attitude::Neutral),
            (Self::Indifferent | Self::Rival | Self::Unaware | Self::Told, _) => {
                (agent_on(AgentId::ZERO, elsewhere), Attitude::Neutral)
            }
        }
    }
}

impl Contrast {
    /// Draws the scenes. All bodies satisfy what each stance requires of them; which of the two agents is the
    /// changed one is random.
    ///
    /// # Errors
    /// [`SampleError`] if the draws are exhausted, for example because a stance does not suit the goal.
    pub fn sample(request: &ContrastRequest<'_>, random: &mut dyn Rng) -> Result<Self, SampleError> {
        let variant = request.stances.first().map_or(Variant::Places, |stance| stance.variant(request.about));
        if request.layouts.is_empty() || !request.stances.iter().all(|stance| stance.suits(request.about)) {
            return Err(SampleError(variant));
        }
        // Most places that hide how an object is moved are in few layouts, so each layout has its turn.
        let hides = variant == Variant::Seek;
        let mut layout = [request.layouts[0]];
        for draw in 0..SET_DRAWS {
            if hides && draw % DRAWS_PER_LAYOUT == 0 {
                layout = [choose(request.layouts, random)];
            }
            let layouts = if hides { &layout[..] } else { request.layouts };
            let Some(scenes) = propose(&ContrastRequest { layouts, ..*request }, random) else { continue };
            let swapped = random.random_bool(0.5);
            return Ok(Self {
                changed: if swapped { AgentId::ONE } else { AgentId::ZERO },
                scenes: scenes
                    .into_iter()
                    .map(|scene| if swapped { recipe::exchanged(&scene) } else { scene })
                    .collect(),
            });
        }
        Err(SampleError(variant))
    }
}

/// One draw, with the changed agent as agent 0; `None` if a stance is impossible in it.
fn propose(request: &ContrastRequest<'_>, random: &mut dyn Rng) -> Option<Vec<Scene>> {
    let landmarks = LandmarkId::ALL;
    let landmark = request.goal_index % landmarks.len();
    let round = request.goal_index / landmarks.len();
    let goal = match request.about {
        About::Object => object_on(ObjectId::ALL[round % 2], landmarks[landmark]),
        About::Place => agent_on(AgentId::ONE, landmarks[landmark]),
    };
    let elsewhere = landmarks[(landmark + random.random_range(1..landmarks.len())) % landmarks.len()];
    let layout = choose(request.layouts, random);
    // The bodies are those of hindering, whose requirements are the fewest.
    let draft = adversarial::hinder([goal.negated(), goal], random)?;
    let mut bodies = draft.into_scene(EventKind::Hindering, layout, (Objects::Two, request.starts), random);
    let of_beliefs = request.stances.iter().any(|stance| stance.sight().is_some());
    if of_beliefs {
        // Few places hide how an object is moved.
        let hiding = Hiding::of(&bodies).filter(|_| is_moved_soon(&bodies))?;
        bodies.agents[0].start = hiding.draw_start(request.starts, random)?;
    }
    let acted_on = request.stances.iter().any(|stance| matches!(stance, Stance::Help | Stance::Hinder));
    if acted_on && !is_first_at_object(&bodies) {
        return None;
    }
    let waits = if of_beliefs { random.random_range(adversarial::WAITS) } else { 0 };
    let mut scenes = Vec::with_capacity(request.stances.len());
    for &stance in request.stances {
        let mut scene = of_stance(&bodies, stance, request.about, elsewhere)?;
        if let Some(sees) = stance.sight() {
            scene.agents[0].awareness = Awareness { sees, waits, ..Awareness::default() };
        }
        scenes.push(scene);
    }
    Some(scenes)
}

/// The scene with a stance of agent 0, if that is possible.
fn of_stance(bodies: &Scene, stance: Stance, about: About, elsewhere: LandmarkId) -> Option<Scene> {
    let mut scene = bodies.clone();
    let variant = stance.variant(about);
    let (goal, attitude) = stance.of_agent(bodies.agents[1].goal, elsewhere);
    (scene.agents[0].goal, scene.agents[0].attitude, scene.kind) = (goal, attitude, variant.kind());
    if stance.sight().is_none() && !scene.goals().iter().all(|&goal| shows_its_landmark_soon(&scene, goal)) {
        return None;
    }
    // Role 0 of this variant is the one that moves an object.
    let playable = if variant == Variant::Mixed {
        is_playable(variant, &recipe::exchanged(&scene), true)
    } else {
        is_playable(variant, &scene, true)
    };
    playable.then_some(scene)
}
