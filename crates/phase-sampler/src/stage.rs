//! Bodies without roles: what can be seen of a scene before anything moves, shared by events of several
//! kinds.
//!
//! If each kind of event drew its own bodies, sizes and places would reveal the kind. A [`Stage`] is
//! therefore drawn once for several [`Part`]s, one event each, such that all of them can be played on it. Who
//! plays which role, the strengths, which cannot be seen, and where the agents look are drawn anew for each
//! event.

use crate::{
    Request, SampleError, Variant,
    draft::{Objects, Starts, any_angle, choose, object_of},
    recipe::{self, MAX_DRAWS},
    requirements,
};
use phase_model::{AgentSpec, Attitude, Awareness, Body, Layout, Scene, Size, Vec2, scene::ObjectSpec};
use rand::{Rng, seq::SliceRandom};

/// Layout and bodies.
#[derive(Clone, PartialEq, Debug)]
pub struct Stage {
    /// The walls.
    pub layout: Layout,
    /// Sizes and places of agents 0 and 1.
    pub agents: [(Size, Body); 2],
    /// The objects.
    pub objects: Vec<ObjectSpec>,
}

/// One of the events that share a stage.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Part {
    /// The variant.
    pub variant: Variant,
    /// Index of the pair of goals to be tried first; see [`Variant::goals`].
    pub goal_index: usize,
    /// Whether two that compete or chase have to meet soon: the chaser has at most 14 u to go, and of
    /// competitors the one with the shorter way to the object has at most 8 u and is no stronger than the
    /// other.
    pub meet_soon: bool,
}

/// The goals that a part may have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Goals {
    /// Those of its index.
    Own,
    /// Those of its index, or of the next one that can be pursued.
    Any,
}

impl Part {
    /// The part with each of the goals that it may have.
    fn with(self, goals: Goals) -> impl Iterator<Item = Self> {
        let count = if goals == Goals::Own { 1 } else { self.variant.goal_count() };
        (self.goal_index..self.goal_index + count).map(move |goal_index| Self { goal_index, ..self })
    }

    /// Whether the two of a scene, in which role 0 is agent 0, meet as soon as they have to.
    fn suits(self, scene: &Scene) -> bool {
        !self.meet_soon || requirements::meet_soon(self.variant, scene)
    }
}

/// The assignments of roles to the agents' bodies and of numbers to the objects' bodies: whether either is
/// swapped.
const WAYS: [(bool, bool); 4] = [(false, false), (false, true), (true, false), (true, true)];
/// Draws of strengths for each assignment of roles.
const STRENGTH_DRAWS: usize = 6;
/// Casts of one part, with its own goals and with any, before a scene is given up; a stage on which the part
/// was cast once is likely to allow it again.
const MAX_CASTS: usize = 200;
/// Maximum number of draws of a stage, with the parts' own goals and with any: thousands are needed if
/// several variants have to be possible at once with goals that are given. In PHASE-500, one block in fifty
/// needs others.
const MAX_STAGE_DRAWS: usize = 10 * MAX_DRAWS;
/// Draws of a stage in one layout before another layout is drawn.
const DRAWS_PER_LAYOUT: usize = 200;

impl Stage {
    /// Draws a stage on which every part can be played with its own goals. The first part proposes the
    /// bodies, and all accept or reject them. Layouts are tried in the order given, so that a caller can use
    /// all of them equally often. If no draw allows all goals, one is drawn that allows all variants.
    ///
    /// # Errors
    /// [`SampleError`] if the draws are exhausted, for example because no layout fits a variant.
    pub fn sample(
        parts: &[Part],
        layouts: &[Layout],
        starts: Starts,
        random: &mut dyn Rng,
    ) -> Result<Self, SampleError> {
        let Some(&lead) = parts.first() else { return Err(SampleError(Variant::Places)) };
        for goals in [Goals::Own, Goals::Any] {
            for draw in 0..MAX_STAGE_DRAWS {
                let Some(layout) = layouts.get((draw / DRAWS_PER_LAYOUT) % layouts.len().max(1)) else {
                    break;
                };
                let Part { variant, goal_index, .. } = lead;
                let request = Request { variant, goal_index, layouts: &[*layout], starts };
                let Some(scene) = recipe::propose(&request, Objects::Two, random) else { continue };
                let stage = Self::of(&scene);
                // Searching for plans takes the most time, so bodies at the wrong places are rejected before.
                if parts.iter().all(|part| part.with(goals).any(|part| stage.may_allow(part, random)))
                    && parts.iter().all(|&part| stage.cast_with(goals, part, random).is_some())
                {
                    return Ok(stage);
                }
            }
        }
        Err(SampleError(lead.variant))
    }

    /// The stage of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        Self {
            layout: scene.layout,
            agents: scene.agents.map(|agent| (agent.size, agent.start)),
            objects: scene.objects.clone(),
        }
    }

    /// A scene of this part on the stage: who plays which role, which object has which number, strengths and
    /// directions are drawn. Where the part's goals cannot be pursued on the stage, the next ones are tried.
    /// `None` if the variant cannot be played at all.
    pub fn cast(&self, part: Part, random: &mut dyn Rng) -> Option<Scene> {
        self.cast_with(Goals::Any, part, random)
    }

    fn cast_with(&self, goals: Goals, part: Part, random: &mut dyn Rng) -> Option<Scene> {
        part.with(goals).find_map(|part| self.cast_exactly(part, random))
    }

    /// Whether the bodies' places allow the part; see [`requirements::may_be_playable`].
    fn may_allow(&self, part: Part, random: &mut dyn Rng) -> bool {
        WAYS.iter().any(|&(agents_swapped, objects_swapped)| {
            let scene = self.assigned(part, agents_swapped, objects_swapped, random);
            part.suits(&scene) && requirements::may_be_playable(part.variant, &scene)
        })
    }

    /// A scene of this part on the stage, with its own goals.
    fn cast_exactly(&self, part: Part, random: &mut dyn Rng) -> Option<Scene> {
        let mut ways = WAYS;
        ways.shuffle(random);
        for (agents_swapped, objects_swapped) in ways {
            for _ in 0..STRENGTH_DRAWS {
                let scene = self.assigned(part, agents_swapped, objects_swapped, random);
                if part.suits(&scene) && requirements::is_playable(part.variant, &scene, true) {
                    return Some(if agents_swapped { recipe::exchanged(&scene) } else { scene });
                }
            }
        }
        None
    }

    /// A scene of this part on the stage, as [`cast`](Self::cast), which is repeated where it fails, first
    /// with the part's own goals.
    ///
    /// # Errors
    /// [`SampleError`] if the draws are exhausted.
    pub fn scene(&self, part: Part, random: &mut dyn Rng) -> Result<Scene, SampleError> {
        let mut goals = [Goals::Own, Goals::Any].into_iter().flat_map(|goals| [goals; MAX_CASTS]);
        let drawn = goals.find_map(|goals| self.cast_with(goals, part, random));
        drawn.ok_or(SampleError(part.variant))
    }

    /// The scene with role 0 as agent 0.
    fn assigned(
        &self,
        part: Part,
        agents_swapped: bool,
        objects_swapped: bool,
        random: &mut dyn Rng,
    ) -> Scene {
        let Part { variant, goal_index, .. } = part;
        let goals = variant.goals(goal_index);
        let attitudes = [variant.attitude(), Attitude::Neutral];
        let strengths = requirements::strengths(variant);
        let mut role = |k: usize| {
            let (size, start) = self.agents[if agents_swapped { 1 - k } else { k }];
            let start = Body { angle: any_angle(random), ..start };
            let strength = choose(strengths[k], random);
            AgentSpec {
                size,
                strength,
                goal: goals[k],
                attitude: attitudes[k],
                awareness: Awareness::default(),
                start,
            }
        };
        let mut agents = [role(0), role(1)];
        let mut objects = self.objects.clone();
        if objects_swapped {
            objects.reverse();
        }
        if matches!(variant, Variant::Hide | Variant::HandOver)
            && let Some(object) = object_of(goals[1]).and_then(|object| objects.get(object.index()))
        {
            // One who has to look for the object first seldom comes before the other, or in time to hand it
            // over.
            let towards = object.start.position - agents[0].start.position;
            agents[0].start.angle = heading(towards);
        }
        Scene { layout: self.layout, agents, objects, kind: variant.kind() }
    }
}

/// The angle at which a body faces a direction (rad); 0 faces +y, positive ones turn counter-clockwise.
fn heading(direction: Vec2) -> f32 {
    libm::atan2f(-direction.x, direction.y)
}
