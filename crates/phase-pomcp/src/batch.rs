//! Several simulations at a time, in lockstep: each takes one step per round, and all steps of a round are computed
//! together.

use rand::{Rng, RngExt};

use crate::simulation::{Simulation, Simulations, Stage};
use crate::{GenerativeModel, PomcpError, Transition};

/// The memory of a batch, which is reused from search to search.
#[derive(Debug, Clone)]
pub(crate) struct Lanes<O> {
    simulations: Vec<Simulation>,
    actions: Vec<usize>,
    steps: Vec<Transition<O>>,
    rollout_steps: Vec<Transition<()>>,
}

impl<O> Lanes<O> {
    pub(crate) fn new() -> Self {
        Self { simulations: Vec::new(), actions: Vec::new(), steps: Vec::new(), rollout_steps: Vec::new() }
    }
}

/// Runs the search's simulations from `roots`, so many at a time as its settings say: as soon as one has ended, the next
/// takes its place. Asks `is_over` after each that has ended, and leaves those under way where it says so.
pub(crate) fn run<M: GenerativeModel>(
    search: &mut Simulations<'_, M>,
    lanes: &mut Lanes<M::Observation>,
    roots: &[M::State],
    random: &mut impl Rng,
    mut is_over: impl FnMut(&Simulations<'_, M>) -> bool,
) -> Result<(), PomcpError> {
    let Some(root) = roots.first() else { return Err(PomcpError::NoRoots) };
    let mut waiting = search.settings.simulations;
    let mut live = search.settings.batch.min(waiting);
    let Lanes { simulations, actions, steps, rollout_steps } = lanes;
    simulations.resize_with(live.max(simulations.len()), Simulation::new);
    simulations.iter_mut().for_each(|simulation| simulation.stage = Stage::Ended);
    // States that take a step are contiguous: those in the tree first, then those in rollouts.
    let mut states = vec![root.clone(); live];
    if let ([simulation, ..], [state]) = (simulations.as_mut_slice(), states.as_mut_slice()) {
        // The same without the exchange of places, which would cost more than the steps of a small problem.
        for _ in 0..waiting {
            state.clone_from(&roots[random.random_range(0..roots.len())]);
            simulation.start();
            search.finish(simulation, state, random)?;
            if is_over(search) {
                break;
            }
        }
        return Ok(());
    }
    loop {
        for (simulation, state) in simulations.iter_mut().zip(&mut states[..live]) {
            loop {
                if simulation.stage == Stage::Ended {
                    if waiting == 0 {
                        break;
                    }
                    waiting -= 1;
                    state.clone_from(&roots[random.random_range(0..roots.len())]);
                    simulation.start();
                }
                search.choose(simulation, state, random)?;
                if simulation.stage != Stage::Ended {
                    break;
                }
                if is_over(search) {
                    return Ok(());
                }
            }
        }
        let (lanes, states) = (&mut simulations[..live], &mut states[..live]);
        let in_tree = gather(lanes, states, 0, |stage| matches!(stage, Stage::Tree { .. }));
        live = gather(lanes, states, in_tree, |stage| stage != Stage::Ended);
        if live == 0 {
            return Ok(());
        }
        let (lanes, states) = (&mut lanes[..live], &mut states[..live]);
        actions.clear();
        actions.extend(lanes.iter().map(|simulation| simulation.action));
        steps.clear();
        rollout_steps.clear();
        search.model.advance_batch(states, actions, in_tree, random, steps, rollout_steps);
        check(steps, in_tree)?;
        check(rollout_steps, live - in_tree)?;
        let (tree, rollouts) = lanes.split_at_mut(in_tree);
        let (tree_states, rollout_states) = states.split_at(in_tree);
        for ((simulation, state), outcome) in tree.iter_mut().zip(tree_states).zip(steps.drain(..)) {
            search.after_step(simulation, state, outcome)?;
            if simulation.stage == Stage::Ended && is_over(search) {
                return Ok(());
            }
        }
        let rollouts = rollouts.iter_mut().zip(rollout_states);
        for ((simulation, state), outcome) in rollouts.zip(rollout_steps.drain(..)) {
            search.after_rollout_step(simulation, state, outcome)?;
            if simulation.stage == Stage::Ended && is_over(search) {
                return Ok(());
            }
        }
    }
}

/// Checks that there is one outcome for each state.
fn check<O>(outcomes: &[Transition<O>], states: usize) -> Result<(), PomcpError> {
    let outcomes = outcomes.len();
    if outcomes == states { Ok(()) } else { Err(PomcpError::OutcomeCount { outcomes, states }) }
}

/// Moves the simulations from `first` on whose stage `belongs` to the front, with their states, and returns the end of
/// those.
fn gather<S>(
    simulations: &mut [Simulation],
    states: &mut [S],
    first: usize,
    belongs: impl Fn(Stage) -> bool,
) -> usize {
    let (mut front, mut back) = (first, simulations.len());
    loop {
        while front < back && belongs(simulations[front].stage) {
            front += 1;
        }
        while front < back && !belongs(simulations[back - 1].stage) {
            back -= 1;
        }
        if front == back {
            return front;
        }
        simulations.swap(front, back - 1);
        states.swap(front, back - 1);
    }
}
