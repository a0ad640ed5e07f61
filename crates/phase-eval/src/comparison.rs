//! Two methods on the same events.

use crate::{
    Estimate,
    goals::{RecognisedEvent, goals_among, says},
    trajectories::ForecastEvent,
};
use serde::Serialize;
use thiserror::Error;

/// The answers of two methods are not about the same events.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("the answers of both methods must be about the same events; {id} is an event of only one of them")]
pub struct OtherEvents {
    /// The first such event.
    pub id: String,
}

/// Scores of one method less those of another at Task 1. Both are drawn together in every resample, so that
/// an interval on one side of 0 tells them apart even where the intervals of both overlap.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct GoalDifference {
    /// Of the share of agents whose goal is the most likely one.
    pub goal: Estimate,
    /// Of the share of events whose relation is the most likely one.
    pub relation: Estimate,
}

/// Errors of one method less those of another at Task 2 (u), of the agents; see [`GoalDifference`].
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ForecastDifference {
    /// Of the average displacement error.
    pub ade: Estimate,
    /// Of the final displacement error.
    pub fde: Estimate,
}

impl GoalDifference {
    /// Compares two methods; `None` without events. The seed is that of the intervals.
    ///
    /// # Errors
    /// [`OtherEvents`]. The order of events does not matter.
    pub fn of(
        one: &[RecognisedEvent],
        other: &[RecognisedEvent],
        seed: u64,
    ) -> Result<Option<Self>, OtherEvents> {
        let pairs = pairs(one, other, |event| &event.id)?;
        let goal = difference(&pairs, seed, |event| goals_among(&event.answer, &event.label, 1));
        let relation = difference(&pairs, seed, |event| says(&event.answer, event.label.relation));
        Ok(goal.zip(relation).map(|(goal, relation)| Self { goal, relation }))
    }
}

impl ForecastDifference {
    /// Compares two methods; `None` without events. The seed is that of the intervals.
    ///
    /// # Errors
    /// [`OtherEvents`]. The order of events does not matter.
    pub fn of(
        one: &[ForecastEvent],
        other: &[ForecastEvent],
        seed: u64,
    ) -> Result<Option<Self>, OtherEvents> {
        let pairs = pairs(one, other, |event| &event.id)?;
        let ade = difference(&pairs, seed, |event| event.agents.ade);
        let fde = difference(&pairs, seed, |event| event.agents.fde);
        Ok(ade.zip(fde).map(|(ade, fde)| Self { ade, fde }))
    }
}

fn pairs<'a, E>(one: &'a [E], other: &'a [E], id: fn(&E) -> &String) -> Result<Vec<[&'a E; 2]>, OtherEvents> {
    let missing = |event: &E| OtherEvents { id: id(event).clone() };
    if let Some(event) = other.iter().find(|event| one.iter().all(|known| id(known) != id(event))) {
        return Err(missing(event));
    }
    let pair = |event: &'a E| {
        let same = other.iter().find(|known| id(known) == id(event));
        same.map(|same| [event, same]).ok_or_else(|| missing(event))
    };
    one.iter().map(pair).collect()
}

fn difference<E>(pairs: &[[&E; 2]], seed: u64, score: fn(&E) -> f64) -> Option<Estimate> {
    let differences: Vec<f64> = pairs.iter().map(|[one, other]| score(one) - score(other)).collect();
    Estimate::of(&differences, seed)
}
