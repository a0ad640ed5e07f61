//! Settings that somebody chooses: their names, units and ranges, and the error of a value outside.
//!
//! A setting often decides how much memory and time a program takes. Each is declared once, as a [`Setting`]
//! beside the struct that holds its value, and whatever reads one (command line, file, Python) checks it
//! there. Upper bounds are far above what anybody needs, and low enough that one step stays within a few
//! gigabytes and minutes.
//!
//! ```
//! use phase_model::setting::EVENT_STEPS;
//!
//! assert_eq!(EVENT_STEPS.range(), "1 to 10000");
//! let refused = EVENT_STEPS.check(1e9).unwrap_err();
//! assert_eq!(refused.to_string(), "field `max_steps` must be 1 to 10000, not 1000000000");
//! let place = refused.within("settings").to_string();
//! assert_eq!(place, "field `settings.max_steps` must be 1 to 10000, not 1000000000");
//! ```

use crate::json::FieldError;
use thiserror::Error;

/// Longest event (steps of 0.25 s). A step keeps five states and two thoughts, some kilobytes: an event of
/// this length has tens of megabytes, and lasts 42 minutes; the paper's last 25 s.
pub const EVENT_STEPS: Setting = Setting::whole("max_steps", "steps", 1, 10_000);
/// Threads of one program. More than cores only cost memory: each has a stack of some megabytes.
pub const THREADS: Setting = Setting::whole("threads", "", 1, 1024);
/// Events of one dataset, whose descriptions are in memory at once.
pub const EVENTS: Setting = Setting::whole("events", "", 1, 1_000_000);
/// Rounds of a training, of 320 events each.
pub const ROUNDS: Setting = Setting::whole("rounds", "", 1, 1_000_000);

/// A number that somebody chooses: its name, its unit and the values that it may have.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Setting {
    /// Its name in files, such as `particles`.
    pub name: &'static str,
    /// Its unit; empty for a number of things or a share.
    pub unit: &'static str,
    /// The least value.
    pub low: f64,
    /// The greatest value.
    pub high: f64,
    /// The numbers between them that it may have.
    pub numbers: Numbers,
}

/// The numbers between the bounds of a setting that it may have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Numbers {
    /// Whole ones.
    Whole,
    /// All.
    All,
    /// All but the least.
    Above,
}

impl Setting {
    /// A whole number from `low` to `high`.
    #[must_use]
    pub const fn whole(name: &'static str, unit: &'static str, low: u32, high: u32) -> Self {
        Self { name, unit, low: low as f64, high: high as f64, numbers: Numbers::Whole }
    }

    /// A number from `low` to `high`.
    #[must_use]
    pub const fn real(name: &'static str, unit: &'static str, low: f64, high: f64) -> Self {
        Self { name, unit, low, high, numbers: Numbers::All }
    }

    /// A number above 0 and at most `high`.
    #[must_use]
    pub const fn positive(name: &'static str, unit: &'static str, high: f64) -> Self {
        Self { name, unit, low: 0.0, high, numbers: Numbers::Above }
    }

    /// The range in words, such as `1 to 10000`.
    #[must_use]
    pub fn range(&self) -> String {
        match self.numbers {
            Numbers::Whole | Numbers::All => format!("{} to {}", self.low, self.high),
            Numbers::Above => format!("above {}, to {}", self.low, self.high),
        }
    }

    /// The bounds of a setting that is a whole number, for a reader of command lines.
    #[must_use]
    pub const fn bounds(&self) -> core::ops::RangeInclusive<i64> {
        self.low as i64..=self.high as i64
    }

    /// The greatest value of a number of things.
    #[must_use]
    pub const fn most(&self) -> usize {
        self.high as usize
    }

    /// Checks a value.
    ///
    /// # Errors
    /// [`RangeError`], if it is not in the range.
    pub fn check(&self, value: f64) -> Result<(), RangeError> {
        // A number of 32 bits is read as 64: its bound is rounded as it is.
        let low = self.low.min(f64::from(self.low as f32));
        let high = self.high.max(f64::from(self.high as f32));
        let is_allowed = match self.numbers {
            Numbers::Whole => (self.low..=self.high).contains(&value) && value.fract() == 0.0,
            Numbers::All => (low..=high).contains(&value),
            Numbers::Above => value > self.low && value <= high,
        };
        if is_allowed {
            Ok(())
        } else {
            Err(RangeError { field: self.name.into(), range: self.range(), value })
        }
    }

    /// Checks a number of things and returns it.
    ///
    /// # Errors
    /// [`RangeError`], if it is not in the range.
    pub fn check_count(&self, count: usize) -> Result<usize, RangeError> {
        self.check(count as f64).map(|()| count)
    }
}

/// A setting whose value is outside of its range.
#[derive(Clone, PartialEq, Debug, Error)]
#[error("field `{field}` {}", self.rule())]
pub struct RangeError {
    /// The path of the setting, such as `settings.minds.particles`.
    pub field: String,
    /// The range in words.
    pub range: String,
    /// The value.
    pub value: f64,
}

impl RangeError {
    /// This error for a setting inside of another object, whose path goes before the setting's.
    #[must_use]
    pub fn within(self, path: &str) -> Self {
        let field = if path.is_empty() { self.field } else { format!("{path}.{}", self.field) };
        Self { field, ..self }
    }

    /// This error as that of a reader of JSON; `path` leads to the object that has the setting.
    #[must_use]
    pub fn at(self, path: &str) -> FieldError {
        let Self { field, .. } = self.clone().within(path);
        FieldError { field, rule: self.rule() }
    }

    /// The rule, as it follows on the name of the field.
    #[must_use]
    pub fn rule(&self) -> String {
        format!("must be {}, not {}", self.range, self.value)
    }
}

#[cfg(test)]
mod tests {
    use super::Setting;

    const COUNT: Setting = Setting::whole("count", "", 1, 5);
    const SHARE: Setting = Setting::real("share", "", 0.1, 0.7);
    const SCALE: Setting = Setting::positive("scale", "u", 10.0);

    #[test]
    fn bounds_belong_to_a_range_and_nothing_beyond_them_does() {
        for (setting, good, bad) in [
            (COUNT, vec![1.0, 5.0], vec![0.0, 6.0, 1.5, -1.0, u64::MAX as f64]),
            (SHARE, vec![0.1, 0.7, f64::from(0.1_f32), f64::from(0.7_f32)], vec![0.09, 0.71]),
            (SCALE, vec![f64::MIN_POSITIVE, 10.0], vec![0.0, -1.0, 10.1]),
        ] {
            assert!(good.iter().all(|&value| setting.check(value).is_ok()), "{setting:?}");
            for value in bad.into_iter().chain([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]) {
                let error = setting.check(value).unwrap_err();
                assert_eq!(error.field, setting.name);
                assert!(error.to_string().contains(&setting.range()), "{error}");
            }
        }
    }
}
