//! The target that PHASE_FUZZ_TARGET names.

#![no_main]

use libfuzzer_sys::fuzz_target;
use phase_fuzz::targets::{self, Check};
use std::sync::LazyLock;

static CHECK: LazyLock<Check> = LazyLock::new(|| {
    let name = std::env::var("PHASE_FUZZ_TARGET").unwrap_or_default();
    targets::named(&name).unwrap_or_else(|| {
        let names = targets::TARGETS.map(|(name, _)| name).join(", ");
        panic!("PHASE_FUZZ_TARGET must be one of {names}, not {name:?}")
    })
});

fuzz_target!(|data: &[u8]| CHECK(data));
