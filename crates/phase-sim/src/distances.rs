//! Distances to go, for rewards that are more frequent than those of Equation 1.

use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Entity, Goal, PhysicsConfig, Scene, State, Vec2, arena::LANDMARKS,
};
use phase_navigation::{Mover, NavigationParameters, Navigator, Target};

/// The travel distances, around walls, that separate a scene from what its agents want.
///
/// Other bodies are no obstacles. A door that is too narrow for the body can be passed at the price of
/// [`NavigationParameters::DEFAULT`], so that every distance is finite.
///
/// ```
/// use phase_sim::{Distances, Engine, Episode};
///
/// let scene = phase_sampler::sample_named(Some("helping"), Some("fetch"), 1)?;
/// let mut distances = Distances::new(&scene);
/// let start = *Episode::new(&scene, Engine::World).state();
/// let [goal, _] = distances.goals(&start);
/// assert!(goal >= scene.goals()[0].distance(&start) - 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Distances {
    physics: PhysicsConfig,
    goals: [Goal; AGENT_COUNT],
    attitudes: [Attitude; AGENT_COUNT],
    navigator: Navigator,
}

impl Distances {
    /// The distances of a scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self {
            physics: scene.physics(),
            goals: scene.goals(),
            attitudes: scene.attitudes(),
            navigator: Navigator::new(scene.layout, NavigationParameters::DEFAULT),
        }
    }

    /// For each agent's goal, the travel distance of its subject to its target (u): the landmark's centre, or
    /// the other agent, less both radii and at least 0. Its sign is that of the goal: for one with sign −1,
    /// which asks to be away, it is the negative. So less is better for every goal.
    pub fn goals(&mut self, state: &State) -> [f32; AGENT_COUNT] {
        self.goals.map(|goal| {
            let subject = goal.subject();
            let distance = match goal {
                Goal::AgentOnLandmark { landmark, .. } | Goal::ObjectOnLandmark { landmark, .. } => {
                    self.travel(state, subject, LANDMARKS[landmark])
                }
                Goal::Touch { other, .. } => self.gap(state, subject, Entity::Agent(other)),
            };
            f32::from(goal.sign().value()) * distance
        })
    }

    /// For each agent, its travel distance to the object of the goal that it acts on (u), less both radii and
    /// at least 0: of its own goal if it is neutral, otherwise of the other's. 0 if that goal has no object.
    pub fn approaches(&mut self, state: &State) -> [f32; AGENT_COUNT] {
        AgentId::ALL.map(|agent| {
            let whose = if self.attitudes[agent] == Attitude::Neutral { agent } else { agent.other() };
            match self.goals[usize::from(whose)] {
                Goal::ObjectOnLandmark { object, .. } => {
                    self.gap(state, Entity::Agent(agent), Entity::Object(object))
                }
                _ => 0.0,
            }
        })
    }

    fn gap(&mut self, state: &State, mover: Entity, target: Entity) -> f32 {
        let radii = self.physics.radius(mover) + self.physics.radius(target);
        (self.travel(state, mover, state.position(target)) - radii).max(0.0)
    }

    fn travel(&mut self, state: &State, entity: Entity, target: Vec2) -> f32 {
        let mover = Mover::of(&self.physics, entity);
        let here = self.navigator.map().layout().place_of(&self.physics, state, entity);
        self.navigator.field(Target::Point(target), mover, &[]).distance(here)
    }
}
