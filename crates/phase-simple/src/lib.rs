//! SIMPLE (SIMulation, Planning and Local Estimation): what explains the motion of a social event, and how it goes on.
//!
//! An event is first prepared ([`Stage`]): what was done ([`InverseDynamics`]), and what each agent can have observed
//! and so believed. Each [`Hypothesis`] is then put to the very minds and physics that make events, and is the
//! likelier the better they do what was observed. [`infer`] weighs hypotheses, either all of them by what each
//! agent would do next at every step (`inverse_planning`), or as Algorithm 2 of the paper some of them by simulations of
//! whole events ([`metropolis`]), and returns a [`Posterior`]; [`forecast()`] plays the likeliest on.
//!
//! The key design decision is that everything starts from an [`ObservedEvent`](phase_event::ObservedEvent), a type
//! without labels: what is inferred cannot have been read. The price is that actions and grips, which trajectories do
//! not tell, have to be found out.
//!
//! `docs/simple.md` says where the paper's formulas were settled and where this goes beyond them.
//!
//! Agent 0 is observed for eight steps on its way from one landmark to the next, while agent 1 rests. The likeliest
//! goal of agent 0 is to reach that next landmark:
//!
//! ```
//! use phase_event::ObservedEvent;
//! use phase_model::{AgentId, Body, Goal, LandmarkId, Layout, Sign, Size, Vec2};
//! use phase_simple::{AnyStrength, Settings, explain};
//!
//! let rows = (0..=8_u8).map(|step| {
//!     let places = [Vec2::new(23.5, 6.0 + f32::from(step)), Vec2::new(8.5, 19.5), Vec2::ZERO, Vec2::ZERO];
//!     let mut row = places.map(|place| Body::at_rest(place, 0.0)); // both face +y
//!     row[0].velocity = Vec2::new(0.0, 12.0); // 1 u in each step of 1/12 s
//!     row
//! });
//! let observed = ObservedEvent::new(Layout::new(0, None)?, [Size::Small; 2], Vec::new(), rows.collect())?;
//!
//! let mut settings = Settings::default();
//! (settings.minds.particles, settings.minds.simulations) = (5, 20);
//! let posterior = explain(&observed, &AnyStrength, 1, &settings)?.posterior;
//! let (likeliest, _probability) = posterior.goals(AgentId::ZERO)[0];
//! let (agent, landmark) = (AgentId::ZERO, LandmarkId::TOP_RIGHT);
//! assert_eq!(likeliest, Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive });
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beliefs;
pub mod cue;
pub mod forecast;
pub mod generative;
pub mod hypothesis;
pub mod inference;
pub mod inverse_dynamics;
mod inverse_planning;
pub mod metropolis;
pub mod posterior;
pub mod proposal;
pub mod settings;
pub mod simulations;
pub mod strength;
pub mod want;

pub use forecast::{ForecastSettings, forecast};
pub use generative::Stage;
pub use hypothesis::{Hypothesis, physical_goals};
pub use inference::{Inference, explain, infer};
pub use inverse_dynamics::InverseDynamics;
pub use posterior::Posterior;
pub use proposal::Proposal;
pub use settings::{Algorithm, ChainSettings, PlanningSettings, Settings, Update};
pub use strength::{AnyStrength, StrengthCue, StrengthRegressor};
pub use want::Want;
