//! The choice of the scenes of a game.

use phase_model::{
    Scene,
    random::{Purpose, stream},
};
use rand::RngExt as _;

/// A scene that can be played.
#[derive(Clone, PartialEq, Debug)]
pub struct Item {
    /// Id of the event that it was taken from.
    pub source: String,
    /// The scene.
    pub scene: Scene,
}

/// Scenes, and how often each was given to a game.
#[derive(Clone, Debug)]
pub struct Playlist {
    items: Vec<Item>,
    given: Vec<u32>,
    seed: u64,
    games: u64,
}

impl Playlist {
    /// Scenes that nobody has played.
    #[must_use]
    pub fn new(items: Vec<Item>, seed: u64) -> Self {
        Self { given: vec![0; items.len()], items, seed, games: 0 }
    }

    /// Number of scenes.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Ids of the events that scenes were taken from, with the number of times that each was given out.
    pub fn given(&self) -> impl Iterator<Item = (&str, u32)> {
        self.items.iter().map(|item| item.source.as_str()).zip(self.given.iter().copied())
    }

    /// Notes that a game has a scene already, one that was opened before this list was made.
    pub fn note(&mut self, source: &str) {
        if let Some(k) = self.items.iter().position(|item| item.source == source) {
            self.given[k] += 1;
        }
    }

    /// Different scenes for one game, at most so many: those given least often, ties at random, in random
    /// order.
    pub fn draw(&mut self, count: usize) -> Vec<Item> {
        let mut random = stream(self.seed, Purpose::Scene, self.games);
        self.games += 1;
        let mut ranked: Vec<(u32, u64, usize)> =
            self.given.iter().enumerate().map(|(k, &given)| (given, random.random(), k)).collect();
        ranked.sort_unstable();
        ranked.truncate(count);
        ranked.sort_unstable_by_key(|&(_, chance, _)| chance);
        ranked
            .into_iter()
            .map(|(_, _, k)| {
                self.given[k] += 1;
                self.items[k].clone()
            })
            .collect()
    }
}
