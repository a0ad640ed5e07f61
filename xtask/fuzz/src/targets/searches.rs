//! The planner in sampled scenes with bodies anywhere, and the search in small random problems.

use crate::{
    draw::{Bytes, Draw},
    scenes::{Start, start},
};
use phase_model::{
    AgentId, BodySet, Entity, EventKind,
    random::{Purpose, stream},
};
use phase_planner::Planner;
use phase_pomcp::{GenerativeModel, Pomcp, PomcpSettings, Transition};
use rand::{Rng, RngExt};

/// Both agents' plans in a sampled scene: they exist, cost a finite number, and are the same again.
pub(super) fn planner(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let kind = bytes.pick(&EventKind::ALL);
    let seed = u64::from(bytes.byte());
    let Ok(scene) = phase_sampler::sample_kind(kind, &mut stream(seed, Purpose::Scene, 0)) else { return };
    let physics = scene.physics();
    let begins = bytes.pick(&Start::ALL);
    let state = start(&physics, begins, &mut bytes).unwrap_or_else(|| scene.initial_state());
    let mut observed = BodySet::default();
    for entity in Entity::ALL {
        if bytes.below(4) > 0 {
            observed.insert(entity);
        }
    }
    for agent in AgentId::ALL {
        let planner = Planner::new(
            physics.clone(),
            scene.layout,
            agent,
            scene.goals(),
            scene.attitudes()[agent.index()],
        );
        let plan = planner.plan(&state, observed);
        assert!(!plan.distance.is_nan(), "{plan:?}");
        assert_eq!(plan, planner.plan(&state, observed));
    }
}

/// A problem of a few states whose transitions, rewards, priors and legal actions are bytes.
struct Small<'a> {
    table: &'a [u8],
    actions: usize,
    discount: f64,
    noisy: bool,
}

impl Small<'_> {
    fn entry(&self, state: u8, action: usize, of: usize) -> u8 {
        let place = (usize::from(state) * 31 + action * 7 + of) % self.table.len().max(1);
        self.table.get(place).copied().unwrap_or(0)
    }
}

impl GenerativeModel for Small<'_> {
    type State = u8;
    type Observation = u8;

    fn action_count(&self) -> usize {
        self.actions
    }

    fn discount(&self) -> f64 {
        self.discount
    }

    fn step(&self, state: &mut u8, action: usize, random: &mut impl Rng) -> Transition<u8> {
        let noise: u8 = if self.noisy { random.random_range(0..3) } else { 0 };
        *state = self.entry(*state, action, 0).wrapping_add(noise) % 16;
        let reward = f64::from(self.entry(*state, action, 1)) - 100.0;
        Transition { observation: *state % 4, reward, terminal: self.entry(*state, action, 2) < 20 }
    }

    fn is_legal(&self, _: &u8, action: usize) -> bool {
        action == 0 || self.entry(0, action, 3) >= 60
    }

    fn prior_weight(&self, _: &u8, action: usize) -> f64 {
        1.0 + f64::from(self.entry(0, action, 4))
    }

    fn is_deterministic(&self) -> bool {
        !self.noisy
    }
}

/// A search in a small problem: it ends, its visits are those of its simulations, it takes legal actions
/// only, and its values are within the range of returns.
pub(super) fn pomcp(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let settings = PomcpSettings {
        simulations: bytes.below(200),
        rollout_steps: bytes.below(12),
        c_init: f64::from(bytes.between(0.0, 4.0)),
        c_base: f64::from(bytes.between(0.0, 2000.0)),
        horizon: bytes.below(20),
        normalise_values: bytes.below(2) == 0,
        stop_when_decided: bytes.below(2) == 0,
        convergence: f64::from(bytes.unit()) * f64::from(u8::from(bytes.below(2) == 0)),
        untried_first: bytes.below(2) == 0,
    };
    let actions = bytes.below(6);
    let discount = f64::from(bytes.unit());
    let noisy = bytes.below(2) == 0;
    let roots: Vec<u8> = (0..bytes.below(4)).map(|_| bytes.byte() % 16).collect();
    let seed = u64::from(bytes.byte());
    let model = Small { table: bytes.rest(), actions, discount, noisy };
    let Ok(mut search) = Pomcp::new(settings) else {
        assert!(settings.validate().is_err());
        return;
    };
    let mut decide = || search.search(&model, &roots, &mut stream(seed, Purpose::Search, 0));
    let Ok(decision) = decide() else {
        assert!(roots.is_empty() || actions == 0, "a sound problem was refused");
        return;
    };
    let visits: usize = decision.actions.iter().map(|action| action.visits).sum();
    assert!(visits <= settings.simulations, "{visits} visits");
    assert!(model.is_legal(&0, decision.action) && decision.action < actions);
    /// Largest reward, in absolute terms.
    const REWARD: f64 = 156.0;
    let horizon = (1.0 - discount.min(0.999_999)).recip().min(400.0 + settings.horizon.min(400) as f64);
    for (action, found) in decision.actions.iter().enumerate() {
        assert!(found.visits == 0 || model.is_legal(&0, action), "an illegal action was visited");
        assert!(found.value.abs() <= REWARD * horizon + 1.0, "value {} beyond all returns", found.value);
    }
    assert_eq!(
        decide().ok().map(|again| again.action),
        Some(decision.action),
        "the same search decides otherwise"
    );
}
