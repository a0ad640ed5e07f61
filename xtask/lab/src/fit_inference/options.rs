//! The options of `fit-inference`.

use crate::fit_events::FitEvents;
use clap::{Args, value_parser};
use phase_cli::named::named;
use phase_minds::MindKind;
use std::path::PathBuf;

/// Options of `fit-inference`.
#[derive(Args, Debug)]
pub struct FitInference {
    /// Events, seed and result.
    #[command(flatten)]
    pub events: FitEvents,
    /// The weights of one kind of minds alone: `phase`, or `published`, those of the published simulator
    /// [default: both kinds, averaged, as SIMPLE has them]
    #[arg(long, value_name = "MINDS", hide_possible_values = true,
        value_parser = named(MindKind::ALL, MindKind::name))]
    pub minds: Option<MindKind>,
    /// Parts into which the events are divided; each is held out of one fit
    #[arg(long, value_name = "K", default_value_t = 5, value_parser = value_parser!(u16).range(2..=1000))]
    pub folds: u16,
    /// JSON file of the parameters of the minds, of which all that are absent have their defaults; of one
    /// kind alone
    #[arg(long, value_name = "FILE", conflicts_with = "minds")]
    pub parameters: Option<PathBuf>,
    /// POMCP simulations a decision [default: SIMPLE's, 50, with published minds 100]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(phase_minds::SIMULATIONS.bounds()))]
    pub simulations: Option<u32>,
    /// Steps from one decision that is looked at to the next [default: SIMPLE's, 3]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1000))]
    pub interval: Option<u16>,
}
