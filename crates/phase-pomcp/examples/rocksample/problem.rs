//! The problem: a rover among rocks, some of which are worth sampling.

use crate::support::Problem;
use phase_pomcp::{GenerativeModel, Transition};
use rand::{Rng, RngExt};

/// Squares on a side.
const SIDE: i8 = 7;
/// Start of the rover: x to the east, y to the north.
const START: [i8; 2] = [0, 3];
/// Positions of the rocks in the published instance.
const ROCKS: [[i8; 2]; 8] = [[2, 0], [0, 1], [3, 1], [6, 3], [2, 4], [3, 4], [5, 5], [1, 6]];
/// Distance at which the accuracy of a check above chance is half of that from nearby (squares).
const HALF_EFFICIENCY: f64 = 20.0;
/// Unit steps north, east, south and west, the first four actions.
const MOVES: [[i8; 2]; 4] = [[0, 1], [1, 0], [0, -1], [-1, 0]];
const EAST: usize = 1;
/// The action of sampling the rock underneath; after it come the checks, one for each rock.
const SAMPLE: usize = 4;
const CHECK: usize = 5;

/// RockSample[7,8]: leaving to the east earns 10, sampling a good rock 10, a bad one −10; the probability
/// that a check is correct decreases with the distance from the rock.
///
/// In the literature, walking into a wall or sampling where there is no rock costs 100. Here it has no
/// effect, which is never worth a step either, so that the optimum is the same.
pub(crate) struct RockSample;

/// A state of the problem.
#[derive(Clone, Copy)]
pub(crate) struct Rover {
    at: [i8; 2],
    /// Which rocks are good: hidden from the rover.
    good: [bool; ROCKS.len()],
    taken: [bool; ROCKS.len()],
    /// Evidence from the checks so far about each rock: the logarithm of the odds that it is good.
    evidence: [f64; ROCKS.len()],
}

impl GenerativeModel for RockSample {
    type State = Rover;
    type Observation = Option<bool>; // result of a check

    fn action_count(&self) -> usize {
        CHECK + ROCKS.len()
    }

    fn discount(&self) -> f64 {
        0.95
    }

    fn step(&self, rover: &mut Rover, action: usize, random: &mut impl Rng) -> Transition<Option<bool>> {
        let (mut observation, mut reward, mut terminal) = (None, 0.0, false);
        match action {
            0..SAMPLE => {
                let to = [rover.at[0] + MOVES[action][0], rover.at[1] + MOVES[action][1]];
                if to.iter().all(|place| (0..SIDE).contains(place)) {
                    rover.at = to;
                } else if action == EAST {
                    (reward, terminal) = (10.0, true);
                }
            }
            SAMPLE => {
                if let Some(rock) = rover.rock_below() {
                    rover.taken[rock] = true;
                    reward = if rover.good[rock] { 10.0 } else { -10.0 };
                }
            }
            check => observation = rover.check(check - CHECK, random),
        }
        Transition { observation, reward, terminal }
    }

    /// From rock to rock, the closest promising one first; each is checked on the spot and sampled if good.
    fn rollout_action(&self, rover: &Rover, _: &mut impl Rng) -> usize {
        let promising = (0..ROCKS.len()).filter(|&rock| !rover.taken[rock] && rover.evidence[rock] >= 0.0);
        match promising.min_by_key(|&rock| rover.paces(rock)) {
            None => EAST,
            Some(rock) if rover.paces(rock) > 0 => rover.towards(rock),
            Some(rock) if rover.evidence[rock] == 0.0 => CHECK + rock,
            Some(_) => SAMPLE,
        }
    }

    /// Useless actions have a low prior, the rollout policy's action a high one.
    fn prior_weight(&self, rover: &Rover, action: usize) -> f64 {
        let is_useful = match action {
            EAST => true,
            0..SAMPLE => {
                let to = [rover.at[0] + MOVES[action][0], rover.at[1] + MOVES[action][1]];
                to.iter().all(|place| (0..SIDE).contains(place))
            }
            SAMPLE => rover.rock_below().is_some_and(|rock| rover.evidence[rock] >= 0.0),
            check => !rover.taken[check - CHECK] && rover.evidence[check - CHECK].is_finite(),
        };
        if is_useful { 1.0 } else { 0.01 }
    }

    /// The way out.
    fn value_estimate(&self, rover: &Rover) -> f64 {
        10.0 * self.discount().powi(i32::from(SIDE - 1 - rover.at[0]))
    }
}

impl Problem for RockSample {
    fn start(&self, random: &mut impl Rng) -> Rover {
        let good = ROCKS.map(|_| random.random());
        Rover { at: START, good, taken: [false; ROCKS.len()], evidence: [0.0; ROCKS.len()] }
    }

    /// Rocks are independent, so any one of them may be resampled given the results of its checks.
    fn reinvigorate(&self, rover: &mut Rover, random: &mut impl Rng) {
        let rock = random.random_range(0..ROCKS.len());
        if !rover.taken[rock] {
            rover.good[rock] = random.random_bool(1.0 / (1.0 + (-rover.evidence[rock]).exp()));
        }
    }
}

impl Rover {
    /// The rock underneath that has not been sampled yet.
    fn rock_below(&self) -> Option<usize> {
        (0..ROCKS.len()).find(|&rock| ROCKS[rock] == self.at && !self.taken[rock])
    }

    /// Steps to a rock.
    fn paces(&self, rock: usize) -> i8 {
        (ROCKS[rock][0] - self.at[0]).abs() + (ROCKS[rock][1] - self.at[1]).abs()
    }

    /// The move towards a rock, north and south first: a rover that has gone east need not come back.
    fn towards(&self, rock: usize) -> usize {
        let [x, y] = [ROCKS[rock][0] - self.at[0], ROCKS[rock][1] - self.at[1]];
        match (x.signum(), y.signum()) {
            (_, 1) => 0,
            (_, -1) => 2,
            (1, _) => EAST,
            _ => 3,
        }
    }

    /// Checks a rock from here; a check of a rock that has been taken is uninformative.
    fn check(&mut self, rock: usize, random: &mut impl Rng) -> Option<bool> {
        if self.taken[rock] {
            return None;
        }
        let offset = [ROCKS[rock][0] - self.at[0], ROCKS[rock][1] - self.at[1]].map(f64::from);
        let distance = offset[0].hypot(offset[1]);
        let accuracy = 0.5 * (1.0 + (-distance / HALF_EFFICIENCY).exp2());
        let says_good = self.good[rock] == random.random_bool(accuracy);
        let weight = (accuracy / (1.0 - accuracy)).ln();
        self.evidence[rock] += if says_good { weight } else { -weight };
        Some(says_good)
    }
}
