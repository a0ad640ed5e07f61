//! The options of `train`.

use crate::output::Output;
use clap::{Args, Subcommand, value_parser};
use phase_model::setting::{EVENTS, ROUNDS};
#[cfg(feature = "networks")]
use phase_runs::train::{Trainee, Training};
use std::path::PathBuf;

/// Network or model to train.
#[derive(Subcommand, Debug)]
pub enum Train {
    /// The strength regressor of SIMPLE
    Strength(Options),
    /// The intent network of SIMPLE: a guess at goals and attitudes from motion alone
    IntentNetwork(NetworkOptions),
    /// The policy network of our own minds: what a search would choose, learnt from the searches of events
    Policy(NetworkOptions),
    /// The policy network of published minds, with searches of 1000 simulations in the states of any events
    PublishedPolicy(NetworkOptions),
    /// A baseline for beliefs: in which room each agent believes what it does not see
    BeliefNetwork(NetworkOptions),
    /// 2-Level LSTM, a baseline for goals and relations
    TwoLevelLstm(NetworkOptions),
    /// Actor relation graph, a baseline for goals and relations
    Arg(NetworkOptions),
    /// SocialGNN, a baseline for relations
    #[command(name = "socialgnn")]
    SocialGnn(NetworkOptions),
    /// Social-LSTM, a baseline for trajectories
    SocialLstm(NetworkOptions),
    /// Spatial-temporal graph attention, a baseline for trajectories
    Stgat(NetworkOptions),
}

/// Datasets and output.
#[derive(Args, Debug)]
pub struct Options {
    /// Folder of a finished dataset that is divided into train, validation and test
    #[arg(long, value_name = "DIR")]
    pub data: PathBuf,
    /// Also train on these: the training events of other datasets, and all events of folders of `simulate`
    #[arg(long, value_name = "DIR", num_args = 1..)]
    pub more: Vec<PathBuf>,
    /// Train on the first N training events of --data only, 1 to 1000000
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(EVENTS.bounds()))]
    pub events: Option<u32>,
    /// Folder of the dataset for validation and testing; by default the one for training
    #[arg(long, value_name = "DIR")]
    pub validation: Option<PathBuf>,
    /// File for the weights (safetensors)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Random seed of the training
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Also evaluate the final weights on the test events
    #[arg(long)]
    pub test: bool,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Datasets and output, with the maximum duration.
#[derive(Args, Debug)]
pub struct NetworkOptions {
    /// Datasets and output.
    #[command(flatten)]
    pub options: Options,
    /// Maximum number of rounds, 1 to 1000000
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(ROUNDS.bounds()))]
    pub rounds: Option<u32>,
}

#[cfg(feature = "networks")]
impl Train {
    /// Datasets and output.
    pub(super) const fn options(&self) -> &Options {
        self.parts().1
    }

    /// The network, datasets and output, and the maximum number of rounds.
    const fn parts(&self) -> (Trainee, &Options, Option<u32>) {
        match self {
            Self::Strength(options) => (Trainee::Strength, options, None),
            Self::IntentNetwork(it) => (Trainee::IntentNetwork, &it.options, it.rounds),
            Self::Policy(it) => (Trainee::Policy, &it.options, it.rounds),
            Self::PublishedPolicy(it) => (Trainee::PublishedPolicy, &it.options, it.rounds),
            Self::BeliefNetwork(it) => (Trainee::Beliefs, &it.options, it.rounds),
            Self::TwoLevelLstm(it) => (Trainee::TwoLevelLstm, &it.options, it.rounds),
            Self::Arg(it) => (Trainee::Arg, &it.options, it.rounds),
            Self::SocialGnn(it) => (Trainee::SocialGnn, &it.options, it.rounds),
            Self::SocialLstm(it) => (Trainee::SocialLstm, &it.options, it.rounds),
            Self::Stgat(it) => (Trainee::Stgat, &it.options, it.rounds),
        }
    }
}

#[cfg(feature = "networks")]
impl From<&Train> for Training {
    fn from(train: &Train) -> Self {
        let (trainee, options, rounds) = train.parts();
        Self {
            trainee,
            data: options.data.clone(),
            more: options.more.clone(),
            events: options.events.map(|events| events as usize),
            validation: options.validation.clone(),
            out: options.out.clone(),
            seed: options.seed,
            test: options.test,
            rounds: rounds.map(|rounds| rounds as usize),
        }
    }
}
