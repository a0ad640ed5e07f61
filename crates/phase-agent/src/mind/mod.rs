//! The decision step of Algorithm 1: from particles to subgoal to action, for a given belief.

mod finding_out;

use crate::{
    PhaseParameters, PolicyNetwork, Prior, action_set,
    ignorance::{Ignorance, believed, commonest},
    matter::{Consideration, Matter, Question, likeliest, localised, sample, summary_of, target_entity},
    objective::Objective,
    policy::{VISITS, summary},
    rollout_policy,
    search_model::{SearchModel, SearchState},
    suspicion::Suspicion,
    theory::{self, Supposition},
    view::BeliefView,
};
use phase_event::{ActionEvaluation, SubgoalValue, Thought};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, BodySet, Dynamics, Entity, Goal, Literal, PhysicsConfig, Scene,
    Subgoal,
    random::{Purpose, stream},
};
use phase_navigation::Navigator;
use phase_planner::{Candidate, Plan, Planner, value};
use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings};
use rand::Rng;

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
    /// The additional parts of a mind that does not know the other's.
    ignorance: Option<Ignorance<D>>,
    /// The other's suspicion, if that matters to the agent.
    suspicion: Option<Suspicion>,
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
            ignorance: None,
            suspicion: None,
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
        if let Some(suspicion) = &mut self.suspicion {
            suspicion.learn(belief_view.particles, belief_view.last_action);
        }
        let suspicion = self.suspicion.as_ref().map(Suspicion::of_hindering);
        let question = match self.question(belief_view) {
            Matter::Nothing => return Ok((Action::Stop, Thought { suspicion, ..Thought::IDLE })),
            Matter::Watch(action, subgoals) => {
                let intents = believed(belief_view.suppositions);
                return Ok((action, Thought { subgoals, intents, suspicion, ..Thought::IDLE }));
            }
            Matter::Search(question) => question,
        };
        let (action, actions) = match question.actions {
            [only] => (*only, Vec::new()),
            _ => {
                // Each decision has its own generator, so the length of a search does not affect later ones.
                let mut random = stream(random.next_u64(), Purpose::Search, 0);
                self.search(belief_view, &question, &mut random)?
            }
        };
        let Question { subgoal, subgoals, plan, .. } = question;
        let intents = believed(belief_view.suppositions);
        Ok((action, Thought { subgoal, subgoals, plan, actions, intents, suspicion }))
    }

    /// The next decision as the policy network sees it, with the actions that it is about; `None` if there
    /// is nothing to choose. [`decide`](Self::decide) would search the same actions.
    pub fn consider(&mut self, belief_view: BeliefView<'_>) -> Option<Consideration> {
        let Matter::Search(question) = self.question(belief_view) else { return None };
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

    /// The subgoal to pursue and what is to be searched for it.
    fn question(&mut self, belief_view: BeliefView<'_>) -> Matter {
        let particles = belief_view.particles;
        let localised = localised(&self.physics, particles, self.agent, self.parameters.agreement);
        let known = belief_view.observed.union(localised);
        let (plans, plan_of) = self.plans(belief_view, known);
        let by_particle: Vec<&Plan> = plan_of.iter().map(|&plan| &plans[plan]).collect();
        let candidates = value::candidates(&by_particle, self.parameters.lambda);
        let subgoals: Vec<SubgoalValue> = candidates.iter().map(summary_of).collect();
        let best = match &self.ignorance {
            Some(ignorance) => ignorance.best(self.attitude, belief_view.suppositions, &candidates),
            None => candidates.first(),
        };
        if let (Some(ignorance), false) = (&mut self.ignorance, candidates.is_empty()) {
            ignorance.count_watching(best.is_none());
        }
        let Some(best) = best else {
            return if candidates.is_empty() { Matter::Nothing } else { self.watch(belief_view, subgoals) };
        };
        let chosen = self.search_particles(belief_view, best, &by_particle);
        let plan = by_particle[chosen[0]].subgoals.clone();
        Matter::Search(self.search_for(belief_view, best.subgoal, subgoals, plan, chosen))
    }

    /// A search for a subgoal from some particles, at least one.
    fn search_for(
        &self,
        belief_view: BeliefView<'_>,
        subgoal: Subgoal,
        subgoals: Vec<SubgoalValue>,
        plan: Vec<Subgoal>,
        particles: Vec<usize>,
    ) -> Question {
        let roots = particles.iter().map(|&particle| belief_view.particles[particle]).collect();
        let actions = action_set::actions(self.agent, subgoal);
        Question { subgoal, subgoals, plan, actions, particles, roots }
    }

    /// One plan for each distinct particle, and the index of each particle's plan. When everything is
    /// observed all particles are equal and one plan suffices, or one for each supposition.
    fn plans(&mut self, belief_view: BeliefView<'_>, known: BodySet) -> (Vec<Plan>, Vec<usize>) {
        let BeliefView { particles, suppositions, contest, .. } = belief_view;
        let PhaseParameters { patience, respite, .. } = self.parameters;
        let ceded = contest.ceded(self.agent, patience, respite);
        let mut different: Vec<usize> = Vec::new();
        let mut plans = Vec::new();
        let mut plan_of = Vec::with_capacity(particles.len());
        for (k, particle) in particles.iter().enumerate() {
            let same = |other: usize| {
                particles[other] == *particle && suppositions.get(other) == suppositions.get(k)
            };
            let seen = different.iter().position(|&other| same(other));
            plan_of.push(seen.unwrap_or_else(|| {
                different.push(k);
                plans.push(self.plan(particle, suppositions.get(k), known, ceded));
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
        // The commonest supposition of these particles is that of the search.
        let suppositions: Vec<Supposition> =
            question.particles.iter().filter_map(|&k| belief_view.suppositions.get(k)).copied().collect();
        let (physics, dynamics, goals) = match (&self.ignorance, commonest(&suppositions)) {
            (Some(ignorance), Some(supposition)) => {
                let (physics, dynamics) = &ignorance.worlds[usize::from(supposition.strength.level())];
                let own = self.goals[self.agent];
                let goals = theory::goals(self.agent, self.attitude, own, supposition.intent);
                (physics, dynamics, goals)
            }
            _ => (&self.physics, &self.dynamics, self.goals),
        };
        let other_goal = Subgoal::Achieve(Literal::from(goals[other]));
        let parameters = &self.parameters;
        let navigator = &mut self.navigator;
        let objective =
            Objective::new(physics, navigator, &roots[0], self.agent, question.subgoal, parameters);
        let other_objective = Objective::new(physics, navigator, &roots[0], other, other_goal, parameters);
        let scrutiny = self
            .suspicion
            .as_mut()
            .map(|suspicion| suspicion.scrutiny(&objective, navigator, &roots[0], goals[other], belief_view));
        let model = SearchModel {
            dynamics,
            physics,
            objective,
            other_objective,
            actions: question.actions,
            goals,
            rewards_goals: !matches!(unobserved, Some(Entity::Object(_))),
            attitude: self.attitude,
            scrutiny,
            root_prior: Vec::new(),
        };
        // If all particles are equal, one root suffices and the search can cache its transitions.
        let different = if roots.iter().all(|root| root == &roots[0]) { &roots[..1] } else { roots };
        let search_states: Vec<SearchState> = different
            .iter()
            .map(|&state| {
                let state = SearchState::new(&model.objective, state, belief_view.last_action);
                model.scrutiny.as_ref().map_or(state, |scrutiny| state.under(scrutiny))
            })
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
        let PhaseParameters { prior, decisiveness, .. } = self.parameters;
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
                        let visits = |p: &f64| (libm::round(p * VISITS) as u32, evaluation.value);
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
