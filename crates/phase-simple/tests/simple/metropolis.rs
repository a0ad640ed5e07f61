//! The acceptance rule against exact enumeration, on a problem small enough to enumerate.

use phase_model::random::{Purpose, stream};
use phase_simple::metropolis::threshold;
use rand::RngExt;

/// Four hypotheses, proposed non-uniformly and independently of their likelihoods.
const LIKELIHOODS: [f64; 4] = [0.1, 0.4, 0.05, 0.45];
const PROPOSED: [f64; 4] = [0.55, 0.1, 0.3, 0.05];

#[test]
fn chains_come_to_the_posterior_whatever_proposes() {
    let mut random = stream(3, Purpose::Inference, 0);
    let mut draw = move || -> f64 { random.random() };
    let propose = |u: f64| {
        let mut left = u;
        PROPOSED
            .iter()
            .position(|p| {
                left -= p;
                left < 0.0
            })
            .unwrap_or(3)
    };
    let mut current = 0;
    let mut visits = [0u32; 4];
    const STEPS: u32 = 400_000;
    for _ in 0..STEPS {
        let candidate = propose(draw());
        let needed = threshold(
            draw().ln(),
            LIKELIHOODS[current].ln(),
            PROPOSED[candidate].ln(),
            PROPOSED[current].ln(),
        );
        if LIKELIHOODS[candidate].ln() > needed {
            current = candidate;
        }
        visits[current] += 1;
    }
    for (visits, likelihood) in visits.iter().zip(LIKELIHOODS) {
        // The prior is uniform, so the posterior is the likelihood. The chain moves seldom; 0.01 is several
        // of its standard deviations, while the inverted ratio would give 0.03 instead of 0.45.
        let share = f64::from(*visits) / f64::from(STEPS);
        assert!((share - likelihood).abs() < 0.01, "{share} for {likelihood}");
    }
}
