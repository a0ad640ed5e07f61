//! Progressive widening with weighted particles, compared with closed forms.

use phase_pomcp::{
    BeliefError, BeliefModel, GenerativeModel, ObservationModel, ParticleBelief, Pomcp, PomcpError,
    PomcpSettings, Transition, Widening,
};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A hidden sign; measuring it costs 0.1 and gives it with a normal error of standard deviation 1, and
/// guessing it earns 1 or costs 1.
struct Sign {
    /// By what a likelihood is multiplied.
    scale: f64,
}

const MEASURE: usize = 2;

impl GenerativeModel for Sign {
    type State = bool;
    type Observation = f64;

    fn action_count(&self) -> usize {
        3
    }

    fn discount(&self) -> f64 {
        1.0
    }

    fn step(&self, is_plus: &mut bool, action: usize, random: &mut impl Rng) -> Transition<f64> {
        if action != MEASURE {
            let reward = if *is_plus == (action == 1) { 1.0 } else { -1.0 };
            return Transition { observation: 0.0, reward, terminal: true };
        }
        let radius = (-2.0 * (1.0 - random.random::<f64>()).ln()).sqrt();
        let error = radius * (std::f64::consts::TAU * random.random::<f64>()).cos();
        Transition { observation: value(*is_plus) + error, reward: -0.1, terminal: false }
    }
}

fn value(is_plus: bool) -> f64 {
    if is_plus { 1.0 } else { -1.0 }
}

impl ObservationModel for Sign {
    fn likelihood(&self, _: usize, &is_plus: &bool, &seen: &f64) -> f64 {
        self.scale * (-0.5 * (seen - value(is_plus)).powi(2)).exp()
    }
}

impl BeliefModel for Sign {}

const SETTINGS: PomcpSettings = PomcpSettings {
    simulations: 30_000,
    rollout_steps: 0,
    horizon: 2,
    c_init: 1.25,
    c_base: 1e6,
    normalise_values: false,
    stop_when_decided: false,
    convergence: 0.0,
    untried_first: true,
};

/// After one measurement the sign that it has is the right one with probability Φ(1), so that a guess is
/// worth 2 Φ(1) − 1. A search that took the state of a branch for known would promise 1.
#[test]
fn a_measurement_is_worth_what_the_normal_distribution_says() {
    const PHI_1: f64 = 0.841_344_746;
    let mut values = Vec::new();
    for seed in 0..20 {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut pomcp = Pomcp::new(SETTINGS).unwrap();
        let widening = Widening { factor: 40.0, exponent: 0.0 };
        let model = Sign { scale: 1.0 };
        let decision = pomcp.search_widened(&model, &[false, true], widening, &mut random).unwrap();
        assert_eq!(decision.action, MEASURE);
        values.push(decision.actions[MEASURE].value);
        // The 41st observation still begins a branch: the number may be as large as the factor before.
        assert_eq!(pomcp.view(1, 0).actions[0].branches.len(), 41);
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let expected = 2.0 * PHI_1 - 1.0 - 0.1;
    assert!((mean - expected).abs() < 0.05, "{mean}, expected {expected}");
}

/// Without widening every measurement has a branch of its own, and no simulation comes back to guess.
#[test]
fn without_widening_a_measurement_is_worth_nothing() {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut pomcp = Pomcp::new(SETTINGS).unwrap();
    let decision = pomcp.search(&Sign { scale: 1.0 }, &[false, true], &mut random).unwrap();
    assert!((decision.actions[MEASURE].value + 0.1).abs() < 1e-9);
}

#[test]
fn branches_widen_with_visits() {
    let mut pomcp = Pomcp::new(SETTINGS).unwrap();
    let widening = Widening { factor: 1.0, exponent: 0.5 };
    let mut random = Pcg64Mcg::seed_from_u64(2);
    pomcp.search_widened(&Sign { scale: 1.0 }, &[false, true], widening, &mut random).unwrap();
    let root = pomcp.view(1, 0);
    let measure = root.actions.iter().find(|action| action.action == MEASURE).unwrap();
    let most = (measure.visits as f64).sqrt();
    let branches = measure.branches.len() as f64;
    assert!((most - 1.0..=most + 2.0).contains(&branches), "{branches}, {most}");
}

#[test]
fn invalid_widening_and_likelihoods_are_refused() {
    let mut pomcp = Pomcp::new(SETTINGS).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(3);
    for (factor, exponent) in [(0.0, 0.5), (f64::NAN, 0.5), (f64::INFINITY, 0.5), (1.0, -0.1), (1.0, 1.1)] {
        let widening = Widening { factor, exponent };
        let error = pomcp.search_widened(&Sign { scale: 1.0 }, &[true], widening, &mut random);
        assert!(matches!(error, Err(PomcpError::InvalidWidening { .. })), "{error:?}");
    }
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let model = Sign { scale };
        let error = pomcp.search_widened(&model, &[true], Widening::default(), &mut random);
        assert!(matches!(error, Err(PomcpError::InvalidLikelihood { .. })), "{error:?}");
        let mut belief = ParticleBelief::new(vec![true]).unwrap();
        let error = belief.update_weighted(&model, MEASURE, &0.0, &mut random);
        let is_refused = match error {
            Err(BeliefError::Contradicted { .. }) => scale == 0.0,
            Err(BeliefError::InvalidLikelihood { .. }) => scale != 0.0,
            _ => false,
        };
        assert!(is_refused, "{error:?}");
        assert_eq!(belief.particles(), [true]);
    }
}

/// From even odds, a measurement of 0.7 makes plus e^1.4 times as likely as minus.
#[test]
fn weighted_updates_follow_bayes_rule() {
    let mut belief = ParticleBelief::new((0..10_000).map(|k| k % 2 == 0).collect()).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(4);
    let update = belief.update_weighted(&Sign { scale: 3.0 }, MEASURE, &0.7, &mut random).unwrap();
    let share = belief.particles().iter().filter(|&&is_plus| is_plus).count() as f64 / 1e4;
    let odds = 1.4_f64.exp();
    // Draws of one in 10 000 each would err by 0.004.
    assert!((share - odds / (1.0 + odds)).abs() < 0.01, "{share}");
    assert_eq!((update.attempts, update.recovered), (10_000, 0));
    assert!((5_000..10_000).contains(&update.accepted), "{update:?}");
}
