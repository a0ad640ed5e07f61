//! The random numbers of searches.

use crate::recorded::SEARCH_SEED;
use phase_model::random::Pcg64Mcg;
use rand::RngExt;
use rand_mt::Mt;
use serde::{Deserialize, Serialize};

/// The source of the random numbers of searches.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RandomNumbers {
    /// As in the original: Python's Mersenne Twister, begun anew with the same seed in every step, for both
    /// agents. A decision is then a function of state and belief alone, and a simulation under the true
    /// hypothesis repeats part of what was recorded.
    Original,
    /// From the seed of the simulation, so that chance is chance.
    #[default]
    Seeded,
}

/// A source of whole numbers.
pub(crate) trait Draws {
    /// A number below `count`, all equally likely. `count` is at least 1.
    fn below(&mut self, count: usize) -> usize;

    /// Brings the elements of a list into any order.
    fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            let chosen = self.below(last + 1);
            list.swap(last, chosen);
        }
    }
}

impl Draws for Pcg64Mcg {
    fn below(&mut self, count: usize) -> usize {
        self.random_range(0..count)
    }
}

/// Python's random numbers after `seed(1)`.
pub(crate) struct PythonStream {
    twister: Mt,
    /// Words drawn since the seed.
    drawn: u64,
}

impl PythonStream {
    /// The stream after this many words.
    pub(crate) fn after(drawn: u64) -> Self {
        let mut twister = Mt::new_with_key([SEARCH_SEED]);
        for _ in 0..drawn {
            twister.next_u32();
        }
        Self { twister, drawn }
    }

    /// Words drawn since the seed.
    pub(crate) const fn drawn(&self) -> u64 {
        self.drawn
    }
}

impl Draws for PythonStream {
    /// As `_randbelow`: as many bits as `count` has, again while they say too much.
    fn below(&mut self, count: usize) -> usize {
        let unused = (count as u32).leading_zeros();
        loop {
            self.drawn += 1;
            let word = (self.twister.next_u32() >> unused) as usize;
            if word < count {
                return word;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Draws, PythonStream};

    /// `random.seed(1)`, then `randint(0, 49)`, `choice(range(5))` and `shuffle` in Python 3.
    #[test]
    fn draws_are_pythons() {
        let mut stream = PythonStream::after(0);
        let numbers: Vec<usize> = (0..6).map(|_| stream.below(50)).collect();
        assert_eq!(numbers, [8, 36, 48, 4, 16, 7]);
        let mut list = [0, 1, 2, 3, 4];
        stream.shuffle(&mut list);
        let ones: Vec<usize> = (0..3).map(|_| stream.below(1)).collect();
        assert_eq!((list, ones), ([0, 2, 1, 4, 3], vec![0, 0, 0]));
        assert_eq!(PythonStream::after(stream.drawn()).below(1000), 29);
        let mut again = PythonStream::after(stream.drawn());
        assert_eq!(again.below(1000), stream.below(1000));
    }
}
