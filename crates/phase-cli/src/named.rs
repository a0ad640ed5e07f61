//! Options whose values have names.

use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Reads one of some values by its name.
pub fn named<T: Copy + Send + Sync + 'static, const COUNT: usize>(
    all: [T; COUNT],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let of = move |given: String| all.into_iter().find(|it| name(*it) == given).ok_or("no such name");
    PossibleValuesParser::new(all.map(name)).try_map(of)
}
