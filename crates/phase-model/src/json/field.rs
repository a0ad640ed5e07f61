//! The fields of a JSON document, each of which knows its path.

use super::{FieldError, similar::nearest};
use crate::foreign;
use serde_json::{Map, Value};

/// A value in a JSON tree and the path that leads to it.
#[derive(Clone, Debug)]
pub struct Field<'a> {
    value: &'a Value,
    path: String,
}

impl<'a> Field<'a> {
    /// The root of a tree, which has no path.
    #[must_use]
    pub const fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    /// The value.
    #[must_use]
    pub const fn value(&self) -> &'a Value {
        self.value
    }

    /// An error about this field: `rule` continues the sentence that begins with the field's name.
    #[must_use]
    pub fn error(&self, rule: impl Into<String>) -> FieldError {
        FieldError { field: self.path.clone(), rule: rule.into() }
    }

    /// An error that states what the field must be and what it is instead.
    #[must_use]
    pub fn must_be(&self, what: &str) -> FieldError {
        self.error(format!("must be {what}, not {}", shown(self.value)))
    }

    /// A member of an object; `None` if it is absent or null.
    ///
    /// # Errors
    /// If this is not an object.
    pub fn optional(&self, key: &str) -> Result<Option<Field<'a>>, FieldError> {
        let value = self.object()?.get(key).filter(|value| !value.is_null());
        Ok(value.map(|value| Field { value, path: self.path_of(key) }))
    }

    /// A required member of an object; it may be null.
    ///
    /// # Errors
    /// If it is absent or this is not an object.
    pub fn required(&self, key: &str) -> Result<Field<'a>, FieldError> {
        let path = self.path_of(key);
        match self.object()?.get(key) {
            Some(value) => Ok(Field { value, path }),
            None => Err(FieldError { field: path, rule: "is missing".into() }),
        }
    }

    /// Checks that an object has no members but these, except those whose names begin with `_`, which are
    /// reserved for user annotations.
    ///
    /// # Errors
    /// Names the first unknown member, and the intended one if the spelling of a known member is close.
    pub fn only(&self, keys: &[&str]) -> Result<(), FieldError> {
        let is_unknown = |key: &&String| !key.starts_with('_') && !keys.contains(&key.as_str());
        let Some(key) = self.object()?.keys().find(is_unknown) else { return Ok(()) };
        let rule = match nearest(key, keys) {
            Some(meant) => format!("is unknown; did you mean `{meant}`?"),
            None if keys.is_empty() => "is unknown; there are no members".into(),
            None => format!("is unknown; expected are {}", keys.join(", ")),
        };
        Err(FieldError { field: self.path_of(key), rule })
    }

    /// The elements of an array.
    ///
    /// # Errors
    /// If this is not an array.
    pub fn items(&self) -> Result<impl ExactSizeIterator<Item = Field<'a>> + use<'a>, FieldError> {
        let path = self.path.clone();
        let items = self.array()?.iter().enumerate();
        Ok(items.map(move |(k, value)| Field { value, path: format!("{path}[{k}]") }))
    }

    /// The array itself, for long arrays whose elements do not need a path each.
    ///
    /// # Errors
    /// If this is not an array.
    pub fn array(&self) -> Result<&'a Vec<Value>, FieldError> {
        self.value.as_array().ok_or_else(|| self.must_be("an array"))
    }

    /// A string.
    ///
    /// # Errors
    /// If this is not a string.
    pub fn text(&self) -> Result<&'a str, FieldError> {
        self.value.as_str().ok_or_else(|| self.must_be("a text"))
    }

    /// A number representable in single precision.
    ///
    /// # Errors
    /// If this is not such a number.
    pub fn number(&self) -> Result<f32, FieldError> {
        finite(self.value).ok_or_else(|| self.must_be("a finite number"))
    }

    /// An integer in a range.
    ///
    /// # Errors
    /// If this is not such an integer.
    pub fn whole(&self, from: i64, to: i64) -> Result<i64, FieldError> {
        let number = self.value.as_i64().filter(|number| (from..=to).contains(number));
        number.ok_or_else(|| self.must_be(&format!("a whole number from {from} to {to}")))
    }

    /// The id or entity with this number, out of several in order from 0.
    ///
    /// # Errors
    /// If this is not a valid number.
    pub fn id<T: Copy>(&self, ids: &[T]) -> Result<T, FieldError> {
        let number = self.whole(0, ids.len() as i64 - 1)?;
        Ok(ids[number as usize])
    }

    /// One of a few words, or of other named values.
    ///
    /// # Errors
    /// Lists the valid names if this is not one of them.
    pub fn one_of<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, FieldError> {
        let found = self.value.as_str().and_then(|text| choices.iter().find(|(name, _)| *name == text));
        found.map(|(_, choice)| *choice).ok_or_else(|| {
            let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
            self.must_be(&format!("one of {}", names.join(", ")))
        })
    }

    fn object(&self) -> Result<&'a Map<String, Value>, FieldError> {
        self.value.as_object().ok_or_else(|| self.must_be("an object"))
    }

    fn path_of(&self, key: &str) -> String {
        let key = foreign::name(key);
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }
}

/// A number representable in single precision.
#[must_use]
pub fn finite(value: &Value) -> Option<f32> {
    value.as_f64().map(|number| number as f32).filter(|number| number.is_finite())
}

/// A value as in the file, truncated, with unseen letters written out.
#[must_use]
pub fn shown(value: &Value) -> String {
    const LONGEST: usize = 40;
    foreign::short(&value.to_string(), LONGEST).into_owned()
}
