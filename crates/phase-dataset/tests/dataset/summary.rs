//! Simulations against recordings.

use phase_dataset::{
    checksum::FileEntry,
    summary::{AgentComparison, Comparison, Summary, tabulate},
};
use phase_evidence::Outcome;
use phase_model::{EventKind, Goal, Sign};
use serde_json::json;
use std::fs;

fn outcome(steps: Option<usize>) -> Outcome {
    Outcome { reached: steps.is_some(), steps }
}

/// An event whose agents took these numbers of steps, recorded and simulated; `None` is never.
fn comparison(id: &str, kind: EventKind, agents: [(Option<usize>, Option<usize>); 2]) -> Comparison {
    Comparison {
        id: id.into(),
        kind,
        recorded_steps: 50,
        simulated_steps: 60,
        agents: agents.map(|(recorded, simulated)| AgentComparison {
            goal: Goal::AgentOnLandmark { agent: 0, landmark: 0, sign: Sign::Positive },
            alpha: 0,
            recorded: outcome(recorded),
            simulated: outcome(simulated),
        }),
        event: FileEntry { path: format!("{id}.json"), bytes: 0, sha256: String::new() },
        video: None,
    }
}

fn example() -> Vec<Comparison> {
    let mut start_only = comparison("d", EventKind::Chasing, [(None, None); 2]);
    start_only.recorded_steps = 0;
    vec![
        comparison("a", EventKind::Competing, [(Some(10), Some(20)), (None, None)]),
        comparison("b", EventKind::Competing, [(Some(31), Some(40)), (Some(12), None)]),
        comparison("c", EventKind::Helping, [(Some(20), Some(24)), (None, Some(9))]),
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
    let summary = Summary::new(json!({"seed": 1}), example());
    fs::write(&path, summary.to_json()).expect("written");
    let read = Summary::read(&path).expect("our own summary");
    assert_eq!(read, summary);
    read.verify(folder.path()).expect_err("the events' files are missing");
    fs::write(&path, "{\"format\": \"phase-dataset/1\"}").expect("written");
    assert!(Summary::read(&path).is_err());
}

#[test]
fn the_printed_table_has_a_line_for_each_row() {
    let table = Summary::new(json!({}), example()).table();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 1 + 3);
    assert!(lines[2].starts_with("competing") && lines[2].contains("3 of   4   75 %"), "{}", lines[2]);
    assert!(lines[3].starts_with("all"));
    let empty = Summary::new(json!({}), vec![]).table();
    assert!(empty.contains("all") && !empty.contains("NaN"), "{empty}");
}
