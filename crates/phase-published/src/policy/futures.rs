//! Imagined futures of the actions that the policy network weighs.
//!
//! They do not depend on what an agent wants. So the minds that are asked what an agent might want in one
//! state share them.

use super::features::ACTIONS;
use crate::search::Task;
use phase_forward::Imagined;
use phase_model::{AGENT_COUNT, Action, AgentId, Entity, MAX_OBJECTS, ObjectId, State, Vec2};
use std::{cell::RefCell, collections::VecDeque};

/// Steps for which an action is repeated, at most.
pub(super) const MOST_REPEATED: usize = 8;
/// Steps for which an action is repeated before the agent pushes forward, for [`FORWARD`] steps.
pub(super) const BEFORE_FORWARD: [usize; 3] = [1, 2, 4];
pub(super) const FORWARD: usize = 4;
const STEPS: usize = MOST_REPEATED + BEFORE_FORWARD.len() * FORWARD;
/// Beginnings that are kept, the latest ones: those of both agents' particles in two steps.
const KEPT: usize = 8;

/// The states after each step of an action's imagined futures.
pub(super) struct Futures([State; STEPS]);

impl Futures {
    fn of(beginning: &Beginning, action: Action) -> Self {
        let mut states = [beginning.state; STEPS];
        let (repeated, forward) = states.split_at_mut(MOST_REPEATED);
        let mut state = beginning.state;
        for place in repeated.iter_mut() {
            beginning.step(&mut state, action);
            *place = state;
        }
        for (steps, places) in BEFORE_FORWARD.into_iter().zip(forward.chunks_exact_mut(FORWARD)) {
            let mut state = repeated[steps - 1];
            for place in places {
                beginning.step(&mut state, Action::Up);
                *place = state;
            }
        }
        Self(states)
    }

    /// The states after each repetition.
    pub(super) fn repeated(&self) -> &[State] {
        &self.0[..MOST_REPEATED]
    }

    /// The states after each push forward that follows so many repetitions, in the order of
    /// [`BEFORE_FORWARD`].
    pub(super) fn forward(&self) -> impl Iterator<Item = (usize, &[State])> {
        BEFORE_FORWARD.into_iter().zip(self.0[MOST_REPEATED..].chunks_exact(FORWARD))
    }
}

/// All that imagined futures depend on, but for the action.
struct Beginning {
    agent: AgentId,
    state: State,
    objects_at: [Vec2; MAX_OBJECTS],
    imagined: Imagined,
}

impl Beginning {
    fn step(&self, state: &mut State, action: Action) {
        let mut actions = [Action::NoForce; AGENT_COUNT];
        actions[self.agent] = action;
        self.imagined.step_reaching(self.agent, state, actions, self.objects_at);
    }
}

struct Kept {
    beginning: Beginning,
    /// By the action's index.
    futures: [Option<Box<Futures>>; ACTIONS],
}

thread_local! {
    /// The latest first.
    static FUTURES: RefCell<VecDeque<Kept>> = const { RefCell::new(VecDeque::new()) };
}

/// Shows the futures of each of a search's actions that begin in one of its states.
pub(super) fn each<T>(task: &Task<'_>, root: &State, mut show: impl FnMut(Action, &Futures) -> T) -> Vec<T> {
    let objects_at =
        [ObjectId::ZERO, ObjectId::ONE].map(|object| task.roots[0].position(Entity::Object(object)));
    FUTURES.with_borrow_mut(|kept| {
        let known = kept.iter().position(|Kept { beginning: it, .. }| {
            it.state == *root
                && it.agent == task.agent
                && it.objects_at == objects_at
                && it.imagined == *task.imagined
        });
        let entry = known.and_then(|index| kept.remove(index)).unwrap_or_else(|| {
            let (agent, state, imagined) = (task.agent, *root, task.imagined.clone());
            let beginning = Beginning { agent, state, objects_at, imagined };
            Kept { beginning, futures: Default::default() }
        });
        kept.truncate(KEPT - 1);
        kept.push_front(entry);
        let Kept { beginning, futures } = &mut kept[0];
        let of = |&action: &Action| {
            let known = &mut futures[action.index()];
            show(action, known.get_or_insert_with(|| Box::new(Futures::of(beginning, action))))
        };
        task.actions.iter().map(of).collect()
    })
}
