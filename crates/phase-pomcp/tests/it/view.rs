//! The tree as data, and searches that go on in a part of it.

use phase_pomcp::{ActionView, HistoryView, Pomcp, PomcpSettings};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use serde_json::Value;

use crate::arbitrary::{problem, settings};

/// A history that nothing is known of.
static NOTHING: HistoryView<u64> = HistoryView { visits: 0, actions: Vec::new() };
/// As deep as a view gets.
const ALL: u8 = u8::MAX;

/// The history after an action and an observation.
fn after(view: &HistoryView<u64>, action: usize, observation: u64) -> Option<&HistoryView<u64>> {
    let action = view.actions.iter().find(|it| it.action == action)?;
    action.branches.iter().find(|(seen, _)| *seen == observation).map(|(_, after)| after)
}

/// What has to hold of every history of a tree that is shown with the actions of so many levels.
fn check(view: &HistoryView<u64>, levels: u8) {
    if levels == 0 {
        return;
    }
    let of = |action: &ActionView<u64>| action.visits;
    assert_eq!(view.actions.iter().map(of).sum::<usize>(), view.visits);
    assert!(view.actions.is_sorted_by(|a, b| a.visits >= b.visits));
    if !view.actions.is_empty() {
        let priors: f64 = view.actions.iter().map(|action| action.prior).sum();
        assert!((priors - 1.0).abs() < 1e-9);
    }
    for action in &view.actions {
        // A branch's first simulation ends in a rollout, and others end with the problem or at the horizon.
        let below: usize = action.branches.iter().map(|(_, after)| after.visits + 1).sum();
        assert!(below <= action.visits, "{below} of {}", action.visits);
        action.branches.iter().for_each(|(_, after)| check(after, levels - 1));
    }
}

/// The JSON of a history says what the view says.
fn same(json: &Value, view: &HistoryView<u64>) {
    assert_eq!(json["visits"], view.visits);
    let actions = json["actions"].as_array().expect("actions");
    assert_eq!(actions.len(), view.actions.len());
    for (json, action) in actions.iter().zip(&view.actions) {
        assert_eq!(json["action"], action.action);
        assert_eq!(json["value"].as_f64().expect("a number"), action.value);
        let branches = json["branches"].as_array().expect("actions");
        assert_eq!(branches.len(), action.branches.len());
        for (json, (observation, after)) in branches.iter().zip(&action.branches) {
            assert_eq!(json["observation"], observation.to_string());
            same(&json["after"], after);
        }
    }
}

proptest! {
    #[test]
    fn a_view_counts_every_simulation_once(problem in problem(), settings in settings(), seed: u64) {
        let roots: Vec<u64> = (0..problem.states).collect();
        let mut pomcp = Pomcp::new(settings).unwrap();
        prop_assert_eq!(&pomcp.view(ALL, 0), &NOTHING);
        let decision = pomcp.search(&problem, &roots, &mut Pcg64Mcg::seed_from_u64(seed)).unwrap();
        let view = pomcp.view(ALL, 0);
        check(&view, ALL);
        let shallow = pomcp.view(20, 0);
        same(&serde_json::from_str(&shallow.to_json()).unwrap(), &shallow);
        prop_assert_eq!(view.visits, decision.actions.iter().map(|it| it.visits).sum::<usize>());
        prop_assert_eq!(view.principal_variation()[0].0.action, decision.action);
        for action in &view.actions {
            prop_assert_eq!(action.value, decision.actions[action.action].value);
        }
        // Fewer levels, and only what is visited often.
        let part = pomcp.view(1, 5);
        prop_assert!(part.actions.iter().all(|it| it.visits >= 5));
        let mut below = part.actions.iter().flat_map(|it| &it.branches);
        prop_assert!(below.all(|(_, after)| after.actions.is_empty()));
    }

    #[test]
    fn what_is_kept_is_what_was_there(problem in problem(), settings in settings(), seed: u64) {
        let roots: Vec<u64> = (0..problem.states).collect();
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut pomcp = Pomcp::new(settings).unwrap();
        pomcp.search(&problem, &roots, &mut random).unwrap();
        let whole = pomcp.view(ALL, 0);
        for action in 0..problem.actions {
            for observation in 0..problem.observations {
                let expected = after(&whole, action, observation).unwrap_or(&NOTHING);
                let mut pomcp = pomcp.clone();
                let kept = pomcp.keep(action, &observation);
                prop_assert_eq!(&pomcp.view(ALL - 1, 0), expected);
                prop_assert_eq!(kept, expected.visits);
                // A search that goes on adds its simulations to those that are there.
                let decision = pomcp.search_on(&problem, &roots, &mut random).unwrap();
                let visits: usize = decision.actions.iter().map(|it| it.visits).sum();
                prop_assert!(visits <= kept + settings.simulations);
                prop_assert!(settings.stop_when_decided || visits == kept + settings.simulations);
                check(&pomcp.view(ALL, 0), ALL);
            }
        }
    }

    #[test]
    fn a_search_that_goes_on_from_nothing_is_a_search(
        problem in problem(), settings in settings(), seed: u64
    ) {
        let roots: Vec<u64> = (0..problem.states).collect();
        let new = || (Pomcp::new(settings).unwrap(), Pcg64Mcg::seed_from_u64(seed));
        let (mut fresh, mut random) = new();
        let expected = fresh.search(&problem, &roots, &mut random).unwrap();
        let (mut kept, mut random) = new();
        prop_assert_eq!(&kept.search_on(&problem, &roots, &mut random).unwrap(), &expected);
        // An observation that no simulation made.
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        prop_assert_eq!(kept.keep(0, &u64::MAX), 0);
        prop_assert_eq!(&kept.search_on(&problem, &roots, &mut random).unwrap(), &expected);
    }
}

#[test]
fn a_graph_has_every_history_and_action_once() {
    let leaf = HistoryView { visits: 0, actions: Vec::new() };
    let action =
        ActionView { action: 1, visits: 3, value: 0.5, prior: 1.0, branches: vec![("\"quoted\"", leaf)] };
    let view = HistoryView { visits: 3, actions: vec![action] };
    let expected = "digraph {\n  h0 [shape=point]\n  \
        a1 [shape=box, label=\"peek\\n0.500, 3 visits, prior 1.000\"]\n  h0 -> a1\n  \
        h2 [shape=point]\n  a1 -> h2 [label=\"\\\"\\\\\\\"quoted\\\\\\\"\\\", 0 visits\"]\n}\n";
    assert_eq!(view.to_dot(|_| "peek".into()), expected);
    let text = view.to_string();
    assert_eq!(text, "1: 0.500, 3 visits, prior 1.000\n  \"\\\"quoted\\\"\", 0 visits\n");
    let settings = PomcpSettings::default();
    assert_eq!(Pomcp::<u64>::new(settings).unwrap().view(1, 0).to_string(), "");
}
