//! Contests for an object that two agents want in two places.

use crate::Track;
use phase_model::{AGENT_COUNT, Goal};

/// The distance by which each agent's goal is favoured (u): the sum, over the steps in which its subject
/// comes closer to this goal's place than to the other's, of half the difference. Between two places that
/// lie on a line with the object it is the distance that the object goes towards each. The half keeps both
/// sums apart from motion that serves both goals.
#[must_use]
pub fn favours(track: &Track, goals: [Goal; AGENT_COUNT]) -> [f32; AGENT_COUNT] {
    let mut favours = [0.0; AGENT_COUNT];
    for pair in track.states.windows(2) {
        let [a, b] = goals.map(|goal| goal.distance(&pair[0]) - goal.distance(&pair[1]));
        favours[0] += (0.5 * (a - b)).max(0.0);
        favours[1] += (0.5 * (b - a)).max(0.0);
    }
    favours
}
