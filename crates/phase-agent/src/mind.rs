//! The decision step of Algorithm 1: from particles to subgoal to action, for a given belief.

use crate::{
    Settings,
    imagination::{Imagination, Imagined},
    objective::Objective,
    patience::Patience,
    repertoire,
};
use phase_event::{ActionValue, SubgoalValue, Thought};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, BodySet, Dynamics, Entity, Goal, Literal, Physique, Place,
    Predicate, Scene, State, Subgoal,
    random::{Purpose, stream},
};
use phase_planner::{Candidate, Plan, Planner, value};
use phase_pomcp::{Pomcp, PomcpError, PomcpSettings};
use rand::Rng;

/// One agent's goals and planners, with its own model of the dynamics. The belief is an argument of every
/// decision, so inference can use a mind with estimated beliefs.
#[derive(Debug)]
pub struct Mind<D> {
    agent: AgentId,
    physique: Physique,
    goals: [Goal; AGENT_COUNT],
    attitude: Attitude,
    settings: Settings,
    dynamics: D,
    planner: Planner,
    pomcp: Pomcp<u16>,
    patience: Patience,
}

/// The belief state that a decision is based on.
#[derive(Clone, Copy, Debug)]
pub struct Outlook<'a> {
    /// Possible states of the world, all equally likely; at least one.
    pub particles: &'a [State],
    /// The entities that the agent observes now, itself included.
    pub observed: BodySet,
}

impl<D: Dynamics> Mind<D> {
    /// The mind of an agent of a scene.
    ///
    /// # Errors Invalid search parameters.
    pub fn new(scene: &Scene, agent: AgentId, dynamics: D, settings: Settings) -> Result<Self, PomcpError> {
        let physique = scene.physique();
        let pomcp = Pomcp::new(PomcpSettings {
            simulations: settings.simulations,
            rollout_steps: settings.rollout_steps,
            c_init: settings.c_init,
            c_base: settings.c_base,
            stop_when_decided: true,
            ..PomcpSettings::default()
        })?;
        let attitude = scene.agents[agent].attitude;
        Ok(Self {
            agent,
            goals: scene.goals(),
            attitude,
            settings,
            dynamics,
            planner: Planner::new(physique.clone(), scene.layout, agent, scene.goals(), attitude),
            pomcp,
            patience: Patience::default(),
            physique,
        })
    }

    /// Its model of the dynamics.
    pub const fn dynamics(&self) -> &D {
        &self.dynamics
    }

    /// Chooses the next action; returns it with its explanation.
    ///
    /// # Errors
    /// As POMCP's search.
    pub fn decide(
        &mut self,
        outlook: Outlook<'_>,
        random: &mut impl Rng,
    ) -> Result<(Action, Thought), PomcpError> {
        let particles = outlook.particles;
        let known = outlook.observed.union(known_places(&self.physique, particles));
        let (plans, plan_of) = self.plans(particles, known);
        let by_particle: Vec<&Plan> = plan_of.iter().map(|&plan| &plans[plan]).collect();
        let candidates = value::candidates(&by_particle, self.settings.lambda);
        let Some(best) = candidates.first() else {
            return Ok((Action::Stop, Thought::IDLE));
        };
        let attended = self.attended(outlook, best, &by_particle);
        let roots: Vec<State> = attended.iter().map(|&particle| particles[particle]).collect();
        let plan = by_particle[attended[0]].subgoals.clone();
        let subgoal = best.subgoal;
        let (action, actions) = self.search(outlook, subgoal, &roots, random)?;
        let subgoals = candidates.iter().map(summary).collect();
        Ok((action, Thought { subgoal, subgoals, plan, actions }))
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
    fn attended(&self, outlook: Outlook<'_>, candidate: &Candidate, plans: &[&Plan]) -> Vec<usize> {
        /// Maximum distance between target positions that are searched together (u).
        const TOGETHER: f32 = 3.0;
        let all = &candidate.particles;
        let Some(unseen) = self.unseen(outlook, candidate.subgoal) else { return all.clone() };
        let shortest = all.iter().min_by(|&&a, &&b| plans[a].distance.total_cmp(&plans[b].distance));
        let Some(&first) = shortest else { return all.clone() };
        let place = |particle: usize| outlook.particles[particle].position(unseen);
        let near = |&&particle: &&usize| place(particle).distance(place(first)) <= TOGETHER;
        // A NaN position is near nothing, not even itself.
        let mut attended: Vec<usize> = all.iter().filter(near).copied().collect();
        if attended.is_empty() {
            attended.push(first);
        }
        attended
    }

    /// The entity that a subgoal sends the agent to, if it does not see it.
    fn unseen(&self, outlook: Outlook<'_>, subgoal: Subgoal) -> Option<Entity> {
        sought(subgoal, self.agent).filter(|&entity| !outlook.observed.contains(entity))
    }

    /// LP(B̃, h*) of Algorithm 1: the best action for a subgoal in the worlds that agree on it.
    fn search(
        &mut self,
        outlook: Outlook<'_>,
        subgoal: Subgoal,
        roots: &[State],
        random: &mut impl Rng,
    ) -> Result<(Action, Vec<ActionValue>), PomcpError> {
        let routes = self.planner.routes();
        let objective =
            Objective { physique: &self.physique, routes, agent: self.agent, subgoal, retreat: None };
        // A hinderer does not back off: being in the way is its purpose.
        let retreat = match self.attitude {
            Attitude::Hinder => None,
            _ => self.patience.lose(&objective, &roots[0], random),
        };
        let actions = repertoire::actions(self.agent, subgoal, &roots[0], retreat.is_some());
        if let [only] = actions {
            return Ok((*only, Vec::new()));
        }
        let model = Imagination {
            dynamics: &self.dynamics,
            objective: Objective { retreat, ..objective },
            other_objective: Imagination::<D>::other(&self.physique, routes, self.agent, self.goals),
            actions,
            goals: self.goals,
            goals_count: !matches!(self.unseen(outlook, subgoal), Some(Entity::Object(_))),
            attitude: self.attitude,
            discount: self.settings.discount,
            guidance: self.settings.guidance,
            foresight: self.settings.foresight,
        };
        // If all particles are equal, one root suffices and the search can cache its transitions.
        let different = if roots.iter().all(|root| root == &roots[0]) { &roots[..1] } else { roots };
        let imagined: Vec<Imagined> =
            different.iter().map(|&state| Imagined::new(&model.objective, state)).collect();
        // Each decision has its own generator, so the length of a search does not affect later decisions.
        let mut random = stream(random.next_u64(), Purpose::Search, 0);
        let decision = self.pomcp.search(&model, &imagined, &mut random)?;
        let evidence = actions
            .iter()
            .zip(&decision.actions)
            .map(|(&action, found)| ActionValue { action, visits: found.visits as u32, value: found.value })
            .collect();
        Ok((actions[decision.action], evidence))
    }
}

/// The entity that a subgoal sends an agent to.
fn sought(subgoal: Subgoal, agent: AgentId) -> Option<Entity> {
    let Subgoal::Achieve(Literal { predicate, holds: true }) = subgoal else { return None };
    match predicate {
        Predicate::Close(who, Place::Entity(entity)) if who == Entity::Agent(agent) => Some(entity),
        Predicate::Touch(_, entity) => Some(entity),
        Predicate::Attach(_, object) => Some(Entity::Object(object)),
        _ => None,
    }
}

fn summary(candidate: &Candidate) -> SubgoalValue {
    SubgoalValue { subgoal: candidate.subgoal, value: candidate.value, particles: candidate.particles.len() }
}

/// Entities on whose position all particles agree. An agent need not verify the position of an object it has
/// just put down.
fn known_places(physique: &Physique, particles: &[State]) -> BodySet {
    /// Maximum distance between positions that count as equal (u).
    const SAME: f32 = 0.5;
    let mut known = BodySet::EMPTY;
    let Some(first) = particles.first() else { return known };
    for entity in physique.entities() {
        let place = first.position(entity);
        if particles.iter().all(|particle| particle.position(entity).distance(place) <= SAME) {
            known.insert(entity);
        }
    }
    known
}
