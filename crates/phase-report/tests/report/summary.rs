//! Simulations compared with recordings, as tables.

use phase_dataset::summary::{KindRow, MotionQuartiles, Quartiles};
use phase_model::EventKind;
use phase_report::summary::table;

fn row(kind: Option<EventKind>, own_matched: usize, ratio: f32) -> KindRow {
    let quartiles = Some(Quartiles { p25: 0.0, median: 0.0, p75: 1.0 });
    let speed = Some(Quartiles { p25: 2.0, median: 2.0, p75: 4.0 });
    let motion = MotionQuartiles { speed, path: quartiles, contact: quartiles };
    KindRow {
        kind,
        events: 3,
        agents: 4,
        matched: 3,
        own_agents: 6,
        own_matched,
        recorded_reached: 2,
        simulated_reached: 3,
        timed: 2,
        recorded_steps: Some(20.5),
        simulated_steps: None,
        time_ratio: Some(Quartiles { p25: 0.5, median: ratio, p75: 3.0 }),
        recorded_motion: motion,
        simulated_motion: motion,
    }
}

#[test]
fn the_tables_have_a_line_for_each_row() {
    let table = table(&[row(Some(EventKind::Competing), 6, 1.0), row(None, 4, 1.29)]);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), (1 + 2) + 1 + (1 + 2), "{table}");
    assert!(lines[1].starts_with("competing") && lines[1].contains("3 of   4   75 %"), "{}", lines[1]);
    assert!(lines[2].starts_with("all") && lines[6].starts_with("all"), "{table}");
    assert!(lines[6].contains("2.0 / 2.0 / 4.0") && lines[6].contains("0 / 0 / 100"), "{}", lines[6]);
    // 4 of 6 agents with positive goals of their own as recorded, in 1.29 times the steps.
    assert!(lines[2].contains("4 of   6   67 %") && lines[2].contains("1.29"), "{}", lines[2]);
}

#[test]
fn without_events_nothing_is_divided_by_zero() {
    let empty = KindRow {
        events: 0,
        agents: 0,
        matched: 0,
        own_agents: 0,
        time_ratio: None,
        recorded_motion: MotionQuartiles::default(),
        simulated_motion: MotionQuartiles::default(),
        ..row(None, 0, 1.0)
    };
    let table = table(&[empty]);
    assert!(table.contains("all") && !table.contains("NaN") && !table.contains("inf"), "{table}");
}
