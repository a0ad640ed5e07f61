//! The rules of a split, checked and applied.

use phase_dataset::{
    labels::{goal_label, interaction_type},
    splits::{Item, Split, SplitQuota, check, make},
};
use phase_model::{AgentId, EventKind, Goal, LandmarkId, ObjectId, Sign};
use proptest::prelude::*;

fn place(agent: u8, landmark: u8) -> Goal {
    Goal::AgentOnLandmark {
        agent: AgentId::ALL[usize::from(agent)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

fn thing(landmark: u8) -> Goal {
    Goal::ObjectOnLandmark {
        object: ObjectId::ZERO,
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

const TOUCH: Goal = Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Positive };

fn item(k: usize, kind: EventKind, goals: [Goal; 2], base: u8) -> Item {
    Item { id: format!("e{k}"), kind, goals, base }
}

#[test]
fn quotas_are_those_of_the_paper() {
    let quota = SplitQuota { train: 320, validation: 80, test: 100, unseen: 80, exclusive: 9 };
    assert_eq!(SplitQuota::of(500), quota);
    let double = SplitQuota { train: 640, validation: 160, test: 200, unseen: 160, exclusive: 18 };
    assert_eq!(SplitQuota::of(1000), double);
}

/// 25 events: 16, 4 and 5, of which 4 in held-out layouts; 9 in 500 are none of 25.
fn made_up() -> (Vec<Item>, Vec<Split>) {
    let mut items = Vec::new();
    let mut parts = Vec::new();
    for k in 0..25 {
        let (part, base) = match k {
            0..16 => (Split::Train, (k % 3) as u8),
            16..20 => (Split::Validation, 0),
            20..24 => (Split::Test, 7),
            _ => (Split::Test, 1),
        };
        items.push(item(k, EventKind::Independent, [place(0, 0), place(1, 1)], base));
        parts.push(part);
    }
    (items, parts)
}

#[test]
fn a_good_split_passes_and_each_breach_is_found() {
    let broken = |items: &[Item], parts: &[Split]| -> Vec<&str> {
        check(items, parts).iter().filter(|rule| !rule.met()).map(|rule| rule.what).collect()
    };
    let (items, parts) = made_up();
    assert!(broken(&items, &parts).is_empty());
    let mut moved = parts.clone();
    moved[0] = Split::Validation;
    assert_eq!(broken(&items, &moved), ["train", "validation"]);
    // The layout of a test event also occurs among the training events.
    let mut leaked = items.clone();
    leaked[3].base = 7;
    assert_eq!(broken(&leaked, &parts), ["test in layouts seen nowhere else"]);
    let mut new = items.clone();
    new[24].kind = EventKind::Helping;
    assert_eq!(broken(&new, &parts), ["test of a type seen nowhere else"]);
}

proptest! {
    /// For all events the sizes are right as long as there is a choice, and the quotas are never exceeded.
    #[test]
    fn splits_made_obey_the_rules(
        events in prop::collection::vec((0_u8..18, 0_usize..5), 60..200), seed: u64
    ) {
        let items: Vec<Item> = events.iter().enumerate().map(|(k, &(base, which))| {
            let (kind, goals) = [
                (EventKind::Helping, [thing(0), thing(0)]),
                (EventKind::Competing, [thing(0), thing(1)]),
                (EventKind::Chasing, [TOUCH, TOUCH.negated()]),
                (EventKind::Independent, [place(0, 0), place(1, 1)]),
                (EventKind::Independent, [thing(0), place(1, 1)]),
            ][which];
            item(k, kind, goals, base)
        }).collect();
        let parts = make(&items, seed);
        prop_assert_eq!(&parts, &make(&items, seed), "one seed, one split");
        let rules = check(&items, &parts);
        for rule in &rules[..3] {
            prop_assert_eq!(rule.wanted, rule.found, "{}", rule.what);
        }
        prop_assert!(rules[3].found <= rules[3].wanted + (items.len() / 25), "{:?}", rules[3]);
    }
}

#[test]
fn a_set_that_allows_it_is_split_exactly() {
    // Ten layouts of 50 events each; nine events hinder a touch, in a layout of which there is more.
    let items: Vec<Item> = (0..500)
        .map(|k| match k {
            0..9 => item(k, EventKind::Hindering, [TOUCH.negated(), TOUCH], 9),
            _ => item(k, EventKind::Independent, [place(0, 0), place(1, 1)], (k % 25) as u8 % 18),
        })
        .collect();
    let rules = check(&items, &make(&items, 3));
    assert!(rules.iter().all(phase_dataset::splits::Rule::met), "{rules:?}");
}

#[test]
fn labels_hide_what_social_agents_are_about() {
    assert_eq!(goal_label(thing(2), 1), "help");
    assert_eq!(goal_label(thing(2).negated(), -1), "hinder");
    assert_eq!(goal_label(thing(2), 0), "object 0 on landmark 2");
    assert_eq!(goal_label(place(1, 3), 0), goal_label(place(0, 3), 0));
    assert_eq!(
        (goal_label(TOUCH, 0), goal_label(TOUCH.negated(), 0)),
        ("approach".into(), "get away".into())
    );
    let mixed = [
        interaction_type(EventKind::Independent, [thing(0), place(1, 1)]),
        interaction_type(EventKind::Independent, [place(0, 2), thing(3)]),
    ];
    assert_eq!(mixed[0], mixed[1]);
}
