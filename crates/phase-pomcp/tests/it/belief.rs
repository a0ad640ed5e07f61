//! Particle beliefs compared with Bayes' rule.

use phase_pomcp::{BeliefError, BeliefModel, BeliefUpdate, GenerativeModel, ParticleBelief, Transition};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A hidden number is observed as odd or even, wrongly with some probability; while nothing ends, it may grow
/// by one.
#[derive(Debug, Clone, Copy)]
struct Number {
    error: f64,
    grows: f64,
    /// Whether `recover` knows a number for every observation, and what reinvigoration does.
    knows: bool,
    adds: u32,
}

/// The number at which the problem ends.
const END: u32 = 100;

impl GenerativeModel for Number {
    type State = u32;
    type Observation = bool;

    fn action_count(&self) -> usize {
        1
    }

    fn discount(&self) -> f64 {
        1.0
    }

    fn step(&self, number: &mut u32, _: usize, random: &mut impl Rng) -> Transition<bool> {
        *number += u32::from(random.random_bool(self.grows));
        let is_odd = (*number % 2 == 1) != random.random_bool(self.error);
        Transition { observation: is_odd, reward: 0.0, terminal: *number >= END }
    }
}

impl BeliefModel for Number {
    fn reinvigorate(&self, number: &mut u32, _: usize, _: &bool, _: &mut impl Rng) {
        *number += self.adds;
    }

    fn recover(&self, _: usize, &is_odd: &bool, _: &mut impl Rng) -> Option<u32> {
        self.knows.then_some(u32::from(is_odd))
    }
}

const SURE: Number = Number { error: 0.0, grows: 0.0, knows: false, adds: 0 };

fn share(belief: &ParticleBelief<u32>, number: u32) -> f64 {
    let particles = belief.particles();
    particles.iter().filter(|&&particle| particle == number).count() as f64 / particles.len() as f64
}

/// From 0, the number is 0 or 1 after a step, with probabilities 0.7 and 0.3. Odd is observed with
/// probability 0.2 at 0 and 0.8 at 1: by Bayes' rule the number is 1 with probability 0.24 / (0.14 + 0.24) =
/// 12/19. After another step it is 0, 1 or 2 with 7/19 · 0.7, 7/19 · 0.3 + 12/19 · 0.7 and 12/19 · 0.3; even
/// is observed with 0.8, 0.2 and 0.8.
#[test]
fn updates_follow_bayes_rule() {
    let model = Number { error: 0.2, grows: 0.3, ..SURE };
    let mut belief = ParticleBelief::new(vec![0; 40_000]).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let update = belief.update(&model, 0, &true, &mut random).unwrap();
    assert_eq!((update.accepted, update.recovered), (40_000, 0));
    // A step leads to odd with probability 0.38.
    assert!((update.accepted as f64 / update.attempts as f64 - 0.38).abs() < 0.01, "{update:?}");
    assert!((share(&belief, 1) - 12.0 / 19.0).abs() < 0.01);
    belief.update(&model, 0, &false, &mut random).unwrap();
    let joint = [4.9 / 19.0 * 0.8, 10.5 / 19.0 * 0.2, 3.6 / 19.0 * 0.8];
    for (number, probability) in (0..).zip(joint) {
        let expected = probability / joint.iter().sum::<f64>();
        assert!((share(&belief, number) - expected).abs() < 0.01, "{number}: {expected}");
    }
}

#[test]
fn what_would_have_ended_the_problem_is_dropped() {
    let mut belief = ParticleBelief::new(vec![END, 7, END + 1]).unwrap();
    belief.update(&SURE, 0, &true, &mut Pcg64Mcg::seed_from_u64(1)).unwrap();
    assert_eq!(belief.particles(), [7; 3]);
}

#[test]
fn copies_make_up_for_those_that_an_unlikely_observation_leaves() {
    let mut numbers = vec![0; 1000];
    numbers[..10].fill(1);
    let belief = ParticleBelief::new(numbers).unwrap();
    let mut patient = belief.clone();
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let update = patient.update(&SURE, 0, &true, &mut random).unwrap();
    // One attempt in a hundred succeeds, so a hundred for each particle are nearly all needed.
    assert!(update.attempts > 90_000 && update.accepted > 900, "{update:?}");
    assert_eq!(patient.particles(), [1; 1000]);
    let mut hasty = belief.with_attempts(1).unwrap();
    let update = hasty.update(&SURE, 0, &true, &mut random).unwrap();
    assert_eq!(update.attempts, 1000);
    assert!((1..30).contains(&update.accepted), "{update:?}");
    assert_eq!(hasty.particles(), [1; 1000]);
}

#[test]
fn contradictions_are_errors_unless_the_model_knows_better() {
    let belief = ParticleBelief::new(vec![0, 2]).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(4);
    let mut contradicted = belief.clone();
    let error = contradicted.update(&SURE, 0, &true, &mut random);
    assert_eq!(error, Err(BeliefError::Contradicted { attempts: 200 }));
    assert_eq!(contradicted.particles(), belief.particles());
    let knows = Number { knows: true, ..SURE };
    let update = contradicted.update(&knows, 0, &true, &mut random);
    assert_eq!(update, Ok(BeliefUpdate { attempts: 200, accepted: 0, recovered: 2 }));
    assert_eq!(contradicted.particles(), [1, 1]);
}

#[test]
fn every_particle_is_reinvigorated_once() {
    let mut belief = ParticleBelief::new(vec![1; 5]).unwrap();
    let model = Number { adds: 10, ..SURE };
    belief.update(&model, 0, &true, &mut Pcg64Mcg::seed_from_u64(5)).unwrap();
    assert_eq!(belief.particles(), [11; 5]);
}

#[test]
fn beliefs_without_particles_or_attempts_are_refused() {
    assert_eq!(ParticleBelief::<u32>::new(Vec::new()), Err(BeliefError::NoParticles));
    assert_eq!(ParticleBelief::new(vec![0]).unwrap().with_attempts(0), Err(BeliefError::ZeroAttempts));
}
