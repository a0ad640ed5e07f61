//! POMCP with PUCT over any generative model.
//!
//! A problem defines the result of one step ([`GenerativeModel`]); [`Pomcp`] looks ahead by simulating from
//! the particles of a belief, and returns an action with its statistics ([`Decision`]). The tree search is
//! POMCP (Silver & Veness 2010), its selection the PUCT of AlphaZero (Silver et al. 2018) with the constants
//! of the PHASE paper's appendix. It does not depend on PHASE, on physics or on the representation of
//! beliefs.
//!
//! A custom problem takes ten lines. A coin lies under one of two cups; guessing (actions 0 and 1) earns 1 if
//! correct and ends the problem, peeking (action 2) costs 0.1 and reveals the coin:
//!
//! ```
//! use phase_pomcp::{GenerativeModel, Pomcp, PomcpSettings, Transition};
//! use rand::{Rng, SeedableRng};
//!
//! struct Cups;
//!
//! impl GenerativeModel for Cups {
//!     type State = usize; // the cup that hides the coin
//!     type Observation = Option<usize>; // that cup, if peeked
//!     fn action_count(&self) -> usize { 3 }
//!     fn discount(&self) -> f64 { 0.95 }
//!     fn step(&self, cup: &mut usize, action: usize, _: &mut impl Rng) -> Transition<Option<usize>> {
//!         let peeks = action == 2;
//!         let observation = peeks.then_some(*cup);
//!         let reward = if peeks { -0.1 } else { f64::from(action == *cup) };
//!         Transition { observation, reward, terminal: !peeks }
//!     }
//! }
//!
//! fn main() -> Result<(), phase_pomcp::PomcpError> {
//!     let mut random = rand_pcg::Pcg32::seed_from_u64(1);
//!     let mut pomcp = Pomcp::new(PomcpSettings::default())?;
//!     let unsure = pomcp.search(&Cups, &[0, 1], &mut random)?;
//!     println!("{}", pomcp.view(2, 50)); // two levels of the tree
//!     assert_eq!(unsure.action, 2); // peek: −0.1 + 0.95 × 1 beats a guess's 0.5
//!     assert!(unsure.actions[2].value > unsure.actions[0].value); // and that is why
//!     assert_eq!(pomcp.search(&Cups, &[1], &mut random)?.action, 1); // who knows does not peek
//!     Ok(())
//! }
//! ```
//!
//! A generator is any of `rand` 0.10, here `rand_pcg`'s. `examples/tiger.rs` goes on to whole episodes, with
//! a [`ParticleBelief`] between the real steps; `examples/anchors` measures returns on published problems,
//! which docs/how-to/planning.md lists. Where not every action is possible everywhere, a model says so
//! ([`GenerativeModel::is_legal`]).
//!
//! # Key design decision
//!
//! The tree branches on histories of own actions **and observations**, compared by equality, and contains no
//! states. So a plan can react to future observations, which gives information gathering its value, and the
//! whole tree is three flat vectors of a few words per node that are reused from search to search. Only for a
//! model that declares itself deterministic does a search keep the states it reached, and computes no step of
//! the tree twice.
//!
//! The trade-off: the model must return observations coarse enough for simulations to meet again, since the
//! tree has no notion of similar observations. Where they are real numbers, it says how likely they are
//! ([`ObservationModel`]), and [`Pomcp::search_widened`] (POMCPOW) keeps weighted states in its branches.
//! Branches of an action are searched linearly, fine for dozens and slow for thousands; and a belief is
//! updated by the model, not by the particles of a subtree as in POMCP, though a search can go on in the
//! subtree ([`Pomcp::keep`]).
//!
//! # Determinism
//!
//! A search is a function of its settings, model, particles and generator, to the last bit: it does not
//! iterate over hashes or read a clock, and the logarithm is that of the `libm` crate on every platform.
//!
//! # Deviations from the sources
//!
//! PUCT is undefined for actions never tried while the parent has no visits: here every action of a history
//! is tried once, in random order, before they are compared; the same holds in POMCPOW, whose paper selects
//! by UCB. A search may end once it is decided, see
//! [`PomcpSettings::stop_when_decided`]. Values are mapped to 0..1 by the extremes in the
//! tree before they are compared, see [`PomcpSettings::normalise_values`].

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod belief;
mod decision;
mod error;
mod model;
pub mod puct;
mod search;
mod settings;
mod simulation;
mod tree;
mod view;
mod widening;

pub use belief::{BeliefError, BeliefModel, BeliefUpdate, DEFAULT_ATTEMPTS, ParticleBelief};
pub use decision::{ActionStatistics, Decision, SearchStatistics};
pub use error::PomcpError;
pub use model::{GenerativeModel, ObservationModel, Transition};
pub use search::Pomcp;
pub use settings::PomcpSettings;
pub use view::{ActionView, HistoryView};
pub use widening::Widening;
