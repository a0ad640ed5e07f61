//! Acceptance: the scenes that were tried for the events of a dataset, and the reasons why most were refused.

use phase_evidence::selection::RejectionReason;
use phase_sampler::Variant;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Why an attempt was rejected.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refusal {
    /// The variant of the event that did not show its label.
    pub variant: Variant,
    /// Why.
    pub reason: RejectionReason,
}

/// The share of the scenes of one variant that showed their label.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Acceptance {
    /// The variant.
    pub variant: Variant,
    /// Events accepted.
    pub events: usize,
    /// Scenes simulated for them.
    pub attempts: usize,
    /// Numbers of scenes that were refused, by reason.
    pub refused: BTreeMap<RejectionReason, usize>,
}

/// Counts attempts by variant, one slot after the other.
#[derive(Clone, Debug, Default)]
pub struct Tally(BTreeMap<Variant, Acceptance>);

impl Tally {
    /// Adds the attempts at one slot: the variants of its events, and what was refused. Events of a set that
    /// were dropped because another of the set was refused do not count.
    pub fn add(&mut self, accepted: impl IntoIterator<Item = Variant>, refused: &[Refusal]) {
        for variant in accepted {
            let row = self.row(variant);
            row.events += 1;
            row.attempts += 1;
        }
        for refusal in refused {
            let row = self.row(refusal.variant);
            row.attempts += 1;
            *row.refused.entry(refusal.reason).or_default() += 1;
        }
    }

    fn row(&mut self, variant: Variant) -> &mut Acceptance {
        let empty = || Acceptance { variant, events: 0, attempts: 0, refused: BTreeMap::new() };
        self.0.entry(variant).or_insert_with(empty)
    }

    /// The counts, in the order of [`Variant::ALL`].
    #[must_use]
    pub fn rows(self) -> Vec<Acceptance> {
        self.0.into_values().collect()
    }
}
