//! Training on strengths: from synthetic motion, where the answer is known.

use phase_baselines::strength::{
    AgentSamples, Epoch, Sample, StrengthTrainingSettings, TrainingError, WINDOW, most_common, nearest,
    score, train,
};
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Body, Layout, MAX_ENTITIES, Size, Strength, Vec2};
use phase_simple::{ChainSettings, StrengthRegressor, Update, strength::features};

/// Two agents that push in a straight line until friction holds them at a speed: 2 u/s for each level of
/// strength. `variety` makes one event unlike the next.
fn event(strengths: [Strength; AGENT_COUNT], variety: u8) -> ObservedEvent {
    let rows = (0..=15_u8).map(|t| {
        let mut row = [Body::default(); MAX_ENTITIES];
        for (body, strength) in row.iter_mut().zip(strengths) {
            let greatest = 2.0 * f32::from(strength.level() + 1) + 0.05 * f32::from(variety % 8);
            body.velocity = Vec2::new(greatest * (1.0 - 0.7_f32.powi(t.into())), 0.0);
        }
        row
    });
    let layout = Layout::new(0, None).expect("a layout");
    ObservedEvent::new(layout, [Size::Small, Size::Huge], Vec::new(), rows.collect()).expect("an event")
}

/// Events of all pairs of strengths.
fn motions(variety: u8) -> Vec<AgentSamples> {
    let pairs = Strength::ALL.into_iter().flat_map(|a| Strength::ALL.map(|b| [a, b]));
    pairs
        .zip(variety..)
        .flat_map(|(pair, variety)| AgentSamples::of_event(&event(pair, variety), pair))
        .collect()
}

fn small() -> StrengthTrainingSettings {
    StrengthTrainingSettings {
        hidden: 16,
        batch: 16,
        learning_rate: 1e-2,
        epochs: 40,
        ..StrengthTrainingSettings::default()
    }
}

/// Trains and also returns the progress reported.
fn trained(
    training: &[AgentSamples],
    seed: u64,
    settings: &StrengthTrainingSettings,
) -> (StrengthRegressor, Vec<Epoch>) {
    let mut epochs = Vec::new();
    let regressor = train(training, &motions(3), seed, settings, &mut |epoch| epochs.push(*epoch));
    (regressor.expect("weights"), epochs)
}

#[test]
fn a_motion_is_cut_into_all_its_windows() {
    let strengths = [Strength::Fair, Strength::Mighty];
    let event = event(strengths, 0);
    let [first, second] = AgentSamples::of_event(&event, strengths);
    assert_eq!((first.whole.strength, second.whole.strength), (Strength::Fair, Strength::Mighty));
    assert_eq!(first.whole.features, features(event.rows(), AgentId::ZERO, Size::Small));
    // 16 rows hold six windows of 11.
    assert_eq!(second.windows.len(), 6);
    assert_eq!(second.windows[5].features, features(&event.rows()[5..=15], AgentId::ONE, Size::Huge));
    let short = AgentSamples::of_event(&event.prefix(WINDOW - 1), strengths);
    assert_eq!(short[0].windows, [short[0].whole]);
}

#[test]
fn windows_are_as_long_as_those_of_inference() {
    assert_eq!(ChainSettings::resynchronised(Update::Local).window, WINDOW);
}

#[test]
fn the_error_becomes_small() {
    let (regressor, epochs) = trained(&motions(0), 1, &small());
    let first = epochs.first().unwrap();
    let best = epochs.iter().rfind(|epoch| epoch.best).unwrap();
    // A constant prediction is wrong by 168 N.
    assert!(best.training < 0.3 * first.training, "{first:?} {best:?}");
    assert!(best.validation < 60.0, "{best:?}");
    let rmse = f64::from(regressor.weights().rmse);
    assert!((rmse - best.validation).abs() < 1e-3, "{rmse} is not that of {best:?}");
}

#[test]
fn what_is_trained_is_what_is_evaluated_later() {
    // Without updates, the training error is that of the regressor in plain Rust on the same samples.
    let settings = StrengthTrainingSettings { learning_rate: 0.0, windows: 0, patience: 1, ..small() };
    let (_, epochs) = trained(&motions(3), 1, &settings);
    let Epoch { training, whole, .. } = epochs[0];
    assert!((training - whole).abs() < 1e-3, "{training} is not {whole}");
}

#[test]
fn one_seed_one_result() {
    let settings = StrengthTrainingSettings { epochs: 3, ..small() };
    let file = |seed| trained(&motions(0), seed, &settings).0.to_safetensors().unwrap();
    assert_eq!(file(1), file(1));
    assert_ne!(file(1), file(2));
}

#[test]
fn eight_samples_are_learnt_by_heart() {
    // Features that carry no information about strength, one outlier for each agent.
    let motions: Vec<AgentSamples> = [2_u8, 0, 3, 1, 1, 3, 0, 2]
        .into_iter()
        .enumerate()
        .map(|(k, level)| {
            let number = k as f64;
            let features = [number, (number * 2.3) % 3.0, 0.0, (number * 1.7) % 4.0, number % 2.0, 0.0, 1.2];
            let whole = Sample { features, strength: Strength::from_level(level).unwrap() };
            AgentSamples { whole, windows: vec![whole] }
        })
        .collect();
    let settings = StrengthTrainingSettings {
        batch: 8,
        learning_rate: 1e-2,
        epochs: 300,
        patience: 300,
        ..StrengthTrainingSettings::default()
    };
    let regressor = train(&motions, &motions, 1, &settings, &mut |_| {}).unwrap();
    for AgentSamples { whole, .. } in &motions {
        let force = whole.strength.max_force();
        let estimate = regressor.estimate_from(&whole.features);
        assert!((estimate - f64::from(force)).abs() < 10.0, "{estimate} is not {force}");
    }
}

#[test]
fn training_stops_when_nothing_is_gained() {
    let settings = StrengthTrainingSettings { learning_rate: 0.0, patience: 4, ..small() };
    let (_, epochs) = trained(&motions(0), 1, &settings);
    assert_eq!(epochs.len(), 5);
    assert_eq!(epochs.iter().filter(|epoch| epoch.best).count(), 1);
}

#[test]
fn what_cannot_be_learnt_from_is_refused() {
    let some = motions(0);
    let outcome = |training, validation, settings: &StrengthTrainingSettings| {
        train(training, validation, 1, settings, &mut |_| {}).unwrap_err()
    };
    assert!(matches!(outcome(&[], &some, &small()), TrainingError::NoMotion("training")));
    assert!(matches!(outcome(&some, &[], &small()), TrainingError::NoMotion("validation")));
    let wild = StrengthTrainingSettings { learning_rate: 1e30, ..small() };
    assert!(matches!(outcome(&some, &some, &wild), TrainingError::Diverged { epoch: 1, .. }));
}

#[test]
fn scores_by_hand() {
    // A network that always predicts 400 N.
    let mut weights =
        trained(&motions(0), 1, &StrengthTrainingSettings { epochs: 1, ..small() }).0.weights().clone();
    weights.output.weight.fill(0.0);
    weights.output.bias = vec![400.0];
    let regressor = StrengthRegressor::new(weights).unwrap();
    let sample = |strength| Sample { features: [0.0; 7], strength };
    let fair = sample(Strength::Fair);
    let strong = sample(Strength::Strong);
    // 100 N off in half of the first group, 50 N in the other half and in all of the second.
    let groups: [&[Sample]; 2] = [&[fair, strong], &[strong]];
    let found = score(&regressor, groups, Strength::Fair);
    assert!((found.rmse - (0.25 * 10_000.0 + 0.75 * 2500.0_f64).sqrt()).abs() < 1e-9);
    assert!((found.rmse_of_constant - 150.0 * (0.25 * 0.75_f64).sqrt()).abs() < 1e-9);
    assert_eq!((found.accuracy, found.accuracy_of_guess), (0.75, 0.25));
    assert_eq!(most_common([strong, fair, strong].iter()), Strength::Strong);
    assert_eq!(most_common([strong, fair].iter()), Strength::Fair);
}

#[test]
fn nearest_levels() {
    let cases = [(-1e9, 0), (225.0, 0), (225.1, 1), (460.0, 2), (524.9, 2), (1e9, 3)];
    for (force, level) in cases {
        assert_eq!(nearest(force).level(), level, "{force} N");
    }
}
