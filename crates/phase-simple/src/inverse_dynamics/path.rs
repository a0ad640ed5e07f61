//! Ways to explain an event as far as it has been followed.

use super::{reading::Reading, replay::{Replay, TrackedState, Difference, LEVELS}, search::{self, EXACT}};
use phase_model::{AGENT_COUNT, Action, Body, Entity, MAX_ENTITIES, State};

/// Residual of a step that the physics explains (u).
const RESIDUAL_SCALE: f64 = 0.02;
/// Cost of attaching or detaching beside its residual, in logarithms: it is rare.
const GRIP_CHANGE_COST: f64 = 0.5;
/// Residual above which a state is corrected by the observation (u).
const CORRECTED: f32 = 0.01;
/// Prediction error beyond which a body is reset to the observation (u, rad).
const RESET: f32 = 0.4;
/// Difference up to which states are the same (u, u/s, rad).
const SAME: f32 = 2e-4;
/// Paths whose cost exceeds that of the best by more are given up.
const GIVE_UP: f64 = 40.0;

/// A path through an event: its last step, and the path before it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) before: Option<usize>,
    pub(super) reading: usize,
    pub(super) tracked: TrackedState,
    /// Possible strengths of each agent, one bit for each level.
    pub(super) strengths: [u8; AGENT_COUNT],
    pub(super) actions: [Action; AGENT_COUNT],
    pub(super) residual: f32,
    /// Cost of the whole path, in logarithms.
    pub(super) cost: f64,
}

/// All paths that were followed, and those that still are.
pub(super) struct Beam {
    pub(super) nodes: Vec<Node>,
    pub(super) ends: Vec<usize>,
    width: usize,
}

impl Beam {
    /// One path for each reading.
    pub(super) fn new(readings: &[(Reading, Replay)], width: usize) -> Self {
        let mut beam = Self { nodes: Vec::new(), ends: Vec::new(), width };
        let nodes = readings.iter().enumerate().map(|(number, (reading, replay))| Node {
            before: None,
            reading: number,
            tracked: replay.start(reading),
            strengths: [(1 << LEVELS) - 1; AGENT_COUNT],
            actions: [Action::NoForce; AGENT_COUNT],
            residual: 0.0,
            cost: 0.0,
        });
        beam.keep(nodes.collect());
        beam
    }

    /// Follows all paths by one step, to row `t`.
    pub(super) fn advance(&mut self, readings: &[(Reading, Replay)], between: &[Vec<State>], t: usize) {
        let mut longer = Vec::new();
        for &end in &self.ends {
            let node = &self.nodes[end];
            let (reading, replay) = &readings[node.reading];
            let row = &reading.event.rows()[t];
            let found = search::explanations(replay, &node.tracked, row, node.strengths, node.actions);
            for explanation in found {
                let predicted = explanation.predicted;
                let mut strengths = node.strengths;
                for (strengths, (action, level)) in strengths.iter_mut().zip(explanation.deeds) {
                    if action.push().is_some() {
                        *strengths = 1 << level;
                    }
                }
                let changes = predicted.end.state.grips.iter().zip(&node.tracked.state.grips);
                let changes = changes.filter(|(after, before)| after.is_some() != before.is_some()).count();
                let extra = GRIP_CHANGE_COST * changes as f64;
                let mut next = Node {
                    before: Some(end),
                    reading: node.reading,
                    tracked: predicted.end,
                    strengths,
                    actions: explanation.deeds.map(|(action, _)| action),
                    residual: predicted.residual,
                    cost: node.cost + cost(predicted.residual) + extra,
                };
                if next.residual > CORRECTED {
                    let mut corrected = next.clone();
                    correct(&mut corrected, replay, &predicted.differences, row, &between[node.reading][t]);
                    longer.push(corrected);
                }
                if next.residual <= 10.0 * CORRECTED {
                    next.cost += 1e-3;
                    longer.push(next);
                }
            }
        }
        self.keep(longer);
    }

    /// Keeps the cheapest paths, one for each state with its grips.
    fn keep(&mut self, mut nodes: Vec<Node>) {
        nodes.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        self.ends.clear();
        let limit = nodes.first().map_or(0.0, |node| node.cost) + GIVE_UP;
        for node in nodes {
            if node.cost > limit {
                break;
            }
            let same = self.ends.iter().find(|&&end| same(&self.nodes[end], &node));
            if let Some(&end) = same {
                // Steps that tell nothing about strengths.
                if node.before == self.nodes[end].before {
                    let strengths = node.strengths;
                    for (kept, merged) in self.nodes[end].strengths.iter_mut().zip(strengths) {
                        *kept |= merged;
                    }
                }
            } else if self.ends.len() < self.width {
                self.ends.push(self.nodes.len());
                self.nodes.push(node);
            }
        }
    }
}

fn same(a: &Node, b: &Node) -> bool {
    let grips = |node: &Node| node.tracked.state.grips.map(|grip| grip.map(|grip| (grip.object, grip.side)));
    let near = |(a, b): (&Body, &Body)| {
        (a.position - b.position).abs().max_element() < SAME
            && (a.velocity - b.velocity).abs().max_element() < SAME
            && (a.angle - b.angle).abs() < SAME
    };
    a.reading == b.reading
        && a.tracked.late == b.tracked.late
        && grips(a) == grips(b)
        && a.tracked.state.bodies.iter().zip(&b.tracked.state.bodies).all(near)
}

/// Corrects a state by what was observed.
fn correct(
    node: &mut Node,
    replay: &Replay,
    differences: &[Difference; MAX_ENTITIES],
    _row: &[Body; MAX_ENTITIES],
    between: &State,
) {
    let mut moved = false;
    for entity in replay.event.entities().map(Entity::index) {
        let difference = &differences[entity];
        if difference.square(replay.radii[entity]).sqrt() < EXACT {
            continue;
        }
        moved = true;
        let off = difference.position.length().max(difference.angle.abs());
        let body = &mut node.tracked.state.bodies[entity];
        *body = if off > RESET {
            // Of the angles that are observed alike, the nearest.
            let turned = replay.difference(body, &between.bodies, entity).angle;
            let angle = body.angle + turned;
            Body { angular_velocity: body.angular_velocity, angle, ..between.bodies[entity] }
        } else {
            difference.added_to(body)
        };
    }
    if moved && node.residual > 2.0 * CORRECTED {
        node.tracked = replay.at(node.tracked.state);
    }
}

/// Cost of a residual, in logarithms: a heavy-tailed distribution, since motion that cannot be explained does
/// occur.
pub(super) fn cost(residual: f32) -> f64 {
    let scaled = f64::from(residual) / RESIDUAL_SCALE;
    libm::log1p(scaled * scaled)
}
