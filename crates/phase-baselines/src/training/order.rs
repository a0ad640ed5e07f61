//! The order of training samples: an endless sequence of passes, cut into rounds.

use phase_model::random::{self, Pcg64Mcg, Purpose};
use rand::seq::SliceRandom;

/// The samples of a round (`number` from 1), in training order.
///
/// Each pass contains all samples once in its own random order; a round is the next `length` of them, across
/// pass boundaries. A pass's order depends only on (seed, number of the pass), so that training can resume at
/// any round.
pub(super) fn samples<T>(samples: &[T], seed: u64, number: usize, length: usize) -> Vec<&T> {
    let mut round = Vec::with_capacity(length);
    let mut place = number.saturating_sub(1).saturating_mul(length);
    while round.len() < length && !samples.is_empty() {
        let mut pass: Vec<&T> = samples.iter().collect();
        pass.shuffle(&mut random_of_pass(seed, place / samples.len()));
        let rest = pass.iter().skip(place % samples.len()).take(length - round.len());
        let before = round.len();
        round.extend(rest);
        place = place.saturating_add(round.len() - before);
    }
    round
}

/// The random stream of a network in a round. Index 0 is that of the initial weights; rounds and passes take
/// even and odd ones.
pub(super) fn random_of_round(seed: u64, number: usize) -> Pcg64Mcg {
    random::stream(seed, Purpose::Training, 2 * number as u64)
}

fn random_of_pass(seed: u64, number: usize) -> Pcg64Mcg {
    random::stream(seed, Purpose::Training, 2 * number as u64 + 1)
}
