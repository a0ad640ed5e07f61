//! Independent agents.

use crate::draft::{self, SELF_SUFFICIENT, SceneDraft, agent, any_room, any_size, choose, object, object_of};
use phase_model::{Goal, Strength};
use rand::Rng;

/// Each agent has its own goal; goals about different objects, each in another room than its landmark.
pub(crate) fn independent(goals: [Goal; 2], random: &mut dyn Rng) -> Option<SceneDraft> {
    let mut objects = Vec::new();
    let mut agents = Vec::new();
    for goal in goals {
        let strengths = match object_of(goal) {
            Some(_) => {
                let room = draft::other_room(&[goal.landmark()?.room()], random)?;
                objects.push(object(any_size(random), room, random));
                &SELF_SUFFICIENT[..]
            }
            None => &Strength::ALL[..],
        };
        agents.push(agent(any_size(random), choose(strengths, random), goal, any_room(random), random));
    }
    SceneDraft::about(goals, agents.try_into().ok()?, objects)
}
