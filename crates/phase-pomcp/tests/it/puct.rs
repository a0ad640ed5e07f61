//! Selection compared with the formula computed by hand, alone and inside a search.

use phase_pomcp::puct::{ValueRange, exploration, score};
use phase_pomcp::{GenerativeModel, Pomcp, PomcpSettings, Transition};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg32;

#[test]
fn scores_follow_the_formula() {
    let cases = [
        // (value, prior, visits of the history, visits of the action, score by pocket calculator)
        (0.5, 0.25, 9, 2, 0.814_987_582_7),
        (0.5, 0.25, 0, 0, 0.5),
        (0.0, 1.0, 1, 0, 1.251_998_002_7),
        (-3.0, 0.0, 100, 1, -3.0),
        (0.0, 0.5, 1000, 499, 0.061_463_516_6),
    ];
    for (value, prior, parent, visits, expected) in cases {
        let explored = exploration(&PomcpSettings::default(), parent);
        let found = score(value, prior, explored, visits);
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }
}

#[test]
fn a_range_maps_its_ends_to_zero_and_one() {
    let mut range = ValueRange::EMPTY;
    assert_eq!(range.normalise(3.0), 0.0);
    range.include(-2.0);
    assert_eq!(range.normalise(-2.0), 0.0);
    range.include(6.0);
    range.include(0.0);
    assert_eq!([-2.0, 0.0, 6.0].map(|value| range.normalise(value)), [0.0, 0.25, 1.0]);
}

/// Arms with constant rewards, pulled once.
struct Bandit {
    pays: Vec<f64>,
    weights: Vec<f64>,
}

impl GenerativeModel for Bandit {
    type State = ();
    type Observation = ();

    fn action_count(&self) -> usize {
        self.pays.len()
    }

    fn discount(&self) -> f64 {
        1.0
    }

    fn step(&self, _: &mut (), action: usize, _: &mut impl Rng) -> Transition<()> {
        Transition { observation: (), reward: self.pays[action], terminal: true }
    }

    fn prior_weight(&self, _: &(), action: usize) -> f64 {
        self.weights[action]
    }
}

fn visits(pays: &[f64], weights: &[f64], simulations: usize, normalise_values: bool) -> Vec<usize> {
    let settings = PomcpSettings { simulations, normalise_values, ..PomcpSettings::default() };
    let bandit = Bandit { pays: pays.to_vec(), weights: weights.to_vec() };
    let mut pomcp = Pomcp::new(settings).expect("the settings are valid");
    let decision =
        pomcp.search(&bandit, &[()], &mut Pcg32::seed_from_u64(1)).expect("a bandit can be searched");
    decision.actions.iter().map(|action| action.visits).collect()
}

/// After one visit of each arm the better arm's lead of 1 is compared with the worse arm's growing
/// exploration term e/4 − e/(2(1 + n)) with e = (ln(1 + (1 + N)/1000) + 1.25)·√N. By hand that is 0.965 at N
/// = 13 and 1.014 at N = 14, so the fifteenth simulation is the worse arm's second.
#[test]
fn a_search_visits_as_computed_by_hand() {
    for (simulations, expected) in [(2, [1, 1]), (3, [1, 2]), (14, [1, 13]), (15, [2, 13]), (16, [2, 14])] {
        assert_eq!(visits(&[0.0, 1.0], &[1.0, 1.0], simulations, true), expected);
        assert_eq!(visits(&[0.0, 1.0], &[1.0, 1.0], simulations, false), expected);
    }
}

#[test]
fn normalised_visits_do_not_depend_on_the_rewards_unit() {
    let expected = visits(&[0.0, 1.0, 0.5], &[1.0; 3], 200, true);
    // Powers of two scale without rounding, and an offset of the same size keeps these values exact.
    for (scale, offset) in [(1.0 / 128.0, 0.0), (1024.0, 0.0), (0.5, -8.0)] {
        let pays = [0.0, 1.0, 0.5].map(|pay| pay * scale + offset);
        assert_eq!(visits(&pays, &[1.0; 3], 200, true), expected, "scale {scale}, offset {offset}");
    }
    // Unscaled, rewards of a hundredth are negligible beside the exploration term, and the search is nearly
    // uninformed.
    let blind = visits(&[0.0, 0.01], &[1.0; 2], 200, false);
    assert!(blind[1] - blind[0] < 20, "{blind:?}");
    let seeing = visits(&[0.0, 0.01], &[1.0; 2], 200, true);
    assert!(seeing[1] > 8 * seeing[0], "{seeing:?}");
}

/// Even an action without any prior, against a far better one already known, and whichever comes last.
#[test]
fn each_action_is_tried_once_before_any_is_compared() {
    let bandit = Bandit { pays: vec![0.0, 0.0, 9.0, 0.0], weights: vec![0.0, 1.0, 1.0, 5.0] };
    let settings = PomcpSettings { simulations: 4, ..PomcpSettings::default() };
    let mut pomcp = Pomcp::new(settings).unwrap();
    for seed in 0..30 {
        let decision = pomcp.search(&bandit, &[()], &mut Pcg32::seed_from_u64(seed)).unwrap();
        assert!(decision.actions.iter().all(|action| action.visits == 1), "{decision:?}");
    }
}

/// Scored by its prior, an action of no value and little prior is not tried until exploration asks for it:
/// the first goes to the largest prior, and with equal values visits follow the priors from the first on.
#[test]
fn without_first_tries_the_priors_decide_from_the_start() {
    let decide = |pays: Vec<f64>, weights: Vec<f64>, simulations| {
        let settings = PomcpSettings { simulations, untried_first: false, ..PomcpSettings::default() };
        let bandit = Bandit { pays, weights };
        let mut pomcp = Pomcp::new(settings).unwrap();
        let decision = pomcp.search(&bandit, &[()], &mut Pcg32::seed_from_u64(1)).unwrap();
        decision.actions.iter().map(|action| action.visits).collect::<Vec<_>>()
    };
    assert_eq!(decide(vec![0.0; 3], vec![1.0, 3.0, 2.0], 1), [0, 1, 0]);
    assert_eq!(decide(vec![0.0; 3], vec![1.0, 3.0, 2.0], 6), [1, 3, 2]);
    assert_eq!(decide(vec![5.0, 0.0], vec![0.0, 1.0], 50), [0, 50]);
}

#[test]
fn among_equal_scores_the_smallest_index_is_tried_next() {
    for (simulations, expected) in [(4, [2, 1, 1]), (5, [2, 2, 1]), (6, [2, 2, 2]), (7, [3, 2, 2])] {
        assert_eq!(visits(&[1.0; 3], &[1.0; 3], simulations, true), expected);
    }
}

#[test]
fn first_tries_come_in_random_order() {
    let settings = PomcpSettings { simulations: 1, ..PomcpSettings::default() };
    let bandit = Bandit { pays: vec![0.0; 4], weights: vec![1.0; 4] };
    let mut pomcp = Pomcp::new(settings).unwrap();
    let mut counts = [0; 4];
    for seed in 0..400 {
        counts[pomcp.search(&bandit, &[()], &mut Pcg32::seed_from_u64(seed)).unwrap().action] += 1;
    }
    // 100 each, give or take four standard deviations of 8.7.
    assert!(counts.iter().all(|count| (65..=135).contains(count)), "{counts:?}");
}

#[test]
fn without_differences_in_value_visits_follow_the_priors() {
    let found = visits(&[2.0; 3], &[6.0, 3.0, 1.0], 1000, true);
    for (count, share) in found.iter().zip([600, 300, 100]) {
        assert!(count.abs_diff(share) <= 5, "{found:?}");
    }
}

#[test]
fn equally_visited_actions_are_told_apart_by_value_and_then_by_index() {
    let cases = [(vec![1.0, 2.0, 2.0], 1), (vec![0.0; 3], 0), (vec![-1.0, -3.0, -0.5], 2)];
    for (pays, expected) in cases {
        let settings = PomcpSettings { simulations: 3, ..PomcpSettings::default() };
        let bandit = Bandit { pays: pays.clone(), weights: vec![1.0; 3] };
        let mut pomcp = Pomcp::new(settings).unwrap();
        let decision = pomcp.search(&bandit, &[()], &mut Pcg32::seed_from_u64(1)).unwrap();
        assert_eq!(decision.action, expected, "{pays:?}");
    }
}
