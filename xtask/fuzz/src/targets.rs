//! The targets: functions of some bytes that panic if anything is wrong.
//!
//! A reader may refuse any input, but must not panic, and what it accepts must be written and read again
//! unchanged where there is a writer.

mod engines;
mod files;
mod searches;
mod texts;

/// A function of some bytes that panics if anything is wrong.
pub type Check = fn(&[u8]);

/// Every target, by its name.
pub const TARGETS: [(&str, Check); 25] = [
    ("events", texts::events),
    ("scene", texts::scene),
    ("preset", texts::preset),
    ("paths", texts::paths),
    ("settings", texts::settings),
    ("predictions", texts::predictions),
    ("ratings", texts::ratings),
    ("jspsych", texts::jspsych),
    ("journal", texts::journal),
    ("message", texts::message),
    ("study", texts::study),
    ("answers", texts::answers),
    ("forms", texts::forms),
    ("report_model", texts::report_model),
    ("calibration", texts::calibration),
    ("weights", texts::weights),
    ("table", texts::table),
    ("pictures", texts::pictures),
    ("shapes", texts::shapes),
    ("manifest", files::manifest),
    ("records", files::records),
    ("world", engines::world),
    ("kernel", engines::kernel),
    ("planner", searches::planner),
    ("pomcp", searches::pomcp),
];

/// The target of a name.
#[must_use]
pub fn named(name: &str) -> Option<Check> {
    TARGETS.into_iter().find(|(other, _)| *other == name).map(|(_, check)| check)
}
