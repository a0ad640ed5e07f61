//! One decision: a subgoal for every particle, the selection among them, and the search.

use crate::{
    aim::Aim,
    memo::{Search, SearchMemo},
    parameters::PublishedParameters,
    rooms::Rooms,
    rules::Rules,
    search::SearchModel,
    selection::{Proposal, distance_left, proposals, pursued},
};
use phase_event::{ActionEvaluation, SubgoalValue, Thought};
use phase_forward::Forward;
use phase_model::{
    Action, AgentId, Scene, State, Subgoal,
    random::{Purpose, stream},
};
use phase_pomcp::{ActionStatistics, Pomcp, PomcpError, PomcpSettings};
use rand::Rng;

/// The mind of one agent of the published simulator. The belief is an argument of every decision.
#[derive(Debug)]
pub struct Mind {
    rules: Rules,
    imagined: Forward,
    pomcp: Pomcp<()>,
    parameters: PublishedParameters,
    memo: Option<SearchMemo>,
}

impl Mind {
    /// The mind of an agent of a scene.
    ///
    /// # Errors
    /// [`PomcpError`] for parameters that a search cannot have.
    pub fn new(scene: &Scene, agent: AgentId, parameters: PublishedParameters) -> Result<Self, PomcpError> {
        let physics = scene.physics();
        let pomcp = Pomcp::new(PomcpSettings {
            simulations: parameters.simulations,
            rollout_steps: parameters.rollout_steps,
            c_init: parameters.c_init,
            c_base: parameters.c_base,
            normalise_values: false,
            ..PomcpSettings::default()
        })?;
        let imagined = Forward::imagined(&physics);
        Ok(Self {
            imagined: if parameters.collisions { imagined } else { imagined.without_collisions() },
            rules: Rules {
                layout: scene.layout,
                rooms: Rooms::new(scene.layout),
                physics,
                agent,
                goals: scene.goals(),
                attitude: scene.agents[agent].attitude,
            },
            pomcp,
            parameters,
            memo: None,
        })
    }

    /// This mind with a memo, in which it looks up a search that another mind has done. It decides as it
    /// would without.
    #[must_use]
    pub fn sharing(self, memo: SearchMemo) -> Self {
        Self { memo: Some(memo), ..self }
    }

    /// The subgoal that the rules give in one possible state of the world.
    #[must_use]
    pub fn aim(&self, state: &State) -> Aim {
        self.rules.aim(state)
    }

    /// What a possible state of the world costs a subgoal's value: the distance left to the final goal, of the
    /// other if the agent helps or hinders it, times the weight.
    #[must_use]
    pub fn cost(&self, state: &State) -> f64 {
        let Rules { rooms, agent, .. } = &self.rules;
        self.parameters.lambda * f64::from(distance_left(rooms, *agent, self.rules.goal(), state))
    }

    /// Chooses the next action, given possible states of the world that are all equally likely; returns it
    /// with its explanation. Without particles the agent stops.
    ///
    /// # Errors
    /// [`PomcpError`], if the search fails.
    pub fn decide(
        &mut self,
        particles: &[State],
        random: &mut impl Rng,
    ) -> Result<(Action, Thought), PomcpError> {
        // Each decision draws one number, so the length of a search does not affect later ones.
        let seed = random.next_u64();
        let aims = self.aims(particles);
        let agent = self.rules.agent;
        let costs: Vec<f64> = particles.iter().map(|particle| self.cost(particle)).collect();
        let proposals = proposals(&aims, &costs);
        let Some(chosen) = pursued(&proposals, agent) else { return Ok((Action::Stop, Thought::IDLE)) };
        let aim = chosen.aim;
        let roots: Vec<State> = chosen.particles.iter().map(|&k| particles[k]).collect();
        let (action, actions) = self.search(aim, &roots, seed)?;
        let thought = Thought {
            subgoal: aim.subgoal(),
            subgoals: proposals.iter().map(summary).collect(),
            plan: if aim == Aim::Stop { Vec::new() } else { vec![aim.subgoal()] },
            actions,
        };
        Ok((action, thought))
    }

    /// The subgoal of each particle; equal ones are thought about once.
    fn aims(&self, particles: &[State]) -> Vec<Aim> {
        let mut aims: Vec<Aim> = Vec::with_capacity(particles.len());
        for (k, particle) in particles.iter().enumerate() {
            let known = particles[..k].iter().position(|earlier| earlier == particle);
            aims.push(known.map_or_else(|| self.rules.aim(particle), |earlier| aims[earlier]));
        }
        aims
    }

    fn search(
        &mut self,
        aim: Aim,
        roots: &[State],
        seed: u64,
    ) -> Result<(Action, Vec<ActionEvaluation>), PomcpError> {
        let Rules { agent, physics, .. } = &self.rules;
        let actions = aim.actions(*agent, self.parameters.older_actions, &roots[0]);
        if let [only] = actions {
            return Ok((*only, Vec::new()));
        }
        // Equal particles are one, and the tree's steps can then be cached.
        let roots = if roots.iter().all(|root| root == &roots[0]) { &roots[..1] } else { roots };
        let search =
            Search { agent: *agent, seed, aim, physics, parameters: &self.parameters, actions, roots };
        let known = self.memo.as_ref().and_then(|memo| memo.recall(&search));
        let evaluations = if let Some(known) = known {
            known
        } else {
            let found = evaluate(&search, &self.rules.rooms, &self.imagined, &mut self.pomcp)?;
            if let Some(memo) = &self.memo {
                memo.keep(&search, &found);
            }
            found
        };
        // Of equally visited actions the better, of equally good ones the first.
        let best = evaluations
            .iter()
            .rev()
            .max_by(|a, b| a.visits.cmp(&b.visits).then_with(|| a.value.total_cmp(&b.value)));
        Ok((best.map_or(Action::Stop, |best| best.action), evaluations))
    }
}

/// Searches as often as the parameters say, and adds up what is found.
fn evaluate(
    search: &Search<'_>,
    rooms: &Rooms,
    imagined: &Forward,
    pomcp: &mut Pomcp<()>,
) -> Result<Vec<ActionEvaluation>, PomcpError> {
    let Search { agent, aim, actions, parameters, .. } = *search;
    let model = SearchModel { agent, aim, actions, rooms, imagined, discount: parameters.discount };
    let mut random = stream(search.seed, Purpose::Search, 0);
    let nothing = |&action: &Action| ActionEvaluation { action, visits: 0, value: 0.0 };
    let mut evaluations: Vec<ActionEvaluation> = actions.iter().map(nothing).collect();
    for _ in 0..parameters.searches.max(1) {
        let found = pomcp.search(&model, search.roots, &mut random)?;
        for (evaluation, found) in evaluations.iter_mut().zip(&found.actions) {
            add(evaluation, found);
        }
    }
    Ok(evaluations)
}

/// Adds what a search found about an action to what others found.
fn add(evaluation: &mut ActionEvaluation, found: &ActionStatistics) {
    let visits = evaluation.visits + found.visits as u32;
    if visits > 0 {
        let sum = evaluation.value * f64::from(evaluation.visits) + found.value * found.visits as f64;
        evaluation.value = sum / f64::from(visits);
    }
    evaluation.visits = visits;
}

fn summary(proposal: &Proposal) -> SubgoalValue {
    let subgoal: Subgoal = proposal.aim.subgoal();
    SubgoalValue { subgoal, value: proposal.value, particles: proposal.particles.len() }
}
