//! Names of events and sets in files, which become names of files.

use phase_event::check_id;
use serde::{Deserialize, Deserializer, de::Error};

/// Reads a name that an event may have.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let id = String::deserialize(deserializer)?;
    match check_id(&id) {
        Ok(()) => Ok(id),
        Err(rule) => Err(Error::custom(format!("the id {id:?} {rule}"))),
    }
}
