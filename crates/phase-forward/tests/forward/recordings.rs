//! Long runs of the published simulator, and real recordings whose actions are known.

use crate::records;

use phase_calibration::{
    ColdForward, Deviation, Engine, HorizonErrors, Replay, Run, WarmForward, horizon_errors, replay_reports,
};
use phase_dataset::phase_events;
use phase_statistics::percentile;
use records::{path, text};

/// For several horizons in steps, bounds on nine in ten and 99 in 100 predictions (u): from a state alone,
/// and with the cache of a world newly set up in it.
const HORIZONS: [(usize, [f32; 2], [f32; 2]); 2] =
    [(1, [0.001, 0.03], [0.001, 0.03]), (10, [0.045, 1.5], [0.01, 1.0])];

#[test]
fn predictions_from_recorded_states_hold() {
    let Some(runs) = runs() else { return };
    for (horizon, alone, remembered) in HORIZONS {
        let check = |current: Option<HorizonErrors>, [p90, p99]: [f32; 2], how: &str| {
            let current = current.expect("runs that are long enough");
            println!("{horizon} steps ahead {how}: {current:.6?}");
            assert!(current.p90 < p90 && current.p99 < p99, "{horizon} steps ahead {how}");
        };
        check(horizon_errors::<ColdForward>(&runs, horizon), alone, "from a state alone");
        check(horizon_errors::<WarmForward>(&runs, horizon), remembered, "with fresh memory");
    }
}

#[test]
fn long_runs_are_followed() {
    /// Bound on nine in ten steps (u).
    const LIMIT: f32 = 1e-4;
    let Some(runs) = runs() else { return };
    let mut errors = Vec::new();
    for run in &runs {
        let mut kernel = WarmForward::set_up(&run.physics, &run.states[0]);
        kernel.settle();
        // The cache carries over from step to step while the bodies are reset to the record.
        for (&actions, recorded) in run.actions.iter().zip(&run.states[1..]) {
            kernel.step(actions);
            let deviation = Deviation::between(&run.physics, &kernel.state.bodies, &recorded.bodies);
            errors.push(deviation.position);
            kernel.state.bodies = recorded.bodies;
        }
    }
    let [p50, p90, p99] = [50, 90, 99].map(|share| percentile(&errors, share).expect("some steps"));
    println!("one step ahead with true memory: p50 {p50:.6} p90 {p90:.6} p99 {p99:.6}");
    assert!(p90 < LIMIT);
}

#[test]
fn real_recordings_are_replayed() {
    /// The maximum error of any step's mean position, up to the last known action (u).
    const LIMIT: f32 = 0.02;
    let Some(path) = path("real-phase/dev.json") else { return };
    let recordings = phase_events::read(&path).expect("good recordings");
    let replays: Vec<_> = recordings.iter().filter_map(Replay::of_recording).collect();
    let known = recordings.iter().filter(|recording| recording.recovered_actions.is_some()).count();
    assert!(!replays.is_empty() && replays.len() == known, "{} of {known} recordings", replays.len());
    for report in replay_reports::<WarmForward>(&replays) {
        println!("{}: {} steps, {:.6?}", report.id, report.steps, report.position);
        assert!(report.position.max < LIMIT, "{}", report.id);
    }
}

fn runs() -> Option<Vec<Run>> {
    Some(Run::parse(&text("reference/runs.json")?).expect("good runs"))
}
