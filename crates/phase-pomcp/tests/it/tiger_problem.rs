//! The tiger problem (Kaelbling, Littman & Cassandra 1998), its exact solution, and a belief for it.

use phase_pomcp::{GenerativeModel, Transition};
use rand::{Rng, RngExt};

pub(crate) const LISTEN: usize = 0;
pub(crate) const OPEN_LEFT: usize = 1;
pub(crate) const OPEN_RIGHT: usize = 2;

/// Behind one of two doors is a tiger (−100), behind the other a treasure (+10). Listening costs 1 and
/// reveals the tiger's side with some accuracy; opening a door restarts the problem.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tiger {
    pub(crate) accuracy: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
}

/// The side heard; `None` after a door was opened, which is uninformative.
pub(crate) type Heard = Option<Side>;

impl Side {
    pub(crate) fn draw(left: f64, random: &mut impl Rng) -> Self {
        if random.random_bool(left) { Self::Left } else { Self::Right }
    }

    fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

impl GenerativeModel for Tiger {
    type State = Side;
    type Observation = Heard;

    fn action_count(&self) -> usize {
        3
    }

    fn discount(&self) -> f64 {
        0.95
    }

    fn step(&self, tiger: &mut Side, action: usize, random: &mut impl Rng) -> Transition<Heard> {
        let (observation, reward) = match action {
            LISTEN => {
                let truly = random.random_bool(self.accuracy);
                (Some(if truly { *tiger } else { tiger.other() }), -1.0)
            }
            door => {
                let opened = if door == OPEN_LEFT { Side::Left } else { Side::Right };
                let reward = if opened == *tiger { -100.0 } else { 10.0 };
                *tiger = Side::draw(0.5, random);
                (None, reward)
            }
        };
        Transition { observation, reward, terminal: false }
    }

    /// Opening doors blindly says nothing about the value of a belief, so rollouts only listen.
    fn rollout_action(&self, _: &Side, _: &mut impl Rng) -> usize {
        LISTEN
    }
}

impl Tiger {
    /// The exact optimal value of each action with `steps` steps to go, after hearing the tiger `lead` times
    /// more often on the left than on the right.
    ///
    /// The lead is a sufficient statistic, as observations are independent and a door restarts the problem,
    /// so this is plain backward induction over integers: no grid of beliefs, no sampling.
    pub(crate) fn exact(&self, steps: usize, lead: i32) -> [f64; 3] {
        let reach = steps as i32 + lead.abs();
        let index = |lead: i32| (lead + reach) as usize;
        let mut values = vec![0.0; 2 * reach as usize + 1];
        let mut result = [0.0; 3];
        for step in 1..=steps as i32 {
            let reset = values[index(0)];
            let mut next = values.clone();
            for now in (-reach + step)..=(reach - step) {
                let actions = self.back_up(now, reset, values[index(now + 1)], values[index(now - 1)]);
                next[index(now)] = actions.into_iter().fold(f64::NEG_INFINITY, f64::max);
                if now == lead {
                    result = actions;
                }
            }
            values = next;
        }
        result
    }

    fn back_up(&self, lead: i32, reset: f64, heard_left: f64, heard_right: f64) -> [f64; 3] {
        let left = self.probability_left(lead);
        let hear_left = left * self.accuracy + (1.0 - left) * (1.0 - self.accuracy);
        let discount = self.discount();
        [
            -1.0 + discount * (hear_left * heard_left + (1.0 - hear_left) * heard_right),
            -100.0 * left + 10.0 * (1.0 - left) + discount * reset,
            10.0 * left - 100.0 * (1.0 - left) + discount * reset,
        ]
    }

    /// The probability of the tiger being on the left at that lead (Bayes' rule with a uniform prior).
    pub(crate) fn probability_left(&self, lead: i32) -> f64 {
        1.0 / (1.0 + ((1.0 - self.accuracy) / self.accuracy).powi(lead))
    }

    /// Resamples a belief's particles in proportion to the likelihood of the observation.
    pub(crate) fn update(&self, belief: &mut [Side], heard: Heard, random: &mut impl Rng) {
        let left = match heard {
            None => 0.5,
            Some(side) => {
                let count = belief.iter().filter(|&&particle| particle == Side::Left).count() as f64;
                let likelihood = if side == Side::Left { self.accuracy } else { 1.0 - self.accuracy };
                let left = count * likelihood;
                left / (left + (belief.len() as f64 - count) * (1.0 - likelihood))
            }
        };
        belief.fill_with(|| Side::draw(left, random));
    }
}
