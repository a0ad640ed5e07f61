//! `phase-ratings/1`: how people rated the relations of events.

use core::ops::AddAssign;
use phase_event::EventReadError;
use phase_model::json::{Field, FieldError, check_format};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// The value of the field `format` of ratings.
pub const RATINGS_FORMAT: &str = "phase-ratings/1";

/// Most raters that one event may have in a file.
const MAX_RATERS: i64 = 1_000_000;

/// Numbers of people who called an event friendly, adversarial and neutral.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RatingCounts {
    /// Number of people who called it friendly.
    pub friendly: usize,
    /// Adversarial.
    pub adversarial: usize,
    /// Neutral.
    pub neutral: usize,
}

impl RatingCounts {
    /// The counts in the order of [`RELATIONS`](crate::goals::RELATIONS).
    #[must_use]
    pub const fn counts(&self) -> [usize; 3] {
        [self.friendly, self.adversarial, self.neutral]
    }

    /// Number of raters.
    #[must_use]
    pub const fn raters(&self) -> usize {
        self.friendly + self.adversarial + self.neutral
    }
}

impl AddAssign for RatingCounts {
    fn add_assign(&mut self, other: Self) {
        self.friendly += other.friendly;
        self.adversarial += other.adversarial;
        self.neutral += other.neutral;
    }
}

/// Reads ratings by the ids of their events:
/// `{"format": "phase-ratings/1", "ratings": {id: {"friendly", "neutral", "adversarial"}…}}`, whole numbers,
/// at least one rater an event.
///
/// # Errors
/// If the format is another, there is no event, a field is missing or of the wrong type, or an event has no
/// rater.
pub fn ratings(value: &Value) -> Result<BTreeMap<String, RatingCounts>, EventReadError> {
    check_format(value, RATINGS_FORMAT)?;
    let of_file = |problem| EventReadError::Field { event: None, problem };
    let root = Field::root(value);
    root.only(&["format", "ratings"]).map_err(of_file)?;
    let field = root.required("ratings").map_err(of_file)?;
    let Some(members) = field.value().as_object() else {
        return Err(of_file(field.must_be("an object with a member for each event")));
    };
    let mut ratings = BTreeMap::new();
    for (id, value) in members {
        let of_event = |problem| EventReadError::Field { event: Some(id.clone()), problem };
        ratings.insert(id.clone(), counts(&Field::root(value)).map_err(of_event)?);
    }
    if ratings.is_empty() {
        return Err(of_file(field.error("must hold at least one event")));
    }
    Ok(ratings)
}

fn counts(event: &Field<'_>) -> Result<RatingCounts, FieldError> {
    event.only(&["friendly", "neutral", "adversarial"])?;
    let count = |name| {
        let number = event.required(name)?.whole(0, MAX_RATERS)?;
        Ok(usize::try_from(number).unwrap_or_default())
    };
    let counts = RatingCounts {
        friendly: count("friendly")?,
        adversarial: count("adversarial")?,
        neutral: count("neutral")?,
    };
    if counts.raters() == 0 {
        return Err(FieldError { field: "ratings".into(), rule: "must have at least one rater".into() });
    }
    Ok(counts)
}
