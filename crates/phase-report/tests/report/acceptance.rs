//! How many scenes were tried, as a table.

use phase_dataset::acceptance::{Refusal, Tally};
use phase_evidence::selection::RejectionReason;
use phase_report::acceptance::table;
use phase_sampler::Variant;

#[test]
fn reasons_come_from_the_most_frequent_down() {
    let mut tally = Tally::default();
    let refused = [RejectionReason::NoEffect, RejectionReason::NoFlight, RejectionReason::NoFlight]
        .map(|reason| Refusal { variant: Variant::Chase, reason });
    tally.add([Variant::Chase], &refused);
    tally.add([Variant::Lift], &[]);
    tally.add([Variant::Chase], &[]);
    let table = table(&tally.rows());
    assert!(table.contains("| chasing | chase | 2 | 5 | 40 % | no-flight 2, no-effect 1 |"), "{table}");
    assert!(table.contains("| helping | lift | 1 | 1 | 100 % | – |"), "{table}");
}
