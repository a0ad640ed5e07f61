//! The low level: a tree search over the agent's own actions.

use crate::{aim::Aim, parameters::PublishedParameters, rooms::Rooms, stream::Draws};
use phase_forward::Imagined;
use phase_model::{AGENT_COUNT, Action, AgentId, Entity, MAX_OBJECTS, ObjectId, PhysicsConfig, State, Vec2};

/// The task of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Task<'a> {
    pub(crate) agent: AgentId,
    pub(crate) aim: Aim,
    pub(crate) actions: &'a [Action],
    /// The possible states, all equally likely.
    pub(crate) roots: &'a [State],
    pub(crate) rooms: &'a Rooms,
    pub(crate) physics: &'a PhysicsConfig,
    pub(crate) imagined: &'a Imagined,
    pub(crate) parameters: &'a PublishedParameters,
}

/// The result of a search.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Found {
    /// The actions in the order in which they were compared, with visits and mean returns.
    pub(crate) actions: Vec<(Action, u32, f64)>,
    /// The action chosen among the most visited.
    pub(crate) chosen: Action,
}

/// A node of the tree: an action after those before it. The root comes first.
#[derive(Clone, Copy, Debug)]
struct Node {
    visits: u32,
    /// Sum of the returns.
    sum: f64,
    /// Its first child, or [`NONE`]; the others follow, one for each action.
    children: u32,
    /// The first of its [`Outcome`]s, or [`NONE`].
    outcomes: u32,
}

/// The state that the actions up to a node lead to from a root. The dynamics are deterministic, so each is
/// computed once.
#[derive(Clone, Copy, Debug)]
struct Outcome {
    root: u32,
    next: u32,
    /// Reward of the state and the last action.
    reward: f64,
    state: State,
}

const NONE: u32 = u32::MAX;
const LEAF: Node = Node { visits: 0, sum: 0.0, children: NONE, outcomes: NONE };

/// Searches once, with at least one action and one root.
pub(crate) fn search(task: &Task<'_>, draws: &mut impl Draws) -> Found {
    let mut order = task.actions.to_vec();
    draws.shuffle(&mut order);
    // The first state's objects are where the agent reaches for them.
    let at = |object| task.roots[0].position(Entity::Object(object));
    let mut tree = Tree {
        task,
        order: &order,
        objects_at: [at(ObjectId::ZERO), at(ObjectId::ONE)],
        first_equal: first_equals(task.roots),
        nodes: vec![LEAF],
        outcomes: Vec::new(),
        path: Vec::new(),
    };
    // The original expands the root with any of the states, which leaves no trace but the number drawn.
    draws.below(task.roots.len());
    tree.expand(0);
    for _ in 0..task.parameters.simulations {
        tree.simulate(draws);
    }
    let evaluated = |(k, &action): (usize, &Action)| {
        let node = tree.nodes[1 + k];
        (action, node.visits, if node.visits > 0 { node.sum / f64::from(node.visits) } else { 0.0 })
    };
    let actions: Vec<(Action, u32, f64)> = order.iter().enumerate().map(evaluated).collect();
    let most = actions.iter().map(|&(_, visits, _)| visits).max().unwrap_or(0);
    let best: Vec<Action> =
        actions.iter().filter(|&&(_, visits, _)| visits == most).map(|&(action, ..)| action).collect();
    let chosen = best[draws.below(best.len())];
    Found { actions, chosen }
}

/// For each state, the index of the first that equals it.
fn first_equals(roots: &[State]) -> Vec<u32> {
    let first = |k: usize| roots[..k].iter().position(|earlier| *earlier == roots[k]).unwrap_or(k);
    (0..roots.len()).map(|k| first(k) as u32).collect()
}

/// A search under way.
struct Tree<'a> {
    task: &'a Task<'a>,
    order: &'a [Action],
    objects_at: [Vec2; MAX_OBJECTS],
    first_equal: Vec<u32>,
    nodes: Vec<Node>,
    outcomes: Vec<Outcome>,
    /// The nodes of the simulation after the root, with the rewards there.
    path: Vec<(u32, f64)>,
}

impl Tree<'_> {
    /// Gives a leaf its children.
    fn expand(&mut self, node: usize) {
        self.nodes[node].children = self.nodes.len() as u32;
        self.nodes.extend(self.order.iter().map(|_| LEAF));
    }

    /// One simulation: down to a leaf, which is expanded, then any actions, then back.
    fn simulate(&mut self, draws: &mut impl Draws) {
        let root = self.first_equal[draws.below(self.task.roots.len())];
        let mut state = self.task.roots[root as usize];
        let mut node = 0;
        self.path.clear();
        while self.nodes[node].children != NONE {
            let chosen = self.select(node, draws);
            node = self.nodes[node].children as usize + chosen;
            let outcome = self.outcome(node, self.order[chosen], root, &state);
            state = self.outcomes[outcome].state;
            self.path.push((node as u32, self.outcomes[outcome].reward));
        }
        self.expand(node);
        let mut value = self.rollout(&mut state, draws);
        let discount = self.task.parameters.discount;
        for &(node, reward) in self.path.iter().rev() {
            value = discount * value + reward;
            let node = &mut self.nodes[node as usize];
            node.visits += 1;
            node.sum += value;
        }
        self.nodes[0].visits += 1;
    }

    /// The child to visit: one never visited, else one with the greatest PUCT score.
    fn select(&self, node: usize, draws: &mut impl Draws) -> usize {
        let PublishedParameters { c_init, c_base, .. } = *self.task.parameters;
        let Node { visits, children, .. } = self.nodes[node];
        let count = self.order.len();
        let children = &self.nodes[children as usize..children as usize + count];
        let visits = f64::from(visits);
        let rate = libm::log((1.0 + visits + c_base) / c_base) + c_init;
        let explore = rate / count as f64 * visits.sqrt();
        let score = |child: &Node| {
            if child.visits == 0 {
                f64::INFINITY
            } else {
                let visits = f64::from(child.visits);
                child.sum / visits + explore / (1.0 + visits)
            }
        };
        let mut best = f64::NEG_INFINITY;
        let mut equal = 0;
        for child in children {
            let score = score(child);
            if score > best {
                (best, equal) = (score, 1);
            } else if score == best {
                equal += 1;
            }
        }
        let drawn = draws.below(equal.max(1));
        let mut bests = children.iter().enumerate().filter(|(_, child)| score(child) == best);
        bests.nth(drawn).map_or(0, |(index, _)| index)
    }

    /// The state that a node stands for from a root, given the state before its action.
    fn outcome(&mut self, node: usize, action: Action, root: u32, before: &State) -> usize {
        let mut next = self.nodes[node].outcomes;
        while next != NONE {
            let outcome = &self.outcomes[next as usize];
            if outcome.root == root {
                return next as usize;
            }
            next = outcome.next;
        }
        let mut state = *before;
        self.step(&mut state, action, Action::NoForce);
        let reward = self.task.aim.reward(self.task.rooms, &state, action);
        let index = self.outcomes.len();
        self.outcomes.push(Outcome { root, next: self.nodes[node].outcomes, reward, state });
        self.nodes[node].outcomes = index as u32;
        index
    }

    /// The discounted return of any actions of both agents, from the same set.
    fn rollout(&self, state: &mut State, draws: &mut impl Draws) -> f64 {
        let mut total = 0.0;
        let mut weight = 1.0;
        for _ in 0..self.task.parameters.rollout_steps {
            let [own, others] = [(); 2].map(|()| self.order[draws.below(self.order.len())]);
            total += weight * self.task.aim.reward(self.task.rooms, state, own);
            weight *= self.task.parameters.discount;
            self.step(state, own, others);
        }
        total
    }

    fn step(&self, state: &mut State, own: Action, others: Action) {
        let mut actions = [others; AGENT_COUNT];
        actions[self.task.agent] = own;
        self.task.imagined.step_reaching(self.task.agent, state, actions, self.objects_at);
    }
}
