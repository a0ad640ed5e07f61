//! Every kind of invalid input has its own error, and none of them corrupts the planner.

use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings, Transition};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// A model that satisfies its contract or violates it.
#[derive(Debug, Clone, Copy)]
struct Promises {
    actions: usize,
    discount: f64,
    reward: f64,
    rollout: usize,
    weight: f64,
    estimate: f64,
}

const KEPT: Promises =
    Promises { actions: 2, discount: 0.9, reward: 1.0, rollout: 1, weight: 1.0, estimate: 0.0 };

impl GenerativeModel for Promises {
    type State = ();
    type Observation = ();

    fn action_count(&self) -> usize {
        self.actions
    }

    fn discount(&self) -> f64 {
        self.discount
    }

    fn step(&self, _: &mut (), _: usize, _: &mut impl Rng) -> Transition<()> {
        Transition { observation: (), reward: self.reward, terminal: false }
    }

    fn rollout_action(&self, _: &(), _: &mut impl Rng) -> usize {
        self.rollout
    }

    fn prior_weight(&self, _: &(), _: usize) -> f64 {
        self.weight
    }

    fn value_estimate(&self, _: &()) -> f64 {
        self.estimate
    }
}

/// Simulations until a broken promise has shown.
const SIMULATIONS: usize = 100;

/// Searches with `model`, and checks that the planner is unaffected afterwards.
fn fails(model: Promises, roots: &[()]) -> PomcpError {
    let settings = PomcpSettings { simulations: SIMULATIONS, ..PomcpSettings::default() };
    let mut used = Pomcp::new(settings).expect("the defaults are valid");
    let error = used.search(&model, roots, &mut Pcg32::seed_from_u64(1)).expect_err("the model is broken");
    let mut fresh = Pomcp::new(settings).expect("the defaults are valid");
    let after = used.search(&KEPT, &[()], &mut Pcg32::seed_from_u64(2));
    assert_eq!(after, fresh.search(&KEPT, &[()], &mut Pcg32::seed_from_u64(2)));
    assert!(after.is_ok());
    error
}

#[test]
fn what_cannot_be_searched_is_refused() {
    assert_eq!(fails(KEPT, &[]), PomcpError::NoRoots);
    assert_eq!(fails(Promises { actions: 0, ..KEPT }, &[()]), PomcpError::NoActions);
    let actions = usize::MAX / 2;
    let too_large = PomcpError::TooLarge { simulations: SIMULATIONS, action_count: actions };
    assert_eq!(fails(Promises { actions, ..KEPT }, &[()]), too_large);
}

#[test]
fn broken_promises_are_named() {
    let action = |error: PomcpError| matches!(error, PomcpError::NonFiniteReward { action: 0 | 1, .. });
    assert!(action(fails(Promises { reward: f64::NAN, ..KEPT }, &[()])));
    assert!(action(fails(Promises { reward: f64::INFINITY, ..KEPT }, &[()])));
    let overflow = |error: PomcpError| matches!(error, PomcpError::ReturnOverflow { .. });
    assert!(overflow(fails(Promises { reward: f64::MAX, ..KEPT }, &[()])));
    assert!(overflow(fails(Promises { reward: -1e308, discount: 1.0, ..KEPT }, &[()])));
    for discount in [-0.1, 1.5, f64::NAN, f64::INFINITY] {
        let error = fails(Promises { discount, ..KEPT }, &[()]);
        assert!(matches!(error, PomcpError::InvalidDiscount { .. }), "{discount}: {error}");
    }
    let out_of_range = PomcpError::RolloutActionOutOfRange { action: 2, action_count: 2 };
    assert_eq!(fails(Promises { rollout: 2, ..KEPT }, &[()]), out_of_range);
    for weight in [-1.0, 0.0, f64::NAN, f64::INFINITY, f64::MAX] {
        let error = fails(Promises { weight, ..KEPT }, &[()]);
        assert!(matches!(error, PomcpError::InvalidPrior { .. }), "{weight}: {error}");
    }
    let error = fails(Promises { estimate: f64::NAN, ..KEPT }, &[()]);
    assert!(matches!(error, PomcpError::NonFiniteEstimate { .. }), "{error}");
}

#[test]
fn large_but_finite_returns_stay_finite() {
    for reward in [1e306, -1e306] {
        let mut pomcp = Pomcp::new(PomcpSettings::default()).unwrap();
        let model = Promises { reward, ..KEPT };
        let decision = pomcp.search(&model, &[()], &mut Pcg32::seed_from_u64(1)).unwrap();
        assert!(decision.actions.iter().all(|action| action.value.is_finite()), "{decision:?}");
    }
}

#[test]
fn settings_are_checked_before_any_search() {
    let fine = PomcpSettings::default();
    let refused = |settings| Pomcp::<()>::new(settings).err();
    assert_eq!(refused(fine), None);
    assert_eq!(refused(PomcpSettings { c_init: 0.0, rollout_steps: 0, horizon: 1, ..fine }), None);
    assert_eq!(refused(PomcpSettings { simulations: 0, ..fine }), Some(PomcpError::ZeroSimulations));
    assert_eq!(refused(PomcpSettings { horizon: 0, ..fine }), Some(PomcpError::ZeroHorizon));
    for (c_init, c_base) in [(-1.0, 1.0), (f64::NAN, 1.0), (1.0, 0.0), (1.0, f64::NAN), (1.0, f64::INFINITY)]
    {
        let error = refused(PomcpSettings { c_init, c_base, ..fine });
        assert!(matches!(error, Some(PomcpError::InvalidExploration { .. })), "{c_init} {c_base}: {error:?}");
    }
}
