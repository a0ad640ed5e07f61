//! Recordings and events for serde: written as in files, read by the validating reader.

use crate::{
    Event, EventWriteError, Recording, Trajectory,
    write::{EventMembers, is_event_finite, is_recording_finite},
};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};
use serde_json::Value;

/// The form of an element of the list `events` of a file.
impl Serialize for Recording {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if !is_recording_finite(self) {
            return Err(ser::Error::custom(EventWriteError::NotFinite(self.id.clone())));
        }
        EventMembers::of_recording(self).serialize(serializer)
    }
}

/// For self-describing formats such as JSON.
impl<'de> Deserialize<'de> for Recording {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::from_value(&Value::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

/// The form of an element of the list `events` of a file, without the members that only a [`Recording`] has.
impl Serialize for Event {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if !is_event_finite(self) {
            return Err(ser::Error::custom(
                "the event holds a number that is not finite and cannot be written",
            ));
        }
        EventMembers::of_event(self, &Trajectory::means(self)).serialize(serializer)
    }
}

/// For self-describing formats such as JSON.
impl<'de> Deserialize<'de> for Event {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::from_value(&Value::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}
