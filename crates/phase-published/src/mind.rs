//! One decision: a subgoal for every particle, the selection among them, and the search.

use crate::{
    aim::Aim,
    memo::{Findings, Search, SearchMemo},
    parameters::PublishedParameters,
    policy::{Features, PolicyNetwork},
    rooms::Rooms,
    rules::Rules,
    search::{self, Task},
    selection::{Proposal, distance_left, proposals, pursued},
    stream::{Draws, PythonStream, RandomNumbers},
};
use phase_event::{ActionEvaluation, SubgoalValue, Thought};
use phase_forward::Imagined;
use phase_model::{
    Action, AgentId, Attitude, PhysicsConfig, Scene, State, Subgoal,
    random::{Purpose, stream},
};
use phase_pomcp::{PomcpError, PomcpSettings};
use rand::{Rng, RngExt};

/// Exponent of the policy network's probabilities in the choice of an action. What one search settles on is
/// partly chance, but seldom a rarely visited action; the number is that of our own minds' `decisiveness`.
const DECISIVENESS: f64 = 4.0;
/// Visits that the policy network's probabilities are given as.
const VISITS: f64 = 1000.0;

/// A decision before it is made, as the policy network sees it.
#[derive(Clone, Debug)]
pub struct Consideration {
    /// The subgoal pursued.
    pub aim: Aim,
    /// The actions to choose from, at least two.
    pub actions: Vec<Action>,
    /// The network's input.
    pub features: Features,
}

/// The matter of a search: a subgoal, and the states that propose it.
struct Question {
    aim: Aim,
    roots: Vec<State>,
    /// All subgoals that were proposed.
    subgoals: Vec<SubgoalValue>,
}

/// The mind of one agent of the published simulator. The belief is an argument of every decision.
#[derive(Clone, Debug)]
pub struct Mind {
    rules: Rules,
    imagined: Imagined,
    /// Words of the original's stream drawn before this step's decision, and until after it.
    previous: u64,
    drawn: u64,
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
        let PublishedParameters { simulations, rollout_steps, c_init, c_base, .. } = parameters;
        let settings =
            PomcpSettings { simulations, rollout_steps, c_init, c_base, ..PomcpSettings::default() };
        settings.validate()?;
        let imagined = imagined(&physics, &parameters);
        Ok(Self {
            imagined,
            rules: Rules {
                layout: scene.layout,
                rooms: Rooms::new(scene.layout),
                physics,
                agent,
                goals: scene.goals(),
                hindering: scene.agents.iter().any(|agent| agent.attitude == Attitude::Hinder),
                attitude: scene.agents[agent].attitude,
            },
            previous: 0,
            drawn: 0,
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

    /// The cost of a possible state of the world in a subgoal's value: the distance left to the final goal,
    /// of the other if the agent helps or hinders it, times the weight.
    #[must_use]
    pub fn cost(&self, state: &State) -> f64 {
        let Rules { rooms, agent, .. } = &self.rules;
        self.parameters.lambda * distance_left(rooms, *agent, self.rules.goal(), state)
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
        let seed = match self.parameters.random {
            RandomNumbers::Seeded => random.next_u64(),
            RandomNumbers::Original => core::mem::take(&mut self.previous),
        };
        self.drawn = 0;
        let Some(Question { aim, roots, subgoals }) = self.question(particles) else {
            return Ok((Action::Stop, Thought::IDLE));
        };
        let Findings { action, evaluations: actions, drawn } = self.search(aim, &roots, seed);
        self.drawn = drawn;
        let thought = Thought {
            subgoal: aim.subgoal(),
            subgoals,
            plan: if aim == Aim::Stop { Vec::new() } else { vec![aim.subgoal()] },
            actions,
            intents: Vec::new(),
            suspicion: None,
        };
        Ok((action, thought))
    }

    /// The next decision as the policy network sees it; `None` if there is nothing to choose.
    /// [`decide`](Self::decide) would search the same actions.
    #[must_use]
    pub fn consider(&self, particles: &[State]) -> Option<Consideration> {
        let Question { aim, roots, .. } = self.question(particles)?;
        let actions = self.actions(aim, &roots);
        (actions.len() > 1).then(|| {
            let features = Features::of(&self.task(aim, &actions, &roots));
            Consideration { aim, actions, features }
        })
    }

    /// The subgoal pursued; `None` without particles.
    fn question(&self, particles: &[State]) -> Option<Question> {
        let aims = self.aims(particles);
        let costs: Vec<f64> = particles.iter().map(|particle| self.cost(particle)).collect();
        let proposals = proposals(&aims, &costs);
        let chosen = pursued(&proposals, self.rules.agent)?;
        Some(Question {
            aim: chosen.aim,
            roots: chosen.particles.iter().map(|&k| particles[k]).collect(),
            subgoals: proposals.iter().map(summary).collect(),
        })
    }

    /// The position at which the last decision has left the original's stream of random numbers, as words
    /// drawn; 0 with other random numbers.
    #[must_use]
    pub const fn stream_position(&self) -> u64 {
        self.drawn
    }

    /// Lets the next decision begin at a position of the original's stream, instead of anew: the second
    /// agent's search follows the first one's in the same stream.
    pub const fn begin_at(&mut self, position: u64) {
        self.previous = position;
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

    /// The actions that are compared, in the original's order.
    fn actions(&self, aim: Aim, roots: &[State]) -> Vec<Action> {
        let Rules { agent, layout, hindering, .. } = self.rules;
        let actions = aim.actions(agent, self.parameters.older_actions && hindering, &roots[0]);
        // The original thinks in the layout before reflection.
        let mirrored = layout.flip().is_some();
        actions.iter().map(|&action| if mirrored { action.mirrored() } else { action }).collect()
    }

    fn search(&mut self, aim: Aim, roots: &[State], seed: u64) -> Findings {
        let Rules { agent, physics, .. } = &self.rules;
        let actions = self.actions(aim, roots);
        if let [only] = *actions {
            return Findings { action: only, evaluations: Vec::new(), drawn: 0 };
        }
        let parameters = &self.parameters;
        let actions = &actions;
        let search = Search { agent: *agent, seed, aim, physics, parameters, actions, roots };
        if let Some(known) = self.memo.as_ref().and_then(|memo| memo.recall(&search)) {
            return known;
        }
        let found = self.evaluate(&search);
        if let Some(memo) = &self.memo {
            memo.keep(&search, &found);
        }
        found
    }

    /// Searches as often as the parameters say, and adds up what is found; or asks the network.
    fn evaluate(&self, search: &Search<'_>) -> Findings {
        if self.parameters.network_alone {
            return self.estimate(search);
        }
        match self.parameters.random {
            RandomNumbers::Seeded => self.search_with(search, &mut stream(search.seed, Purpose::Search, 0)),
            RandomNumbers::Original => {
                let mut draws = PythonStream::after(search.seed);
                let found = self.search_with(search, &mut draws);
                Findings { drawn: draws.drawn(), ..found }
            }
        }
    }

    fn task<'a>(&'a self, aim: Aim, actions: &'a [Action], roots: &'a [State]) -> Task<'a> {
        let Self { rules: Rules { agent, rooms, physics, .. }, imagined, parameters, .. } = self;
        Task { agent: *agent, aim, actions, roots, rooms, physics, imagined, parameters }
    }

    /// The findings of a search as the policy network takes them to be.
    fn estimate(&self, search: &Search<'_>) -> Findings {
        let Search { aim, actions, roots, .. } = *search;
        let features = Features::of(&self.task(aim, actions, roots));
        let (policy, value) = PolicyNetwork::bundled().evaluate(&features, actions);
        let visits = |probability: &f64| libm::round(probability * VISITS) as u32;
        let of_action = |(&action, share)| ActionEvaluation { action, visits: visits(share), value };
        let evaluations = actions.iter().zip(&policy).map(of_action).collect();
        let weights: Vec<f64> = policy.iter().map(|p| libm::pow(*p, DECISIVENESS)).collect();
        let sum: f64 = weights.iter().sum();
        if !sum.is_normal() {
            // What is not finite cannot be drawn from.
            return Findings { action: Action::Stop, evaluations, drawn: 0 };
        }
        let mut left = stream(search.seed, Purpose::Search, 0).random_range(0.0..sum);
        let drawn = weights.iter().position(|weight| {
            left -= weight;
            left < 0.0
        });
        let action = drawn.and_then(|drawn| actions.get(drawn)).copied().unwrap_or(Action::Stop);
        Findings { action, evaluations, drawn: 0 }
    }

    fn search_with(&self, search: &Search<'_>, draws: &mut impl Draws) -> Findings {
        let Search { aim, parameters, actions, roots, .. } = *search;
        let task = self.task(aim, actions, roots);
        let nothing = |&action: &Action| ActionEvaluation { action, visits: 0, value: 0.0 };
        let mut evaluations: Vec<ActionEvaluation> = actions.iter().map(nothing).collect();
        let mut action = Action::Stop;
        for _ in 0..parameters.searches.max(1) {
            let found = search::search(&task, draws);
            for evaluation in &mut evaluations {
                let of = found.actions.iter().find(|it| it.0 == evaluation.action);
                if let Some(&(_, visits, value)) = of {
                    add(evaluation, visits, value);
                }
            }
            action = found.chosen;
        }
        if parameters.searches > 1 {
            // Of equally visited actions the better, of equally good ones the first.
            let best = evaluations
                .iter()
                .rev()
                .max_by(|a, b| a.visits.cmp(&b.visits).then_with(|| a.value.total_cmp(&b.value)));
            action = best.map_or(action, |best| best.action);
        }
        Findings { action, evaluations, drawn: 0 }
    }
}

/// Adds what a search found about an action to what others found.
fn add(evaluation: &mut ActionEvaluation, visits: u32, value: f64) {
    let sum = evaluation.value * f64::from(evaluation.visits) + value * f64::from(visits);
    evaluation.visits += visits;
    if evaluation.visits > 0 {
        evaluation.value = sum / f64::from(evaluation.visits);
    }
}

fn summary(proposal: &Proposal) -> SubgoalValue {
    let subgoal: Subgoal = proposal.aim.subgoal();
    SubgoalValue { subgoal, value: proposal.value, particles: proposal.particles.len() }
}

/// The dynamics that a mind with these parameters imagines.
pub(crate) fn imagined(physics: &PhysicsConfig, parameters: &PublishedParameters) -> Imagined {
    let mut imagined = Imagined::new(physics);
    if !parameters.collisions {
        imagined = imagined.without_collisions();
    }
    if parameters.strongest_coasts { imagined.with_coasting_strongest() } else { imagined }
}
