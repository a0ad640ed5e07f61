//! Parameters as people give them: by name, of one kind of mind, within their ranges.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use phase_minds::{MindKind, MindParameters, PhaseParameters, Prior, PublishedParameters};
use serde_json::{Value, json};

fn refused(given: Value) -> String {
    MindParameters::from_overrides(given).unwrap_err().to_string()
}

#[test]
fn absent_parameters_have_their_defaults() {
    let given = MindParameters::from_overrides(json!({"simulations": 7, "heuristic_share": 0.25})).unwrap();
    let expected = PhaseParameters { simulations: 7, heuristic_share: 0.25, ..PhaseParameters::default() };
    assert_eq!(given, expected.into());
    assert_eq!(MindParameters::from_overrides(json!({})).unwrap(), MindParameters::default());
    // The prior is left out of files at its default, and a parameter all the same.
    let given = MindParameters::from_overrides(json!({"prior": "network-alone"})).unwrap();
    let prior = Prior::NetworkAlone;
    assert_eq!(given, PhaseParameters { prior, ..PhaseParameters::default() }.into());
    assert!(json!(MindParameters::default()).get("prior").is_none());
    assert!(refused(json!({"prior": "none"})).starts_with("field `prior` is wrong: "));
    let given = MindParameters::from_overrides(json!({"kind": "published", "searches": 3})).unwrap();
    assert_eq!(given, PublishedParameters { searches: 3, ..PublishedParameters::default() }.into());
}

#[test]
fn an_error_names_the_parameter_and_the_rule() {
    assert_eq!(refused(json!(3)), "parameters of minds must be an object");
    assert_eq!(refused(json!({"kind": "mine"})), "field `kind` must be phase or published, not \"mine\"");
    assert_eq!(refused(json!({"stamina": 3})), "field `stamina` is no parameter of phase minds");
    assert!(
        refused(json!({"simulations": "many"})).starts_with("field `simulations` is wrong: invalid type")
    );
    assert_eq!(refused(json!({"particles": 0})), "field `particles` must be 1 to 100000, not 0");
    assert_eq!(refused(json!({"decisiveness": -1})), "field `decisiveness` must be 0 to 100, not -1");
    assert_eq!(refused(json!({"effort": 2})), "field `effort` must be 0 to 1, not 2");
    assert_eq!(refused(json!({"rest_prior": 0})), "field `rest_prior` must be above 0, to 1000, not 0");
}

#[test]
fn a_parameter_of_another_kind_is_refused_by_name() {
    assert_eq!(
        refused(json!({"searches": 2})),
        "field `searches` is a parameter of published minds, not of phase minds"
    );
    assert_eq!(
        refused(json!({"kind": "published", "rest_prior": 0.5})),
        "field `rest_prior` is a parameter of phase minds, not of published minds"
    );
    for (kind, foreign) in [("phase", "searches"), ("published", "effort"), ("phase", "one_way_turns")] {
        let mut whole = json!(MindParameters::from_overrides(json!({ "kind": kind })).unwrap());
        assert!(serde_json::from_value::<MindParameters>(whole.clone()).is_ok());
        whole[foreign] = json!(1);
        let refused = serde_json::from_value::<MindParameters>(whole).unwrap_err().to_string();
        assert!(refused.contains(&format!("unknown field `{foreign}`")), "{refused}");
    }
}

#[test]
fn files_name_the_kind_and_hold_every_parameter() {
    for kind in MindKind::ALL {
        let whole = json!(MindParameters::of(kind));
        assert_eq!(whole["kind"], kind.name());
        assert_eq!(
            serde_json::from_value::<MindParameters>(whole.clone()).unwrap(),
            MindParameters::of(kind)
        );
        for name in whole.as_object().unwrap().keys() {
            let mut part = whole.clone();
            part.as_object_mut().unwrap().remove(name);
            let refused = serde_json::from_value::<MindParameters>(part).unwrap_err().to_string();
            assert!(refused.contains(name), "{refused}");
        }
    }
}

#[test]
fn a_file_with_a_parameter_out_of_its_range_is_refused() {
    let mut whole = json!(MindParameters::default());
    whole["particles"] = json!(0);
    let refused = serde_json::from_value::<MindParameters>(whole).unwrap_err().to_string();
    assert_eq!(refused, "field `particles` must be 1 to 100000, not 0");
}

/// Every number has a range, with both ends, and the defaults lie in it.
#[test]
fn no_number_may_be_negative_or_huge() {
    for kind in MindKind::ALL {
        MindParameters::of(kind).validate().unwrap();
        let whole = json!(MindParameters::of(kind));
        for (name, value) in whole.as_object().unwrap() {
            if !value.is_number() {
                continue;
            }
            for beyond in [json!(-1), json!(2_000_000_000_u64)] {
                let refused = refused(json!({"kind": kind.name(), name.as_str(): beyond}));
                assert!(refused.contains(&format!("field `{name}`")), "{refused}");
                let mut file = whole.clone();
                file[name] = beyond;
                if let Err(wrong) = serde_json::from_value::<MindParameters>(file.clone()) {
                    assert!(!wrong.to_string().is_empty());
                } else {
                    panic!("a file may have {name} {}", file[name]);
                }
                let error = MindParameters::read(&file, "settings.minds").unwrap_err().to_string();
                assert!(error.contains("field `settings.minds"), "{error}");
                assert!(error.contains(name.as_str()), "{error}");
            }
        }
    }
}

/// Each of these may be large, not all at once: a decision would never end.
#[test]
fn the_work_of_a_decision_has_a_bound() {
    let most = json!({"simulations": 1_000_000, "rollout_steps": 100});
    MindParameters::from_overrides(most).unwrap();
    let more = refused(json!({"simulations": 1_000_000, "rollout_steps": 101}));
    assert!(more.contains("must be 0 to 100000000, not 101000000"), "{more}");
    let more = refused(json!({"kind": "published", "simulations": 1_000_000, "searches": 100}));
    assert!(more.contains("must be 0 to 100000000, not 1000000000"), "{more}");
}

/// The ranges of parameters in the documents are those that are enforced.
#[test]
fn documents_state_the_ranges() {
    let documents = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/explanation");
    let files = [(MindKind::Phase, "minds.md"), (MindKind::Published, "published-minds.md")];
    for (kind, file) in files {
        let Ok(text) = std::fs::read_to_string(documents.join(file)) else {
            println!("skipped: the crate is not in its repository");
            continue;
        };
        for setting in MindParameters::of(kind).settings() {
            let row = text.lines().find(|line| line.starts_with(&format!("| `{}` |", setting.name)));
            let row = row.unwrap_or_else(|| panic!("{file} lacks {}", setting.name));
            let said = row.split('|').nth(4).unwrap().trim();
            let least = setting.range().replace(" to ", "–").replace("above 0,–", "> 0, ≤ ");
            assert_eq!(said, least, "{file}: {}", setting.name);
        }
    }
}
