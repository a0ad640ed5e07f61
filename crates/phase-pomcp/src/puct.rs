//! PUCT selection, and the normalisation of values.

use crate::PomcpSettings;

/// The exploration factor shared by all actions of one history that has been visited `visits` times:
/// `(ln((1 + N + c_base) / c_base) + c_init) · √N` (Silver et al. 2018).
pub fn exploration(settings: &PomcpSettings, visits: u32) -> f64 {
    let visits = f64::from(visits);
    let rate = libm::log((1.0 + visits + settings.c_base) / settings.c_base) + settings.c_init;
    rate * visits.sqrt()
}

/// The PUCT score `Q(a) + P(a) · exploration / (1 + n(a))` of an action of value `value` and prior `prior`
/// that was chosen `visits` times; `exploration` is [`exploration`] of its history.
pub fn score(value: f64, prior: f64, exploration: f64, visits: u32) -> f64 {
    value + prior * exploration / (1.0 + f64::from(visits))
}

/// [`exploration`] by visits, each computed once: its logarithm costs more than the rest of a selection.
#[derive(Debug, Clone)]
pub(crate) struct ExplorationTable {
    factors: Vec<f64>,
}

/// Visits up to which factors are kept (half a megabyte); histories with more are few.
const GREATEST_KEPT: u32 = 1 << 16;

impl ExplorationTable {
    pub(crate) const EMPTY: Self = Self { factors: Vec::new() };

    /// `exploration(settings, visits)`; the settings must be the same in all calls.
    pub(crate) fn at(&mut self, settings: &PomcpSettings, visits: u32) -> f64 {
        if visits > GREATEST_KEPT {
            return exploration(settings, visits);
        }
        let kept = self.factors.len() as u32;
        self.factors.extend((kept..=visits).map(|visits| exploration(settings, visits)));
        self.factors[visits as usize]
    }
}

/// The minimum and maximum mean value of any action in the tree so far.
///
/// Means, not single returns, as in MuZero: the scale has to distinguish actions, and one unlucky rollout
/// deep in an average would only compress it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueRange {
    min: f64,
    max: f64,
}

impl ValueRange {
    /// The empty range.
    pub const EMPTY: Self = Self { min: f64::INFINITY, max: f64::NEG_INFINITY };

    /// Extends the range to include `value`.
    pub fn include(&mut self, value: f64) {
        self.min = self.min.min(value);
        self.max = self.max.max(value);
    }

    /// Maps a value within the range to 0..=1; to 0 where the range is a single value or empty, since it then
    /// distinguishes no actions.
    pub fn normalise(&self, value: f64) -> f64 {
        if self.max > self.min { (value - self.min) / (self.max - self.min) } else { 0.0 }
    }
}
