//! The return of a single simulation, and how the settings truncate it.

use phase_pomcp::{GenerativeModel, Pomcp, PomcpSettings, SearchStatistics, Transition};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// One action with reward 1 a step, forever or until a given time; the value estimate of the remainder is
/// 100.
struct Salary {
    lasts: usize,
}

impl GenerativeModel for Salary {
    type State = usize;
    type Observation = ();

    fn action_count(&self) -> usize {
        1
    }

    fn discount(&self) -> f64 {
        0.5
    }

    fn step(&self, time: &mut usize, _: usize, _: &mut impl Rng) -> Transition<()> {
        *time += 1;
        Transition { observation: (), reward: 1.0, terminal: *time >= self.lasts }
    }

    fn value_estimate(&self, _: &usize) -> f64 {
        100.0
    }
}

#[test]
fn one_simulation_is_one_step_and_one_rollout() {
    let cases = [
        // (lasts, rollout steps, horizon, steps taken, whether the estimate counts)
        (usize::MAX, 0, usize::MAX, 1, true),
        (usize::MAX, 3, usize::MAX, 4, true),
        (usize::MAX, 3, 2, 2, true),
        (usize::MAX, 3, 1, 1, true),
        (1, 3, usize::MAX, 1, false),
        (3, 3, usize::MAX, 3, false),
        (4, 3, usize::MAX, 4, false),
    ];
    for (lasts, rollout_steps, horizon, steps, estimated) in cases {
        let settings = PomcpSettings { simulations: 1, rollout_steps, horizon, ..PomcpSettings::default() };
        let mut pomcp = Pomcp::new(settings).unwrap();
        let decision = pomcp.search(&Salary { lasts }, &[0], &mut Pcg32::seed_from_u64(1)).unwrap();
        // 1 + 1/2 + 1/4 + …, and the estimate after the last of them; all exact in binary.
        let tail = 0.5_f64.powi(steps);
        let expected = 2.0 - 2.0 * tail + if estimated { 100.0 * tail } else { 0.0 };
        assert_eq!(decision.value(), expected, "{lasts} {rollout_steps} {horizon}");
        let histories = if lasts > 1 && horizon > 1 { 2 } else { 1 };
        let effort = SearchStatistics { histories, depth: 1, steps: steps as usize };
        assert_eq!(decision.effort, effort, "{lasts} {rollout_steps} {horizon}");
    }
}

#[test]
fn each_simulation_goes_one_history_deeper() {
    let settings = PomcpSettings { simulations: 5, rollout_steps: 10, ..PomcpSettings::default() };
    let mut pomcp = Pomcp::new(settings).unwrap();
    let decision = pomcp.search(&Salary { lasts: usize::MAX }, &[0], &mut Pcg32::seed_from_u64(1)).unwrap();
    // One action and one observation make the tree a path: simulation k takes k steps in it and 10 beyond.
    assert_eq!(decision.effort, SearchStatistics { histories: 6, depth: 5, steps: 1 + 2 + 3 + 4 + 5 + 50 });
}
