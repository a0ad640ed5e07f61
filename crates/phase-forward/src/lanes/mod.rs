//! Eight worlds of one scene stepped together, one in each lane of a vector.
//!
//! Worlds in which the agents hold the same objects go together; within a group, masks say which lanes a contact, a correction
//! or another iteration concerns. Every lane has the bits of the scalar kernel: operations are the same, in the same order, and
//! what is rare or full of decisions (the moment of an impact, two agents that touch) is left to the scalar kernel, lane by lane.
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
mod motion;
mod outline;
mod reach;
mod real;
mod touching;
mod walls;
mod weld;
mod worlds;

use crate::model::Model;
use arrayvec::ArrayVec;
use phase_model::{AGENT_COUNT, Action, State};
use real::{LANES, LaneSet, each};
use worlds::Start;

/// Worlds that are looked at together, to be grouped.
const CHUNK: usize = 4 * LANES;
/// Fewer worlds than this are stepped one by one, which then costs less.
const MIN_TOGETHER: usize = 3;

/// Steps states of one scene, each by a pair of actions. `together` steps worlds in lanes and returns those that it did not step;
/// `alone` steps one of them.
fn step_all(
    model: &Model,
    states: &mut [State],
    actions: &[[Action; AGENT_COUNT]],
    together: impl Fn(&Model, &[&Start], &mut [State]) -> LaneSet,
    alone: impl Fn(&mut State, [Action; AGENT_COUNT]),
) {
    for (states, actions) in states.chunks_mut(CHUNK).zip(actions.chunks(CHUNK)) {
        if states.len() < MIN_TOGETHER || model.imagined {
            for (state, actions) in states.iter_mut().zip(actions) {
                alone(state, *actions);
            }
            continue;
        }
        let starts: ArrayVec<Start, CHUNK> = states
            .iter()
            .zip(actions)
            .enumerate()
            .map(|(index, (state, actions))| Start::new(model, index, state, *actions))
            .collect();
        let mut left: u32 = u32::MAX >> (CHUNK - starts.len());
        while left != 0 {
            let signature = starts[left.trailing_zeros() as usize].signature();
            let group: ArrayVec<&Start, LANES> = starts
                .iter()
                .filter(|start| left & 1 << start.index != 0 && start.signature() == signature)
                .take(LANES)
                .collect();
            for start in &group {
                left &= !(1 << start.index);
            }
            let missed = if group.len() < MIN_TOGETHER { !0 } else { together(model, &group, states) };
            for lane in each(missed).take_while(|&lane| lane < group.len()) {
                let index = group[lane].index;
                alone(&mut states[index], actions[index]);
            }
        }
    }
}

/// [`phase_model::Dynamics::step`] of every state.
pub(crate) fn step(
    model: &Model,
    states: &mut [State],
    actions: &[[Action; AGENT_COUNT]],
    alone: impl Fn(&mut State, [Action; AGENT_COUNT]),
) {
    step_all(model, states, actions, exact::step, alone);
}

/// [`crate::Forward::step_coarse`] of every state.
pub(crate) fn step_coarse(
    model: &Model,
    states: &mut [State],
    actions: &[[Action; AGENT_COUNT]],
    alone: impl Fn(&mut State, [Action; AGENT_COUNT]),
) {
    step_all(model, states, actions, coarse::step, alone);
}
