//! The results of searches are pinned, to the last bit.

use phase_pomcp::{Decision, Pomcp, PomcpSettings};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::arbitrary::{Arbitrary, Certain};

/// Digests of 200 problems under settings of all kinds: with several roots, and with the single root of a
/// deterministic problem, whose steps are cached.
const PINNED: [u64; 2] = [0xf322_6601_2487_c88f, 0x08d0_5a65_9930_99d8];

fn problem(random: &mut impl Rng) -> Arbitrary {
    let low = random.random_range(-100.0..100.0);
    Arbitrary {
        seed: random.random(),
        states: random.random_range(1..6),
        actions: random.random_range(1..7),
        observations: random.random_range(1..5),
        discount: random.random(),
        rewards: (low, low + random.random_range(0.0..100.0)),
        ends: if random.random() { 0.0 } else { random.random_range(0.0..0.5) },
    }
}

fn settings(random: &mut impl Rng) -> PomcpSettings {
    PomcpSettings {
        simulations: random.random_range(1..600),
        rollout_steps: random.random_range(0..12),
        c_init: random.random_range(0.0..3.0),
        c_base: random.random_range(1.0..1e4),
        horizon: if random.random() { usize::MAX } else { random.random_range(1..15) },
        normalise_values: random.random(),
        stop_when_decided: random.random(),
        convergence: if random.random() { 0.0 } else { random.random_range(0.0..0.3) },
        untried_first: random.random(),
    }
}

/// FNV-1a over the bits of everything a decision says.
fn include(digest: &mut u64, decision: &Decision) {
    let mut word = |word: u64| {
        for byte in word.to_le_bytes() {
            *digest = (*digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    };
    word(decision.action as u64);
    for action in &decision.actions {
        word(action.visits as u64);
        word(action.value.to_bits());
    }
    let effort = decision.effort;
    [effort.histories, effort.depth, effort.steps].into_iter().for_each(|count| word(count as u64));
}

#[test]
fn searches_are_unchanged() {
    let mut digests = [0xcbf2_9ce4_8422_2325_u64; 2];
    let mut random = Pcg64Mcg::seed_from_u64(20_260_101);
    for _ in 0..200 {
        let (problem, settings) = (problem(&mut random), settings(&mut random));
        let roots: Vec<u64> = (0..problem.states).collect();
        let mut pomcp = Pomcp::new(settings).unwrap();
        include(&mut digests[0], &pomcp.search(&problem, &roots, &mut random).unwrap());
        let certain = Certain { problem, says_so: true };
        include(&mut digests[1], &pomcp.search(&certain, &roots[..1], &mut random).unwrap());
        digests[1] ^= random.random::<u64>();
    }
    assert_eq!(digests, PINNED, "{digests:#018x?}");
}
