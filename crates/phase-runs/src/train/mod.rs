//! Training of neural networks on datasets, round by round, so that the same training goes on after an
//! interruption.

mod events;
mod network;
mod strength;
mod training_files;

use crate::{
    error::{RunError, train::TrainError},
    eval::TrueBeliefs,
    listener::Listener,
};
use phase_baselines::{
    arg::Arg,
    belief_network::{self, BeliefNetwork, LabelledBeliefs},
    forecasting,
    intent_network::{self, IntentNetwork, LabelledIntents},
    nodes::Nodes,
    policy::{self, Decisions, OurMinds, PolicyNetwork, PublishedMinds, Searchers},
    recognition::{self, LabelledEvent},
    social_gnn::{self, SocialGnn},
    social_lstm::SocialLstm,
    stgat::Stgat,
    two_level_lstm::TwoLevelLstm,
};
use phase_event::{BeliefOrder, ObservedEvent, Recording};
use phase_sim::SimulationSettings;
use serde_json::Value;
use std::path::PathBuf;

/// A network that can be trained.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Trainee {
    /// The strength regressor of SIMPLE.
    Strength,
    /// The intent network of SIMPLE: a guess at goals and attitudes from motion alone.
    IntentNetwork,
    /// The policy network of our own minds: what a search would choose.
    Policy,
    /// The policy network of published minds.
    PublishedPolicy,
    /// The belief network: where agents believe entities to be.
    Beliefs,
    /// 2-Level LSTM, for goals and relations.
    TwoLevelLstm,
    /// Actor relation graph, for goals and relations.
    Arg,
    /// SocialGNN, for relations.
    SocialGnn,
    /// Social-LSTM, for trajectories.
    SocialLstm,
    /// Spatial-temporal graph attention, for trajectories.
    Stgat,
}

/// A training of a network on the training events of datasets.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Training {
    /// The network.
    pub trainee: Trainee,
    /// Folder of a finished dataset that is divided into train, validation and test.
    pub data: PathBuf,
    /// Folders with further training events: other datasets, and simulations, of which all events are taken.
    pub more: Vec<PathBuf>,
    /// Only so many of the first training events of `data`, at least 1.
    pub events: Option<usize>,
    /// Folder of the dataset for validation and testing; without it `data`.
    pub validation: Option<PathBuf>,
    /// File for the weights (safetensors).
    pub out: PathBuf,
    /// Random seed of the training.
    pub seed: u64,
    /// Whether to evaluate the final weights on the test events, too.
    pub test: bool,
    /// Maximum number of rounds, at least 1; the strength regressor has none.
    pub rounds: Option<usize>,
}

/// A network that is trained; its weights are in their file.
#[derive(Clone, PartialEq, Debug)]
pub struct Trained {
    /// Its figures as a table in Markdown.
    pub text: String,
    /// Its figures for programs.
    pub figures: Value,
}

impl Training {
    /// Trains the network, or goes on with what an interrupted training has left.
    ///
    /// # Errors
    /// If a dataset cannot be used, training fails or a file cannot be written.
    pub fn run(&self, listener: &dyn Listener) -> Result<Trained, RunError> {
        let nodes = |_: &Recording, observed: &ObservedEvent| Ok(Nodes::of(observed));
        match self.trainee {
            Trainee::Strength => strength::run(self, listener),
            Trainee::IntentNetwork => {
                network::run::<IntentNetwork>(self, listener, intent_network::SETTINGS, intents)
            }
            Trainee::Policy => self.policy::<OurMinds>(listener),
            Trainee::PublishedPolicy => self.policy::<PublishedMinds>(listener),
            Trainee::Beliefs => {
                network::run::<BeliefNetwork>(self, listener, belief_network::SETTINGS, beliefs)
            }
            Trainee::TwoLevelLstm => {
                network::run::<TwoLevelLstm>(self, listener, recognition::SETTINGS, labelled)
            }
            Trainee::Arg => network::run::<Arg>(self, listener, recognition::SETTINGS, labelled),
            Trainee::SocialGnn => network::run::<SocialGnn>(self, listener, social_gnn::SETTINGS, labelled),
            Trainee::SocialLstm => network::run::<SocialLstm>(self, listener, forecasting::SETTINGS, nodes),
            Trainee::Stgat => network::run::<Stgat>(self, listener, forecasting::SETTINGS, nodes),
        }
    }

    fn policy<M: Searchers>(&self, listener: &dyn Listener) -> Result<Trained, RunError> {
        network::run::<PolicyNetwork<M>>(self, listener, policy::SETTINGS, decisions::<M>)
    }
}

fn intents(recording: &Recording, observed: &ObservedEvent) -> Result<LabelledIntents, TrainError> {
    LabelledIntents::new(observed, recording.scene.goals(), recording.scene.attitudes())
        .map_err(|source| TrainError::Hypothesis { id: recording.id.clone(), source })
}

fn beliefs(recording: &Recording, observed: &ObservedEvent) -> Result<LabelledBeliefs, TrainError> {
    let steps: Vec<usize> = (0..observed.rows().len()).collect();
    let truth = TrueBeliefs::of(recording, BeliefOrder::First, &steps)
        .map_err(|source| TrainError::Beliefs { id: recording.id.clone(), source })?;
    Ok(LabelledBeliefs::new(observed, truth.beliefs()))
}

fn decisions<M: Searchers>(recording: &Recording, observed: &ObservedEvent) -> Result<Decisions, TrainError> {
    let id = || recording.id.clone();
    let simulation = recording.simulation.as_ref().ok_or_else(|| TrainError::NoThoughts { id: id() })?;
    let settings = SimulationSettings::read(&simulation.settings, "settings")
        .map_err(|source| TrainError::Settings { id: id(), source })?;
    let parameters = M::parameters(&settings.minds).ok_or_else(|| TrainError::NoThoughts { id: id() })?;
    Decisions::of::<M>(&simulation.event, observed, &parameters)
        .map_err(|source| TrainError::Search { id: id(), source })
}

fn labelled(recording: &Recording, observed: &ObservedEvent) -> Result<LabelledEvent, TrainError> {
    LabelledEvent::new(observed, recording.scene.goals(), recording.relation)
        .map_err(|source| TrainError::Label { id: recording.id.clone(), source })
}
