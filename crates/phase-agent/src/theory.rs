//! Theory of mind: what an agent that does not know the other's mind supposes it to want.

use crate::{
    PhaseParameters,
    ascription::{self, ACTIONS, AscribedPolicy, HabitPolicy, TheoryParameters},
    objective::Objective,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, BodySet, Dynamics, Entity, Goal, Intent, LandmarkId, Level,
    PhysicsConfig, Scene, Sign, State, Strength, physical_goals,
};
use phase_navigation::Navigator;
use phase_perception::Observation;
use phase_planner::Planner;

/// The mind and strength that one particle of a belief ascribes to the other agent.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Supposition {
    /// The other's intent.
    pub intent: Intent,
    /// The other's strength.
    pub strength: Strength,
}

/// One agent's beliefs about the mind of the other, beside its belief about the state of the world.
///
/// Suppositions, pairs of an intent and a strength, have weights, and every particle has one, in proportion
/// to the weights. The prior is uniform: over the goals that the other can have, over its strengths, and, of
/// an agent that is neutral itself, over being helped and hindered. Where the agent sees the other before and
/// after a step, the motion tells which actions the other can have taken with which strength. A supposition
/// is as likely as the other's policy makes these actions in the particles that have it.
#[derive(Clone, Debug)]
pub struct TheoryOfMind<D> {
    agent: AgentId,
    level: Level,
    parameters: PhaseParameters,
    theory: TheoryParameters,
    /// Physics and dynamics for each strength of the other.
    worlds: Vec<(PhysicsConfig, D)>,
    navigator: Navigator,
    possible: Vec<Supposition>,
    /// The other's planner for each of these.
    planners: Vec<Planner>,
    weights: Vec<f64>,
    /// The supposition of each particle.
    assigned: Vec<usize>,
    suppositions: Vec<Supposition>,
    /// The other's likeliest last action, if it was seen.
    last: Option<Action>,
    observed: BodySet,
}

/// For each strength how likely the seen motion is after each action, up to a common factor.
type MotionLikelihoods = [[f64; ACTIONS]; Strength::ALL.len()];

impl<D: Dynamics> TheoryOfMind<D> {
    /// The theory of an agent of a scene, before it has seen anything happen; `None` if it knows the other's
    /// goal. `dynamics` makes a model of the world for bodies and walls; `observed` is what the agent sees at
    /// the start.
    #[must_use]
    pub fn new(
        scene: &Scene,
        agent: AgentId,
        parameters: PhaseParameters,
        observed: BodySet,
        mut dynamics: impl FnMut(&PhysicsConfig) -> D,
    ) -> Option<Self> {
        let level = scene.agents[agent].awareness.knows.level()?;
        let attitude = scene.agents[agent].attitude;
        let other = agent.other();
        let own_goal = scene.agents[agent].goal;
        let worlds: Vec<(PhysicsConfig, D)> = Strength::ALL
            .into_iter()
            .map(|strength| {
                let physics = with_strength(scene.physics(), other, strength);
                let dynamics = dynamics(&physics);
                (physics, dynamics)
            })
            .collect();
        let intents = possible_intents(other, attitude, own_goal, scene.objects.len());
        let pairs = Strength::ALL
            .into_iter()
            .flat_map(|strength| intents.iter().map(move |&intent| Supposition { intent, strength }));
        let possible: Vec<Supposition> = pairs.collect();
        let planner = |Supposition { intent, strength }: &Supposition| {
            let goals = goals_of_other(agent, own_goal, *intent);
            let (physics, _) = &worlds[usize::from(strength.level())];
            let planning = parameters.planning();
            let layout = scene.layout;
            Planner::with_parameters(physics.clone(), layout, other, goals, intent.attitude, planning)
        };
        let planners = possible.iter().map(planner).collect();
        let weights = vec![1.0 / possible.len() as f64; possible.len()];
        let assigned = spread(&weights, parameters.particles);
        let suppositions = assigned.iter().map(|&it| possible[it]).collect();
        Some(Self {
            agent,
            level,
            parameters,
            theory: TheoryParameters::default(),
            navigator: Navigator::new(scene.layout, parameters.navigation()),
            planners,
            assigned,
            suppositions,
            last: None,
            weights,
            possible,
            worlds,
            observed,
        })
    }

    /// The supposition of each particle.
    #[must_use]
    pub fn suppositions(&self) -> &[Supposition] {
        &self.suppositions
    }

    /// Everything that can be supposed of the other, with its probability.
    pub fn weighted(&self) -> impl Iterator<Item = (Supposition, f64)> {
        self.possible.iter().copied().zip(self.weights.iter().copied())
    }

    /// Learns from one step: `before` are the particles at its beginning, `own` is the agent's action and
    /// `seen` its observation at the end. Returns for each particle which of them takes its place, if what
    /// the other did tells them apart.
    pub fn learn(&mut self, before: &[State], own: Action, seen: &Observation) -> Option<Vec<usize>> {
        let other = Entity::Agent(self.agent.other());
        let saw = self.observed.contains(other);
        self.observed = seen.observed;
        if self.level == Level::Zero {
            return None;
        }
        if !saw || !seen.observed.contains(other) {
            self.last = None;
            normalise(&mut self.weights, self.theory.fading);
            self.assign();
            return None;
        }
        let motion = self.recognise(&before[0], own, seen);
        let likelihoods = self.likelihoods(before, &motion);
        let of = |action: usize| motion.iter().map(|of_strength| of_strength[action]).sum::<f64>();
        let likeliest = (0..ACTIONS).max_by(|&a, &b| of(a).total_cmp(&of(b)));
        self.last = likeliest.map(|index| Action::ALL[index]);
        self.weigh(&likelihoods)
    }

    /// Likelihoods of the seen motion of the other for each of its strengths and actions.
    fn recognise(&self, before: &State, own: Action, seen: &Observation) -> MotionLikelihoods {
        let other = self.agent.other();
        let mut motion = [[0.0; ACTIONS]; Strength::ALL.len()];
        for (logs, (_, dynamics)) in motion.iter_mut().zip(&self.worlds) {
            for (log, action) in logs.iter_mut().zip(Action::ALL) {
                let mut actions = [own; AGENT_COUNT];
                actions[other] = action;
                let mut state = *before;
                dynamics.step(&mut state, actions);
                *log = self.log_match(&state, seen);
            }
        }
        let most = motion.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
        motion.map(|logs| logs.map(|log| libm::exp(log - most)))
    }

    /// The logarithm of the density with which the other's body is seen where a model of the world predicts
    /// another one: that of Student's distribution, so that a collision the model misses decides nothing.
    fn log_match(&self, predicted: &State, seen: &Observation) -> f64 {
        const FREEDOM: f32 = 4.0;
        let other = self.agent.other();
        let Some(body) = seen.body(Entity::Agent(other)) else { return 0.0 };
        let expected = predicted.body(Entity::Agent(other));
        let theory = &self.theory;
        let position = body.position.distance(expected.position) / theory.position_scale;
        let velocity = body.velocity.distance(expected.velocity) / theory.velocity_scale;
        let angle = (body.angle - expected.angle) / theory.angle_scale;
        let mut square = position * position + velocity * velocity + angle * angle;
        if seen.grip(other).flatten().map(|grip| grip.object) != predicted.held_object(other) {
            // Whether something is held is seen without error.
            square += 1000.0;
        }
        f64::from(-(FREEDOM + 5.0) / 2.0) * libm::log1p(f64::from(square / FREEDOM))
    }

    /// Likelihoods that suppositions give to the motion that was seen: for every particle its own, and for
    /// each that no particle has, in one of them.
    fn likelihoods(&mut self, before: &[State], motion: &MotionLikelihoods) -> Likelihoods {
        let mut known: Vec<(usize, usize, f64)> = Vec::new();
        let mut particles = Vec::with_capacity(before.len());
        for (k, state) in before.iter().enumerate() {
            let supposed = self.assigned[k];
            let same = known.iter().find(|(it, other, _)| *it == supposed && before[*other] == *state);
            let likelihood = match same {
                Some((.., likelihood)) => *likelihood,
                None => {
                    let likelihood = self.likelihood(supposed, state, motion);
                    known.push((supposed, k, likelihood));
                    likelihood
                }
            };
            particles.push(likelihood);
        }
        let suppositions = (0..self.possible.len())
            .map(|supposed| {
                let of = self.assigned.iter().zip(&particles).filter(|(assigned, _)| **assigned == supposed);
                let (sum, count) = of.fold((0.0, 0), |(sum, count), (_, it)| (sum + it, count + 1));
                if count > 0 {
                    sum / f64::from(count)
                } else {
                    self.likelihood(supposed, &before[supposed % before.len()], motion)
                }
            })
            .collect();
        Likelihoods { particles, suppositions }
    }

    fn likelihood(&mut self, supposed: usize, state: &State, motion: &MotionLikelihoods) -> f64 {
        let other = self.agent.other();
        let strength = usize::from(self.possible[supposed].strength.level());
        let physics = &self.worlds[strength].0;
        let motion = &motion[strength];
        let everything: BodySet = physics.entities().collect();
        let subgoal = self.planners[supposed].plan(state, everything).first();
        let objective = Objective::new(physics, &mut self.navigator, state, other, subgoal, &self.parameters);
        let policy = HabitPolicy { sharpness: self.theory.sharpness };
        let weights = policy.weights(&objective, state, self.last);
        let sum: f64 = weights.iter().sum();
        let lapse = self.theory.lapse;
        let at_random = motion.iter().sum::<f64>() / ACTIONS as f64;
        let intended: f64 = weights.iter().zip(motion).map(|(weight, seen)| weight * seen).sum();
        let intended = if sum > 0.0 { intended / sum } else { at_random };
        (1.0 - lapse) * intended + lapse * at_random
    }

    /// Weighs suppositions and particles by their likelihoods.
    fn weigh(&mut self, likelihoods: &Likelihoods) -> Option<Vec<usize>> {
        let exponent = self.theory.inverse_temperature;
        for (weight, likelihood) in self.weights.iter_mut().zip(&likelihoods.suppositions) {
            *weight *= libm::pow(*likelihood, exponent);
        }
        normalise(&mut self.weights, self.theory.forgetting);
        // Among the particles of one supposition, those in which it explains better what the other did.
        let relative: Vec<f64> = self
            .assigned
            .iter()
            .zip(&likelihoods.particles)
            .map(|(&it, likelihood)| match likelihoods.suppositions[it] {
                0.0 => 1.0,
                mean => libm::pow(likelihood / mean, exponent),
            })
            .collect();
        let differs = relative.iter().any(|weight| (weight - 1.0).abs() > 1e-9);
        let ancestors = differs.then(|| spread(&relative, relative.len()));
        if let Some(ancestors) = &ancestors {
            self.assigned = ancestors.iter().map(|&k| self.assigned[k]).collect();
        }
        self.assign();
        ancestors
    }

    /// Gives the particles suppositions in proportion to the weights. A particle keeps its own as long as
    /// that has a share left.
    fn assign(&mut self) {
        let mut left = vec![0_usize; self.possible.len()];
        for supposed in spread(&self.weights, self.assigned.len()) {
            left[supposed] += 1;
        }
        let mut without = Vec::new();
        for (k, &supposed) in self.assigned.iter().enumerate() {
            if left[supposed] > 0 {
                left[supposed] -= 1;
            } else {
                without.push(k);
            }
        }
        let mut rest = left.iter().enumerate().flat_map(|(it, &n)| core::iter::repeat_n(it, n));
        for k in without {
            self.assigned[k] = rest.next().unwrap_or(self.assigned[k]);
        }
        self.suppositions = self.assigned.iter().map(|&it| self.possible[it]).collect();
    }
}

/// Likelihoods of a seen motion: for each particle with its supposition, and for each supposition on average.
struct Likelihoods {
    particles: Vec<f64>,
    suppositions: Vec<f64>,
}

/// The intents that an agent can have towards another with an attitude and a goal.
fn possible_intents(agent: AgentId, attitude: Attitude, others: Goal, objects: usize) -> Vec<Intent> {
    let own = physical_goals(agent, objects).into_iter();
    let neutral = own.map(|goal| Intent { attitude: Attitude::Neutral, goal });
    // At most one of two agents is social.
    let social: &[Attitude] = match attitude {
        Attitude::Neutral => &[Attitude::Help, Attitude::Hinder],
        Attitude::Help | Attitude::Hinder => &[],
    };
    neutral.chain(social.iter().map(|&attitude| Intent { attitude, goal: others })).collect()
}

/// Both goals if the other has an intent.
pub(crate) fn goals(agent: AgentId, attitude: Attitude, own: Goal, intent: Intent) -> [Goal; AGENT_COUNT] {
    let others = if intent.attitude == Attitude::Hinder { intent.goal.negated() } else { intent.goal };
    let own = match attitude {
        Attitude::Neutral => own,
        Attitude::Help => others,
        Attitude::Hinder => others.negated(),
    };
    let mut goals = [own; AGENT_COUNT];
    goals[agent.other()] = others;
    goals
}

/// Both goals as the other has them in its plans if it has an intent. One that pursues a goal of its own does
/// not reckon with this agent, to which a goal is given that has nothing to do with it: level 1 supposes
/// level 0.
pub(crate) fn goals_of_other(agent: AgentId, own: Goal, intent: Intent) -> [Goal; AGENT_COUNT] {
    match intent.attitude {
        Attitude::Neutral => {
            let landmark = LandmarkId::TOP_LEFT;
            let mut goals = [intent.goal; AGENT_COUNT];
            goals[agent] = Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive };
            goals
        }
        Attitude::Help | Attitude::Hinder => goals(agent, Attitude::Neutral, own, intent),
    }
}

/// Bodies and walls, with another strength of an agent.
pub(crate) fn with_strength(mut physics: PhysicsConfig, agent: AgentId, strength: Strength) -> PhysicsConfig {
    physics.agents[agent].max_force = strength.max_force();
    physics
}

/// Indices of weights, `count` in all, in proportion to these: systematic resampling without chance. Equal
/// weights, as many as `count`, give every index once.
fn spread(weights: &[f64], count: usize) -> Vec<usize> {
    let sum: f64 = weights.iter().sum();
    let mut indices = Vec::with_capacity(count);
    let (mut index, mut reached) = (0, weights[0] / sum);
    for k in 0..count {
        let place = (k as f64 + 0.5) / count as f64;
        while reached < place && index + 1 < weights.len() {
            index += 1;
            reached += weights[index] / sum;
        }
        indices.push(index);
    }
    indices
}

/// Makes weights sum up to 1 and mixes in a share of the uniform prior.
fn normalise(weights: &mut [f64], forgetting: f64) {
    let uniform = 1.0 / weights.len() as f64;
    ascription::normalise(weights, core::iter::repeat(uniform), forgetting);
}
