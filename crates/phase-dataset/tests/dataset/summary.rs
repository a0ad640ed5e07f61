//! Simulations compared with recordings.

use crate::support;
use phase_dataset::summary::{
    AgentComparison, EventComparison, MeasuredPair, Quartiles, RecordingSource, SimulationSummary, tabulate,
};
use phase_event::{Event, Recording};
use phase_evidence::{GoalOutcome, MotionStatistics};
use phase_files::measured;
use phase_model::{AgentId, EventKind, Goal, LandmarkId, Sign, arena::SUBSTEPS};
use serde_json::{Value, json};
use std::fs;

fn outcome(steps: Option<usize>) -> GoalOutcome {
    GoalOutcome { reached: steps.is_some(), steps }
}

/// An event whose agents took these numbers of steps, recorded and simulated; `None` is never. Agent 0 moved
/// at 2 u/s in the recording and at 1 u/s in the simulation, agent 1 at twice that and in contact.
fn pair(id: &str, kind: EventKind, agents: [(Option<usize>, Option<usize>); 2]) -> MeasuredPair {
    let motion = |speed: f32, contact_steps| MotionStatistics {
        speeds: vec![speed; 4],
        path: speed / 3.0,
        contact_steps,
    };
    let comparison = EventComparison {
        id: id.into(),
        source: RecordingSource { id: id.into(), seed: 1 },
        kind,
        recorded_steps: 50,
        simulated_steps: 60,
        compared_steps: 50,
        agents: agents.map(|(recorded, simulated)| AgentComparison {
            goal: Goal::AgentOnLandmark {
                agent: AgentId::ZERO,
                landmark: LandmarkId::TOP_LEFT,
                sign: Sign::Positive,
            },
            alpha: 0,
            recorded: outcome(recorded),
            simulated: outcome(simulated),
            recorded_motion: None,
            simulated_motion: None,
        }),
        event: serde_json::from_value(json!({ "path": format!("{id}.json"), "bytes": 0, "sha256": "" }))
            .expect("an entry"),
        video: None,
    };
    MeasuredPair {
        comparison,
        recorded: [motion(2.0, 0), motion(4.0, 4)],
        simulated: [motion(1.0, 0), motion(2.0, 1)],
    }
}

fn example() -> Vec<MeasuredPair> {
    let mut start_only = pair("d", EventKind::Chasing, [(None, None); 2]);
    start_only.comparison.recorded_steps = 0;
    start_only.recorded = Default::default();
    start_only.simulated = Default::default();
    vec![
        pair("a", EventKind::Competing, [(Some(10), Some(20)), (None, None)]),
        pair("b", EventKind::Competing, [(Some(31), Some(40)), (Some(12), None)]),
        pair("c", EventKind::Helping, [(Some(20), Some(24)), (None, Some(9))]),
        start_only,
    ]
}

#[test]
fn the_table_counts_by_kind_and_in_all() {
    let rows = tabulate(&example());
    let counts: Vec<_> = rows
        .iter()
        .map(|row| {
            (row.kind, row.events, row.agents, row.matched, row.recorded_reached, row.simulated_reached)
        })
        .collect();
    assert_eq!(
        counts,
        [
            (Some(EventKind::Helping), 1, 2, 1, 1, 2),
            (Some(EventKind::Competing), 2, 4, 3, 3, 2),
            (None, 3, 6, 4, 4, 4),
        ]
    );
    let medians: Vec<_> =
        rows.iter().map(|row| (row.timed, row.recorded_steps, row.simulated_steps)).collect();
    assert_eq!(
        medians,
        [(1, Some(20.0), Some(24.0)), (2, Some(20.5), Some(30.0)), (3, Some(20.0), Some(24.0))]
    );
}

#[test]
fn a_summary_is_read_as_it_was_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("summary.json");
    let summary = SimulationSummary::new(json!({"seed": 1}), example());
    summary.write(&path).expect("written");
    let read = SimulationSummary::read(&path).expect("our own summary");
    assert_eq!(read, summary);
    read.verify(folder.path()).expect_err("the events' files are missing");
    fs::write(&path, "{\"format\": \"phase-dataset/1\"}").expect("written");
    assert!(SimulationSummary::read(&path).is_err());
}

#[test]
fn an_older_summary_is_refused_by_its_format() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("summary.json");
    let older = json!({"format": "phase-simulation/1", "run": {}, "kinds": [], "events": []});
    fs::write(&path, older.to_string()).expect("written");
    let error = SimulationSummary::read(&path).expect_err("another format").to_string();
    assert!(error.contains("phase-simulation/2") && error.contains("phase-simulation/1"), "{error}");
}

#[test]
fn own_positive_goals_are_counted_apart() {
    let mut hindered = pair("a", EventKind::Hindering, [(None, None), (Some(10), None)]);
    let mut chase = pair("b", EventKind::Chasing, [(Some(5), Some(9)), (None, None)]);
    let mut helped = pair("c", EventKind::Helping, [(Some(10), Some(20)), (Some(10), Some(20))]);
    let negative =
        Goal::AgentOnLandmark { agent: AgentId::ONE, landmark: LandmarkId::TOP_LEFT, sign: Sign::Negative };
    hindered.comparison.agents[0].goal = negative;
    hindered.comparison.agents[0].alpha = -1;
    // A fleeing agent is neutral, but there is nothing to bring about.
    chase.comparison.agents[1].goal =
        Goal::Touch { agent: AgentId::ONE, other: AgentId::ZERO, sign: Sign::Negative };
    helped.comparison.agents[0].alpha = 1;
    let rows = tabulate(&[hindered, chase, helped]);
    let counts: Vec<_> =
        rows.iter().map(|row| (row.kind, row.matched, row.own_agents, row.own_matched)).collect();
    assert_eq!(
        counts,
        [
            (Some(EventKind::Helping), 2, 1, 1),
            (Some(EventKind::Hindering), 1, 1, 0),
            (Some(EventKind::Chasing), 2, 1, 1),
            (None, 5, 3, 2),
        ]
    );
}

#[test]
fn time_ratios_are_those_of_single_agents() {
    let pairs = [
        pair("a", EventKind::Competing, [(Some(10), Some(30)), (Some(40), Some(20))]),
        // Neither an agent that never arrives nor one that is there from the start has a ratio.
        pair("b", EventKind::Competing, [(Some(40), Some(40)), (Some(30), None)]),
        pair("c", EventKind::Competing, [(Some(0), Some(7)), (None, None)]),
    ];
    let row = tabulate(&pairs)[0];
    assert_eq!(row.timed, 3);
    assert_eq!(row.time_ratio, Some(Quartiles { p25: 0.5, median: 1.0, p75: 3.0 }));
}

#[test]
fn motion_is_pooled_over_events_agents_and_steps() {
    let mut long = pair("b", EventKind::Helping, [(None, None); 2]);
    long.recorded[0].speeds = vec![9.0; 20];
    let row = tabulate(&[pair("a", EventKind::Helping, [(None, None); 2]), long])[0];
    let quartiles = |p25, median, p75| Some(Quartiles { p25, median, p75 });
    // 4 steps at 2 u/s, 8 at 4 u/s, 20 at 9 u/s: the 8th is 4 u/s, the 16th 9 u/s.
    assert_eq!(row.recorded_motion.speed, quartiles(4.0, 9.0, 9.0));
    assert_eq!(row.simulated_motion.speed, quartiles(1.0, 1.0, 2.0));
    assert_eq!(row.simulated_motion.path, quartiles(1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0));
    assert_eq!(row.recorded_motion.contact, quartiles(0.0, 0.0, 1.0));
    assert_eq!(row.simulated_motion.contact, quartiles(0.0, 0.0, 0.25));
}

/// An event in which agent 0 moves on by `stride` in every substep (u, along x) and nothing else moves.
fn walk(steps: usize, stride: f32) -> Event {
    let mut event = support::plain_event(steps);
    let mut state = event.initial;
    for step in &mut event.steps {
        step.substeps = [(); SUBSTEPS].map(|()| {
            state.bodies[0].position.x += stride;
            state
        });
    }
    event
}

/// Rows are means over five substeps: the first lies three strides from the start, each other five from the
/// one before, and a step takes 1/12 s.
#[test]
fn a_pair_is_measured_over_the_steps_both_have() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = measured::write(folder.path(), "a-seed3.json", b"{}").expect("written");
    let recording = Recording::of_event("a", walk(6, 0.1), String::new(), Value::Null);
    let mut ours = walk(4, 0.05);
    // An object lies under agent 1 in the third and the fourth step.
    for step in &mut ours.steps[2..] {
        for state in &mut step.substeps {
            state.bodies[2].position = state.bodies[1].position;
        }
    }
    let pair = MeasuredPair::of(&recording, "a-seed3".into(), 3, &ours, (file, None));
    let kept = &pair.comparison;
    assert_eq!((kept.id.as_str(), kept.source.id.as_str(), kept.source.seed), ("a-seed3", "a", 3));
    assert_eq!((kept.recorded_steps, kept.simulated_steps, kept.compared_steps), (6, 4, 4));
    let near = |a: f32, b: f32| (a - b).abs() < 1e-3;
    for (motion, scale) in [(kept.agents[0].recorded_motion, 2.0), (kept.agents[0].simulated_motion, 1.0)] {
        let motion = motion.expect("four steps");
        assert!(near(motion.path, 0.9 * scale), "{motion:?}");
        assert!(near(motion.speed.p25, 1.8 * scale) && near(motion.speed.median, 3.0 * scale), "{motion:?}");
    }
    let contact = |agent: usize| {
        let agent = kept.agents[agent];
        [agent.recorded_motion, agent.simulated_motion].map(|motion| motion.expect("four steps").contact)
    };
    assert_eq!((contact(0), contact(1)), ([0.0, 0.0], [0.0, 0.5]));
}
