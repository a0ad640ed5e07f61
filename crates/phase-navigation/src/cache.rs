//! A bounded cache of results that depend on their key alone.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::{Arc, Mutex, PoisonError},
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
        self.find(&key).unwrap_or_else(|| self.keep(key, compute()))
    }

    fn find(&self, key: &Key) -> Option<Arc<T>> {
        self.entries.get(key).map(Arc::clone)
    }

    fn keep(&mut self, key: Key, result: T) -> Arc<T> {
        let entry = Arc::new(result);
        if self.entries.insert(key.clone(), Arc::clone(&entry)).is_none() {
            if self.oldest_first.len() == self.capacity
                && let Some(oldest) = self.oldest_first.pop_front()
            {
                self.entries.remove(&oldest);
            }
            self.oldest_first.push_back(key);
        }
        entry
    }
}

/// The result for a key in a cache that threads share, computed if it is not there while nobody waits.
pub(crate) fn get_shared<T>(cache: &Mutex<Cache<T>>, key: Key, compute: impl FnOnce() -> T) -> Arc<T> {
    let locked = || cache.lock().unwrap_or_else(PoisonError::into_inner);
    let known = locked().find(&key);
    known.unwrap_or_else(|| {
        let result = compute();
        locked().keep(key, result)
    })
}
