//! The subgoal of every goal and mode.

use crate::cases::{Tally, agent, aim, cases, goal, list, name, scene, state, text};
use phase_model::{AgentId, Attitude, Goal};
use phase_published::{Mind, PublishedParameters};
use std::collections::BTreeMap;

#[test]
fn subgoals_are_the_originals() {
    let Some(cases) = cases("oracle-rules.json") else { return };
    let mut tallies: BTreeMap<String, Tally> = BTreeMap::new();
    let mut crashes = 0;
    for case in &cases {
        let state = state(&case["state"]["bodies"], &case["state"]["grips"]);
        for who in 0..2 {
            for it in list(&case["rules"][who]) {
                let mode = text(&it[0]);
                if it[2].is_string() {
                    crashes += 1;
                    continue;
                }
                let wanted: Goal = goal(&it[1]);
                let attitude = match mode {
                    "neutral" => Attitude::Neutral,
                    "friendly" => Attitude::Help,
                    _ => Attitude::Hinder,
                };
                let mut attitudes = [Attitude::Neutral; 2];
                attitudes[who] = attitude;
                // Whose goal it is does not matter to the rules: both have it.
                let scene = scene(&case["scene"], [wanted; 2], attitudes);
                let who: AgentId = agent(who);
                let mind = Mind::new(&scene, who, PublishedParameters::default()).expect("a mind");
                let (ours, theirs) = (mind.aim(&state), aim(&it[2]));
                let tally = tallies.entry(format!("{mode} {}", text(&it[1][0]))).or_default();
                tally.add(ours == theirs, || {
                    format!("{}, {who}, {mode} {}: {ours:?}, theirs {}", name(case), it[1], it[2])
                });
            }
        }
    }
    println!("the original crashes in {crashes} cases");
    for (kind, tally) in &tallies {
        println!("{kind}: {tally}");
    }
    assert_eq!(tallies.values().map(|tally| tally.different).sum::<usize>(), 0);
}
