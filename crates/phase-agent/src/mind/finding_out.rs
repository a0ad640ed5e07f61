//! A mind that does not know the other's: what it keeps from one decision to the next, and watching.

use super::Mind;
use crate::{
    Prior,
    ascription::TheoryParameters,
    ignorance::Ignorance,
    matter::Matter,
    suspicion::Suspicion,
    theory::{self, Supposition},
    view::BeliefView,
};
use phase_event::SubgoalValue;
use phase_model::{
    Action, Attitude, BodySet, Dynamics, Entity, Level, Literal, ObjectId, PhysicsConfig, Predicate,
    PredicateTarget, State, Strength, Subgoal,
};
use phase_planner::{Plan, Planner};
use std::collections::BTreeMap;

impl<D: Dynamics> Mind<D> {
    /// This mind without knowledge of the other's, about which it reasons at a level. `dynamics` makes a
    /// model of the world for bodies and walls.
    #[must_use]
    pub fn ignorant(mut self, level: Level, mut dynamics: impl FnMut(&PhysicsConfig) -> D) -> Self {
        let world = |strength| {
            let physics = theory::with_strength(self.physics.clone(), self.agent.other(), strength);
            let dynamics = dynamics(&physics);
            (physics, dynamics)
        };
        let worlds = Strength::ALL.into_iter().map(world).collect();
        let theory = TheoryParameters::default();
        // A policy that is not searched for cannot weigh what it gives away.
        let searches = self.parameters.prior != Prior::NetworkAlone;
        if level == Level::Two && self.attitude == Attitude::Hinder && searches {
            let (layout, planning) = (self.navigator.map().layout(), self.parameters.planning());
            self.suspicion = Some(Suspicion::new(self.agent, &self.physics, layout, planning, theory));
        }
        self.ignorance = Some(Ignorance { level, theory, worlds, planners: BTreeMap::new(), watched: 0 });
        self
    }

    /// Sets the steps that an agent without knowledge of the other's goal has watched, less those of acting.
    /// It forgets what it took the other to suspect: who decides out of turn has no past.
    pub fn has_watched(&mut self, steps: u32) {
        self.ignorance.iter_mut().for_each(|ignorance| ignorance.watched = steps);
        self.suspicion.iter_mut().for_each(Suspicion::forget);
    }

    /// Goes through a decision that was made before, without its search. Afterwards the mind remembers as
    /// much as after [`decide`](Self::decide).
    pub fn relive(&mut self, belief_view: BeliefView<'_>) {
        if self.ignorance.is_none() {
            return;
        }
        if let Some(suspicion) = &mut self.suspicion {
            suspicion.learn(belief_view.particles, belief_view.last_action);
        }
        if let Matter::Search(question) = self.question(belief_view)
            && question.actions.len() > 1
            && self.suspicion.is_some()
        {
            self.with_model(belief_view, &question, |_, _, _| ());
        }
    }

    /// Keeps the other in view, or goes where it may be.
    pub(super) fn watch(&self, belief_view: BeliefView<'_>, subgoals: Vec<SubgoalValue>) -> Matter {
        let other = Entity::Agent(self.agent.other());
        let me = Entity::Agent(self.agent);
        let particles = belief_view.particles;
        if belief_view.observed.contains(other) {
            let state = &particles[0];
            let body = state.body(me);
            let way = state.position(other) - body.position;
            let bearing = libm::atan2f(body.forward().perp_dot(way), body.forward().dot(way));
            let angle = self.ignorance.as_ref().map_or(0.0, |ignorance| ignorance.theory.watching_angle);
            let action = match bearing {
                bearing if bearing > angle => Action::TurnLeft,
                bearing if bearing < -angle => Action::TurnRight,
                _ => Action::Stop,
            };
            return Matter::Watch(action, subgoals);
        }
        let close = Predicate::Close(me, PredicateTarget::Entity(other));
        // One place after another, as for any body out of sight: the nearest first.
        let distance = |k: &usize| particles[*k].position(me).distance(particles[*k].position(other));
        let nearest = (0..particles.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(nearest) = nearest else { return Matter::Watch(Action::Stop, subgoals) };
        let place = particles[nearest].position(other);
        let near = |k: &usize| particles[*k].position(other).distance(place) <= self.parameters.colocation;
        let mut chosen: Vec<usize> = (0..particles.len()).filter(near).collect();
        if chosen.is_empty() {
            chosen.push(nearest);
        }
        let subgoal = Subgoal::Achieve(Literal::is(close));
        Matter::Search(self.search_for(belief_view, subgoal, subgoals, Vec::new(), chosen))
    }

    /// The plan from a particle.
    pub(super) fn plan(
        &mut self,
        particle: &State,
        supposition: Option<&Supposition>,
        known: BodySet,
        ceded: Option<ObjectId>,
    ) -> Plan {
        let (Some(ignorance), Some(supposition)) = (&mut self.ignorance, supposition) else {
            return self.planner.plan_ceding(particle, known, ceded);
        };
        let planner = ignorance.planners.entry(*supposition).or_insert_with(|| {
            let (physics, _) = &ignorance.worlds[usize::from(supposition.strength.level())];
            let goals = theory::goals(self.agent, self.attitude, self.goals[self.agent], supposition.intent);
            Planner::with_parameters(
                physics.clone(),
                self.navigator.map().layout(),
                self.agent,
                goals,
                self.attitude,
                self.parameters.planning(),
            )
        });
        planner.plan_ceding(particle, known, ceded)
    }
}
