//! Assignments: balanced, without repeats, decided by the seed.

use crate::support::{document, read};
use phase_study::{
    assignment::{Shown, assign},
    forms::Form,
};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// The same study with half of its videos from people, each rater seeing one source, and with catch trials.
fn of_two_sources(mut document: Value, catch_trials: usize) -> Value {
    let stimuli = document["stimuli"].as_array_mut().expect("a list");
    let half = stimuli.len() / 2;
    stimuli.iter_mut().take(half).for_each(|stimulus| stimulus["source"] = json!("human"));
    document["between_sources"] = json!(true);
    let trial = |k: usize| {
        let video = format!("c{k}.mp4");
        json!({"id": format!("c{k}"), "video": video, "expected": {"relation": "neutral"}})
    };
    document["catch_trials"] = (0..catch_trials).map(trial).collect();
    document
}

proptest! {
    #[test]
    fn everybody_sees_different_videos_and_all_videos_are_seen_alike(
        videos in 2_usize..30, k in 1_u32..8, each in 1_usize..12, catch in 0_usize..4,
        two in any::<bool>(), seed in 0_i64..1000,
    ) {
        let mut document = document(Form::Relation, videos, k, each.min(videos));
        document["seed"] = json!(seed);
        if two {
            document = of_two_sources(document, catch);
        }
        let config = read(&document);
        let mut load = vec![0_u32; videos];
        for rater in 1..=config.raters.into() {
            let trials = assign(&config, &load, rater).expect("there is room for all who are needed");
            prop_assert_eq!(&trials, &assign(&config, &load, rater).expect("the same"));
            prop_assert_eq!(trials.iter().collect::<BTreeSet<_>>().len(), trials.len());
            let mut sources = BTreeSet::new();
            for shown in &trials {
                if let Shown::Stimulus(k) = *shown {
                    load[k] += 1;
                    sources.insert(config.stimuli[k].source.as_str());
                }
            }
            prop_assert!(!two || sources.len() == 1);
            let catches = trials.iter().filter(|shown| matches!(shown, Shown::CatchTrial(_))).count();
            prop_assert_eq!(catches, config.catch_trials.len());
            for group in config.groups() {
                let of_group: Vec<u32> = group.iter().map(|&k| load[k]).collect();
                let least = of_group.iter().min().expect("some");
                let most = of_group.iter().max().expect("some");
                prop_assert!(most - least <= 1, "{:?}", of_group);
            }
        }
        prop_assert!(load.iter().all(|&raters| raters == k), "{:?}", load);
        prop_assert_eq!(assign(&config, &load, 9999), None);
    }
}

proptest! {
    #[test]
    fn no_rater_sees_two_videos_of_a_set_and_all_videos_are_judged(
        sets in 1_usize..12, size in 1_usize..4, alone in 0_usize..4, k in 1_u32..6, each in 1_usize..12,
        seed in 0_i64..1000,
    ) {
        let each = each.min(sets + alone);
        let mut document = document(Form::Relation, sets * size + alone, k, each);
        document["seed"] = json!(seed);
        document["one_of_each_set"] = json!(true);
        // More raters than are needed may come.
        document["raters_per_video_at_most"] = json!(10 * k);
        for (n, stimulus) in document["stimuli"].as_array_mut().expect("a list").iter_mut().enumerate() {
            if n < sets * size {
                stimulus["set"] = json!(format!("set-{}", n / size));
            }
        }
        let config = read(&document);
        let mut load = vec![0_u32; config.stimuli.len()];
        for rater in 1..=u64::from(config.raters) {
            let trials = assign(&config, &load, rater).expect("room");
            prop_assert_eq!(trials.len(), each);
            let mut seen = BTreeSet::new();
            for shown in trials {
                let Shown::Stimulus(n) = shown else { continue };
                load[n] += 1;
                if let Some(set) = &config.stimuli[n].set {
                    prop_assert!(seen.insert(set), "two of {}", set);
                }
            }
        }
        prop_assert!(load.iter().all(|&raters| raters >= k), "{:?}", load);
    }
}

#[test]
fn assignments_differ_between_seeds_and_between_raters() {
    let mut document = document(Form::Relation, 50, 10, 20);
    let one = read(&document);
    document["seed"] = json!(8);
    let other = read(&document);
    let load = vec![0; 50];
    assert_ne!(assign(&one, &load, 1), assign(&one, &load, 2));
    assert_ne!(assign(&one, &load, 1), assign(&other, &load, 1));
}

#[test]
fn catch_trials_are_anywhere() {
    let config = read(&of_two_sources(document(Form::Relation, 40, 50, 9), 1));
    let places: BTreeSet<usize> = (0..300)
        .filter_map(|rater| assign(&config, &[0; 40], rater))
        .filter_map(|trials| trials.iter().position(|shown| matches!(shown, Shown::CatchTrial(_))))
        .collect();
    assert_eq!(places.len(), 10);
}

#[test]
fn one_hundred_and_thirty_raters_can_judge_a_hundred_videos() {
    // Experiment 1 of the paper: 1000 judgements by 130 people, so that some see 7 and some 8, or some videos
    // have 11 raters.
    let mut document = document(Form::Interactions, 100, 10, 8);
    document["raters_per_video_at_most"] = json!(11);
    document["raters"] = json!(130);
    let config = read(&document);
    let mut load = vec![0; 100];
    for rater in 1..=130 {
        let trials = assign(&config, &load, rater).expect("room");
        assert_eq!(trials.len(), 8);
        for shown in trials {
            if let Shown::Stimulus(k) = shown {
                load[k] += 1;
            }
        }
    }
    assert!(load.iter().all(|raters| (10..=11).contains(raters)), "{load:?}");
}
