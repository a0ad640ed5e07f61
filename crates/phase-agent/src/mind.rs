//! The decision step of Algorithm 1: from particles to subgoal to action, for a given belief.

use crate::{
    PhaseParameters, PolicyNetwork, Prior, action_set,
    objective::Objective,
    policy::{Features, summary},
    rollout_policy,
    search_model::{SearchModel, SearchState},
};
use phase_event::{ActionEvaluation, SubgoalValue, Thought};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, BodySet, Dynamics, Entity, Goal, Literal, PhysicsConfig,
    Predicate, PredicateTarget, Scene, State, Subgoal,
    random::{Purpose, stream},
};
use phase_navigation::Navigator;
use phase_planner::{Candidate, Plan, Planner, value};
use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings};
use rand::{Rng, RngExt};

/// One agent's goals and planners, with its own model of the dynamics. The belief is an argument of every
/// decision, so inference can use a mind with estimated beliefs.
#[derive(Clone, Debug)]
pub struct Mind<D> {
    agent: AgentId,
    physics: PhysicsConfig,
    goals: [Goal; AGENT_COUNT],
    attitude: Attitude,
    parameters: PhaseParameters,
    dynamics: D,
    planner: Planner,
    pomcp: Pomcp<u16>,
    navigator: Navigator,
}

/// The belief state that a decision is based on.
#[derive(Clone, Copy, Debug)]
pub struct BeliefView<'a> {
    /// Possible states of the world, all equally likely; at least one.
    pub particles: &'a [State],
    /// The entities that the agent observes now, itself included.
    pub observed: BodySet,
    /// The agent's own last action, if it has acted: action is a habit.
    pub last_action: Option<Action>,
}

/// A decision before it is made, as the policy network sees it.
#[derive(Clone, Debug)]
pub struct Consideration {
    /// The subgoal pursued.
    pub subgoal: Subgoal,
    /// The actions to choose from, at least two.
    pub actions: &'static [Action],
    /// The network's input.
    pub features: Features,
    /// The action of the heuristic in the first particle.
    pub heuristic: Action,
    /// The prior weight of each action by habit in the first particle.
    pub habits: Vec<f64>,
}

/// The matter of a search.
struct Question {
    subgoal: Subgoal,
    subgoals: Vec<SubgoalValue>,
    plan: Vec<Subgoal>,
    actions: &'static [Action],
    /// Possible states of the world, at least one.
    roots: Vec<State>,
}

impl<D: Dynamics> Mind<D> {
    /// The mind of an agent of a scene.
    ///
    /// # Errors
    /// [`PomcpError`] for parameters that a search cannot have.
    pub fn new(
        scene: &Scene,
        agent: AgentId,
        dynamics: D,
        parameters: PhaseParameters,
    ) -> Result<Self, PomcpError> {
        let physics = scene.physics();
        let pomcp = Pomcp::new(PomcpSettings {
            simulations: parameters.simulations,
            rollout_steps: parameters.rollout_steps,
            c_init: parameters.c_init,
            c_base: parameters.c_base,
            stop_when_decided: true,
            convergence: parameters.convergence,
            untried_first: false,
            ..PomcpSettings::default()
        })?;
        let attitude = scene.agents[agent].attitude;
        Ok(Self {
            agent,
            goals: scene.goals(),
            attitude,
            parameters,
            dynamics,
            planner: Planner::with_parameters(
                physics.clone(),
                scene.layout,
                agent,
                scene.goals(),
                attitude,
                parameters.planning(),
            ),
            pomcp,
            navigator: Navigator::new(scene.layout, parameters.navigation()),
            physics,
        })
    }

    /// The agent's model of the dynamics.
    pub const fn dynamics(&self) -> &D {
        &self.dynamics
    }

    /// Chooses the next action; returns it with its explanation.
    ///
    /// # Errors
    /// [`PomcpError`], if the search fails.
    pub fn decide(
        &mut self,
        belief_view: BeliefView<'_>,
        random: &mut impl Rng,
    ) -> Result<(Action, Thought), PomcpError> {
        let Some(question) = self.question(belief_view) else { return Ok((Action::Stop, Thought::IDLE)) };
        let (action, actions) = match question.actions {
            [only] => (*only, Vec::new()),
            _ => {
                // Each decision has its own generator, so the length of a search does not affect later ones.
                let mut random = stream(random.next_u64(), Purpose::Search, 0);
                self.search(belief_view, &question, &mut random)?
            }
        };
        let Question { subgoal, subgoals, plan, .. } = question;
        Ok((action, Thought { subgoal, subgoals, plan, actions }))
    }

    /// The next decision as the policy network sees it, with the actions that it is about; `None` if there
    /// is nothing to choose. [`decide`](Self::decide) would search the same actions.
    pub fn consider(&mut self, belief_view: BeliefView<'_>) -> Option<Consideration> {
        let question = self.question(belief_view)?;
        let Question { actions, subgoal, .. } = question;
        (actions.len() > 1).then(|| {
            self.with_model(belief_view, &question, |_, model, search_states| {
                let mut habits = Vec::with_capacity(actions.len());
                model.prior_weights(&search_states[0], &mut habits);
                let heuristic = rollout_policy::action(&model.objective, search_states[0].state());
                Consideration {
                    subgoal,
                    actions,
                    features: summary(&model, search_states),
                    heuristic,
                    habits,
                }
            })
        })
    }

    /// The subgoal to pursue and what is to be searched for it; `None` if no particle proposes any.
    fn question(&self, belief_view: BeliefView<'_>) -> Option<Question> {
        let particles = belief_view.particles;
        let known =
            belief_view.observed.union(localised(&self.physics, particles, self.parameters.agreement));
        let (plans, plan_of) = self.plans(particles, known);
        let by_particle: Vec<&Plan> = plan_of.iter().map(|&plan| &plans[plan]).collect();
        let candidates = value::candidates(&by_particle, self.parameters.lambda);
        let best = candidates.first()?;
        let search_particles = self.search_particles(belief_view, best, &by_particle);
        Some(Question {
            subgoal: best.subgoal,
            subgoals: candidates.iter().map(summary_of).collect(),
            plan: by_particle[search_particles[0]].subgoals.clone(),
            actions: action_set::actions(self.agent, best.subgoal),
            roots: search_particles.iter().map(|&particle| particles[particle]).collect(),
        })
    }

    /// One plan for each distinct particle, and the index of each particle's plan. When everything is
    /// observed all particles are equal and one plan suffices.
    fn plans(&self, particles: &[State], known: BodySet) -> (Vec<Plan>, Vec<usize>) {
        let mut different: Vec<usize> = Vec::new();
        let mut plans = Vec::new();
        let mut plan_of = Vec::with_capacity(particles.len());
        for (k, particle) in particles.iter().enumerate() {
            let seen = different.iter().position(|&other| particles[other] == *particle);
            plan_of.push(seen.unwrap_or_else(|| {
                different.push(k);
                plans.push(self.planner.plan(particle, known));
                plans.len() - 1
            }));
        }
        (plans, plan_of)
    }

    /// The particles used as roots of the search. If the subgoal's target is unobserved, only those that
    /// place it near its position in the cheapest plan: the agent searches one location after another. With
    /// all of them, it would oscillate between locations and reach none.
    fn search_particles(
        &self,
        belief_view: BeliefView<'_>,
        candidate: &Candidate,
        plans: &[&Plan],
    ) -> Vec<usize> {
        let all = &candidate.particles;
        let Some(unobserved_target) = self.unobserved_target(belief_view, candidate.subgoal) else {
            return all.clone();
        };
        let shortest = all.iter().min_by(|&&a, &&b| plans[a].distance.total_cmp(&plans[b].distance));
        let Some(&first) = shortest else { return all.clone() };
        let place = |particle: usize| belief_view.particles[particle].position(unobserved_target);
        let near = |&&particle: &&usize| place(particle).distance(place(first)) <= self.parameters.colocation;
        // A NaN position is near nothing, not even itself.
        let mut search_particles: Vec<usize> = all.iter().filter(near).copied().collect();
        if search_particles.is_empty() {
            search_particles.push(first);
        }
        search_particles
    }

    /// The entity that a subgoal sends the agent to, if it does not see it.
    fn unobserved_target(&self, belief_view: BeliefView<'_>, subgoal: Subgoal) -> Option<Entity> {
        target_entity(subgoal, self.agent).filter(|&entity| !belief_view.observed.contains(entity))
    }

    /// Hands over the search, the model of a question and the states to search from.
    fn with_model<R>(
        &mut self,
        belief_view: BeliefView<'_>,
        question: &Question,
        use_model: impl FnOnce(&mut Pomcp<u16>, SearchModel<'_, D>, &[SearchState]) -> R,
    ) -> R {
        let roots = &question.roots;
        let unobserved = self.unobserved_target(belief_view, question.subgoal);
        let other = self.agent.other();
        let other_goal = Subgoal::Achieve(Literal::from(self.goals[other]));
        let physics = &self.physics;
        let parameters = &self.parameters;
        let navigator = &mut self.navigator;
        let objective =
            Objective::new(physics, navigator, &roots[0], self.agent, question.subgoal, parameters);
        let other_objective = Objective::new(physics, navigator, &roots[0], other, other_goal, parameters);
        let model = SearchModel {
            dynamics: &self.dynamics,
            physics,
            objective,
            other_objective,
            actions: question.actions,
            goals: self.goals,
            rewards_goals: !matches!(unobserved, Some(Entity::Object(_))),
            attitude: self.attitude,
            root_prior: Vec::new(),
        };
        // If all particles are equal, one root suffices and the search can cache its transitions.
        let different = if roots.iter().all(|root| root == &roots[0]) { &roots[..1] } else { roots };
        let search_states: Vec<SearchState> = different
            .iter()
            .map(|&state| SearchState::new(&model.objective, state, belief_view.last_action))
            .collect();
        use_model(&mut self.pomcp, model, &search_states)
    }

    /// LP(B̃, h*) of Algorithm 1: the best action for a subgoal in the worlds that agree on it.
    fn search(
        &mut self,
        belief_view: BeliefView<'_>,
        question: &Question,
        random: &mut impl Rng,
    ) -> Result<(Action, Vec<ActionEvaluation>), PomcpError> {
        let PhaseParameters { prior, simulations, decisiveness, .. } = self.parameters;
        let network = match prior {
            Prior::Habits => None,
            Prior::Network | Prior::NetworkAlone => Some(PolicyNetwork::bundled()),
        };
        let actions = question.actions;
        let (evidence, best) =
            self.with_model(belief_view, question, |pomcp, mut model, search_states| {
                let of_action = |(&action, (visits, value))| ActionEvaluation { action, visits, value };
                if let Some(network) = network {
                    let evaluation = network.evaluate(&summary(&model, search_states), actions);
                    model.root_prior = evaluation.policy;
                    if prior == Prior::NetworkAlone {
                        let visits = |p: &f64| (libm::round(p * simulations as f64) as u32, evaluation.value);
                        let found = actions.iter().zip(model.root_prior.iter().map(visits)).map(of_action);
                        return Ok((found.collect(), likeliest(&model.root_prior)));
                    }
                }
                let decision = pomcp.search(&model, search_states, random)?;
                let found = decision.actions.iter().map(|found| (found.visits as u32, found.value));
                Ok((actions.iter().zip(found).map(of_action).collect::<Vec<_>>(), decision.action))
            })?;
        let visits: Vec<f64> = evidence.iter().map(|found| f64::from(found.visits)).collect();
        let chosen = sample(&visits, decisiveness, random).unwrap_or(best);
        Ok((actions[chosen], evidence))
    }
}

/// Draws an index with a probability proportional to its visits to the power of `exponent`; `None` if all are
/// zero.
fn sample(visits: &[f64], exponent: f64, random: &mut impl Rng) -> Option<usize> {
    let most = visits.iter().copied().fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let weights = visits.iter().map(|visits| libm::pow(visits / most, exponent));
    let sum: f64 = weights.clone().sum();
    if !sum.is_finite() {
        return None;
    }
    let mut left = random.random_range(0.0..sum);
    for (index, weight) in weights.enumerate() {
        if left < weight {
            return Some(index);
        }
        left -= weight;
    }
    None
}

/// The index of the greatest probability.
fn likeliest(policy: &[f64]) -> usize {
    let greatest = policy.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    greatest.map_or(0, |(index, _)| index)
}

/// The entity that a subgoal sends an agent to.
fn target_entity(subgoal: Subgoal, agent: AgentId) -> Option<Entity> {
    let Subgoal::Achieve(Literal { predicate, holds: true }) = subgoal else { return None };
    match predicate {
        Predicate::Close(who, PredicateTarget::Entity(entity)) if who == Entity::Agent(agent) => Some(entity),
        Predicate::Touch(_, entity) => Some(entity),
        Predicate::Attach(_, object) => Some(Entity::Object(object)),
        _ => None,
    }
}

fn summary_of(candidate: &Candidate) -> SubgoalValue {
    SubgoalValue { subgoal: candidate.subgoal, value: candidate.value, particles: candidate.particles.len() }
}

/// Entities on whose position all particles agree, to within `agreement` (u). An agent need not verify the
/// position of an object it has just put down.
fn localised(physics: &PhysicsConfig, particles: &[State], agreement: f32) -> BodySet {
    let mut known = BodySet::EMPTY;
    let Some(first) = particles.first() else { return known };
    for entity in physics.entities() {
        let place = first.position(entity);
        if particles.iter().all(|particle| particle.position(entity).distance(place) <= agreement) {
            known.insert(entity);
        }
    }
    known
}
