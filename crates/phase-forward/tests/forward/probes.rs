//! The published simulator's probes, replayed from their starts.

use crate::records;

use phase_calibration::{ColdForward, ErrorQuantiles, Probe, WarmForward};
use records::text;
use std::collections::BTreeMap;

/// The families of probes by the prefix of their names, with bounds on the position errors (u) of nine in ten
/// substeps: warm-started, and step by step without the cache.
const FAMILIES: [(&str, f32, f32); 16] = [
    ("free_action", 1e-5, 1e-5),
    ("free", 1e-5, 1e-5),
    ("stop", 1e-5, 1e-5),
    ("coast", 1e-5, 1e-5),
    ("item_coast", 1e-5, 1e-5),
    ("turn", 1e-5, 1e-5),
    ("wall", 1e-3, 1e-3),
    ("inner_wall", 1e-5, 1e-5),
    ("push", 1e-4, 1e-3),
    ("grab_pull", 1e-5, 5e-3),
    ("grab_turn", 1e-4, 1e-4),
    ("attach", 1.2e-5, 2e-3),
    ("carry", 1e-3, 5e-3),
    ("tug", 1e-5, 1e-5),
    ("items_collide", 1e-3, 1e-2),
    ("collide", 1e-3, 1e-3),
];
/// The maximum error of any warm-started substep (u).
const WORST: f32 = 0.005;

#[test]
fn probes_are_replayed() {
    let Some(text) = text("reference/probes.json") else { return };
    let probes = Probe::parse(&text).expect("good probes");
    let mut errors: BTreeMap<&str, [Vec<f32>; 2]> = BTreeMap::new();
    for probe in &probes {
        let family = FAMILIES.into_iter().find(|(family, ..)| probe.name.starts_with(family));
        let family = family.unwrap_or_else(|| panic!("{} is of no family", probe.name)).0;
        let (warm, cold) = (probe.follow::<WarmForward>(), probe.follow::<ColdForward>());
        assert!(warm.start.position < 1e-5, "{}: {:?} after the idle substep", probe.name, warm.start);
        assert_eq!(warm.grip_mismatches, 0, "{}", probe.name);
        for (errors, followed) in errors.entry(family).or_default().iter_mut().zip([warm, cold]) {
            errors.extend(followed.substeps.iter().map(|error| error.position));
        }
    }
    for (family, warm_limit, cold_limit) in FAMILIES {
        let [warm, cold] =
            errors[family].each_ref().map(|errors| ErrorQuantiles::of(errors).expect("some substeps"));
        println!("{family:<14} with memory {warm:.6?}, without {cold:.6?}");
        assert!(warm.p90 < warm_limit && cold.p90 < cold_limit && warm.max < WORST, "{family}");
    }
}
