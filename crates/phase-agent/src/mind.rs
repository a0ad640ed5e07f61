//! Particles to subgoal to action: what an agent of Algorithm 1 does with a belief, wherever that comes from.

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

/// One agent's goals and planners. The dynamics are its own model of the world. What it believes is shown to it at
/// every decision, so that it can also think on behalf of somebody whose beliefs are estimated.
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

/// What a decision rests on.
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
    /// # Errors
    /// Settings that cannot be searched with.
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

    /// How it imagines the world to move.
    pub const fn dynamics(&self) -> &D {
        &self.dynamics
    }

    /// Decides what to do next, and says why.
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

    /// One plan for each different particle, and which plan belongs to each particle. Once everything is in
    /// view all particles are the same world, and planning once is enough.
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

    /// The particles to search an action in. If the subgoal is to get to something unseen, these are the ones
    /// that put it near where the shortest plan has it: one looks in one place after the other. Drawn to all
    /// places at once, one would turn to and fro between them and never see any.
    fn attended(&self, outlook: Outlook<'_>, candidate: &Candidate, plans: &[&Plan]) -> Vec<usize> {
        /// Greatest distance between places that are looked at together (u).
        const TOGETHER: f32 = 3.0;
        let all = &candidate.particles;
        let Some(unseen) = self.unseen(outlook, candidate.subgoal) else { return all.clone() };
        let shortest = all.iter().min_by(|&&a, &&b| plans[a].distance.total_cmp(&plans[b].distance));
        let Some(&first) = shortest else { return all.clone() };
        let place = |particle: usize| outlook.particles[particle].position(unseen);
        let near = |&&particle: &&usize| place(particle).distance(place(first)) <= TOGETHER;
        // A place that is not a number is near nothing, not even itself.
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
        // Whoever hinders has nothing to gain by making room.
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
        // Where all particles are the same world, one of them says it all, and the search need not redo its steps.
        let different = if roots.iter().all(|root| root == &roots[0]) { &roots[..1] } else { roots };
        let imagined: Vec<Imagined> =
            different.iter().map(|&state| Imagined::new(&model.objective, state)).collect();
        // A generator of its own for every decision: how long a search takes changes nothing that comes later.
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

/// Entities that all particles believe to be in the same place. Nobody need go and look whether an object lies
/// where it has just been put.
fn known_places(physique: &Physique, particles: &[State]) -> BodySet {
    /// Greatest distance between places that count as the same (u).
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
