//! Many items at once: what comes back does not depend on the threads.

use phase_runs::{error::RunError, parallel::make_all};
use std::sync::{
    Mutex,
    atomic::{AtomicUsize, Ordering},
};

#[test]
fn results_are_in_order_whatever_the_threads() {
    for threads in 1..=4 {
        for count in [0, 1, 7, 100] {
            let made = make_all(threads, count, |k| Ok(Some(k * k))).expect("made");
            assert_eq!(made, Some((0..count).map(|k| k * k).collect()), "{threads} threads");
        }
    }
}

#[test]
fn items_are_begun_in_order() {
    let begun = Mutex::new(Vec::new());
    let note = |k| {
        begun.lock().expect("no panic").push(k);
        Ok(Some(()))
    };
    make_all(1, 20, note).expect("made");
    assert_eq!(begun.into_inner().expect("no panic"), (0..20).collect::<Vec<_>>());
}

/// A failure is told even where others were interrupted by it; of several, the first in order.
#[test]
fn the_first_failure_in_order_is_told() {
    for threads in 1..=4 {
        let failing = |k: usize| match k {
            3 | 40 => Err(RunError::Usage(format!("item {k}"))),
            5 => Ok(None),
            _ => Ok(Some(k)),
        };
        let error = make_all(threads, 50, failing).expect_err("two fail").to_string();
        assert_eq!(error, "item 3", "{threads} threads");
    }
}

#[test]
fn after_a_failure_nothing_new_is_begun() {
    let begun = AtomicUsize::new(0);
    let made = make_all(1, 1000, |_| -> Result<Option<()>, RunError> {
        begun.fetch_add(1, Ordering::Relaxed);
        Err(RunError::Usage("no".into()))
    });
    assert!(made.is_err());
    assert_eq!(begun.into_inner(), 1);
}

#[test]
fn an_interruption_is_no_result() {
    assert_eq!(make_all(2, 10, |k| Ok((k != 9).then_some(k))).expect("no failure"), None);
}
