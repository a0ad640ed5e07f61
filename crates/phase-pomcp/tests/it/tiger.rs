//! A partially observed problem with an exact solution: do searches find it, and do episodes achieve it?

use phase_pomcp::{GenerativeModel, Pomcp, PomcpSettings};
use phase_statistics::{mean, standard_error};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use crate::tiger_problem::{LISTEN, OPEN_LEFT, OPEN_RIGHT, Side, Tiger};

/// The problem in the literature.
const CLASSIC: Tiger = Tiger { accuracy: 0.85 };

/// Steps after which the future is negligible: 0.95³⁰⁰ is 2 in ten million.
const FOREVER: usize = 300;

/// Settings that decide well with few simulations. The tiger's worst return sets the scale of values, about
/// −130 to 20, on which a listening action that pays is only a hundredth better than one that does not, and
/// with the constants intended for games it takes tens of thousands of simulations to distinguish them.
const SHARP: PomcpSettings = PomcpSettings {
    stop_when_decided: false,
    convergence: 0.0,
    untried_first: true,
    simulations: 2000,
    rollout_steps: 10,
    c_init: 0.6,
    c_base: 1e6,
    horizon: usize::MAX,
    normalise_values: true,
};

fn particles(tiger: &Tiger, lead: i32, count: usize) -> Vec<Side> {
    let left = (tiger.probability_left(lead) * count as f64).round() as usize;
    (0..count).map(|index| if index < left { Side::Left } else { Side::Right }).collect()
}

fn best(values: [f64; 3]) -> usize {
    (1..3).fold(0, |best, action| if values[action] > values[best] { action } else { best })
}

#[test]
fn the_reference_gives_the_known_optimum() {
    let values = CLASSIC.exact(FOREVER, 0);
    assert!((values[LISTEN] - 19.37).abs() < 0.005, "the literature says 19.37, not {values:?}");
}

#[test]
fn it_listens_until_it_knows_enough() {
    let cases = [
        // (accuracy, how much more often heard on the left, action)
        (0.85, 0, LISTEN),
        (0.85, 1, LISTEN),
        (0.85, -1, LISTEN),
        (0.85, 2, OPEN_RIGHT),
        (0.85, -2, OPEN_LEFT),
        (0.85, 4, OPEN_RIGHT),
        (0.99, 1, OPEN_RIGHT),
        (0.99, -1, OPEN_LEFT),
        (0.7, 2, LISTEN),
        // Uninformative observations do not change the belief, however frequent; listening is merely the
        // least bad.
        (0.5, 2, LISTEN),
        (0.5, -9, LISTEN),
    ];
    for (accuracy, lead, expected) in cases {
        let tiger = Tiger { accuracy };
        assert_eq!(
            best(tiger.exact(FOREVER, lead)),
            expected,
            "reference at accuracy {accuracy}, lead {lead}"
        );
        let settings = PomcpSettings { simulations: 60_000, ..PomcpSettings::default() };
        let mut pomcp = Pomcp::new(settings).unwrap();
        let roots = particles(&tiger, lead, 10_000);
        for seed in 0..3 {
            let decision = pomcp.search(&tiger, &roots, &mut Pcg64Mcg::seed_from_u64(seed)).unwrap();
            assert_eq!(decision.action, expected, "accuracy {accuracy}, lead {lead}: {decision:?}");
        }
    }
}

#[test]
fn root_values_approach_the_exact_ones() {
    let settings = PomcpSettings { simulations: 100_000, rollout_steps: 0, c_init: 0.2, ..SHARP };
    for (horizon, lead) in [(1, 0), (2, 0), (3, 0), (3, 1), (3, 2), (4, 1)] {
        let mut pomcp = Pomcp::new(PomcpSettings { horizon, ..settings }).unwrap();
        let roots = particles(&CLASSIC, lead, 10_000);
        let decision = pomcp.search(&CLASSIC, &roots, &mut Pcg64Mcg::seed_from_u64(5)).unwrap();
        let exact = CLASSIC.exact(horizon, lead);
        assert_eq!(decision.action, best(exact), "{horizon} steps, lead {lead}: {exact:?} {decision:?}");
        // Below by the cost of exploration; above by no more than sampling error (returns vary by about 30).
        let error = decision.value() - exact[decision.action];
        assert!((-0.9..0.3).contains(&error), "{horizon} steps, lead {lead}: {exact:?} {decision:?}");
    }
}

#[test]
fn episodes_earn_nearly_the_optimum() {
    assert_near_optimum(SHARP);
}

/// Simulates whole episodes, planning at every step from a particle belief, and compares them with the
/// optimum in two ways.
///
/// The total loss of the decisions is computed exactly: each costs the optimal value of the true belief less
/// the exact value of the action taken. That has little noise, so it can be bounded tightly, and it is what
/// the planner loses by finite search and by approximating beliefs with particles. And the actual return must
/// equal the optimum less that loss, within three standard errors. An episode is cut after 30 steps and
/// credited with the exact value of the belief it ended in, so nothing is lost by cutting.
fn assert_near_optimum(settings: PomcpSettings) {
    const EPISODES: u64 = 100;
    const GREATEST_LEAD: i32 = 8;
    let exact: Vec<[f64; 3]> =
        (-GREATEST_LEAD..=GREATEST_LEAD).map(|lead| CLASSIC.exact(FOREVER, lead)).collect();
    let exact = |lead: i32| exact[(lead + GREATEST_LEAD) as usize];
    let optimum = exact(0)[LISTEN];
    let mut pomcp = Pomcp::new(settings).expect("the settings are valid");
    let (mut losses, mut surprises) = (Vec::new(), Vec::new());
    for episode in 0..EPISODES {
        let mut random = Pcg64Mcg::seed_from_u64(episode);
        let mut tiger = Side::draw(0.5, &mut random);
        let mut belief = particles(&CLASSIC, 0, 1000);
        let (mut earned, mut lost, mut weight, mut lead) = (0.0, 0.0, 1.0, 0_i32);
        for _ in 0..30 {
            let action =
                pomcp.search(&CLASSIC, &belief, &mut random).expect("the tiger can be searched").action;
            let values = exact(lead);
            lost += weight * (values[best(values)] - values[action]);
            let outcome = CLASSIC.step(&mut tiger, action, &mut random);
            CLASSIC.update(&mut belief, outcome.observation, &mut random);
            lead = match outcome.observation {
                None => 0,
                Some(Side::Left) => lead + 1,
                Some(Side::Right) => lead - 1,
            };
            earned += weight * outcome.reward;
            weight *= CLASSIC.discount();
        }
        let values = exact(lead);
        earned += weight * values[best(values)];
        losses.push(lost);
        surprises.push(earned - (optimum - lost));
    }
    let loss = mean(&losses).expect("some episodes");
    assert!(loss < 2.5, "gave away {loss} of {optimum}");
    let surprise = mean(&surprises).expect("some episodes");
    let error = standard_error(&surprises).expect("some episodes");
    assert!(error < 4.0, "returns vary too much for a test: {error}");
    assert!(surprise.abs() < 3.0 * error, "earned {surprise} ± {error} more than decided");
}
