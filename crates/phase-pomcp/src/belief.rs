//! A belief as particles, updated with the model itself.

use rand::{Rng, RngExt};
use thiserror::Error;

use crate::{GenerativeModel, ObservationModel};

/// Knowledge of a problem's hidden state beside one step of it, which keeps a particle belief alive. A
/// problem without such knowledge has an empty `impl`.
pub trait BeliefModel: GenerativeModel {
    /// Resamples part of what is hidden in a particle, consistently with all actions and observations so far,
    /// of which `action` and `observation` are the last. It is called for every particle after an update.
    ///
    /// Does nothing unless overridden. Where a hidden part never changes, rejection can only ever remove its
    /// values: without this hook few distinct particles are left in the end.
    fn reinvigorate(
        &self,
        _particle: &mut Self::State,
        _action: usize,
        _observation: &Self::Observation,
        _random: &mut impl Rng,
    ) {
    }

    /// A particle consistent with the last action and observation, for when an observation contradicts all
    /// particles; `None`, unless overridden, if there is none.
    fn recover(
        &self,
        _action: usize,
        _observation: &Self::Observation,
        _random: &mut impl Rng,
    ) -> Option<Self::State> {
        None
    }
}

/// Why a belief could not be made or updated. A failed update leaves the belief as it was.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum BeliefError {
    /// There is no particle to begin with.
    #[error("a belief needs at least one particle")]
    NoParticles,
    /// The updates may make no attempt.
    #[error("`attempts` is 0; an update has to advance at least one particle")]
    ZeroAttempts,
    /// No particle led to the observation, and the model knows no other. States of small probability die out
    /// among few particles: what is true may be one of them.
    #[error(
        "the observation contradicts all particles ({attempts} attempts), and `BeliefModel::recover` gave none; \
         define it, or use more particles"
    )]
    Contradicted {
        /// The number of particles advanced.
        attempts: usize,
    },
    /// A likelihood is negative, infinite or NaN, or the sum of all is infinite.
    #[error("`likelihood` said {likelihood}; it must be finite and not negative, as must the sum of all")]
    InvalidLikelihood {
        /// The likelihood that the model returned.
        likelihood: f64,
    },
}

/// The course of an update.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BeliefUpdate {
    /// Particles advanced by the model.
    pub attempts: usize,
    /// Particles that led to the observation and were kept; the others of the belief are copies of these.
    pub accepted: usize,
    /// Particles that [`BeliefModel::recover`] made, since no other led to the observation.
    pub recovered: usize,
}

/// Equally likely states, always as many as in the beginning.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleBelief<S> {
    particles: Vec<S>,
    /// The memory of the next update.
    next: Vec<S>,
    attempts: usize,
}

/// Particles advanced in an update, for each particle of the belief, before it makes do with copies of those
/// kept.
///
/// An observation less likely than one in a hundred leaves fewer distinct particles than there were.
pub const DEFAULT_ATTEMPTS: usize = 100;

impl<S: Clone> ParticleBelief<S> {
    /// A belief in these states, such as samples of the problem's initial belief.
    ///
    /// # Errors
    /// [`BeliefError::NoParticles`].
    pub fn new(particles: Vec<S>) -> Result<Self, BeliefError> {
        if particles.is_empty() {
            return Err(BeliefError::NoParticles);
        }
        Ok(Self { next: Vec::with_capacity(particles.len()), particles, attempts: DEFAULT_ATTEMPTS })
    }

    /// Advances at most `attempts` particles per particle in an update, instead of [`DEFAULT_ATTEMPTS`].
    ///
    /// # Errors
    /// [`BeliefError::ZeroAttempts`].
    pub fn with_attempts(self, attempts: usize) -> Result<Self, BeliefError> {
        if attempts == 0 { Err(BeliefError::ZeroAttempts) } else { Ok(Self { attempts, ..self }) }
    }

    /// The states; one at least. They are the roots of a search.
    pub fn particles(&self) -> &[S] {
        &self.particles
    }

    /// Updates the belief after an action and an observation, in a problem that has not ended: a particle is
    /// sampled, advanced by the model, and kept if the problem goes on with the same observation, until there
    /// are as many as before (Silver & Veness 2010, section 3.2). Then each is reinvigorated.
    ///
    /// An unlikely observation may leave too few after that many attempts: the rest are then copies of those.
    /// If it leaves none, the model may make new ones.
    ///
    /// # Errors
    /// [`BeliefError::Contradicted`].
    pub fn update<M>(
        &mut self,
        model: &M,
        action: usize,
        observation: &M::Observation,
        random: &mut impl Rng,
    ) -> Result<BeliefUpdate, BeliefError>
    where
        M: BeliefModel<State = S>,
    {
        let count = self.particles.len();
        let most = self.attempts.saturating_mul(count);
        self.next.clear();
        let mut attempts = 0;
        while self.next.len() < count && attempts < most {
            attempts += 1;
            let mut particle = self.particles[random.random_range(0..count)].clone();
            let outcome = model.step(&mut particle, action, random);
            if !outcome.terminal && outcome.observation == *observation {
                self.next.push(particle);
            }
        }
        self.complete(model, action, observation, attempts, random)
    }

    /// Updates the belief where observations seldom repeat, such as real numbers: every particle is advanced
    /// once and weighted by the likelihood of the observation, 0 if the problem ended, and as many as before
    /// are drawn by weight, one from each of as many equal parts of the sum (stratified resampling). Then
    /// each is reinvigorated.
    ///
    /// In the result, `attempts` is the number of particles, and `accepted` the number of those that were
    /// drawn at least once.
    ///
    /// # Errors
    /// [`BeliefError::Contradicted`] if no particle has a likelihood above 0 and the model makes none;
    /// [`BeliefError::InvalidLikelihood`].
    pub fn update_weighted<M>(
        &mut self,
        model: &M,
        action: usize,
        observation: &M::Observation,
        random: &mut impl Rng,
    ) -> Result<BeliefUpdate, BeliefError>
    where
        M: BeliefModel<State = S> + ObservationModel,
    {
        let attempts = self.particles.len();
        let mut advanced = Vec::with_capacity(attempts);
        let mut sum = 0.0;
        for particle in &self.particles {
            let mut particle = particle.clone();
            let outcome = model.step(&mut particle, action, random);
            let weight =
                if outcome.terminal { 0.0 } else { model.likelihood(action, &particle, observation) };
            sum += weight;
            if !(0.0..=f64::MAX).contains(&weight) || sum.is_infinite() {
                return Err(BeliefError::InvalidLikelihood { likelihood: weight });
            }
            advanced.push((particle, sum));
        }
        self.next.clear();
        let mut accepted = 0;
        if sum > 0.0 {
            let mut last = None;
            for k in 0..attempts {
                let drawn = (k as f64 + random.random::<f64>()) / attempts as f64 * sum;
                let index = advanced.partition_point(|&(_, below)| below <= drawn).min(attempts - 1);
                accepted += usize::from(last != Some(index));
                last = Some(index);
                self.next.push(advanced[index].0.clone());
            }
        }
        let update = self.complete(model, action, observation, attempts, random)?;
        Ok(BeliefUpdate { accepted, ..update })
    }

    /// Makes the particles in `next` as many as before, or lets the model make them, reinvigorates them, and
    /// takes them for the belief.
    fn complete<M>(
        &mut self,
        model: &M,
        action: usize,
        observation: &M::Observation,
        attempts: usize,
        random: &mut impl Rng,
    ) -> Result<BeliefUpdate, BeliefError>
    where
        M: BeliefModel<State = S>,
    {
        let count = self.particles.len();
        let accepted = self.next.len();
        if accepted == 0 {
            let recovered = (0..count).map_while(|_| model.recover(action, observation, random));
            self.next.extend(recovered);
        }
        let recovered = self.next.len() - accepted;
        let distinct = self.next.len();
        if distinct == 0 {
            return Err(BeliefError::Contradicted { attempts });
        }
        for _ in distinct..count {
            self.next.push(self.next[random.random_range(0..distinct)].clone());
        }
        for particle in &mut self.next {
            model.reinvigorate(particle, action, observation, random);
        }
        std::mem::swap(&mut self.particles, &mut self.next);
        Ok(BeliefUpdate { attempts, accepted, recovered })
    }
}
