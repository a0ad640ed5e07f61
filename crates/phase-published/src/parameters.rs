//! The parameters of a published mind.

use crate::stream::RandomNumbers;
use serde::{Deserialize, Serialize};

/// Every number of a published mind that can be chosen. The defaults are those of the published recordings;
/// what cannot be chosen is a fact of the published code. Ranges are checked where parameters enter a
/// program, by `phase_minds::MindParameters::validate`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedParameters {
    /// Belief particles; at least 1.
    pub particles: usize,
    /// Weight of the distance in a subgoal's value (1/u).
    pub lambda: f64,
    /// Simulations a decision; at least 1.
    pub simulations: usize,
    /// Searches a decision, each from the start and with that many simulations, whose visits are added up; at
    /// least 1. The original searches once. What one search settles on is to some degree chance, and a
    /// likelihood of actions needs to know how much.
    pub searches: usize,
    /// Steps of a rollout.
    pub rollout_steps: usize,
    /// Exploration constant of PUCT.
    pub c_init: f64,
    /// Visits after which exploration grows.
    pub c_base: f64,
    /// Weight of the next step's reward.
    pub discount: f64,
    /// Whether bodies collide with each other in the search, as they do in the original; if not, they pass
    /// through each other.
    pub collisions: bool,
    /// Whether agents push in all directions on the way to a landmark where one hinders, as they do in the
    /// recordings of before the 28th of August 2020, which are the hindering ones (inferred); if not, they
    /// turn, push forward or let themselves slide.
    pub older_actions: bool,
    /// Whether agents of the greatest strength coast when they mean to stop, in the mind's imagination. That
    /// is how it was when the published events were recorded; the bodies' own settings are elsewhere.
    pub strongest_coasts: bool,
    /// The source of the random numbers of searches.
    pub random: RandomNumbers,
    /// Whether the policy network says what a search would choose, in its place. Simulations, searches and
    /// rollouts are then of no account.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub network_alone: bool,
}

impl Default for PublishedParameters {
    fn default() -> Self {
        Self {
            particles: 50,
            lambda: 0.05,
            simulations: 1000,
            searches: 1,
            rollout_steps: 10,
            c_init: 1.25,
            c_base: 1000.0,
            discount: 0.95,
            collisions: true,
            older_actions: false,
            strongest_coasts: false,
            random: RandomNumbers::Seeded,
            network_alone: false,
        }
    }
}
