//! Evaluation of how well a method perceives events.
//!
//! [`methods`] knows the methods by name, `task` asks one of them event by event and stores its answers, so
//! that a run can be interrupted; `shards` divides it among machines; `goals` and `trajectories` are the two
//! tasks of the paper, `beliefs` is about where agents believe entities to be, `intents` about what they take
//! each other to want, `answers` has also those of an external method.

pub(crate) mod answers;
mod beliefs;
pub mod compare;
pub(crate) mod goals;
pub(crate) mod input;
mod intents;
pub mod methods;
pub mod networks;
pub(crate) mod ratings;
pub(crate) mod scored;
mod shards;
pub(crate) mod task;
pub(crate) mod trajectories;
mod unlabelled;

pub use beliefs::TrueBeliefs;
pub use intents::TrueIntents;
pub use task::{Evaluated, REPORT_FILE};
pub use unlabelled::Answered;

use crate::{effort::MindChoice, error::RunError, listener::Listener};
use beliefs::BeliefTask;
use goals::Goals;
use input::Input;
use intents::IntentTask;
use phase_dataset::splits::Split;
use phase_eval::{
    beliefs::BeliefEvent, goals::RecognisedEvent, intents::IntentEvent, trajectories::ForecastEvent,
};
use phase_event::BeliefOrder;
use ratings::Ratings;
use std::{collections::BTreeMap, path::PathBuf};
use trajectories::Trajectories;

/// An evaluation of a method on the events of a file or dataset.
///
/// Answers are stored as they are computed: interrupted, the same evaluation goes on from what is finished.
/// Results do not depend on threads and shards.
#[derive(Clone, PartialEq, Debug)]
pub struct Evaluation {
    /// A file in the format `phase-events/1`, or the folder of a dataset or of simulations.
    pub events: PathBuf,
    /// Only this part of a dataset.
    pub split: Option<Split>,
    /// Only so many of the first events, at least 1.
    pub limit: Option<usize>,
    /// Random seed of the method and of intervals.
    pub seed: u64,
    /// Folder for results and report: new, empty, or of the same evaluation; without it one below `out/eval`.
    pub out: Option<PathBuf>,
    /// Of goals, also ask the method after these numbers of seconds of each event (multiples of 0.25).
    pub watched: Vec<f64>,
    /// Of goals, how people rated the relations of the events (`phase-ratings/1`).
    pub ratings: Option<PathBuf>,
    /// The part of the events to ask about, from 1, and the number of parts; without it all.
    pub shard: Option<(usize, usize)>,
    /// Folders of all parts, to take the answers from instead of asking the method.
    pub merge: Vec<PathBuf>,
    /// Number of threads; without it that of this machine's cores.
    pub threads: Option<usize>,
    /// The names that answers give to events, by those of the dataset; other events have their own.
    pub names: BTreeMap<String, String>,
}

/// The source of the answers that are evaluated.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Answers {
    /// One of PHASE's methods.
    Method {
        /// Its name, see [`methods`].
        name: String,
        /// The weights of a neural network, if not the bundled ones.
        weights: Option<PathBuf>,
        /// The minds that SIMPLE imagines.
        minds: MindChoice,
    },
    /// A file with the answers of an external method.
    Predictions(PathBuf),
}

impl Answers {
    /// One of PHASE's methods as it is, by its name.
    #[must_use]
    pub fn of_method(name: impl Into<String>) -> Self {
        Self::Method { name: name.into(), weights: None, minds: MindChoice::default() }
    }
}

impl Evaluation {
    /// An evaluation on all events of a file or folder, with seed 1, on all cores.
    #[must_use]
    pub fn new(events: impl Into<PathBuf>) -> Self {
        Self {
            events: events.into(),
            split: None,
            limit: None,
            seed: 1,
            out: None,
            watched: Vec::new(),
            ratings: None,
            shard: None,
            merge: Vec::new(),
            threads: None,
            names: BTreeMap::new(),
        }
    }

    /// Evaluates goals and relations, Task 1 of the paper; `None` if that is only a part, which is now done.
    ///
    /// # Errors
    /// If the events, the answers or the folder cannot be used, the method has no answer, a file cannot be
    /// written, or a stop was requested.
    pub fn goals(
        &self,
        answers: &Answers,
        listener: &dyn Listener,
    ) -> Result<Option<Evaluated<RecognisedEvent>>, RunError> {
        let input = Input::open(self, listener)?;
        let ratings =
            self.ratings.as_deref().map(|file| Ratings::read(file, &[&input], listener)).transpose()?;
        let mut watched = self.watched.clone();
        watched.sort_by(f64::total_cmp);
        watched.dedup();
        let goals = Goals::of(answers, &input, listener)?.with_watched(watched).with_ratings(ratings);
        task::evaluate(&goals, &input, self, listener)
    }

    /// Evaluates predicted trajectories, Task 2 of the paper; `None` if that is only a part, which is now
    /// done.
    ///
    /// # Errors
    /// Those of [`Evaluation::goals`].
    pub fn trajectories(
        &self,
        answers: &Answers,
        listener: &dyn Listener,
    ) -> Result<Option<Evaluated<ForecastEvent>>, RunError> {
        let input = Input::open(self, listener)?;
        let trajectories = Trajectories::of(answers, &input, listener)?;
        task::evaluate(&trajectories, &input, self, listener)
    }

    /// Evaluates where a method says that agents believe entities to be, or believe each other to believe
    /// them, in simulated events; `None` if that is only a part, which is now done.
    ///
    /// # Errors
    /// Those of [`Evaluation::goals`], and for a file of predictions or an event that was not simulated.
    pub fn beliefs(
        &self,
        answers: &Answers,
        order: BeliefOrder,
        listener: &dyn Listener,
    ) -> Result<Option<Evaluated<BeliefEvent>>, RunError> {
        let input = Input::open(self, listener)?;
        task::evaluate(&BeliefTask::of(answers, order)?, &input, self, listener)
    }

    /// Evaluates what a method says that agents take each other to want, in simulated events of agents that
    /// do not know it; `None` if that is only a part, which is now done.
    ///
    /// # Errors
    /// Those of [`Evaluation::beliefs`].
    pub fn intents(
        &self,
        answers: &Answers,
        listener: &dyn Listener,
    ) -> Result<Option<Evaluated<IntentEvent>>, RunError> {
        let input = Input::open(self, listener)?;
        task::evaluate(&IntentTask::of(answers)?, &input, self, listener)
    }
}
