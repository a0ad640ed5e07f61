//! A robot on a line that sees where it is only near a light ("Light Dark" of Sunberg & Kochenderfer 2018).

use crate::episodes::Problem;
use phase_pomcp::{
    BeliefError, BeliefModel, Decision, GenerativeModel, ObservationModel, ParticleBelief, Pomcp, PomcpError,
    PomcpSettings, Transition, Widening,
};
use rand::{Rng, RngExt};

/// The problem: places −60 to 60, starts uniform in −30 to 30, moves of 1 and 10 in both directions, and the
/// action of stopping, which earns 100 at 0, costs 100 anywhere else, and ends the problem. A move costs 1.
///
/// After a move the robot observes its place with an error of normal distribution, whose standard deviation
/// is the distance from the light at 10.
pub(crate) struct LightDark {
    /// Return from each place of a robot that knows where it is.
    known: Vec<f64>,
    /// Whether branches widen progressively; otherwise every observation has a branch of its own.
    is_widened: bool,
}

const MOVES: [i16; 5] = [-10, -1, 0, 1, 10];
/// The action that stops.
const STOP: usize = 2;
const FARTHEST: i16 = 60;
/// The distance of the farthest starts.
const FARTHEST_START: i16 = 30;
const LIGHT: f64 = 10.0;
const DISCOUNT: f64 = 0.95;
/// Standard deviation of the error at the light.
const LEAST_ERROR: f64 = 1e-4;

impl LightDark {
    pub(crate) fn new(is_widened: bool) -> Self {
        let mut known = vec![-100.0; 2 * FARTHEST as usize + 1];
        known[index(0)] = 100.0;
        // No place is more steps away than there are places.
        for _ in 0..known.len() {
            for place in (-FARTHEST..=FARTHEST).filter(|&place| place != 0) {
                let values = MOVES.map(|by| DISCOUNT * known[index(moved(place, by))] - 1.0);
                known[index(place)] = values.into_iter().fold(known[index(place)], f64::max);
            }
        }
        Self { known, is_widened }
    }
}

fn index(place: i16) -> usize {
    (place + FARTHEST) as usize
}

fn moved(place: i16, by: i16) -> i16 {
    (place + by).clamp(-FARTHEST, FARTHEST)
}

fn error_at(place: i16) -> f64 {
    (f64::from(place) - LIGHT).abs() + LEAST_ERROR
}

/// A draw from the standard normal distribution (Box & Muller 1958).
fn normal(random: &mut impl Rng) -> f64 {
    let radius = libm::sqrt(-2.0 * libm::log(1.0 - random.random::<f64>()));
    radius * libm::cos(core::f64::consts::TAU * random.random::<f64>())
}

impl GenerativeModel for LightDark {
    type State = i16;
    type Observation = f64;

    fn action_count(&self) -> usize {
        MOVES.len()
    }

    fn discount(&self) -> f64 {
        DISCOUNT
    }

    fn step(&self, place: &mut i16, action: usize, random: &mut impl Rng) -> Transition<f64> {
        if action == STOP {
            let reward = if *place == 0 { 100.0 } else { -100.0 };
            return Transition { observation: 0.0, reward, terminal: true };
        }
        *place = moved(*place, MOVES[action]);
        let seen = f64::from(*place) + error_at(*place) * normal(random);
        Transition { observation: seen, reward: -1.0, terminal: false }
    }

    /// Return if the place is known from now on.
    fn value_estimate(&self, &place: &i16) -> f64 {
        self.known[index(place)]
    }
}

impl ObservationModel for LightDark {
    /// The normal density, without the factor that all places share.
    fn likelihood(&self, _: usize, &place: &i16, &seen: &f64) -> f64 {
        let error = error_at(place);
        let by = (seen - f64::from(place)) / error;
        libm::exp(-0.5 * by * by) / error
    }
}

impl BeliefModel for LightDark {
    /// The place where the robot seems to be.
    fn recover(&self, _: usize, &seen: &f64, _: &mut impl Rng) -> Option<i16> {
        Some((seen.round() as i16).clamp(-FARTHEST, FARTHEST))
    }
}

impl Problem for LightDark {
    const SETTINGS: PomcpSettings = PomcpSettings {
        simulations: 1000,
        rollout_steps: 0,
        c_init: 1.25,
        c_base: 1e6,
        horizon: usize::MAX,
        normalise_values: true,
        stop_when_decided: false,
        convergence: 0.0,
        untried_first: false,
    };

    fn start(&self, random: &mut impl Rng) -> i16 {
        random.random_range(-FARTHEST_START..=FARTHEST_START)
    }

    fn imagine(&self, _: &i16, random: &mut impl Rng) -> i16 {
        self.start(random)
    }

    fn decide(
        &self,
        pomcp: &mut Pomcp<f64>,
        roots: &[i16],
        _: bool,
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError> {
        match self.is_widened {
            true => pomcp.search_widened(self, roots, Widening::default(), random),
            false => pomcp.search(self, roots, random),
        }
    }

    fn update(
        &self,
        belief: &mut ParticleBelief<i16>,
        action: usize,
        seen: &f64,
        random: &mut impl Rng,
    ) -> Result<(), BeliefError> {
        belief.update_weighted(self, action, seen, random).map(drop)
    }
}
