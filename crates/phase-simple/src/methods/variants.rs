//! The named variants of SIMPLE.

use crate::{ChainSettings, InferenceSettings, StrengthSource, Update};

/// A named variant.
pub(super) struct Variant {
    /// The name on the command line, in results and in Python.
    pub(super) name: &'static str,
    /// Whether the intent network guides it.
    pub(super) guided: bool,
    /// The settings of its inference.
    pub(super) settings: fn() -> InferenceSettings,
}

/// Every variant. `simple` averages over both kinds of minds, `simple-knowledge` also over what agents know;
/// `simple-initial`, `simple-global` and `simple-local` are the paper's Algorithm 2 and its ablation with our
/// own minds; `simple-published…` are Algorithm 2 and its ablation with the published simulator's minds.
pub(super) const VARIANTS: [Variant; 11] = [
    Variant { name: "simple", guided: true, settings: InferenceSettings::averaged },
    Variant { name: "simple-knowledge", guided: true, settings: InferenceSettings::averaged_over_knowledge },
    unguided("simple-unguided", || InferenceSettings::averaged().searching()),
    unguided("simple-points", || InferenceSettings::averaged().without_collisions()),
    unguided("simple-initial", || resynchronised(Update::Initial)),
    unguided("simple-global", || resynchronised(Update::Global)),
    unguided("simple-local", || resynchronised(Update::Local)),
    unguided("simple-published", || published(Update::Local)),
    unguided("simple-published-global", || published(Update::Global)),
    unguided("simple-published-initial", || published(Update::Initial)),
    unguided("simple-published-dynamics", || {
        InferenceSettings::published(Update::Local, StrengthSource::InverseDynamics)
    }),
];

const fn unguided(name: &'static str, settings: fn() -> InferenceSettings) -> Variant {
    Variant { name, guided: false, settings }
}

fn resynchronised(update: Update) -> InferenceSettings {
    InferenceSettings::chains(ChainSettings::resynchronised(update))
}

fn published(update: Update) -> InferenceSettings {
    InferenceSettings::published(update, StrengthSource::Network)
}
