//! The suspicion that a hinderer of level 2 ascribes to the other, from decision to decision.

use crate::{
    ascription::{ACTIONS, TheoryParameters},
    objective::Objective,
    pretext::{self, Scrutiny},
    theory,
    view::BeliefView,
};
use phase_model::{
    Action, AgentId, Attitude, BodySet, Entity, Goal, Intent, Layout, PhysicsConfig, State, physical_goals,
};
use phase_navigation::Navigator;
use phase_perception::observed_set;
use phase_planner::{Planner, PlannerParameters};
use std::collections::BTreeMap;

/// The inference about a hinderer that it ascribes to the other.
///
/// The other is taken to be of level 1 and to see whole states: it weighs hindering, helping and each goal
/// that the agent can have of its own by the agent's actions that it perceives. How far it has perceived one
/// is the share of the agent's particles in which it did.
#[derive(Clone, Debug)]
pub(crate) struct Suspicion {
    agent: AgentId,
    theory: TheoryParameters,
    physics: PhysicsConfig,
    layout: Layout,
    planning: PlannerParameters,
    /// Planners of goals of its own.
    planners: Vec<Planner>,
    /// Planners of helping, for each goal of the other, made when first needed.
    helping: BTreeMap<Goal, Planner>,
    /// Probabilities of hindering, of each goal of its own, and of helping.
    weights: Vec<f64>,
    /// The last decision with a search.
    last: Option<Decision>,
}

/// Explanations of an action in the state of a decision.
#[derive(Clone, Debug)]
struct Decision {
    /// The policy of each explanation.
    policies: Vec<[f64; ACTIONS]>,
    /// In what share of the particles the other perceives the agent, 0 to 1.
    perceived: f64,
}

impl Suspicion {
    /// Everything is as likely before the other has seen anything.
    pub(crate) fn new(
        agent: AgentId,
        physics: &PhysicsConfig,
        layout: Layout,
        planning: PlannerParameters,
        theory: TheoryParameters,
    ) -> Self {
        let goals = physical_goals(agent, physics.object_count);
        let count = goals.len() + 2;
        let mut this = Self {
            agent,
            theory,
            physics: physics.clone(),
            layout,
            planning,
            planners: Vec::with_capacity(goals.len()),
            helping: BTreeMap::new(),
            weights: vec![1.0 / count as f64; count],
            last: None,
        };
        this.planners = goals.into_iter().map(|goal| this.planner(Attitude::Neutral, goal)).collect();
        this
    }

    /// The agent's planner if it were neutral and had a goal, or helped the other with it.
    fn planner(&self, attitude: Attitude, goal: Goal) -> Planner {
        let intent = Intent { attitude, goal };
        let goals = theory::goals_of_other(self.agent.other(), goal, intent);
        Planner::with_parameters(
            self.physics.clone(),
            self.layout,
            self.agent,
            goals,
            attitude,
            self.planning,
        )
    }

    /// The other's explanations of the agent's next actions. `own` is the subgoal of the agent, compiled in
    /// `state`, `others_goal` the goal that it takes the other to have.
    pub(crate) fn scrutiny<'a>(
        &mut self,
        own: &Objective<'a>,
        navigator: &mut Navigator,
        state: &State,
        others_goal: Goal,
        view: BeliefView<'_>,
    ) -> Scrutiny<'a> {
        let everything: BodySet = self.physics.entities().collect();
        if !self.helping.contains_key(&others_goal) {
            let planner = self.planner(Attitude::Help, others_goal);
            self.helping.insert(others_goal, planner);
        }
        let planners = self.planners.iter().chain(self.helping.get(&others_goal));
        // Goals with the same first subgoal are one pretext.
        let mut pretexts: Vec<(Objective<'a>, f64, usize)> = Vec::new();
        let mut pretext_of = Vec::with_capacity(self.weights.len());
        for (planner, weight) in planners.zip(&self.weights[1..]) {
            let subgoal = planner.plan(state, everything).first();
            let known = pretexts.iter().position(|(objective, ..)| objective.subgoal() == subgoal);
            let pretext = known.unwrap_or_else(|| {
                let (physics, parameters) = (own.physics(), own.parameters());
                let objective = Objective::new(physics, navigator, state, self.agent, subgoal, parameters);
                pretexts.push((objective, 0.0, 0));
                pretexts.len() - 1
            });
            pretexts[pretext].1 += weight;
            pretexts[pretext].2 += 1;
            pretext_of.push(pretext);
        }
        let policy = |objective| pretext::policy(objective, state, view.last_action, &self.theory);
        let of_pretexts: Vec<[f64; ACTIONS]> = pretexts.iter().map(|(it, ..)| policy(it)).collect();
        let policies =
            core::iter::once(policy(own)).chain(pretext_of.into_iter().map(|it| of_pretexts[it])).collect();
        let perceived = self.perceived(view.particles);
        self.last = Some(Decision { policies, perceived });
        pretexts.sort_by(|(_, a, _), (_, b, _)| b.total_cmp(a));
        Scrutiny::new(self.weights[0], pretexts, self.weights.len(), self.theory)
    }

    /// Learns from the action that followed the last decision. `particles` are those after it.
    pub(crate) fn learn(&mut self, particles: &[State], action: Option<Action>) {
        let prior = vec![1.0 / self.weights.len() as f64; self.weights.len()];
        let mut unseen = self.weights.clone();
        pretext::learn(&mut unseen, None, &prior, &self.theory);
        let (Some(last), Some(action)) = (self.last.take(), action) else {
            self.weights = unseen;
            return;
        };
        let likelihoods: Vec<f64> =
            last.policies.iter().map(|policy| pretext::likelihood(policy, action, &self.theory)).collect();
        pretext::learn(&mut self.weights, Some(&likelihoods), &prior, &self.theory);
        let seen = last.perceived.min(self.perceived(particles));
        for (weight, unseen) in self.weights.iter_mut().zip(unseen) {
            *weight = seen * *weight + (1.0 - seen) * unseen;
        }
    }

    /// Back to what the other infers before it has seen anything.
    pub(crate) fn forget(&mut self) {
        let each = 1.0 / self.weights.len() as f64;
        self.weights.fill(each);
        self.last = None;
    }

    /// The probability of hindering, 0 to 1.
    pub(crate) fn of_hindering(&self) -> f64 {
        self.weights[0]
    }

    /// In what share of the particles the other perceives the agent, 0 to 1.
    fn perceived(&self, particles: &[State]) -> f64 {
        let is_perceived = |state: &State| {
            observed_set(&self.physics, state, self.agent.other()).contains(Entity::Agent(self.agent))
        };
        // Mostly all particles are equal.
        if particles.iter().all(|particle| particle == &particles[0]) {
            return f64::from(u8::from(is_perceived(&particles[0])));
        }
        particles.iter().filter(|particle| is_perceived(particle)).count() as f64 / particles.len() as f64
    }
}
