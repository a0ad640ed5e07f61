//! Impressions of events while they are watched, and people's predicted reports.

use phase_event::ObservedEvent;
use phase_model::{
    AgentId, Attitude, Body, Goal, LandmarkId, Layout, MAX_ENTITIES, ObjectId, Relation, Sign, Size,
    Strength, Vec2,
};
use phase_simple::{
    Happening, Hypothesis, Impression, Interaction, ReportModel, ReportModelError, physical_goals,
    report_model::{REPORT_FEATURES, REPORT_MODEL_FORMAT, report_features},
};
use proptest::prelude::*;

/// A row with bodies at rest.
fn row(places: [(f32, f32); MAX_ENTITIES]) -> [Body; MAX_ENTITIES] {
    places.map(|(x, y)| Body::at_rest(Vec2::new(x, y), 0.0))
}

#[test]
fn interactions_by_hand() {
    let [agent, object] = [Size::Small, Size::Large].map(Size::radius);
    let near = 8.0 + 2.0 * agent + 1.9;
    let touching = 8.0 + 2.0 * agent + 0.29;
    let beside = 12.0 + agent + object + 0.29;
    let rows = vec![
        // Far apart from everything.
        row([(8.0, 8.0), (20.0, 8.0), (8.0, 18.0), (20.0, 18.0)]),
        // Near each other.
        row([(8.0, 8.0), (near, 8.0), (8.0, 18.0), (20.0, 18.0)]),
        // In contact.
        row([(8.0, 8.0), (touching, 8.0), (8.0, 18.0), (20.0, 18.0)]),
        // Either side of object 1, which is wider than near.
        row([(12.0 - agent - object - 0.29, 12.0), (beside, 12.0), (20.0, 20.0), (12.0, 12.0)]),
    ];
    let layout = Layout::new(0, None).expect("a layout");
    let sizes = [Size::Small; 2];
    let observed = ObservedEvent::new(layout, sizes, vec![Size::Large; 2], rows).expect("an event");
    let interaction = Interaction::of(&observed);
    let Interaction { near, shared_object } = interaction;
    let apart = 2.0 * object + 0.58 >= 2.0;
    assert_eq!(near, if apart { 0.5 } else { 0.75 });
    assert!((shared_object - 0.25).abs() < 1e-12, "{shared_object}");
    assert_eq!(interaction.involvement(), near);
    let apart = Interaction { near: 0.1, ..interaction };
    assert_eq!(apart.involvement(), shared_object);
}

/// Whatever goes on, it is of the relation of its hypothesis.
#[test]
fn happenings_have_the_relations_of_their_hypotheses() {
    let mut seen = Vec::new();
    for first in physical_goals(AgentId::ZERO, 2) {
        for second in physical_goals(AgentId::ONE, 2) {
            for attitudes in [
                [Attitude::Neutral; 2],
                [Attitude::Help, Attitude::Neutral],
                [Attitude::Neutral, Attitude::Hinder],
            ] {
                let hypothesis = Hypothesis::new([first, second], attitudes, [Strength::Fair; 2]);
                let happening = Happening::of(&hypothesis);
                let expected = match happening {
                    Happening::Help | Happening::SharedGoal => Relation::Friendly,
                    Happening::Hindrance | Happening::Competition | Happening::Chase => Relation::Adversarial,
                    Happening::Nothing => Relation::Neutral,
                };
                assert_eq!(hypothesis.relation(), expected, "{hypothesis:?}");
                if !seen.contains(&happening) {
                    seen.push(happening);
                }
            }
        }
    }
    assert_eq!(seen.len(), Happening::ALL.len());
    let touch = |sign| Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign };
    let chase = Hypothesis::new(
        [touch(Sign::Positive), touch(Sign::Negative)],
        [Attitude::Neutral; 2],
        [Strength::Fair; 2],
    );
    assert_eq!(Happening::of(&chase), Happening::Chase);
    let object =
        |landmark| Goal::ObjectOnLandmark { object: ObjectId::ALL[0], landmark, sign: Sign::Positive };
    let compete = Hypothesis::new(
        [object(LandmarkId::TOP_LEFT), object(LandmarkId::BOTTOM_LEFT)],
        [Attitude::Neutral; 2],
        [Strength::Fair; 2],
    );
    assert_eq!(Happening::of(&compete), Happening::Competition);
}

fn model(weights: [[f64; REPORT_FEATURES]; 3], intercepts: [f64; 3]) -> ReportModel {
    let means = [0.0; REPORT_FEATURES];
    let deviations = [1.0; REPORT_FEATURES];
    ReportModel { format: REPORT_MODEL_FORMAT.into(), means, deviations, weights, intercepts }
}

/// With a single weight the odds of a report are e to the power of weight times feature.
#[test]
fn reports_by_hand() {
    let mut happenings = [0.0; 6];
    happenings[Happening::Help as usize] = 0.98;
    let interaction = Interaction { near: 0.5, ..Interaction::default() };
    let impression = Impression { happenings, interaction };
    let features = report_features(&impression);
    assert_eq!(features[Happening::Help as usize], 0.0, "ln of 0.98 and the floor of 0.02");
    assert_eq!(features[6], 0.5);
    let mut weights = [[0.0; REPORT_FEATURES]; 3];
    weights[0][6] = 2.0 * f64::ln(3.0);
    let reports = model(weights, [0.0, 0.0, f64::ln(2.0)]).reports(&impression);
    for (found, expected) in [(reports.friendly, 3.0), (reports.adversarial, 1.0), (reports.neutral, 2.0)] {
        assert!((found - expected / 6.0).abs() < 1e-12, "{reports:?}");
    }
}

proptest! {
    /// Reports are a distribution, whatever the weights.
    #[test]
    fn reports_are_a_distribution(
        weight in prop::collection::vec(-1e3..1e3_f64, 21),
        shares in prop::collection::vec(0.0..1.0_f64, 6),
        near in 0.0..1.0_f64,
    ) {
        let weights = core::array::from_fn(|report| core::array::from_fn(|k| weight[7 * report + k]));
        let impression = Impression {
            happenings: core::array::from_fn(|k| shares[k]),
            interaction: Interaction { near, ..Interaction::default() },
        };
        let reports = model(weights, [0.0; 3]).reports(&impression);
        let three = [reports.friendly, reports.adversarial, reports.neutral];
        prop_assert!(three.iter().all(|p| (0.0..=1.0).contains(p)), "{three:?}");
        prop_assert!((three.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn the_bundled_model_is_sound_and_others_are_refused() {
    let bundled = ReportModel::bundled().expect("a sound file");
    let text = serde_json::to_string(&bundled).expect("JSON");
    assert_eq!(ReportModel::from_json(&text).expect("what was written"), bundled);
    let with = |change: &dyn Fn(&mut ReportModel)| {
        let mut other = bundled.clone();
        change(&mut other);
        ReportModel::from_json(&serde_json::to_string(&other).expect("JSON"))
    };
    assert!(matches!(with(&|it| it.format = "phase-events/1".into()), Err(ReportModelError::Format)));
    assert!(matches!(with(&|it| it.deviations[3] = 0.0), Err(ReportModelError::Number)));
    for broken in
        ["", "{}", &text.replacen("\"means\":[", "\"means\":[1,", 1), &text.replacen('{', "{\"more\":1,", 1)]
    {
        assert!(matches!(ReportModel::from_json(broken), Err(ReportModelError::Json(_))), "{broken}");
    }
}
