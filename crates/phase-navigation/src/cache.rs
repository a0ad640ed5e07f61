//! A bounded cache of results that depend on their key alone.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
};

/// The bits of a result's arguments.
pub(crate) type Key = Vec<u32>;

/// Keeps a number of results; the oldest goes first.
#[derive(Clone, Debug)]
pub(crate) struct Cache<T> {
    capacity: usize,
    entries: BTreeMap<Key, Arc<T>>,
    oldest_first: VecDeque<Key>,
}

impl<T> Cache<T> {
    pub(crate) const fn new(capacity: usize) -> Self {
        Self { capacity, entries: BTreeMap::new(), oldest_first: VecDeque::new() }
    }

    /// The result for a key, computed if it is not there.
    pub(crate) fn get(&mut self, key: Key, compute: impl FnOnce() -> T) -> Arc<T> {
        if let Some(entry) = self.entries.get(&key) {
            return Arc::clone(entry);
        }
        let entry = Arc::new(compute());
        if self.oldest_first.len() == self.capacity
            && let Some(oldest) = self.oldest_first.pop_front()
        {
            self.entries.remove(&oldest);
        }
        self.oldest_first.push_back(key.clone());
        self.entries.insert(key, Arc::clone(&entry));
        entry
    }
}
