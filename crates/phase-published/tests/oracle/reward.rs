//! Rewards and the actions offered.

use crate::cases::{Tally, agent, aim, cases, layout, list, name, real, state, whole};
use phase_model::Action;
use phase_published::Rooms;

/// Greatest difference of a reward: the original rounds nothing, but computes in double precision.
const TOLERANCE: f64 = 1e-5;

#[test]
fn rewards_and_actions_are_the_originals() {
    let Some(cases) = cases("oracle-reward.json") else { return };
    let [mut rewards, mut actions] = [(); 2].map(|()| Tally::default());
    for case in &cases {
        let rooms = Rooms::new(layout(&case["scene"]));
        let state = state(&case["state"]["bodies"], &case["state"]["grips"]);
        for it in list(&case["rewards"]) {
            let aim = aim(&it[0]);
            let ours = aim.reward(&rooms, &state, Action::Stop);
            let theirs = real(&it[1]);
            rewards.add((ours - theirs).abs() < TOLERANCE, || {
                format!("{}, {}: reward {ours}, theirs {theirs}", name(case), it[0])
            });
            for who in 0..2 {
                let ours = aim.actions(agent(who), false, &state).len();
                let theirs = whole(&it[2][who]);
                actions.add(ours == theirs, || {
                    format!("{}, {}, agent {who}: {ours} actions, theirs {theirs}", name(case), it[0])
                });
            }
        }
    }
    println!("rewards: {rewards}; numbers of actions: {actions}");
    for tally in [rewards, actions] {
        assert_eq!(tally.different, 0);
    }
}
