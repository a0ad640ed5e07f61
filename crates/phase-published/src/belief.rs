//! The particle belief of the published simulator's agents.

use crate::{
    PublishedParameters,
    mind::imagined,
    recorded::INITIAL_REACH,
    redraw::Redraw,
    senses::{observe, visible},
};
use phase_belief::overwrite;
use phase_forward::Imagined;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Entity, Flip, Layout, MAX_ENTITIES, PhysicsConfig, State, Vec2, arena,
};
use phase_perception::{CellSet, Observation};
use rand::{Rng, RngExt};

/// One agent's belief: complete states of the world, all equally likely.
#[derive(Clone, Debug)]
pub struct Belief {
    agent: AgentId,
    physics: PhysicsConfig,
    imagined: Imagined,
    flip: Option<Flip>,
    particles: Vec<State>,
    /// Every cell ever seen.
    seen: CellSet,
}

impl Belief {
    /// The belief after the first observation: unseen bodies lie at integer places of the middle 16 × 16 u,
    /// facing up, at rest, and may overlap anything; then the belief is updated as if the agent had let a
    /// step pass.
    #[must_use]
    pub fn new(
        layout: Layout,
        physics: &PhysicsConfig,
        parameters: &PublishedParameters,
        observation: &Observation,
        truth: Option<&State>,
        random: &mut impl Rng,
    ) -> Self {
        let flip = layout.flip();
        let angle = flip.map_or(0.0, |flip| flip.angle(0.0));
        let particles = (0..parameters.particles)
            .map(|_| {
                let mut particle = State::new([Body::default(); MAX_ENTITIES]);
                for entity in physics.entities().filter(|&entity| entity != Entity::Agent(observation.agent))
                {
                    let mut coordinate = || random.random_range(-INITIAL_REACH..=INITIAL_REACH) as f32;
                    let place = arena::CENTRE + Vec2::new(coordinate(), coordinate());
                    *particle.body_mut(entity) = Body::at_rest(place, angle);
                }
                if let Some(body) = observation.body(Entity::Agent(observation.agent)) {
                    *particle.body_mut(Entity::Agent(observation.agent)) = *body;
                }
                particle
            })
            .collect();
        let mut belief = Self {
            agent: observation.agent,
            imagined: imagined(physics, parameters),
            physics: physics.clone(),
            flip,
            particles,
            seen: CellSet::EMPTY,
        };
        belief.update(Action::NoForce, observation, truth.map_or(&[], core::slice::from_ref), random);
        belief
    }

    /// One step: every particle is moved on by the imagined dynamics, in which the other agent coasts, then
    /// overwritten with the observation, and unseen bodies that contradict it are redrawn.
    ///
    /// `substeps` are the true states after the substeps, the last of which is observed, or none where nobody
    /// knows them: what comes into view in any of them counts as seen, and an unseen body near its true place
    /// is left there.
    pub fn update(
        &mut self,
        action: Action,
        observation: &Observation,
        substeps: &[State],
        random: &mut impl Rng,
    ) {
        let truth = substeps.last();
        self.seen = self.seen.union(&observation.visible);
        for state in substeps.iter().rev().skip(1) {
            self.seen = self.seen.union(&visible(&self.physics, state, self.agent));
        }
        let mut actions = [Action::NoForce; AGENT_COUNT];
        actions[self.agent] = action;
        let redraw = Redraw { physics: &self.physics, flip: self.flip, seen: &self.seen, observation, truth };
        // When everything is observed, all particles become what is observed.
        let blind = self.physics.entities().any(|entity| !observation.observed.contains(entity));
        for particle in &mut self.particles {
            if blind {
                let at = [2, 3].map(|body: usize| particle.bodies[body].position);
                self.imagined.step_reaching(self.agent, particle, actions, at);
            }
            overwrite(particle, observation);
            if blind {
                redraw.apply(particle, random);
            }
        }
    }

    /// The observation that the agent makes of a state.
    #[must_use]
    pub fn observe(&self, state: &State) -> Observation {
        observe(&self.physics, state, self.agent)
    }

    /// The agent.
    #[must_use]
    pub const fn agent(&self) -> AgentId {
        self.agent
    }

    /// The possible states.
    #[must_use]
    pub fn particles(&self) -> &[State] {
        &self.particles
    }
}
