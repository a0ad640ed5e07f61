//! Independent random streams, each derived from (seed, purpose, index) and never shared.

use rand::SeedableRng;
pub use rand_pcg::Pcg64Mcg;

/// The purpose of a random stream. Streams of different purposes are independent, whatever the seed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u64)]
pub enum Purpose {
    /// Sampling a scene.
    Scene = 1,
    /// Drawing and redrawing an agent's belief particles.
    Belief = 2,
    /// An agent's low-level search.
    Search = 3,
    /// Seeds of the events of a dataset.
    Event = 4,
    /// Attempts at one event of a dataset.
    Attempt = 5,
    /// Proposals of an inference.
    Inference = 6,
    /// Sampled lengths of events.
    Length = 7,
    /// Random draws of a perception method on one event, by the hash of its id.
    Evaluation = 8,
    /// Resampling events for an interval.
    Bootstrap = 9,
    /// Initial weights of a network (index 0) and random draws of its training (by epoch, or by round and
    /// pass, from 1).
    Training = 10,
    /// Stages that events of several kinds share.
    Stage = 11,
    /// Videos for a rater of a study (by the rater's number).
    Assignment = 12,
}

/// A generator for one purpose and one index (an event's number, an agent's number, a step …).
#[must_use]
pub fn stream(seed: u64, purpose: Purpose, index: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(derive_seed(seed, purpose, index))
}

/// The seed of [`stream`], for code that derives further streams from it.
#[must_use]
pub fn derive_seed(seed: u64, purpose: Purpose, index: u64) -> u64 {
    mix(mix(mix(seed) ^ purpose as u64) ^ index)
}

/// The finaliser of SplitMix64: a bijection that spreads every input bit over the whole word.
fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}
