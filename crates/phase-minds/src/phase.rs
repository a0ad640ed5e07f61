//! Our own minds behind the interface.

use crate::{BeliefState, Mind};
use phase_agent::{BeliefView, Foresight, PhaseParameters, Supposition, TheoryOfMind};
use phase_belief::{Belief, Contest};
use phase_event::Thought;
use phase_forward::Forward;
use phase_model::{Action, AgentId, PhysicsConfig, Scene, Sight, State, random::Pcg64Mcg};
use phase_perception::Observation;
use phase_pomcp::PomcpError;

pub(crate) fn mind(
    scene: &Scene,
    agent: AgentId,
    parameters: PhaseParameters,
) -> Result<Box<dyn Mind>, PomcpError> {
    let dynamics = |physics: &PhysicsConfig| match parameters.foresight {
        Foresight::Points => Forward::new(physics).without_collisions(),
        Foresight::Coarse | Foresight::Exact => Forward::new(physics),
    };
    let mind = phase_agent::Mind::new(scene, agent, dynamics(&scene.physics()), parameters)?;
    Ok(match scene.agents[agent].awareness.knows.level() {
        Some(level) => Box::new(mind.ignorant(level, dynamics)),
        None => Box::new(mind),
    })
}

pub(crate) fn belief(
    physics: &PhysicsConfig,
    particles: usize,
    observation: &Observation,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    let belief = Belief::new(physics, observation, particles, random);
    let forward = Forward::new(physics);
    Box::new(PhaseBelief { belief, physics: physics.clone(), forward, sight: Sight::Own, theory: None })
}

/// The belief of an agent of a scene, which has the senses and the theory of mind that the scene gives it.
pub(crate) fn belief_in(
    scene: &Scene,
    parameters: PhaseParameters,
    observation: &Observation,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    let physics = scene.physics();
    let agent = observation.agent;
    let belief = Belief::new(&physics, observation, parameters.particles, random);
    let forward = Forward::new(&physics);
    let sight = match scene.agents[agent].awareness.sees {
        Sight::Objects => Sight::Objects,
        // What it knows from the start is in its first observation.
        Sight::Own | Sight::Start => Sight::Own,
    };
    let theory = TheoryOfMind::new(scene, agent, parameters, observation.observed, Forward::new);
    Box::new(PhaseBelief { belief, physics, forward, sight, theory })
}

/// The observation that an agent makes of a state.
pub(crate) fn observe(physics: &PhysicsConfig, state: &State, agent: AgentId, sight: Sight) -> Observation {
    match sight {
        Sight::Own => phase_perception::observe(physics, state, agent),
        Sight::Start | Sight::Objects => phase_perception::observe_told(physics, state, agent),
    }
}

impl Mind for phase_agent::Mind<Forward> {
    fn decide(
        &mut self,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> Result<(Action, Thought), PomcpError> {
        Self::decide(self, belief, random)
    }

    fn relive(&mut self, belief: BeliefView<'_>) {
        Self::relive(self, belief);
    }

    fn has_watched(&mut self, steps: u32) {
        Self::has_watched(self, steps);
    }

    fn boxed(&self) -> Box<dyn Mind> {
        Box::new(self.clone())
    }
}

/// A belief with the dynamics that predict it.
#[derive(Clone, Debug)]
struct PhaseBelief {
    belief: Belief,
    physics: PhysicsConfig,
    forward: Forward,
    sight: Sight,
    theory: Option<TheoryOfMind<Forward>>,
}

impl BeliefState for PhaseBelief {
    fn observe(&self, state: &State) -> Observation {
        observe(&self.physics, state, self.belief.agent(), self.sight)
    }

    fn update(
        &mut self,
        action: Action,
        observation: &Observation,
        _substeps: &[State],
        random: &mut Pcg64Mcg,
    ) {
        let learnt = self.theory.as_mut().and_then(|theory| {
            // What the other did is a matter of the particles before it did it.
            theory.learn(self.belief.particles(), action, observation)
        });
        if let Some(indices) = learnt {
            self.belief.resample(&indices);
        }
        self.belief.update(&self.forward, &self.physics, action, observation, random);
    }

    fn suppositions(&self) -> &[Supposition] {
        self.theory.as_ref().map_or(&[], TheoryOfMind::suppositions)
    }

    fn particles(&self) -> &[State] {
        self.belief.particles()
    }

    fn contest(&self) -> Contest {
        self.belief.contest()
    }

    fn boxed(&self) -> Box<dyn BeliefState> {
        Box::new(self.clone())
    }
}
