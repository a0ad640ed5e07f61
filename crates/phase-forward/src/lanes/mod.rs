//! Eight worlds of one scene stepped together, one in each lane of a vector.
//!
//! Worlds in which the agents hold the same objects go together; within a group, masks say which lanes a contact, a correction
//! or another iteration concerns. Every lane has the bits of the scalar kernel: operations are the same, in the same order, and
//! what is rare or full of decisions (the moment of an impact, two agents that touch) is left to the scalar kernel, lane by lane.
//!
//! States are stepped alone (`exact`, `coarse`) or with their caches (`warm`, `memory`). Lanes differ in what is done and, with
//! caches, in the agents' strengths.
//!
//! How much it saves depends on how much the worlds agree: `docs/performance.md` has measurements.

// A body's number indexes several arrays at once here.
#![allow(clippy::needless_range_loop)]

mod coarse;
mod collide;
mod contact;
mod exact;
mod groups;
mod islands;
mod manifold;
mod memory;
mod motion;
mod outline;
mod reach;
mod real;
mod touching;
mod walls;
mod warm;
mod weld;
mod worlds;

use crate::{Exertion, SolverCache, model::Model};
use arrayvec::ArrayVec;
use phase_model::{AGENT_COUNT, Action, State, arena::SUBSTEPS};
pub use real::LANES;
use real::{LaneSet, each};
pub(crate) use warm::WarmBatch;
use worlds::Start;

/// Worlds that are looked at together, to be grouped.
const CHUNK: usize = 4 * LANES;
/// Fewer worlds than this are stepped one by one, which then costs less.
const MIN_TOGETHER: usize = 3;

/// Worlds of one scene that are to be stepped, by their places in a batch.
trait Batch {
    /// Their number.
    fn len(&self) -> usize;

    /// One of them, with what is done in it.
    fn start(&self, model: &Model, index: usize) -> Start;

    /// Steps worlds with equal signatures in lanes, and returns those that it did not step.
    fn together(&mut self, model: &Model, starts: &[&Start]) -> LaneSet;

    /// Steps one of them by the scalar kernel.
    fn alone(&mut self, index: usize);
}

/// Steps all worlds of a batch.
fn step_all(model: &Model, batch: &mut impl Batch) {
    let count = batch.len();
    for first in (0..count).step_by(CHUNK) {
        let chunk = first..count.min(first + CHUNK);
        if chunk.len() < MIN_TOGETHER || model.imagined {
            chunk.for_each(|index| batch.alone(index));
            continue;
        }
        let starts: ArrayVec<Start, CHUNK> = chunk.map(|index| batch.start(model, index)).collect();
        let mut left: u32 = u32::MAX >> (CHUNK - starts.len());
        while left != 0 {
            let signature = starts[left.trailing_zeros() as usize].signature();
            let group: ArrayVec<&Start, LANES> = starts
                .iter()
                .filter(|start| left & 1 << (start.index - first) != 0 && start.signature() == signature)
                .take(LANES)
                .collect();
            for start in &group {
                left &= !(1 << (start.index - first));
            }
            let missed = if group.len() < MIN_TOGETHER { !0 } else { batch.together(model, &group) };
            for lane in each(missed).take_while(|&lane| lane < group.len()) {
                batch.alone(group[lane].index);
            }
        }
    }
}

/// States without caches.
struct States<'a, T, A> {
    states: &'a mut [State],
    actions: &'a [[Action; AGENT_COUNT]],
    together: T,
    alone: A,
}

impl<T, A> Batch for States<'_, T, A>
where
    T: Fn(&Model, &[&Start], &mut [State]) -> LaneSet,
    A: Fn(&mut State, [Action; AGENT_COUNT]),
{
    fn len(&self) -> usize {
        self.states.len()
    }

    fn start(&self, model: &Model, index: usize) -> Start {
        let max_forces = [0, 1].map(|agent: usize| model.shapes[agent].max_force);
        let exertion = Exertion { actions: self.actions[index], max_forces };
        Start::new(model, index, &self.states[index], 1, exertion)
    }

    fn together(&mut self, model: &Model, starts: &[&Start]) -> LaneSet {
        (self.together)(model, starts, self.states)
    }

    fn alone(&mut self, index: usize) {
        (self.alone)(&mut self.states[index], self.actions[index]);
    }
}

/// [`phase_model::Dynamics::step`] of every state.
pub(crate) fn step(
    model: &Model,
    states: &mut [State],
    actions: &[[Action; AGENT_COUNT]],
    alone: impl Fn(&mut State, [Action; AGENT_COUNT]),
) {
    step_all(model, &mut States { states, actions, together: exact::step, alone });
}

/// [`crate::Forward::step_coarse`] of every state.
pub(crate) fn step_coarse(
    model: &Model,
    states: &mut [State],
    actions: &[[Action; AGENT_COUNT]],
    alone: impl Fn(&mut State, [Action; AGENT_COUNT]),
) {
    step_all(model, &mut States { states, actions, together: coarse::step, alone });
}

/// [`crate::Forward::step_warm_with`] of every state.
pub(crate) fn step_warm(
    model: &Model,
    batch: &mut WarmBatch<'_>,
    alone: impl Fn(&mut State, &mut SolverCache, &Exertion) -> [State; SUBSTEPS],
) {
    step_all(model, &mut warm::WithAlone { batch, alone });
}
