//! A rover among rocks, some of which are worth sampling (Smith & Simmons 2004).

use crate::episodes::Problem;
use crate::layouts::Layout;
use crate::tour::{self, Step};
use phase_pomcp::{BeliefModel, GenerativeModel, PomcpSettings, Transition};
use rand::{Rng, RngExt};

/// Distance at which the accuracy of a check above chance is half of that from nearby (squares).
const HALF_EFFICIENCY: f64 = 20.0;
/// Reward of a good rock and of leaving to the east; a bad rock costs as much.
pub(crate) const REWARD: f64 = 10.0;
/// Cost of walking into a wall and of sampling where there is no rock.
const PENALTY: f64 = 100.0;
/// Weight of the next reward.
pub(crate) const DISCOUNT: f64 = 0.95;
/// The most rocks of a layout.
pub(crate) const MOST_ROCKS: usize = 15;
/// Unit steps north, east, south and west, the first four actions.
const MOVES: [[i8; 2]; 4] = [[0, 1], [1, 0], [0, -1], [-1, 0]];
const EAST: usize = 1;
/// The action of sampling the rock underneath; after it come the checks, one for each rock.
const SAMPLE: usize = 4;
const CHECK: usize = 5;

/// The problem on a map.
///
/// As in POMCP's and DESPOT's planners, walking into a wall and sampling where there is no rock are not
/// legal.
pub(crate) struct RockSample {
    pub(crate) layout: Layout,
}

/// A state of the problem.
#[derive(Clone, Copy)]
pub(crate) struct Rover {
    pub(crate) at: [i8; 2],
    /// Bits of the rocks that are good: hidden from the rover.
    good: u16,
    /// Bits of the rocks that have been sampled.
    taken: u16,
    /// The probability that each rock is good, given all checks so far: a function of the history.
    pub(crate) probability: [f64; MOST_ROCKS],
}

impl RockSample {
    pub(crate) fn new(layout: impl Into<Layout>) -> Self {
        Self { layout: layout.into() }
    }

    /// The rock underneath that has not been sampled yet.
    fn rock_below(&self, rover: &Rover) -> Option<usize> {
        self.layout.rocks.iter().position(|&rock| rock == rover.at).filter(|&rock| !rover.has_taken(rock))
    }

    fn is_inside(&self, place: [i8; 2]) -> bool {
        place.iter().all(|coordinate| (0..self.layout.side).contains(coordinate))
    }

    /// The probability that a check from here is correct.
    fn accuracy(&self, rover: &Rover, rock: usize) -> f64 {
        let rock = self.layout.rocks[rock];
        let [x, y] = [0, 1].map(|axis| f64::from(rock[axis] - rover.at[axis]));
        0.5 * (1.0 + libm::exp2(-libm::hypot(x, y) / HALF_EFFICIENCY))
    }

    fn check(&self, rover: &mut Rover, rock: usize, random: &mut impl Rng) -> bool {
        let accuracy = self.accuracy(rover, rock);
        let says_good = rover.is_good(rock) == random.random_bool(accuracy);
        let likelihood = if says_good { accuracy } else { 1.0 - accuracy };
        let good = rover.probability[rock] * likelihood;
        let bad = (1.0 - rover.probability[rock]) * (1.0 - likelihood);
        rover.probability[rock] = good / (good + bad);
        says_good
    }
}

impl Rover {
    fn is_good(&self, rock: usize) -> bool {
        self.good >> rock & 1 == 1
    }

    pub(crate) fn has_taken(&self, rock: usize) -> bool {
        self.taken >> rock & 1 == 1
    }
}

fn moved(at: [i8; 2], action: usize) -> [i8; 2] {
    [at[0] + MOVES[action][0], at[1] + MOVES[action][1]]
}

impl GenerativeModel for RockSample {
    type State = Rover;
    type Observation = Option<bool>; // result of a check

    fn action_count(&self) -> usize {
        CHECK + self.layout.rocks.len()
    }

    fn discount(&self) -> f64 {
        DISCOUNT
    }

    fn is_legal(&self, rover: &Rover, action: usize) -> bool {
        match action {
            EAST => true,
            0..SAMPLE => self.is_inside(moved(rover.at, action)),
            SAMPLE => self.rock_below(rover).is_some(),
            check => !rover.has_taken(check - CHECK),
        }
    }

    fn step(&self, rover: &mut Rover, action: usize, random: &mut impl Rng) -> Transition<Option<bool>> {
        let (mut observation, mut reward, mut terminal) = (None, 0.0, false);
        match action {
            0..SAMPLE => {
                let to = moved(rover.at, action);
                if self.is_inside(to) {
                    rover.at = to;
                } else if action == EAST {
                    (reward, terminal) = (REWARD, true);
                } else {
                    reward = -PENALTY;
                }
            }
            SAMPLE => match self.rock_below(rover) {
                Some(rock) => {
                    rover.taken |= 1 << rock;
                    reward = if rover.is_good(rock) { REWARD } else { -REWARD };
                }
                None => reward = -PENALTY,
            },
            check => observation = Some(self.check(rover, check - CHECK, random)),
        }
        Transition { observation, reward, terminal }
    }

    /// What a tour of the rocks earns that goes by the probabilities, in place of rollouts.
    fn value_estimate(&self, rover: &Rover) -> f64 {
        tour::best(&self.layout, rover).0
    }

    /// The tour's next action is much more likely than others; checks are the less likely the surer the rover
    /// is.
    fn prior_weights(&self, rover: &Rover, weights: &mut Vec<f64>) {
        let next = match tour::best(&self.layout, rover).1 {
            Step::Move(direction) => direction,
            Step::Sample => SAMPLE,
            Step::Check(rock) => CHECK + rock,
        };
        weights.extend((0..self.action_count()).map(|action| match action {
            action if action == next => PRIORS.next,
            0..SAMPLE => PRIORS.movement,
            SAMPLE => PRIORS.sample,
            check => {
                let p = rover.probability[check - CHECK];
                PRIORS.check * 4.0 * p * (1.0 - p) * (2.0 * self.accuracy(rover, check - CHECK) - 1.0)
            }
        }));
    }
}

/// Prior weights of actions: the tour's next, other movements, sampling, and checking a rock of which nothing
/// is known from nearby.
struct Priors {
    next: f64,
    movement: f64,
    sample: f64,
    check: f64,
}

const PRIORS: Priors = Priors { next: 4.0, movement: 0.5, sample: 0.1, check: 1.0 };

impl BeliefModel for RockSample {
    /// Rocks are independent, so all of them can be resampled given their checks, and the belief is exact.
    fn reinvigorate(&self, rover: &mut Rover, _: usize, _: &Option<bool>, random: &mut impl Rng) {
        for rock in 0..self.layout.rocks.len() {
            if !rover.has_taken(rock) {
                let bit = u16::from(random.random_bool(rover.probability[rock]));
                rover.good = rover.good & !(1 << rock) | bit << rock;
            }
        }
    }
}

impl Problem for RockSample {
    const SETTINGS: PomcpSettings = PomcpSettings {
        simulations: 1000,
        rollout_steps: 0,
        c_init: 1.0,
        c_base: 1e6,
        horizon: usize::MAX,
        normalise_values: true,
        stop_when_decided: false,
        convergence: 0.0,
        untried_first: false,
    };

    fn start(&self, random: &mut impl Rng) -> Rover {
        Rover { at: self.layout.start, good: random.random(), taken: 0, probability: [0.5; MOST_ROCKS] }
    }

    fn imagine(&self, _: &Rover, random: &mut impl Rng) -> Rover {
        self.start(random)
    }
}
