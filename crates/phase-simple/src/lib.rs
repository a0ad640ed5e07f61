//! SIMPLE (SIMulation, Planning and Local Estimation): infers what explains the motion of a social event, and
//! predicts how it continues.
//!
//! An event is first prepared ([`PreparedEvent`]): actions are inferred ([`InverseDynamics`]), and the
//! observations and beliefs that each agent can have had. Each [`Hypothesis`] is then tested with the same
//! agents and physics that generate events, and is more likely the better they reproduce what was observed.
//! [`infer`] weighs hypotheses, either all of them by what each agent would do next at every step
//! (`inverse_planning`), or, as in Algorithm 2 of the paper, some of them by simulations of whole events
//! ([`metropolis`]), and returns a [`Posterior`]; [`futures`] simulates the most likely ones further.
//!
//! Key design decision: everything starts from an [`ObservedEvent`](phase_event::ObservedEvent), a type
//! without labels, so that labels cannot leak into the inference. The trade-off is that actions and grips,
//! which trajectories do not contain, have to be inferred.
//!
//! `docs/explanation/simple.md` states how the paper's formulas were interpreted and where this goes beyond
//! them.
//!
//! Agent 0 is observed for eight steps on its way from one landmark to the next, while agent 1 rests. The
//! most likely goal of agent 0 is to reach that next landmark:
//!
//! ```
//! use phase_event::ObservedEvent;
//! use phase_model::{AgentId, Body, Goal, LandmarkId, Layout, Sign, Size, Vec2};
//! use phase_simple::{UniformStrength, InferenceSettings, explain};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let rows = (0..=8_u8).map(|step| {
//!         let [first, second] = [Vec2::new(23.5, 6.0 + f32::from(step)), Vec2::new(8.5, 19.5)];
//!         let places = [first, second, Vec2::ZERO, Vec2::ZERO];
//!         let mut row = places.map(|place| Body::at_rest(place, 0.0)); // both face +y
//!         row[0].velocity = Vec2::new(0.0, 12.0); // 1 u in each step of 1/12 s
//!         row
//!     });
//!     let layout = Layout::new(0, None)?;
//!     let observed = ObservedEvent::new(layout, [Size::Small; 2], Vec::new(), rows.collect())?;
//!
//!     let mut settings = InferenceSettings::default();
//!     settings.agents.minds = settings.agents.minds.with_particles(5).with_simulations(20);
//!     let posterior = explain(&observed, &UniformStrength, 1, &settings)?.posterior;
//!     let (likeliest, _probability) = posterior.goals(AgentId::ZERO)[0];
//!     let agent = AgentId::ZERO;
//!     let landmark = LandmarkId::TOP_RIGHT;
//!     assert_eq!(likeliest, Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive });
//!     Ok(())
//! }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod answer;
mod beliefs;
mod believed;
pub mod choice;
pub mod cue;
mod evidence;
mod forecast;
mod generative;
mod guide;
mod hypothesis;
mod ignorance;
mod impression;
mod inference;
pub mod intent;
pub mod intent_network;
pub mod inverse_dynamics;
mod inverse_planning;
mod kinds;
mod knowledge;
mod methods;
pub mod metropolis;
mod models;
mod observer;
mod posterior;
mod proposal;
pub mod report_model;
mod settings;
mod settling;
mod simulation_run;
mod simulations;
pub mod strength;
mod uninformed;

pub use answer::{Inference, KnowledgeOfGoal, MindPosterior};
pub use believed::{IntentBeliefEvidence, NeutralKnowledge};
pub use evidence::{ActionLikelihoods, Budget, IntentEvidence};
pub use forecast::{
    Continuation, ForecastSettings, Futures, continuations, futures, geometric_median, hindcast_error,
};
pub use generative::{AgentDecision, PreparedEvent};
pub use guide::{Guidance, Guide};
pub use hypothesis::Hypothesis;
pub use impression::{Happening, Impression, Interaction};
pub use inference::{Cues, InferenceError, explain, infer};
pub use intent_network::IntentNetwork;
pub use inverse_dynamics::{InverseDynamics, MotionTracker};
pub use knowledge::{BeliefEvidence, KnowledgeSettings};
pub use methods::{IntentGuess, MotionCue, Simple};
pub use models::{Models, ModelsError};
pub use observer::{Observer, ObserverError};
pub use phase_model::{Intent, physical_goals};
pub use posterior::Posterior;
pub use proposal::Proposal;
pub use report_model::{ReportModel, ReportModelError};
pub use settings::{
    Algorithm, AlternativeAgents, ChainSettings, ImaginedAgents, InferenceSettings, InversePlanningSettings,
    StrengthSource, Update,
};
pub use strength::{InferredStrengths, StrengthCue, StrengthRegressor, UniformStrength};
