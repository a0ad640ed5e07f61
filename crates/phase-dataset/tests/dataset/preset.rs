//! Presets and the slots they consist of.

use phase_data::{DEMO, PHASE_500, PHASE_500_V1, PHASE_MINDS, PHASE_PAIRS, PHASE_TRAINING};
use phase_dataset::{
    composition::{Composition, EventSlot},
    labels::goal_counts,
    preset::{Ends, Preset, Selection},
    splits::Split,
};
use phase_model::{AGENT_COUNT, EventKind, Level, Relation};
use phase_sampler::Variant;
use std::collections::{BTreeMap, BTreeSet};

fn slots(preset: &Preset, count: usize) -> Vec<EventSlot> {
    let composition = Composition::of(preset);
    (0..count).map(|index| composition.slot(index)).collect()
}

#[test]
fn the_demo_has_two_of_each_kind() {
    let preset = Preset::parse("demo", DEMO).expect("a preset");
    assert_eq!((preset.name.as_str(), preset.events()), ("demo", 12));
    let slots = slots(&preset, 24);
    for kind in EventKind::ALL {
        let count = slots[..12].iter().filter(|slot| slot.variant.kind() == kind).count();
        assert_eq!(count, 2, "{kind:?}");
    }
    assert_eq!(preset.id(7), "demo-0007");
    assert_eq!(slots[12].variant, slots[0].variant);
    assert!(slots[12].goal_index > slots[0].goal_index, "goals go on by turns");
    assert_eq!(preset.pool("all").len(), 90);
    assert_eq!(preset.pool("none").len(), 0);
}

const fn relation(kind: EventKind) -> Relation {
    match kind {
        EventKind::Helping | EventKind::Collaborating => Relation::Friendly,
        EventKind::Hindering | EventKind::Chasing | EventKind::Competing => Relation::Adversarial,
        EventKind::Independent => Relation::Neutral,
    }
}

/// The paper's numbers (section "Dataset Statistics"), for the dataset and in proportion for one three times
/// as large.
#[test]
fn both_editions_have_the_papers_composition() {
    for (text, times) in [(PHASE_500_V1, 1), (PHASE_500_V1, 3), (PHASE_500, 1), (PHASE_500, 3)] {
        let preset = Preset::parse("phase-500", text).expect("a preset");
        assert_eq!(preset.events(), 500);
        let slots = slots(&preset, 500 * times);
        let count = |holds: &dyn Fn(&EventSlot) -> bool| slots.iter().filter(|slot| holds(slot)).count();
        for (wanted, events) in
            [(Relation::Friendly, 200), (Relation::Adversarial, 192), (Relation::Neutral, 108)]
        {
            let found = count(&|slot: &EventSlot| relation(slot.variant.kind()) == wanted);
            assert_eq!(found, events * times, "{wanted:?}");
        }
        for (split, events) in [(Split::Train, 320), (Split::Validation, 80), (Split::Test, 100)] {
            assert_eq!(count(&|slot: &EventSlot| slot.split == Some(split)), events * times, "{split:?}");
        }
        assert_eq!(count(&|slot: &EventSlot| slot.layouts == "unseen"), 80 * times);
        let agents = slots.iter().flat_map(|slot| {
            let kind = slot.variant.kind();
            let alphas = match kind {
                EventKind::Helping => [1, 0],
                EventKind::Hindering => [-1, 0],
                _ => [0; AGENT_COUNT],
            };
            slot.variant.goals(slot.goal_index).into_iter().zip(alphas)
        });
        let goals = goal_counts(agents);
        assert_eq!(goals.len(), 16);
        for (goal, count) in goals {
            assert!((47 * times..=129 * times).contains(&count), "{goal}: {count} of {times} x 500");
        }
    }
}

#[test]
fn both_editions_keep_layouts_and_one_type_for_the_test() {
    for (text, variant) in [(PHASE_500_V1, Variant::Evade), (PHASE_500, Variant::Objects)] {
        check_test_set(&Preset::parse("phase-500", text).expect("a preset"), variant);
    }
}

fn check_test_set(preset: &Preset, unseen: Variant) {
    let slots = slots(preset, 500);
    let bases = |name: &str| -> BTreeSet<u8> { preset.pool(name).iter().map(|it| it.base()).collect() };
    assert!(bases("seen").is_disjoint(&bases("unseen")));
    assert_eq!(preset.pool("seen").len() + preset.pool("unseen").len(), 90);
    for slot in &slots {
        assert!(slot.layouts == "seen" || slot.split == Some(Split::Test), "{slot:?}");
    }
    let tested = |slot: &&EventSlot| slot.split == Some(Split::Test);
    let learnt: BTreeSet<Variant> = slots.iter().filter(|it| !tested(it)).map(|it| it.variant).collect();
    let only: Vec<Variant> =
        slots.iter().filter(tested).map(|it| it.variant).filter(|it| !learnt.contains(it)).collect();
    assert_eq!(only, [unseen; 9]);
}

/// A run that stops early still has events of every kind.
#[test]
fn groups_are_spread_evenly() {
    let preset = Preset::parse("phase-500-v1", PHASE_500_V1).expect("a preset");
    for part in [50, 100, 250] {
        let mut counts: BTreeMap<Split, usize> = BTreeMap::new();
        for slot in slots(&preset, part) {
            *counts.entry(slot.split.expect("a split")).or_default() += 1;
        }
        assert!(counts[&Split::Train].abs_diff(part * 16 / 25) <= part / 10, "{part}: {counts:?}");
    }
    let turns = |variant: Variant| -> Vec<usize> {
        slots(&preset, 1500).into_iter().filter(|it| it.variant == variant).map(|it| it.goal_index).collect()
    };
    for variant in [Variant::Lift, Variant::Evade] {
        let turns = turns(variant);
        assert_eq!(turns, (0..turns.len()).collect::<Vec<_>>(), "{variant:?}");
    }
}

/// Every length is as likely as any other, and only for those whose events would not end by themselves.
#[test]
fn ends_are_drawn_for_those_at_odds() {
    let selection = Preset::parse("v1", PHASE_500_V1).expect("a preset").selection.expect("selects");
    let mut ends = [0; 101];
    for seed in 0..6100 {
        assert_eq!(selection.sampled_length(Relation::Friendly, seed, 0), None);
        assert_eq!(selection.sampled_length(Relation::Neutral, seed, 0), None);
        let (min, max) = selection.sampled_length(Relation::Adversarial, seed, 0).expect("is drawn");
        assert_eq!(min, 0);
        ends[max] += 1;
    }
    assert!(ends[..40].iter().all(|&count| count == 0));
    // A hundred each, give or take five standard deviations.
    assert!(ends[40..].iter().all(|count| (50..=150).contains(count)), "{ends:?}");
    let settled = Selection { ends: Ends::Settled, ..selection };
    assert_eq!(settled.sampled_length(Relation::Adversarial, 1, 0), None);
}

/// The length depends on the slot alone: neither on the relation nor on how many scenes were rejected. It is
/// the smaller of two uniform ones, whose mean over 0 to 28 is (28 · 57) / (6 · 29).
#[test]
fn lengths_are_the_same_for_all_kinds() {
    let selection = Preset::parse("v2", PHASE_500).expect("a preset").selection.expect("selects");
    let mut sum = 0;
    for slot in 0..6100 {
        let length = |relation, seed| selection.sampled_length(relation, seed, slot).expect("is drawn");
        let (min, max) = length(Relation::Friendly, 1);
        assert!(min == max && (44..=72).contains(&max));
        assert_eq!(length(Relation::Adversarial, 2), (min, max));
        assert_eq!(length(Relation::Neutral, 3), (min, max));
        sum += max;
    }
    let mean = sum as f64 / 6100.0;
    // Five standard errors of a standard deviation of 7.
    assert!((mean - 44.0 - 28.0 * 57.0 / 174.0).abs() < 0.45, "{mean}");
}

/// Every block has each relation, whatever its bodies are drawn for, and is in one part of the dataset.
#[test]
fn blocks_share_bodies_and_parts() {
    for text in [PHASE_500, PHASE_TRAINING] {
        let preset = Preset::parse("v2", text).expect("a preset");
        let composition = Composition::of(&preset);
        for first in (0..preset.events() * 2).step_by(5) {
            let slots: Vec<EventSlot> = (first..first + 5).map(|index| composition.slot(index)).collect();
            let place = slots[0].block.expect("is in a block");
            assert_eq!((place.block, place.first, place.events), (first / 5, first, 5));
            assert!(slots.iter().all(|slot| slot.block == Some(place) && slot.split == slots[0].split));
            assert!(slots.iter().all(|slot| slot.layouts == slots[0].layouts));
            let parts = composition.parts(place);
            assert!(parts.iter().zip(&slots).all(|(part, slot)| part.variant == slot.variant));
            let relations: BTreeSet<Relation> =
                slots.iter().map(|slot| relation(slot.variant.kind())).collect();
            assert_eq!(relations.len(), 3, "{slots:?}");
        }
    }
}

/// Each manner of helping and hindering, and crossing, has at least a tenth of its kind; but viewers take who
/// makes way for somebody that minds its own business.
#[test]
fn no_manner_is_rare() {
    let preset = Preset::parse("v2", PHASE_500).expect("a preset");
    let slots = slots(&preset, 500);
    let count = |holds: &dyn Fn(Variant) -> bool| slots.iter().filter(|slot| holds(slot.variant)).count();
    let is_shown =
        |it: &Variant| phase_dataset::composition::manner_of(*it).is_some() && *it != Variant::MakeWay;
    for variant in Variant::ALL.into_iter().filter(is_shown) {
        let (of_it, of_kind) = (count(&|it| it == variant), count(&|it| it.kind() == variant.kind()));
        assert!(10 * of_it >= of_kind, "{variant:?}: {of_it} of {of_kind}");
    }
}

/// The level of reasoning says nothing of kind and relation: all events of a block share it.
#[test]
fn levels_are_the_same_for_all_kinds() {
    let preset = Preset::parse("minds", PHASE_MINDS).expect("a preset");
    assert_eq!(preset.events(), 250);
    let slots = slots(&preset, 500);
    let count = |kind: EventKind, level: Level| {
        let same = |slot: &&EventSlot| slot.variant.kind() == kind && slot.level == Some(level);
        slots.iter().filter(same).count()
    };
    for (level, events) in [(Level::Zero, 10), (Level::One, 70), (Level::Two, 20)] {
        for kind in
            [EventKind::Helping, EventKind::Hindering, EventKind::Collaborating, EventKind::Independent]
        {
            assert_eq!(count(kind, level), events, "{kind:?}, {level:?}");
        }
    }
    for (split, events) in [(Split::Train, 160), (Split::Validation, 40), (Split::Test, 50)] {
        assert_eq!(slots[..250].iter().filter(|slot| slot.split == Some(split)).count(), events, "{split:?}");
    }
    let slot = slots.iter().find(|slot| slot.level == Some(Level::Two)).expect("a slot");
    let mut random = phase_model::random::stream(1, phase_model::random::Purpose::Scene, 0);
    let scene = phase_sampler::sample_variant(Variant::Carry, &mut random).expect("a scene");
    assert!(scene.agents.iter().all(|agent| agent.awareness.knows.level().is_none()));
    let scene = slot.with_knowledge(scene);
    assert!(scene.agents.iter().all(|agent| agent.awareness.knows.level() == Some(Level::Two)));

    // Older presets have none, and in one without blocks the events of a variant take turns.
    assert!(
        self::slots(&Preset::parse("old", PHASE_500).expect("a preset"), 500)
            .iter()
            .all(|it| it.level.is_none())
    );
    let turns = DEMO.replace("\"seed\"", "\"levels\": [2, 0], \"seed\"");
    let turns = self::slots(&Preset::parse("turns", &turns).expect("a preset"), 24);
    let chases = turns.iter().filter(|slot| slot.variant == Variant::Chase).map(|slot| slot.level);
    assert_eq!(chases.collect::<Vec<_>>(), [Some(Level::Two), Some(Level::Zero)].repeat(2));
}

#[test]
fn what_is_no_preset_is_refused() {
    let nothing = DEMO.split("\"groups\"").next().unwrap_or_default().to_owned() + "\"groups\": []}";
    let cases = [
        ("{}", "missing field"),
        ("", "EOF"),
        (&DEMO.replace("phase-preset/3", "phase-preset/9"), "format"),
        (&DEMO.replace("\"events\": 1", "\"events\": 0"), "events"),
        (&nothing, "groups"),
        (&DEMO.replace("\"lift\"", "\"dance\""), "dance"),
        (&DEMO.replace("\"seed\"", "\"sead\""), "sead"),
        (&DEMO.replace("\"seed\"", "\"levels\": [3], \"seed\""), "0, 1 or 2"),
        (&PHASE_PAIRS.replace("\"seed\"", "\"levels\": [1], \"seed\""), "`levels` need"),
        (&DEMO.replace("{\"all\"", "{\"most\""), "all"),
        (&DEMO.replace("[0, 2", "[1, 2"), "base 1"),
        (&DEMO.replace("\"demo\"", "\"../demo\""), "name"),
        (&DEMO.replace("\"demo\"", "\".demo\""), "name"),
        (&DEMO.replace("\"demo\"", "\"nul.\""), "name"),
        (&PHASE_500.replace("\"blocks\": 64", "\"blocks\": 0"), "blocks` must be 1"),
        (
            &PHASE_500.replace("\"meet_soon\": true", "\"meet_soon\": 3"),
            "field `blocks.meet_soon` must be true or false, not 3",
        ),
        (
            &PHASE_500.replace("\"min_steps\": 44", "\"min_steps\": \"a\""),
            "field `selection.min_steps` must be a whole number from 0 on, not \"a\"",
        ),
        (
            &PHASE_500.replace("\"places\": \"objects\"", "\"places\": \"x\""),
            "in `blocks.groups[3].replace`: ",
        ),
        (&PHASE_500.replace("[\"carry\"]", "[]"), "`columns`"),
        (&PHASE_500.replace("\"blocks\": {", "\"groups\": [{}], \"blocks\": {"), "variant"),
        (&PHASE_500.replace("\"unseen\", \"blocks\": 5", "\"hidden\", \"blocks\": 5"), "hidden"),
        (&PHASE_500.replace("1000,", "0,"), "attempt"),
        (&PHASE_500.replace("\"max_steps\": 72", "\"max_steps\": 10"), "min_steps"),
        (&PHASE_500.replace("\"validation\"", "\"holdout\""), "holdout"),
        // No memory for them is asked for before they are refused.
        (
            &DEMO.replace("\"events\": 1", "\"events\": 10000000000"),
            "`groups[0].events` must be 1 to 1000000",
        ),
        (
            &DEMO.replace("\"events\": 1", "\"events\": 9223372036854775808"),
            "`groups[0].events` must be 1 to 1000000",
        ),
        (&DEMO.replace("\"events\": 1", "\"events\": 600000"), "in all"),
        (
            &PHASE_500.replace("\"blocks\": 64", "\"blocks\": 9223372036854775807"),
            "`blocks.groups[0].blocks` must be 1 to",
        ),
        (&PHASE_500.replace("\"blocks\": 64", "\"blocks\": 999999"), "in all"),
        (
            &PHASE_500.replace("\"max_steps\": 72", "\"max_steps\": 1000000000"),
            "`selection.max_steps` must be 1 to 10000",
        ),
        (&PHASE_500.replace("1000,", "18446744073709551615,"), "`selection.attempts` must be 1 to 1000000"),
    ];
    for (text, part) in cases {
        let sentence = Preset::parse("demo", text).expect_err(part).to_string();
        assert!(sentence.starts_with("demo: ") && sentence.contains(part), "{sentence}");
    }
}
