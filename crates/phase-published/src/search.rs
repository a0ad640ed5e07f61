//! The low level's model of the world for POMCP: the subgoal's distance as reward, and another agent that
//! coasts in the tree and does anything in rollouts.

use crate::{aim::Aim, rooms::Rooms};
use phase_forward::Forward;
use phase_model::{AGENT_COUNT, Action, AgentId, Dynamics, State};
use phase_pomcp::{GenerativeModel, Transition};
use rand::{Rng, RngExt};

/// The model that the search samples from.
#[derive(Debug)]
pub(crate) struct SearchModel<'a> {
    pub(crate) agent: AgentId,
    pub(crate) aim: Aim,
    pub(crate) actions: &'static [Action],
    pub(crate) rooms: &'a Rooms,
    pub(crate) imagined: &'a Forward,
    pub(crate) discount: f64,
}

impl SearchModel<'_> {
    fn advance(&self, state: &mut State, own: Action, others: Action) {
        let mut actions = [others; AGENT_COUNT];
        actions[self.agent] = own;
        self.imagined.step(state, actions);
    }
}

impl GenerativeModel for SearchModel<'_> {
    type State = State;
    /// Nothing is observed in the tree, whose nodes branch on actions alone.
    type Observation = ();

    fn action_count(&self) -> usize {
        self.actions.len()
    }

    fn discount(&self) -> f64 {
        self.discount
    }

    /// In the tree the other coasts, and the state that an action leads to is rewarded.
    fn step(&self, state: &mut State, action: usize, _random: &mut impl Rng) -> Transition<()> {
        let action = self.actions[action];
        self.advance(state, action, Action::NoForce);
        let reward = self.aim.reward(self.rooms, state, action);
        Transition { observation: (), reward, terminal: false }
    }

    /// In rollouts the other does anything from the same set of actions, and the state that an action is
    /// taken in is rewarded.
    fn rollout_step(&self, state: &mut State, action: usize, random: &mut impl Rng) -> Transition<()> {
        let action = self.actions[action];
        let reward = self.aim.reward(self.rooms, state, action);
        self.advance(state, action, self.actions[random.random_range(0..self.actions.len())]);
        Transition { observation: (), reward, terminal: false }
    }

    fn is_deterministic(&self) -> bool {
        true
    }
}
