//! Those who have come and have not yet agreed or refused, of whom nothing is stored.

use crate::record::Millis;
use std::collections::{BTreeMap, HashMap, VecDeque};

/// Most of them that are remembered. Of more, those who came first are asked again.
const MOST: usize = 10_000;

type Digest = [u8; 32];
/// The time at which somebody came, and the members of the address that the study keeps.
type Came = (Millis, BTreeMap<String, String>);

/// Those who have come, by the digests of their tokens.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    by: HashMap<Digest, Came>,
    order: VecDeque<Digest>,
}

impl Waiting {
    /// Remembers somebody.
    pub(super) fn add(&mut self, digest: Digest, at: Millis, parameters: BTreeMap<String, String>) {
        if self.order.len() >= MOST
            && let Some(first) = self.order.pop_front()
        {
            self.by.remove(&first);
        }
        if self.by.insert(digest, (at, parameters)).is_none() {
            self.order.push_back(digest);
        }
    }

    /// Somebody who has come.
    pub(super) fn get(&self, digest: &Digest) -> Option<&Came> {
        self.by.get(digest)
    }

    /// Forgets somebody.
    pub(super) fn remove(&mut self, digest: &Digest) {
        if self.by.remove(digest).is_some() {
            self.order.retain(|other| other != digest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn so_many_are_remembered() {
        let digest = |k: usize| {
            let mut digest = [0; 32];
            digest[..8].copy_from_slice(&k.to_le_bytes());
            digest
        };
        let mut waiting = Waiting::default();
        (0..MOST + 5).for_each(|k| waiting.add(digest(k), 0, BTreeMap::new()));
        assert!(waiting.get(&digest(4)).is_none() && waiting.get(&digest(5)).is_some());
        waiting.remove(&digest(5));
        waiting.add(digest(6), 1, BTreeMap::new());
        assert_eq!((waiting.by.len(), waiting.order.len()), (MOST - 1, MOST - 1));
        assert_eq!(waiting.get(&digest(6)).map(|(at, _)| *at), Some(1));
    }
}
