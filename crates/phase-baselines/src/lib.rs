//! Training of neural networks on social events.
//!
//! - [`strength`] trains SIMPLE's estimate of agents' strengths, which `phase_simple::StrengthRegressor`
//!   evaluates,
//! - [`intent_network`] trains SIMPLE's learnt guess at intents, which `phase_simple::IntentNetwork`
//!   evaluates,
//! - [`policy`] trains the policy network of our own minds, which `phase_agent::PolicyNetwork` evaluates,
//! - [`belief_network`] tells where agents believe entities to be,
//! - [`two_level_lstm`] and [`arg`] are the paper's baselines for Task 1,
//! - [`social_lstm`] and [`stgat`] are those for Task 2,
//! - [`social_gnn`] is a later one for the relations of Task 1,
//! - [`nodes`] is the input of all of them; [`recognition`] with [`goals`], and [`forecasting`], are what
//!   those for one task have in common,
//! - [`training`] trains any of them, and as a [`TrainedNetwork`] each answers to events,
//! - [`layer`], [`perceptron`], [`lstm`] and attention are the building blocks of networks.
//!
//! Key design decision: all randomness (initial weights, order of samples, sampling of events) comes from one
//! seed through `phase_model::random`, none from the neural-network library. So the same seed and samples
//! give the same weights, bit for bit, and an interrupted training resumes as if it had not been interrupted.
//! The trade-off is that the optimiser and the LSTM are implemented here, and that reproducibility holds only
//! for processors with the same matrix-multiplication instructions. Strength networks are small enough for
//! one thread; baselines use as many as `RAYON_NUM_THREADS` gives; one and two gave the same weights
//! (`docs/explanation/networks.md`).
//!
//! Nothing here reads a file, accesses a clock or prints; `train` in `phase-cli` does. No other crate of the
//! library depends on this one, because the neural-network library takes long to build.
//!
//! A network is trained to estimate strength from two agents, of which the weak one was slow and the mighty
//! one fast:
//!
//! ```
//! use phase_baselines::strength::{AgentSamples, Sample, StrengthTrainingSettings, nearest, train};
//! use phase_model::Strength;
//!
//! let motions = [(1.0, Strength::Weak), (9.0, Strength::Mighty)].map(|(mean_speed, strength)| {
//!     let whole = Sample { features: [mean_speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.8], strength };
//!     AgentSamples { whole, windows: vec![whole] }
//! });
//! let settings = StrengthTrainingSettings {
//!     hidden: 8,
//!     learning_rate: 1e-2,
//!     epochs: 200,
//!     patience: 200,
//!     ..StrengthTrainingSettings::default()
//! };
//! let regressor = train(&motions, &motions, 1, &settings, &mut |_epoch| {})?;
//! for AgentSamples { whole, .. } in &motions {
//!     assert_eq!(nearest(regressor.estimate_from(&whole.features)), whole.strength);
//! }
//! # Ok::<(), phase_baselines::strength::TrainingError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod arg;
mod attention;
pub mod belief_network;
pub mod forecasting;
pub mod goals;
pub mod intent_network;
pub mod layer;
pub mod lstm;
mod method;
pub mod nodes;
pub mod parameters;
pub mod perceptron;
pub mod policy;
pub mod recognition;
pub mod social_gnn;
pub mod social_lstm;
pub mod stgat;
pub mod strength;
pub mod training;
pub mod two_level_lstm;

pub use method::TrainedNetwork;
