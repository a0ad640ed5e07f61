//! Counterbalanced lists, matched groups and dissimilarity matrices by their definitions.

use phase_laboratory::{
    counterbalance::{Stimulus, lists},
    matching::{Candidate, matched},
    platform::{Platform, Question, Trial, files},
    representation::{Dissimilarity, Distance, Rank, similarity, unique},
};
use phase_model::random::{Purpose, stream};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn event(id: &str, kind: &str, measures: &[f64]) -> Candidate {
    Candidate { id: id.into(), kind: kind.into(), measures: measures.to_vec() }
}

#[test]
fn matching_finds_the_pairs_that_were_hidden() {
    // Helping events 0, 10, 20, 30 have a hindering twin 0.1 beside them; two hindering events have none.
    let mut events = Vec::new();
    for k in 0..4 {
        events.push(event(&format!("help{k}"), "helping", &[10.0 * f64::from(k)]));
        events.push(event(&format!("hinder{k}"), "hindering", &[10.0 * f64::from(k) + 0.1]));
    }
    events.push(event("alone0", "hindering", &[500.0]));
    events.push(event("alone1", "hindering", &[-500.0]));
    let result = matched(&["speed".into()], &events, 0.1).expect("two kinds");
    let pairs: BTreeSet<Vec<String>> = result.groups.into_iter().collect();
    let wanted = (0..4).map(|k| vec![format!("help{k}"), format!("hinder{k}")]).collect();
    assert_eq!(pairs, wanted);
    let [before, after] = result.differences[0].standardised.map(Option::unwrap);
    assert!(before < after + 1.0 && after < 0.01, "{before} {after}");
    assert!(matched(&["speed".into()], &events[..1], 0.1).is_err());
}

proptest! {
    /// No group has two events of one kind, none exceeds the caliper, and no event is in two groups.
    #[test]
    fn groups_keep_the_caliper(
        values in prop::collection::vec((0_usize..3, -3.0_f64..3.0, -3.0_f64..3.0), 2..40),
        caliper in 0.05_f64..2.0,
    ) {
        let kinds = ["helping", "hindering", "chasing"];
        let events: Vec<Candidate> = values.iter().enumerate()
            .map(|(k, &(kind, a, b))| event(&format!("e{k}"), kinds[kind], &[a, b])).collect();
        let names = ["a".to_owned(), "b".to_owned()];
        let Ok(result) = matched(&names, &events, caliper) else {
            prop_assert!(values.iter().all(|(kind, ..)| *kind == values[0].0));
            return Ok(());
        };
        let of: BTreeMap<&str, &Candidate> = events.iter().map(|event| (event.id.as_str(), event)).collect();
        let sd = |k: usize| {
            let values: Vec<f64> = events.iter().map(|event| event.measures[k]).collect();
            phase_statistics::standard_deviation(&values).unwrap()
        };
        let mut used = BTreeSet::new();
        for group in &result.groups {
            for (id, kind) in group.iter().zip(&result.kinds) {
                prop_assert_eq!(&of[id.as_str()].kind, kind);
                prop_assert!(used.insert(id));
            }
            for (a, b) in group.iter().flat_map(|a| group.iter().map(move |b| (a, b))) {
                for k in 0..2 {
                    let apart = of[a.as_str()].measures[k] - of[b.as_str()].measures[k];
                    prop_assert!(apart.abs() <= caliper * sd(k) * (1.0 + 1e-9));
                }
            }
        }
    }

    /// Members of a set never meet, each is in equally many lists, and stimuli without a set are in all.
    #[test]
    fn lists_are_counterbalanced(
        sets in 1_usize..6,
        members in 1_usize..4,
        alone in 0_usize..5,
        times in 1_usize..3,
        seed in any::<u64>(),
    ) {
        let mut stimuli = Vec::new();
        for set in 0..sets {
            for member in 0..members {
                stimuli.push(Stimulus { id: format!("{set}-{member}"), set: Some(set.to_string()) });
            }
        }
        stimuli.extend((0..alone).map(|k| Stimulus { id: format!("alone{k}"), set: None }));
        let count = members * times;
        let made = lists(&stimuli, count, &mut stream(seed, Purpose::Assignment, 0)).unwrap();
        prop_assert_eq!(made.len(), count);
        let mut shown = vec![0; stimuli.len()];
        for list in &made {
            prop_assert_eq!(list.len(), sets + alone);
            let unit = |&k: &usize| stimuli[k].set.clone().unwrap_or_else(|| stimuli[k].id.clone());
            let of: BTreeSet<String> = list.iter().map(unit).collect();
            prop_assert_eq!(of.len(), list.len());
            list.iter().for_each(|&k| shown[k] += 1);
        }
        for (stimulus, shown) in stimuli.iter().zip(shown) {
            prop_assert_eq!(shown, if stimulus.set.is_some() { times } else { count });
        }
        if members > 1 {
            prop_assert!(lists(&stimuli, members - 1, &mut stream(seed, Purpose::Assignment, 0)).is_err());
        }
    }
}

fn features(rows: &[&[f64]]) -> Vec<(String, Vec<f64>)> {
    rows.iter().enumerate().map(|(k, row)| (format!("s{k}"), row.to_vec())).collect()
}

#[test]
fn a_condensed_matrix_has_scipys_order_and_numpys_form() {
    let matrix =
        Dissimilarity::of(&features(&[&[0.0, 0.0], &[3.0, 4.0], &[0.0, 1.0]]), Distance::Euclidean).unwrap();
    // pdist: (0, 1), (0, 2), (1, 2).
    assert_eq!(matrix.condensed, [5.0, 1.0, 18.0_f64.sqrt()]);
    assert_eq!((matrix.at(2, 1), matrix.at(1, 1)), (18.0_f64.sqrt(), 0.0));
    let bytes = matrix.to_npy();
    let header = u16::from_le_bytes([bytes[8], bytes[9]]) as usize;
    assert_eq!((&bytes[..8], (10 + header) % 64), (&b"\x93NUMPY\x01\x00"[..], 0));
    assert_eq!(bytes.len(), 10 + header + 3 * 8);
    assert_eq!(bytes[10 + header..][..8], 5.0_f64.to_le_bytes());
    let correlation =
        Dissimilarity::of(&features(&[&[1.0, 2.0], &[2.0, 4.0], &[4.0, 2.0]]), Distance::Correlation)
            .unwrap();
    assert!((correlation.condensed[0] - 0.0).abs() < 1e-12 && (correlation.condensed[1] - 2.0).abs() < 1e-12);
}

#[test]
fn what_makes_no_matrix_is_refused() {
    let of =
        |rows: &[&[f64]], distance| Dissimilarity::of(&features(rows), distance).unwrap_err().to_string();
    assert!(of(&[&[1.0], &[2.0]], Distance::Euclidean).contains("3 stimuli"));
    assert!(of(&[&[1.0], &[2.0, 1.0], &[1.0]], Distance::Euclidean).contains("s1 has 2 features, s0 has 1"));
    assert!(of(&[&[1.0, 1.0], &[2.0, 1.0], &[1.0, 3.0]], Distance::Correlation).contains("not defined"));
    for distance in Distance::ALL {
        let huge = of(&[&[1e308, -1e308], &[-1e308, 1e308], &[1.0, 2.0]], distance);
        assert!(huge.contains("s0 has the feature 1") && huge.contains("from -1e150 to 1e150"), "{huge}");
    }
}

#[test]
fn a_model_that_another_determines_explains_nothing_of_its_own() {
    let line: Vec<Vec<f64>> = (0..8).map(|k| vec![f64::from(k * k)]).collect();
    let rows: Vec<&[f64]> = line.iter().map(Vec::as_slice).collect();
    let matrix = Dissimilarity::of(&features(&rows), Distance::Euclidean).unwrap();
    let mut random = stream(1, Purpose::Bootstrap, 0);
    let same = similarity(&matrix, &matrix, Rank::Kendall, 50, &mut random).unwrap();
    assert!((same.value - 1.0).abs() < 1e-12 && same.low > 0.99);
    assert!(unique(&matrix, &matrix, &[&matrix], 50, &mut random).is_none());
}

#[test]
fn every_platform_has_a_table_for_each_list_that_is_read_back() {
    let trial = |k: usize| Trial {
        id: format!("event-{k}"),
        video: format!("event-{k}.mp4"),
        frames: 0,
        milliseconds: 12_250,
        kind: "helping".into(),
        relation: "friendly".into(),
        set: String::new(),
        check: if k == 1 { "neutral".into() } else { String::new() },
    };
    let question = Question { text: "Friendly, or not?", answers: &["friendly", "neutral"] };
    let made = [vec![trial(0), trial(1)], vec![trial(1), trial(0)]];
    for platform in Platform::ALL {
        let files = files(platform, &made, question, "https://example.org/v").unwrap();
        let tables: Vec<_> = files.iter().filter(|(name, _)| name.ends_with(".csv")).collect();
        assert_eq!(tables.len(), 2, "{platform:?}");
        for (_, text) in tables {
            let mut reader = csv::Reader::from_reader(text.as_bytes());
            let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
            let trials = rows.iter().filter(|row| row.iter().any(|cell| cell.ends_with(".mp4"))).count();
            assert_eq!(trials, 2, "{platform:?}");
            assert!(!text.starts_with('\u{feff}'));
        }
        assert!(files.iter().any(|(name, text)| name == "README.md" && text.lines().count() >= 5));
        for (_, text) in files.iter().filter(|(name, _)| name.ends_with(".json")) {
            let protocol: serde_json::Value = serde_json::from_str(text).unwrap();
            let sequence = protocol["sequence"].as_array().unwrap();
            assert!(
                sequence.len() == 4
                    && sequence.iter().all(|name| protocol["frames"][name.as_str().unwrap()].is_object())
            );
        }
    }
}
