//! The benchmark's report, with figures that are easily checked.

use phase_document::plot::{Axis, Series, line_chart};
use phase_eval::{
    Estimate,
    benchmark::{BENCHMARK_FORMAT, Benchmark, Curve, EventSet, Familiarity, Origin, Row, Subset, Training},
    goals::{self, Answer, ErrorBreakdown, Label, RecognisedEvent},
    trajectories::{Errors, ForecastEvent, ForecastSummary},
};
use phase_model::{AgentId, EventKind, Goal, Relation, RelationProbabilities, Sign};
use phase_report::evaluation::{self, LEADERBOARD_FORMAT, Measures, Score, Scores, Source};
use serde_json::{Value, json};

/// Events in which the agents always have these errors.
fn off_by(errors: &[f64]) -> ForecastSummary {
    let event = |(k, &error): (usize, &f64)| {
        let errors = Errors { ade: error, fde: error, by_step: vec![error] };
        ForecastEvent {
            id: format!("event-{k}"),
            kind: EventKind::Independent,
            relation: Relation::Neutral,
            steps: 1,
            agents: errors.clone(),
            entities: errors,
            samples: None,
            forecast: Vec::new(),
            cpu_seconds: Some(0.5),
            details: Value::Null,
        }
    };
    ForecastSummary::of(&errors.iter().enumerate().map(event).collect::<Vec<_>>(), 1).expect("events")
}

fn row(method: &str, origin: Origin, training: Option<usize>, error: f64) -> Row<ForecastSummary> {
    let part = |familiarity| Subset { familiarity, summary: off_by(&[error, error]) };
    Row {
        method: method.into(),
        origin,
        set: 0,
        training,
        summary: off_by(&[error; 3]),
        mistakes: None,
        parts: [Familiarity::SeenLayout, Familiarity::UnseenInteraction].map(part).to_vec(),
    }
}

fn training(events: usize) -> Training {
    let curve = Curve { measure: "agents".into(), training: vec![3.0, 2.0], validation: vec![4.0, 5.0] };
    Training {
        network: "stgat".into(),
        weights: 171_658,
        seed: 1,
        dataset: "phase-training".into(),
        events,
        round: 320,
        rounds: 2,
        best_round: Some(1),
        cpu_seconds: 90.0,
        curves: vec![curve],
    }
}

fn benchmark() -> Benchmark {
    let set = EventSet { name: "Made up".into(), label: "generated".into(), sha256: "0".into(), events: 3 };
    Benchmark {
        format: BENCHMARK_FORMAT.into(),
        generator: "test".into(),
        options: vec!["--data".into(), "out/made-up".into()],
        seed: 1,
        sets: vec![set],
        goals: Vec::new(),
        trajectories: vec![
            row("simple", Origin::Ours, None, 1.5),
            row("stgat", Origin::Ours, Some(1), 4.0),
            row("mine", Origin::Given, None, 3.0),
            row("stgat-80", Origin::Trained, Some(0), 8.0),
            row("stgat-320", Origin::Trained, Some(1), 4.0),
        ],
        // Trained for the curve first, as the command has it.
        trainings: vec![training(80), training(320)],
    }
}

/// Published rows come first, ours below; networks trained to show a curve are in their own table, fewest
/// events first.
#[test]
fn rows_stand_where_they_belong() {
    let text = evaluation::benchmark(&benchmark()).to_markdown();
    let place = |line: &str| text.find(line).unwrap_or_else(|| panic!("{line} in {text}"));
    let error = |error: &str| format!("{error} [{error}, {error}]");
    let ours = |name: &str, value: &str, cost: &str| {
        let [independent, social, all] = [&error(value), "–", &error(value)];
        format!(
            "| {name} | generated (3) | {independent} | {social} | {all} | {independent} | {social} | {all} | 0.5 | {cost} |"
        )
    };
    let in_order = [
        place("## Table 2"),
        place("| SIMPLE | paper, Table 2 | 3.39 | 4.14 | 3.84 | 4.42 | 5.75 | 5.23 | – | – |"),
        place(&ours("simple (ours)", "1.50", "–")),
        place("| Social-LSTM | paper, Table 2 |"),
        place("| STGAT | paper, Table 2 |"),
        place(&ours("stgat (ours)", "4.00", "1.5 CPU min on 320 events")),
        place(&ours("mine (predictions)", "3.00", "–")),
        place("| method | ADE, seen layouts (2) | FDE, seen layouts (2) | ADE, unseen layouts (0) |"),
        place(&format!("| mine (predictions) | {0} | {0} | – | – |", error("3.00"))),
        place("| stgat | 171658 | phase-training, seed 1 | 320 | 2 | 1 | 1.5 |"),
        place("(training-stgat.svg)"),
        place(&format!(
            "| stgat | phase-training | 80 | generated | {} | {} |",
            error("8.00"),
            error("8.00")
        )),
        place(&format!(
            "| stgat | phase-training | 320 | generated | {} | {} |",
            error("4.00"),
            error("4.00")
        )),
        place("(growth-ade.svg)"),
    ];
    assert!(in_order.is_sorted(), "{in_order:?}");
    assert!(!text.contains("stgat-80"), "{text}");
    // Two trainings of one kind, but one plot, of the one with the program's own weights.
    assert_eq!(text.matches("(training-stgat.svg)").count(), 1);
}

/// A method's row about goals in one event of which it said nothing.
fn goals_row(mistakes: ErrorBreakdown) -> Row<goals::RecognitionSummary> {
    let event = RecognisedEvent {
        id: "event".into(),
        answer: Answer {
            goals: Default::default(),
            relation: RelationProbabilities::default(),
            roles: None,
            reported: None,
        },
        label: Label {
            kind: EventKind::Independent,
            goals: [Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Positive }; 2],
            relation: Relation::Neutral,
            relation_human: None,
            set: None,
            layout_seen: None,
            role: None,
            ratings: None,
        },
        watched: Vec::new(),
        cpu_seconds: None,
        details: Value::Null,
    };
    let summary = goals::RecognitionSummary::of(&[event], 1).expect("an event");
    let part = |familiarity| Subset { familiarity, summary: summary.clone() };
    Row {
        method: "arg".into(),
        origin: Origin::Ours,
        set: 0,
        training: None,
        parts: [Familiarity::SeenLayout, Familiarity::UnseenInteraction].map(part).to_vec(),
        summary,
        mistakes: Some(mistakes),
    }
}

#[test]
fn mistakes_stand_in_their_columns() {
    let kinds = [[0, 6, 7], [8, 0, 9], [10, 11, 0]];
    let mistakes = ErrorBreakdown { right: 1, sign: 2, landmark: 3, entity: 4, both: 5, kinds, nothing: 12 };
    let mut benchmark = benchmark();
    benchmark.goals.push(goals_row(mistakes));
    let text = evaluation::benchmark(&benchmark).to_markdown();
    let line = "| arg (ours) | generated (1) | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | 9 | 10 | 11 | 12 |";
    assert!(text.contains(line), "{text}");
    let page = evaluation::page(&benchmark).expect("a page");
    let pictures: Vec<&str> = page.pictures.iter().map(|(file, _)| file.as_str()).collect();
    let expected = ["images/results-goals.svg", "images/results-relations.svg", "images/growth-ade.svg"];
    assert_eq!(pictures, expected);
    assert!(page.text.contains("](../images/results-goals.svg)"), "{}", page.text);
    assert!(!page.text.contains("\n\n\n"), "{}", page.text);
}

#[test]
fn without_networks_nothing_is_said_of_training() {
    let mut benchmark = benchmark();
    benchmark.trainings.clear();
    benchmark.trajectories.truncate(1);
    let text = evaluation::benchmark(&benchmark).to_markdown();
    assert!(!text.contains("## Training") && !text.contains("As training data grows"), "{text}");
}

#[test]
fn figures_for_programs() {
    let figures = serde_json::to_value(benchmark()).expect("JSON");
    let row = &figures["trajectories"][2];
    assert_eq!(
        (&row["method"], &row["origin"], &row["training"]),
        (&json!("mine"), &json!("given"), &Value::Null)
    );
    assert_eq!(row["summary"]["all"]["ade"], json!({ "value": 3.0, "low": 3.0, "high": 3.0 }));
    assert_eq!(row["parts"][1]["familiarity"], "unseen-interaction");
    assert_eq!(figures["trainings"][0]["curves"][0]["validation"], json!([4.0, 5.0]));
}

/// 80, 160, 320, 640 are equally far from each other.
#[test]
fn doubling_is_always_the_same_way() {
    let points = [80.0, 160.0, 320.0, 640.0, 40.0, -1.0].map(|x| (x, 0.0)).to_vec();
    let axes = [Axis::logarithmic("events", 80.0, 640.0), Axis::linear("y", 1.0)];
    let svg = line_chart("Growth", axes, &[Series { name: "ours", points: points.clone() }]);
    assert!(
        svg.contains("points=\"64.0,384.0 224.0,384.0 384.0,384.0 544.0,384.0 64.0,384.0 64.0,384.0\""),
        "{svg}"
    );
    for mark in ["80", "160", "320", "640"] {
        assert!(svg.contains(&format!("text-anchor=\"middle\">{mark}</text>")), "{mark} in {svg}");
    }
    // A single value, or none: all positions coincide.
    for (from, to) in [(80.0, 80.0), (0.0, 80.0), (f64::NAN, 1.0), (80.0, f64::INFINITY)] {
        let axes = [Axis::logarithmic("events", from, to), Axis::linear("y", 1.0)];
        let svg = line_chart("Growth", axes, &[Series { name: "ours", points: points.clone() }]);
        assert!(!svg.contains("NaN"), "{from} {to}: {svg}");
    }
}

#[test]
fn the_page_shows_the_same_figures_after_a_round_trip() {
    let benchmark = benchmark();
    let page = evaluation::page(&benchmark).expect("a page");
    let text = &page.text;
    assert!(
        text.contains("cargo xtask-networks benchmark --data out/made-up --figures data/results.json\n"),
        "{text}"
    );
    assert!(text.contains("Made up\n(3;"), "{text}");
    // Every section with something in it, and its heading alone on a line.
    for heading in ["# Results", "## Table 2: trajectories", "## Training", "## As training data grows"] {
        assert!(
            text.contains(&format!("\n\n{heading}\n\n")) || text.starts_with(heading),
            "{heading} in {text}"
        );
    }
    assert!(!text.contains("## Agreement") && !text.contains("## Minimal pairs"), "{text}");
    assert!(!text.contains("\n\n\n") && text.ends_with('\n') && !text.ends_with("\n\n"), "{text}");
    let pictures: Vec<&str> = page.pictures.iter().map(|(file, _)| file.as_str()).collect();
    assert_eq!(pictures, ["images/growth-ade.svg"]);
    let json = serde_json::to_string(&benchmark).expect("JSON");
    let again: Benchmark = serde_json::from_str(&json).expect("a benchmark");
    assert_eq!(again, benchmark);
    let other = json.replace(BENCHMARK_FORMAT, "phase-benchmark/0");
    assert!(serde_json::from_str::<Benchmark>(&other).is_err());
}

/// What is kept beside the page is all that it shows; the rest is gone.
#[test]
fn the_figures_of_the_page_make_the_same_page() {
    let mut whole = benchmark();
    let kinds = [[0; 3]; 3];
    let nothing = 2;
    let mistakes = ErrorBreakdown { right: 0, sign: 0, landmark: 0, entity: 0, both: 0, kinds, nothing };
    whole.goals.push(goals_row(mistakes));
    let figures = evaluation::figures(&whole);
    assert_eq!(evaluation::page(&figures).expect("a page"), evaluation::page(&whole).expect("a page"));
    assert_eq!(evaluation::overview(&figures), evaluation::overview(&whole));
    assert_eq!(evaluation::figures(&figures), figures);
    assert_ne!(figures, whole);
    let text = evaluation::to_lines(&figures).expect("JSON");
    assert_eq!(serde_json::from_str::<Benchmark>(&text).expect("a benchmark"), figures);
    for gone in ["\"validation\"", "\"from\"", "\"name\": \"independent\""] {
        assert!(serde_json::to_string_pretty(&whole).expect("JSON").contains(gone), "{gone}");
        assert!(!text.contains(gone), "{gone}");
    }
    let rows = text.lines().filter(|line| line.starts_with("  {\"method\"")).count();
    assert_eq!(rows, figures.goals.len() + figures.trajectories.len(), "{text}");
}

#[test]
fn the_leaderboard_has_the_best_first() {
    let estimate = |value| Estimate { value, low: value, high: value };
    let score = |method: &str, ade| Score {
        method: method.into(),
        set: "generated".into(),
        predictions: "0".into(),
        events: "0".into(),
        sealed: None,
        measures: Measures::Trajectories { ade: estimate(ade), fde: estimate(2.0 * ade) },
    };
    let scores =
        Scores { format: LEADERBOARD_FORMAT.into(), scores: vec![score("better", 1.0), score("worse", 3.0)] };
    let source = Source { by: "A | B".into(), source: "https://example.org".into() };
    let text = evaluation::leaderboard(&benchmark(), &scores, &[("better".to_owned(), source)].into());
    let place = |line: &str| text.find(line).unwrap_or_else(|| panic!("{line} in {text}"));
    let in_order = [
        place("| humans (paper, Table 1) | – | – | 0.970 | 0.99 | – |"),
        place("| better | 1.00 [1.00, 1.00] | 2.00 [2.00, 2.00] | – | – |"),
        place("| simple (ours) | 1.50 [1.50, 1.50] |"),
        place("| worse | 3.00 [3.00, 3.00] |"),
        place("| SIMPLE (paper, Table 2) | – | – | 3.84 | 5.23 |"),
        place("- better: A \\| B, https://example.org"),
    ];
    assert!(in_order.is_sorted(), "{in_order:?}");
    let json = serde_json::to_string(&scores).expect("JSON");
    assert_eq!(serde_json::from_str::<Scores>(&json).expect("scores"), scores);
}
