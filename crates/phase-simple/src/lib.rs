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
//! Agent 0 pushes forward from one landmark towards the next, agent 1 rests. What does agent 0 want?
//!
//! ```
//! use phase_forward::Forward;
//! use phase_model::{
//!     Action, AgentId, Body, Dynamics, Goal, LandmarkId, Layout, ObservedEvent, Sign, Size, State, Vec2,
//! };
//! use phase_simple::{AnyStrength, Settings, explain};
//!
//! let (layout, sizes) = (Layout::new(0, None)?, [Size::Small; 2]);
//! let places = [Vec2::new(23.5, 6.0), Vec2::new(8.5, 19.5), Vec2::ZERO, Vec2::ZERO];
//! let mut state = State::new(places.map(|place| Body::at_rest(place, 0.0))); // both face +y
//! let start = ObservedEvent::new(layout, sizes, Vec::new(), vec![state.bodies])?;
//! let forward = Forward::new(&start.physique([450.0; 2]));
//! let mut rows = vec![state.bodies];
//! for _ in 0..8 {
//!     forward.step(&mut state, [Action::Up, Action::Stop]);
//!     rows.push(state.bodies);
//! }
//! let observed = ObservedEvent::new(layout, sizes, Vec::new(), rows)?;
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
