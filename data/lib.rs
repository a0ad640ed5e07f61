//! Data that comes with PHASE: trained weights with the records of their training, fitted models, rating
//! forms, and presets of datasets, as bytes and text.
//!
//! The files are made by commands (docs/explanation/networks.md, docs/explanation/simple.md,
//! docs/reference/dataset.md) and lie beside this file. Key design decision: one crate has them all, so that
//! every other crate can be packed without files from outside of it. What a program does not use is not
//! linked into it.
//!
//! Every preset has a name, and every network the record of its training:
//!
//! ```
//! let names = phase_data::PRESETS.map(|(name, _json)| name);
//! assert!(names.contains(&"phase-500"));
//! assert!(phase_data::ARG.record.contains("validation"));
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

/// A trained network: weights and the record of its training.
#[derive(Clone, Copy, Debug)]
pub struct Trained {
    /// The weights (safetensors).
    pub weights: &'static [u8],
    /// The record of the training (JSON).
    pub record: &'static str,
}

macro_rules! trained {
    ($file:literal) => {
        Trained { weights: include_bytes!($file), record: include_str!(concat!($file, ".training.json")) }
    };
}

/// ARG (docs/explanation/networks.md).
pub const ARG: Trained = trained!("arg.safetensors");
/// The belief network.
pub const BELIEF_NETWORK: Trained = trained!("belief-network.safetensors");
/// The intent network of SIMPLE.
pub const INTENT_NETWORK: Trained = trained!("intent-network.safetensors");
/// The policy network of our own minds (docs/explanation/minds.md).
pub const POLICY: Trained = trained!("policy.safetensors");
/// The policy network of published minds (docs/explanation/published-minds.md).
pub const PUBLISHED_POLICY: Trained = trained!("published-policy.safetensors");
/// The Social-LSTM.
pub const SOCIAL_LSTM: Trained = trained!("social-lstm.safetensors");
/// SocialGNN.
pub const SOCIAL_GNN: Trained = trained!("socialgnn.safetensors");
/// STGAT.
pub const STGAT: Trained = trained!("stgat.safetensors");
/// The weights of the strength network of Algorithm 2 (safetensors).
pub const STRENGTH_WEIGHTS: &[u8] = include_bytes!("strength.safetensors");
/// The 2-Level LSTM.
pub const TWO_LEVEL_LSTM: Trained = trained!("two-level-lstm.safetensors");

/// The model of how people report what they saw (JSON, docs/explanation/simple.md).
pub const REPORT_MODEL: &str = include_str!("report-model.json");
/// The record of its fit: to whose ratings, and how it agrees with those held out of it (JSON, format
/// phase-report-training/1, docs/reference/formats/networks.md).
pub const REPORT_TRAINING: &str = include_str!("report-model.training.json");

/// The rating forms: what people are asked about a video (JSON, format phase-forms/1,
/// docs/reference/formats/studies.md). The 23 types of interaction are those of the paper, in its order.
pub const FORMS: &str = include_str!("forms.json");

/// The figures of the benchmark that documents show (JSON, format phase-benchmark/1,
/// docs/reference/formats/evaluation.md).
pub const RESULTS: &str = include_str!("results.json");
/// Scores of submitted methods (JSON, format phase-leaderboard/1).
pub const LEADERBOARD_SCORES: &str = include_str!("leaderboard/scores.json");
/// Authors of submitted methods (JSON).
pub const LEADERBOARD_METHODS: &str = include_str!("leaderboard/methods.json");

/// Twelve events, two of each kind (JSON, format phase-preset/3, as all presets).
pub const DEMO: &str = include_str!("presets/demo.json");
/// The paper's 500 events, second edition (docs/reference/dataset.md).
pub const PHASE_500: &str = include_str!("presets/phase-500.json");
/// The first edition of them.
pub const PHASE_500_V1: &str = include_str!("presets/phase-500-v1.json");
/// Pairs of a false and a true belief (docs/reference/pairs.md).
pub const PHASE_BELIEFS: &str = include_str!("presets/phase-beliefs.json");
/// Events to train networks for beliefs with (docs/reference/pairs.md).
pub const PHASE_BELIEFS_TRAINING: &str = include_str!("presets/phase-beliefs-training.json");
/// Events of agents that do not know each other's goals (docs/reference/dataset.md).
pub const PHASE_MINDS: &str = include_str!("presets/phase-minds.json");
/// Minimal pairs and triples (docs/reference/pairs.md).
pub const PHASE_PAIRS: &str = include_str!("presets/phase-pairs.json");
/// Training events of the same kind as those of PHASE-500.
pub const PHASE_TRAINING: &str = include_str!("presets/phase-training.json");

/// All presets by their names.
pub const PRESETS: [(&str, &str); 8] = [
    ("demo", DEMO),
    ("phase-500", PHASE_500),
    ("phase-500-v1", PHASE_500_V1),
    ("phase-beliefs", PHASE_BELIEFS),
    ("phase-beliefs-training", PHASE_BELIEFS_TRAINING),
    ("phase-minds", PHASE_MINDS),
    ("phase-pairs", PHASE_PAIRS),
    ("phase-training", PHASE_TRAINING),
];
