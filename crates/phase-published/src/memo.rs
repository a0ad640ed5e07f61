//! The findings of searches, kept for other minds that would search for the same.
//!
//! Many intents lead to one subgoal: an agent that wants an object out of its sight looks for it, wherever it
//! is to go. An inference lets minds with every intent decide in the same states with the same random
//! numbers, so most of their searches are one search.

use crate::{aim::Aim, parameters::PublishedParameters};
use phase_event::ActionEvaluation;
use phase_model::{Action, AgentId, PhysicsConfig, State};
use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

/// The searches of the minds that share it. A mind with it decides exactly as it would without. It grows with
/// the number of different searches, so it should live no longer than the event that they are about.
#[derive(Clone, Default, Debug)]
pub struct SearchMemo(Arc<Mutex<Entries>>);

/// Searches by what tells them apart at a glance.
type Entries = BTreeMap<(AgentId, u64, Aim), Vec<Entry>>;

/// Everything that determines a search besides the agent, the random numbers and the subgoal, and what was
/// found.
#[derive(Debug)]
struct Entry {
    physics: PhysicsConfig,
    parameters: PublishedParameters,
    actions: Vec<Action>,
    roots: Vec<State>,
    found: Findings,
}

/// A search that is to be done.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<'a> {
    pub(crate) agent: AgentId,
    /// The seed of its random numbers, or how many words of the original's stream were drawn before.
    pub(crate) seed: u64,
    pub(crate) aim: Aim,
    pub(crate) physics: &'a PhysicsConfig,
    pub(crate) parameters: &'a PublishedParameters,
    pub(crate) actions: &'a [Action],
    pub(crate) roots: &'a [State],
}

/// The result of the searches of one decision.
#[derive(Clone, Debug)]
pub(crate) struct Findings {
    pub(crate) action: Action,
    pub(crate) evaluations: Vec<ActionEvaluation>,
    /// Words of the original's stream drawn until then; 0 with other random numbers.
    pub(crate) drawn: u64,
}

impl Search<'_> {
    const fn key(&self) -> (AgentId, u64, Aim) {
        (self.agent, self.seed, self.aim)
    }

    fn is(&self, entry: &Entry) -> bool {
        entry.actions == self.actions
            && entry.roots == self.roots
            && entry.parameters == *self.parameters
            && entry.physics == *self.physics
    }
}

impl SearchMemo {
    /// The findings of this search, if it was done before.
    pub(crate) fn recall(&self, search: &Search<'_>) -> Option<Findings> {
        // Entries are only ever added whole, so those of a thread that panicked are sound.
        let entries = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let entry = entries.get(&search.key())?.iter().find(|entry| search.is(entry))?;
        Some(entry.found.clone())
    }

    /// Keeps what a search has found.
    pub(crate) fn keep(&self, search: &Search<'_>, found: &Findings) {
        let entry = Entry {
            physics: search.physics.clone(),
            parameters: *search.parameters,
            actions: search.actions.to_vec(),
            roots: search.roots.to_vec(),
            found: found.clone(),
        };
        let mut entries = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        entries.entry(search.key()).or_default().push(entry);
    }
}
