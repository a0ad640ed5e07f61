//! Reward, actions, contacts and distances of words, compared with their definitions.

use phase_model::{
    Action, AgentId, Attitude, Contacts, Entity, Vec2,
    json::edit_distance,
    reward::{action_cost, social_reward},
};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn attitude() -> impl Strategy<Value = (i8, Attitude)> {
    (-1..=1_i8).prop_map(|alpha| {
        let all = [Attitude::Hinder, Attitude::Neutral, Attitude::Help];
        (alpha, *all.iter().find(|it| it.alpha() == alpha).expect("an attitude of each α"))
    })
}

proptest! {
    /// Equation 1, by cases: the own goal alone, the other's alone, or its opposite.
    #[test]
    fn reward_is_that_of_the_goal_that_counts(
        (alpha, attitude) in attitude(),
        own in -2.0..2.0_f64,
        other in -2.0..2.0_f64,
        action in 0..14_usize,
    ) {
        let action = Action::ALL[action];
        let goal = match alpha {
            0 => own,
            1 => other,
            _ => -other,
        };
        prop_assert_eq!(social_reward(attitude, own, other, action), goal + action_cost(action));
    }

    /// A set of contacts is one of unordered pairs of different entities.
    #[test]
    fn contacts_are_a_set_of_pairs(pairs in prop::collection::vec((0..4_usize, 0..4_usize), 0..12)) {
        let mut contacts = Contacts::NONE;
        let mut halves = [Contacts::NONE; 2];
        let mut known = BTreeSet::new();
        for (k, (a, b)) in pairs.into_iter().enumerate() {
            contacts.insert(Entity::ALL[a], Entity::ALL[b]);
            halves[k % 2].insert(Entity::ALL[a], Entity::ALL[b]);
            known.extend((a != b).then_some((a.min(b), a.max(b))));
        }
        prop_assert_eq!(halves[0].union(halves[1]), contacts);
        for (a, one) in Entity::ALL.into_iter().enumerate() {
            for (b, other) in Entity::ALL.into_iter().enumerate() {
                prop_assert_eq!(contacts.touching(one, other), known.contains(&(a.min(b), a.max(b))));
            }
        }
    }

    /// The edit distance is a metric, and two texts that are two edits apart have a distance of at most two.
    #[test]
    fn edits_are_counted_as_a_distance(a in "[abc]{0,8}", b in "[abc]{0,8}", at in 0..8_usize) {
        let distance = edit_distance(&a, &b);
        prop_assert_eq!(distance, edit_distance(&b, &a));
        prop_assert_eq!(distance == 0, a == b);
        prop_assert!(distance >= a.len().abs_diff(b.len()) && distance <= a.len().max(b.len()));
        let mut longer = a.clone();
        longer.insert(at.min(a.len()), 'x');
        prop_assert_eq!(edit_distance(&a, &longer), 1);
        let mut letters: Vec<char> = a.chars().collect();
        if at + 1 < letters.len() {
            letters.swap(at, at + 1);
            let swapped = letters.iter().collect::<String>();
            prop_assert_eq!(edit_distance(&a, &swapped), usize::from(swapped != a));
        }
    }
}

#[test]
fn seven_pushes_cost_and_nothing_else() {
    for action in Action::ALL {
        let pushes_elsewhere = action.push().is_some() && action != Action::Up;
        assert_eq!(action_cost(action) < 0.0, pushes_elsewhere, "{action:?}");
    }
    assert_eq!(Action::ALL.iter().filter(|action| action_cost(**action) < 0.0).count(), 7);
}

#[test]
fn pushes_go_in_eight_directions_as_their_names_say() {
    let axes = [("up", Vec2::Y), ("down", -Vec2::Y), ("left", -Vec2::X), ("right", Vec2::X)];
    let mut directions = BTreeMap::new();
    for action in Action::ALL {
        let Some(push) = action.push() else { continue };
        assert!((push.length() - 1.0).abs() < 2e-4, "{action:?} has the agent's force");
        let named: Vec2 =
            axes.iter().filter(|(name, _)| action.name().contains(name)).map(|(_, axis)| *axis).sum();
        assert!(push.dot(named.normalize()) > 0.999, "{action:?}: {push}");
        assert_eq!(action.turn(), 0.0, "{action:?}");
        directions.insert((push.to_angle().to_degrees().round() as i32).rem_euclid(360), action);
    }
    assert_eq!(directions.into_keys().collect::<Vec<_>>(), [0, 45, 90, 135, 180, 225, 270, 315]);
}

#[test]
fn actions_have_their_names_and_places_in_files() {
    for (index, action) in Action::ALL.into_iter().enumerate() {
        assert_eq!(action.index(), index);
        assert_eq!(serde_json::to_value(action).expect("JSON"), action.name());
    }
    assert_eq!(Action::TurnLeft.turn(), -Action::TurnRight.turn());
    assert_eq!(Entity::ALL[AgentId::ONE.index()], Entity::Agent(AgentId::ONE));
}

/// A reflection changes nothing when it is done twice, and exchanges the names of left and right.
#[test]
fn a_mirrored_action_exchanges_left_and_right() {
    for action in Action::ALL {
        assert_eq!(action.mirrored().mirrored(), action);
        let words = format!("{action:?}");
        let swapped = words.replace("Left", "\0").replace("Right", "Left").replace('\0', "Right");
        assert_eq!(format!("{:?}", action.mirrored()), swapped);
    }
}
