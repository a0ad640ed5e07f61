//! A fully observed walk whose optimal values have a closed form.

use phase_pomcp::{Decision, GenerativeModel, Pomcp, PomcpSettings, Transition};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const FORWARD: usize = 0;
const BACK: usize = 1;

/// A walk on 0, 1, 2, … that ends at 0 with reward 1. Going back always succeeds, going forward only with a
/// certain probability; otherwise the state does not change.
struct Chain {
    success: f64,
}

impl GenerativeModel for Chain {
    type State = u32;
    type Observation = u32;

    fn action_count(&self) -> usize {
        2
    }

    fn discount(&self) -> f64 {
        0.9
    }

    fn step(&self, distance: &mut u32, action: usize, random: &mut impl Rng) -> Transition<u32> {
        if action == BACK {
            *distance += 1;
        } else if self.is_deterministic() || random.random_bool(self.success) {
            *distance -= 1;
        }
        let terminal = *distance == 0;
        Transition { observation: *distance, reward: f64::from(terminal), terminal }
    }

    fn is_deterministic(&self) -> bool {
        self.success == 1.0
    }
}

impl Chain {
    /// The optimal values of going forward and back. Always going forward is optimal, and a step towards the
    /// goal then takes a geometric time, so V(d) = x^d / γ with x = γp / (1 − γ(1 − p)).
    fn exact(&self, distance: i32) -> [f64; 2] {
        let discount = self.discount();
        let x = discount * self.success / (1.0 - discount * (1.0 - self.success));
        [x.powi(distance) / discount, x.powi(distance + 1)]
    }

    fn decide(&self, distance: u32, simulations: usize) -> Decision {
        let settings = PomcpSettings { simulations, ..PomcpSettings::default() };
        let mut pomcp = Pomcp::new(settings).expect("the defaults are valid");
        pomcp.search(self, &[distance], &mut Pcg64Mcg::seed_from_u64(7)).expect("a chain can be searched")
    }
}

#[test]
fn root_values_converge_to_the_closed_form() {
    let cases = [(1.0, 1), (1.0, 3), (1.0, 5), (0.7, 1), (0.7, 2), (0.7, 3)];
    for (success, distance) in cases {
        let chain = Chain { success };
        let exact = chain.exact(distance as i32);
        let errors = [300, 3000, 30_000].map(|simulations| {
            let decision = chain.decide(distance, simulations);
            assert_eq!(decision.action, FORWARD, "success {success}, distance {distance}: {decision:?}");
            let back = decision.actions[BACK].value - exact[BACK];
            assert!(back < 0.02, "going back cannot be worth more than {}: {decision:?}", exact[BACK]);
            (decision.value() - exact[FORWARD]).abs()
        });
        // Every step on the path is an opportunity to explore, which lowers the mean slightly each time.
        assert!(
            errors[2] < 0.02 * f64::from(distance),
            "success {success}, distance {distance}: errors {errors:?}"
        );
        // One step from the goal there is nothing left to learn, and the error is sampling error alone.
        if distance > 1 {
            assert!(errors[2] < 0.5 * errors[0], "success {success}, distance {distance}: errors {errors:?}");
        }
    }
}

#[test]
fn a_certain_last_step_is_valued_exactly() {
    let decision = Chain { success: 1.0 }.decide(1, 100);
    assert_eq!(decision.actions[FORWARD].value, 1.0);
    assert_eq!(decision.value(), 1.0);
}
