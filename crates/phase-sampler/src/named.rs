//! Scenes by the names of kinds and variants, given as text.

use crate::{SampleError, Variant, sample_kind, sample_variant};
use phase_model::{
    EventKind, Scene,
    random::{self, Purpose},
};
use rand::RngExt;
use thiserror::Error;

/// The reason why a scene cannot be sampled by name.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum NamedError {
    /// No kind has the name.
    #[error("kind must be one of {}, not {name:?}", EventKind::ALL.map(EventKind::name).join(", "))]
    Kind {
        /// The text that was given.
        name: String,
    },
    /// No variant of the kind has the name.
    #[error("variant must be one of {}, not {name:?}", names.join(", "))]
    Variant {
        /// The text that was given.
        name: String,
        /// The variants of the kind, or of all kinds.
        names: Vec<&'static str>,
    },
    /// No scene was found.
    #[error(transparent)]
    Sample(#[from] SampleError),
}

/// Draws a scene of a kind and a variant, of a kind, or of any of the six kinds; the same seed gives the same
/// scene.
///
/// # Errors
/// [`NamedError`].
pub fn sample_named(kind: Option<&str>, variant: Option<&str>, seed: u64) -> Result<Scene, NamedError> {
    let kind = kind.map(|name| EventKind::named(name).ok_or_else(|| NamedError::Kind { name: name.into() }));
    let kind = kind.transpose()?;
    let fits = |variant: &Variant| kind.is_none_or(|kind| variant.kind() == kind);
    let variant = variant.map(|name| {
        let found = Variant::ALL.into_iter().filter(fits).find(|variant| variant.name() == name);
        let names = || Variant::ALL.into_iter().filter(fits).map(Variant::name).collect();
        found.ok_or_else(|| NamedError::Variant { name: name.into(), names: names() })
    });
    let variant = variant.transpose()?;
    let mut random = random::stream(seed, Purpose::Scene, 0);
    Ok(match (variant, kind) {
        (Some(variant), _) => sample_variant(variant, &mut random)?,
        (None, Some(kind)) => sample_kind(kind, &mut random)?,
        (None, None) => {
            let kind = EventKind::ALL[random.random_range(0..EventKind::ALL.len())];
            sample_kind(kind, &mut random)?
        }
    })
}
