//! The audit finds shortcuts that are there, and none that are not.

use phase_audit::{Audit, AuditItem, Feature, Target, audit, summary, table};
use phase_event::{Event, Recording, Step, Thought};
use phase_model::{
    Action, AgentId, AgentSpec, Attitude, Body, EventKind, Goal, LandmarkId, Layout, ObjectSpec, Scene,
    Sight, Sign, Size, Strength, Vec2,
    arena::SUBSTEPS,
    random::{Pcg64Mcg, Purpose, stream},
};
use rand::{Rng, RngExt};

fn body(random: &mut impl Rng) -> Body {
    Body::at_rest(Vec2::new(random.random_range(7.0..25.0), random.random_range(3.0..21.0)), 0.0)
}

/// An event of a kind with everything visible drawn at random.
fn event(kind: EventKind, random: &mut Pcg64Mcg) -> Recording {
    let mut agent = |agent: AgentId, attitude| AgentSpec {
        size: Size::ALL[random.random_range(0..4)],
        strength: Strength::Fair,
        goal: Goal::AgentOnLandmark {
            agent,
            landmark: LandmarkId::ALL[random.random_range(0..4)],
            sign: Sign::Positive,
        },
        attitude,
        awareness: phase_model::Awareness::default(),
        start: body(random),
    };
    let first = match kind {
        EventKind::Helping => Attitude::Help,
        EventKind::Hindering => Attitude::Hinder,
        _ => Attitude::Neutral,
    };
    let agents = [agent(AgentId::ZERO, first), agent(AgentId::ONE, Attitude::Neutral)];
    let objects = (0..2).map(|_| ObjectSpec { size: Size::Small, start: body(random) }).collect();
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let scene = Scene { layout: layouts[random.random_range(0..layouts.len())], agents, objects, kind };
    recording(scene, random.random_range(40..100))
}

/// Nothing moves in it.
fn recording(scene: Scene, steps: usize) -> Recording {
    let initial = scene.initial_state();
    let step = Step {
        actions: [Action::Stop; 2],
        thoughts: [Thought::IDLE, Thought::IDLE],
        substeps: [initial; SUBSTEPS],
    };
    let event = Event { scene, seed: 1, initial, steps: vec![step; steps] };
    Recording::of_event("event", event, String::new(), serde_json::Value::Null)
}

const KINDS: [EventKind; 3] = [EventKind::Helping, EventKind::Hindering, EventKind::Independent];

fn audited(change: impl Fn(EventKind, Recording) -> Recording) -> Audit {
    let mut random = stream(1, Purpose::Event, 0);
    let events = (0..180).map(|k| KINDS[k % 3]).map(|kind| change(kind, event(kind, &mut random)));
    let items: Vec<AuditItem> = events.map(|event| AuditItem::of(&event)).collect();
    audit(&items, 500).expect("enough events")
}

fn accuracy(audit: &Audit, feature: Feature, target: Target) -> f64 {
    let row = audit.rows.iter().find(|row| row.feature == feature).expect("a row for each feature");
    row.accuracies[target as usize]
}

#[test]
fn what_has_no_shortcut_is_told_as_by_chance() {
    let audit = audited(|_, event| event);
    assert_eq!((audit.events, audit.of), (180, 500));
    assert!((audit.majorities[0] - 1.0 / 3.0).abs() < 1e-9);
    for row in &audit.rows {
        // A third, give or take four standard errors of 180 events.
        assert!((row.accuracies[0] - 1.0 / 3.0).abs() < 0.14, "{row:?}");
    }
    assert!(audit.excess(Target::Relation) < 0.14);
}

#[test]
fn a_length_that_belongs_to_a_kind_is_found() {
    let audit = audited(|kind, event| {
        let steps = 40 + 20 * KINDS.iter().position(|it| *it == kind).expect("one of the three");
        recording(event.scene, steps)
    });
    assert!(accuracy(&audit, Feature::Length, Target::Kind) > 0.95);
    // One informative number among forty.
    let all = accuracy(&audit, Feature::All, Target::Kind);
    assert!(all > 0.8, "{all}");
    assert!(accuracy(&audit, Feature::Sizes, Target::Kind) < 0.5);
    assert!(audit.excess(Target::Relation) > 0.4);
}

/// Three events on each stage, one of each kind: a forest that had seen two of them would know what the third
/// is not, and be wrong more often than by chance if it had not.
#[test]
fn events_that_share_bodies_are_in_one_fold() {
    let mut random = stream(2, Purpose::Event, 0);
    let mut items = Vec::new();
    for _ in 0..60 {
        let shared = event(EventKind::Independent, &mut random);
        for kind in KINDS {
            let drawn = event(kind, &mut random);
            let mut scene = drawn.scene.clone();
            scene.layout = shared.scene.layout;
            for (agent, known) in scene.agents.iter_mut().zip(&shared.scene.agents) {
                (agent.size, agent.start) = (known.size, known.start);
            }
            scene.objects.clone_from(&shared.scene.objects);
            if kind == EventKind::Helping {
                scene.objects.reverse();
            }
            items.push(AuditItem::of(&recording(scene, 60)));
        }
    }
    let audit = audit(&items, items.len()).expect("enough events");
    for feature in [Feature::Sizes, Feature::Layout] {
        let found = accuracy(&audit, feature, Target::Kind);
        assert!((found - 1.0 / 3.0).abs() < 0.02, "{feature:?}: {found}");
    }
}

#[test]
fn too_few_events_are_not_audited() {
    let mut random = stream(3, Purpose::Event, 0);
    let items: Vec<AuditItem> =
        (0..49).map(|_| AuditItem::of(&event(EventKind::Independent, &mut random))).collect();
    assert_eq!(audit(&items, 49), None);
}

#[test]
fn a_single_class_leaves_nothing_to_tell() {
    let mut random = stream(3, Purpose::Event, 0);
    let items: Vec<AuditItem> =
        (0..60).map(|_| AuditItem::of(&event(EventKind::Independent, &mut random))).collect();
    let audit = audit(&items, 60).expect("enough events");
    assert_eq!(audit.majorities[0], 1.0);
    assert_eq!(accuracy(&audit, Feature::All, Target::Relation), 1.0);
    let table = table(&audit);
    assert_eq!(table.lines().count(), 2 + 1 + Feature::ALL.len());
    assert!(table.starts_with("| told from | goal of agent 0 |"), "{table}");
    assert_eq!(
        summary(&audit),
        "all events have one relation and one kind, so that there is nothing to tell"
    );
}

/// Twins have the same bodies, and each piece of knowledge once.
#[test]
fn knowledge_of_twins_cannot_be_told_without_motion() {
    let mut random = stream(3, Purpose::Event, 0);
    let mut items = Vec::new();
    for _ in 0..40 {
        let mut twin = event(EventKind::Independent, &mut random);
        for sees in [Sight::Start, Sight::Objects] {
            twin.scene.agents[0].awareness.sees = sees;
            items.push(AuditItem::of(&twin));
        }
    }
    let audit = audit(&items, items.len()).expect("enough events");
    assert_eq!(audit.majorities[Target::Knowledge as usize], 0.5);
    assert_eq!(accuracy(&audit, Feature::All, Target::Knowledge), 0.5);
    let summary = summary(&audit);
    let told = "a random forest that sees no motion tells the knowledge of 0.500 of the events";
    assert!(summary.starts_with(told), "{summary}");
}
