//! Scores of Task 2 and the trivial baselines, compared with numbers computed by hand.

use core::ops::ControlFlow;
use phase_eval::{
    predictions,
    trajectories::{Errors, ForecastError, ForecastEvent, ForecastSummary, SampleErrors},
    trivial::{ConstantVelocity, Stationary},
};
use phase_event::{Forecaster, ObservedEvent};
use phase_model::{Body, EventKind, Forecast, Layout, MAX_ENTITIES, Relation, Size, Vec2};
use proptest::prelude::*;
use serde_json::{Value, json};

/// A path along x at this height.
fn path(y: f32, steps: usize) -> Vec<Vec2> {
    (0..steps).map(|step| Vec2::new(step as f32, y)).collect()
}

#[test]
fn errors_by_hand() {
    // Agent 0 is predicted exactly, agent 1 missed by 3 and 4 (5 u) throughout, the object by 0, then 6.
    let truth = vec![path(0.0, 2), path(0.0, 2), path(0.0, 2)];
    let off: Vec<Vec2> = path(0.0, 2).into_iter().map(|point| point + Vec2::new(3.0, 4.0)).collect();
    let late = vec![Vec2::new(0.0, 0.0), Vec2::new(1.0, 6.0)];
    let [agents, entities] = Errors::of(&vec![path(0.0, 2), off, late], &truth).expect("errors");
    assert_eq!((agents.ade, agents.fde), (2.5, 2.5));
    assert_eq!(agents.by_step, [2.5, 2.5]);
    // (0 + 5 + 0) / 3, then (0 + 5 + 6) / 3
    for (found, expected) in [(entities.ade, 8.0 / 3.0), (entities.fde, 11.0 / 3.0)] {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

/// Two futures, of which agent 0's is exact in the first and agent 1's in the second.
#[test]
fn scores_of_a_distribution_by_hand() {
    let truth = vec![path(0.0, 2), path(9.0, 2), path(0.0, 2)];
    let futures = [
        vec![path(0.0, 2), path(5.0, 2), path(0.0, 2)],
        vec![vec![Vec2::new(0.0, 0.0), Vec2::new(1.0, 6.0)], path(9.0, 2), path(7.0, 2)],
    ];
    let of = |futures: &[Forecast]| SampleErrors::of(futures, &truth).expect("of its shape");
    let both = of(&futures).expect("there are futures");
    assert_eq!((both.count, both.min_ade, both.min_fde), (2, 0.0, 0.0));
    // Agent 0: errors 0 and (0 + 6) / 2; distances 0, 6. Agent 1: errors 4 and 0; distances 4, 4. Of the four
    // pairs of futures two are different.
    let expected = 0.5 * ((1.5 - 0.25 * 3.0) + (2.0 - 0.25 * 4.0));
    assert!((both.energy - expected).abs() < 1e-12, "{both:?}");
    let one = of(&futures[..1]).expect("there is a future");
    let [agents, _] = Errors::of(&futures[0], &truth).expect("errors");
    for score in [one.min_ade, one.energy] {
        assert!((score - agents.ade).abs() < 1e-12, "{one:?}");
    }
    assert_eq!(of(&[]), None);
    let shape = SampleErrors::of(&[truth[..2].to_vec()], &truth);
    assert_eq!(shape, Err(ForecastError::Shape { entities: 3, steps: 2 }));
}

/// The energy score is proper: of two distributions it prefers, on average, the one that the truth is drawn
/// from.
#[test]
fn the_energy_score_prefers_the_true_distribution() {
    let at = |x: f32| vec![vec![Vec2::new(x, 0.0)]; 2];
    let mean = |futures: &[Forecast]| {
        let scores = [0.0, 10.0].map(|x| {
            SampleErrors::of(futures, &at(x)).expect("of its shape").expect("there are futures").energy
        });
        0.5 * (scores[0] + scores[1])
    };
    let true_one = mean(&[at(0.0), at(10.0)]);
    let middle = mean(&[at(5.0)]);
    let certain = mean(&[at(0.0)]);
    assert!(true_one < middle && true_one < certain, "{true_one} {middle} {certain}");
}

#[test]
fn what_is_no_prediction_is_refused() {
    let truth = vec![path(0.0, 3); 3];
    let nan = vec![path(0.0, 3), path(0.0, 3), vec![Vec2::NAN; 3]];
    let shape = ForecastError::Shape { entities: 3, steps: 3 };
    let cases = [
        (Vec::new(), truth.clone(), shape.clone()),
        (vec![path(0.0, 3); 2], truth.clone(), shape.clone()),
        (vec![path(0.0, 2); 3], truth.clone(), shape),
        (nan, truth, ForecastError::NotFinite { entity: 2 }),
        (vec![Vec::new(); 2], vec![Vec::new(); 2], ForecastError::NoSteps),
        (Vec::new(), Vec::new(), ForecastError::NoSteps),
    ];
    for (forecast, truth, expected) in cases {
        assert_eq!(Errors::of(&forecast, &truth), Err(expected), "{forecast:?}");
    }
}

fn event(relation: Relation, errors: &[f64]) -> ForecastEvent {
    let ade = errors.iter().sum::<f64>() / errors.len() as f64;
    let fde = errors.last().copied().unwrap_or_default();
    let errors = Errors { ade, fde, by_step: errors.to_vec() };
    ForecastEvent {
        id: "x".into(),
        kind: EventKind::Independent,
        relation,
        steps: errors.by_step.len(),
        agents: errors.clone(),
        entities: errors,
        samples: None,
        forecast: Vec::new(),
        cpu_seconds: None,
        details: Value::Null,
    }
}

#[test]
fn events_count_alike_and_are_told_apart_by_relation() {
    let mut events = vec![event(Relation::Neutral, &[1.0; 20]), event(Relation::Friendly, &[2.0, 4.0])];
    events.push(event(Relation::Adversarial, &[7.0; 20]));
    let summary = ForecastSummary::of(&events, 1).expect("events");
    let of = |scores: Option<&phase_eval::trajectories::ForecastScores>| {
        scores.map(|scores| (scores.n, scores.ade.value, scores.fde.value))
    };
    assert_eq!(of(summary.independent.as_ref()), Some((1, 1.0, 1.0)));
    assert_eq!(of(summary.social.as_ref()), Some((2, 5.0, 5.5)));
    assert_eq!(of(Some(&summary.all)), Some((3, 11.0 / 3.0, 4.0)));
    assert_eq!(summary.shorter, 1);
    // From the third step on the second event does not contribute.
    assert_eq!(summary.by_step[..3], [10.0 / 3.0, 4.0, 4.0]);
    assert_eq!(ForecastSummary::of(&events[..1], 1).expect("an event").social, None);
    assert_eq!(ForecastSummary::of(&[], 1), None);
}

#[test]
fn plain_methods_go_straight_on_or_stay() {
    let body = |x: f32, vx: f32| Body {
        position: Vec2::new(x, 10.0),
        velocity: Vec2::new(vx, 0.0),
        ..Body::default()
    };
    let mut row = [Body::default(); MAX_ENTITIES];
    (row[0], row[1], row[2]) = (body(10.0, 6.0), body(25.0, 6.0), body(8.0, 0.0));
    let layout = Layout::new(0, None).expect("a layout");
    let observed =
        ObservedEvent::new(layout, [Size::ALL[0]; 2], vec![Size::ALL[1]], vec![row]).expect("an event");
    let forecast = |method: &dyn Forecaster| {
        let mut tick = || ControlFlow::Continue(());
        let (forecast, _) = method.forecast(&observed, 4, 1, &mut tick).expect("an answer").expect("whole");
        forecast
            .forecast
            .iter()
            .map(|path| path.iter().map(|point| point.x).collect())
            .collect::<Vec<Vec<f32>>>()
    };
    assert_eq!(forecast(&Stationary), [[10.0; 4], [25.0; 4], [8.0; 4]]);
    // Half a unit a step, as far as the arena goes.
    let expected = [[10.5, 11.0, 11.5, 12.0], [25.5, 26.0, 26.0, 26.0], [8.0; 4]];
    for (found, expected) in forecast(&ConstantVelocity).iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }
}

#[test]
fn a_forecast_is_cut_to_its_event() {
    let forecast = |lengths: &[usize]| lengths.iter().map(|&steps| path(0.0, steps)).collect::<Vec<_>>();
    // Lengths of the paths, entities and steps of the event, and the rule that is broken.
    let cases: [(&[usize], usize, usize, Option<&str>); 9] = [
        (&[20, 20], 2, 20, None),
        (&[20, 7, 8], 3, 7, None),
        (&[1, 1], 2, 1, None),
        (&[20, 20], 3, 20, Some("field `forecast` must hold 3 lists")),
        (&[20, 20, 20], 2, 20, Some("field `forecast` must hold 2 lists")),
        (&[], 2, 20, Some("field `forecast` must hold 2 lists")),
        (&[20, 19], 2, 20, Some("field `forecast[1]` must hold 20 positions, not 19")),
        (&[6, 20], 2, 7, Some("field `forecast[0]` must hold 7 to 20 positions, not 6")),
        (&[20, 21], 2, 7, Some("field `forecast[1]` must hold 7 to 20 positions, not 21")),
    ];
    for (lengths, entities, steps, rule) in cases {
        match (predictions::fit(&forecast(lengths), entities, steps), rule) {
            (Ok(cut), None) => assert_eq!(cut, forecast(&vec![steps; entities]), "{lengths:?}"),
            (Err(error), Some(rule)) => assert!(error.to_string().starts_with(rule), "{error}"),
            (found, _) => panic!("{lengths:?}: {found:?}, not {rule:?}"),
        }
    }
}

fn position() -> impl Strategy<Value = Vec2> {
    let number = || prop_oneof![-30.0..30.0_f32, prop::num::f32::NORMAL, prop::num::f32::SUBNORMAL];
    (number(), number()).prop_map(|(x, y)| Vec2::new(x, y))
}

proptest! {
    /// A stored forecast reads back to the same bits, and has the same errors.
    #[test]
    fn forecasts_read_back(paths in prop::collection::vec(prop::collection::vec(position(), 20), 2..=4)) {
        let kept = ForecastEvent {
            forecast: paths.iter().map(|path| path.iter().map(|at| at.to_array()).collect()).collect(),
            ..event(Relation::Neutral, &[0.0; 20])
        };
        let text = json!({ "events": [kept] }).to_string();
        let read = predictions::forecasts(&serde_json::from_str(&text).expect("JSON")).expect("forecasts");
        prop_assert_eq!(&read["x"].forecast, &paths);
        let truth = vec![path(0.0, 20); paths.len()];
        for errors in Errors::of(&paths, &truth).expect("errors") {
            let all = errors.by_step.iter().chain([&errors.ade, &errors.fde]);
            prop_assert!(all.into_iter().all(|error| error.is_finite()));
        }
    }

    /// Any invalid forecast is rejected in a sentence that names the event.
    #[test]
    fn rubbish_is_no_forecast(depth in 0..5_usize, leaf in prop_oneof![
        Just(Value::Null), Just(json!(true)), Just(json!("1")), Just(json!({})),
        any::<f64>().prop_map(|x| json!(x)),
    ]) {
        let forecast = (0..depth).fold(leaf, |inner, _| json!([inner]));
        let told = predictions::forecasts(&json!({ "events": [{ "id": "a", "forecast": forecast }] }));
        let told = told.expect_err("no forecast").to_string();
        prop_assert!(told.starts_with("event a: field `forecast"), "{}", told);
    }
}
