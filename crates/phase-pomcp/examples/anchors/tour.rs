//! A tour of the rocks that is known in advance: what the planner knows of RockSample beside its rules.

use crate::layouts::Layout;
use crate::rocksample::{DISCOUNT, MOST_ROCKS, REWARD, Rover};

/// The first step of a tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step {
    /// In a direction: north, east, south or west.
    Move(usize),
    Sample,
    Check(usize),
}

/// Probability from which a rock is sampled unchecked: checking it on the spot costs a step, which is worth
/// more than the mistake it prevents.
const SURE: f64 = 0.95;
/// Probability below which a rock is not visited.
const HOPELESS: f64 = 0.05;

/// A visit of a rock.
#[derive(Clone, Copy)]
struct Visit {
    rock: usize,
    /// Discounted reward to expect, and the discount to expect at the end.
    reward: f64,
    discount: f64,
}

/// The expected return of the tour that goes from rock to rock, checks each on the spot unless it is sure to
/// be good, samples it if it is good, and leaves when that is worth more than any visit; and the tour's first
/// step.
///
/// The next rock is the one whose visit earns most in relation to the time it takes: the order that is best
/// for jobs that do not depend on each other, which rocks do by their distances alone.
pub(crate) fn best(layout: &Layout, rover: &Rover) -> (f64, Step) {
    let mut open = [false; MOST_ROCKS];
    for (rock, open) in open.iter_mut().enumerate().take(layout.rocks.len()) {
        *open = !rover.has_taken(rock) && rover.probability[rock] > HOPELESS;
    }
    let (mut at, mut value, mut weight, mut first) = (rover.at, 0.0, 1.0, None);
    loop {
        let visits =
            (0..layout.rocks.len()).filter(|&rock| open[rock]).map(|rock| visit(layout, rover, at, rock));
        let index = |visit: &Visit| visit.reward / (1.0 - visit.discount);
        let next = visits.max_by(|a, b| index(a).total_cmp(&index(b)));
        let worth = next.filter(|visit| {
            visit.reward + visit.discount * exit(layout, layout.rocks[visit.rock]) > exit(layout, at)
        });
        let Some(visit) = worth else { break };
        first = first.or(Some(visit.rock));
        open[visit.rock] = false;
        at = layout.rocks[visit.rock];
        value += weight * visit.reward;
        weight *= visit.discount;
    }
    (value + weight * exit(layout, at), step(layout, rover, first))
}

fn visit(layout: &Layout, rover: &Rover, from: [i8; 2], rock: usize) -> Visit {
    let p = rover.probability[rock];
    let arrival = power(distance(from, layout.rocks[rock]));
    if p >= SURE {
        return Visit { rock, reward: arrival * REWARD * (2.0 * p - 1.0), discount: arrival * DISCOUNT };
    }
    let checked = arrival * DISCOUNT;
    Visit { rock, reward: checked * REWARD * p, discount: checked * (1.0 - p + p * DISCOUNT) }
}

/// What leaving from a place earns.
fn exit(layout: &Layout, from: [i8; 2]) -> f64 {
    REWARD * power(layout.side - 1 - from[0])
}

fn step(layout: &Layout, rover: &Rover, rock: Option<usize>) -> Step {
    let Some(rock) = rock else { return Step::Move(1) };
    let [x, y] = [0, 1].map(|axis| layout.rocks[rock][axis] - rover.at[axis]);
    match (x.signum(), y.signum()) {
        (0, 0) if rover.probability[rock] >= SURE => Step::Sample,
        (0, 0) => Step::Check(rock),
        // North and south first: who has gone east need not come back.
        (_, 1) => Step::Move(0),
        (_, -1) => Step::Move(2),
        (1, _) => Step::Move(1),
        _ => Step::Move(3),
    }
}

fn distance(from: [i8; 2], to: [i8; 2]) -> i8 {
    (from[0] - to[0]).abs() + (from[1] - to[1]).abs()
}

/// The discount after so many steps.
fn power(steps: i8) -> f64 {
    (0..steps).fold(1.0, |discount, _| discount * DISCOUNT)
}
