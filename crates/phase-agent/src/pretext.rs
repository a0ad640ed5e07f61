//! Pretexts: a hinderer of level 2 knows that the other infers its intent from its actions.

use crate::{
    ascription::{self, ACTIONS, AscribedPolicy, HabitPolicy, TheoryParameters},
    objective::Objective,
};
use phase_model::{Action, State};

/// Number of pretexts that a search follows, the likeliest ones.
pub(crate) const PRETEXTS: usize = 3;

/// Number of explanations in a [`Guess`]: hindering, the pretexts, and everything else.
const EXPLANATIONS: usize = PRETEXTS + 2;

/// The other's guess at the agent's intent, as the agent sees it: probabilities of hindering, of each
/// pretext of a [`Scrutiny`], and of everything else.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub(crate) struct Guess([f64; EXPLANATIONS]);

impl Guess {
    /// The probability of hindering, 0 to 1.
    pub(crate) const fn hindering(&self) -> f64 {
        self.0[0]
    }
}

/// The other's explanations of a hinderer's actions, and the hinderer's cost of being seen through.
///
/// A *pretext* is a subgoal that the agent would pursue if it wanted something harmless. The other is taken
/// to weigh hindering, pretexts and everything else by how likely they make the actions that it sees, as a
/// mind of level 1 does ([`TheoryOfMind`](crate::TheoryOfMind)). So an action that a pretext explains as well
/// costs nothing, and one that a pretext explains better makes up for others: a feint.
#[derive(Clone, Debug)]
pub struct Scrutiny<'a> {
    pretexts: Vec<Objective<'a>>,
    guess: Guess,
    prior: Guess,
    theory: TheoryParameters,
}

impl<'a> Scrutiny<'a> {
    /// Explanations, with the probabilities that the other gives to them.
    ///
    /// `hindering` is that of being hindered (0 to 1). `pretexts`, the likeliest first, are subgoals with
    /// theirs and the numbers of intents that suggest them. Three of them are followed; the others are part
    /// of everything else, which makes all actions as likely.
    /// `possible`, at least 1, is the number of all intents, hindering included: at first they are as likely,
    /// and with every step a share of this prior returns.
    #[must_use]
    pub fn new(
        hindering: f64,
        pretexts: Vec<(Objective<'a>, f64, usize)>,
        possible: usize,
        theory: TheoryParameters,
    ) -> Self {
        let mut guess = [0.0; EXPLANATIONS];
        let mut prior = [0.0; EXPLANATIONS];
        let each = 1.0 / possible as f64;
        guess[0] = hindering;
        prior[0] = each;
        let mut objectives = Vec::with_capacity(PRETEXTS);
        for (k, (objective, share, intents)) in pretexts.into_iter().take(PRETEXTS).enumerate() {
            guess[k + 1] = share;
            prior[k + 1] = intents as f64 * each;
            objectives.push(objective);
        }
        let rest = |shares: &[f64; EXPLANATIONS]| (1.0 - shares.iter().sum::<f64>()).max(0.0);
        guess[EXPLANATIONS - 1] = rest(&guess);
        prior[EXPLANATIONS - 1] = rest(&prior);
        Self { pretexts: objectives, guess: Guess(guess), prior: Guess(prior), theory }
    }

    /// The guess before the search.
    pub(crate) const fn guess(&self) -> Guess {
        self.guess
    }

    /// Cost of a step (reward): in proportion to how probable hindering is to the other.
    pub(crate) fn cost(&self, guess: &Guess) -> f64 {
        self.theory.discretion * guess.hindering()
    }

    /// The likelihood of an action in a state for each explanation. `own` is the agent's subgoal, `last` its
    /// action before.
    pub(crate) fn likelihoods(
        &self,
        own: &Objective<'_>,
        state: &State,
        last: Option<Action>,
        action: Action,
    ) -> [f64; EXPLANATIONS] {
        let of = |objective| likelihood(&policy(objective, state, last, &self.theory), action, &self.theory);
        let mut likelihoods = [1.0 / ACTIONS as f64; EXPLANATIONS];
        likelihoods[0] = of(own);
        for (likelihood, pretext) in likelihoods[1..].iter_mut().zip(&self.pretexts) {
            *likelihood = of(pretext);
        }
        likelihoods
    }

    /// Advances the guess by a step: the other learns from the action if it saw it.
    pub(crate) fn learn(&self, guess: &mut Guess, seen: Option<[f64; EXPLANATIONS]>) {
        learn(&mut guess.0, seen.as_ref().map(<[f64; EXPLANATIONS]>::as_slice), &self.prior.0, &self.theory);
    }
}

/// The probabilities of actions that the other ascribes to an agent with a subgoal.
pub(crate) fn policy(
    objective: &Objective<'_>,
    state: &State,
    last: Option<Action>,
    theory: &TheoryParameters,
) -> [f64; ACTIONS] {
    let weights = HabitPolicy { sharpness: theory.sharpness }.weights(objective, state, last);
    let sum: f64 = weights.iter().sum();
    if sum > 0.0 { weights.map(|weight| weight / sum) } else { [1.0 / ACTIONS as f64; ACTIONS] }
}

/// The probability of an action by a policy, from which the other is taken to lapse at times.
pub(crate) fn likelihood(policy: &[f64; ACTIONS], action: Action, theory: &TheoryParameters) -> f64 {
    (1.0 - theory.lapse) * policy[action.index()] + theory.lapse / ACTIONS as f64
}

/// Weighs explanations by the likelihoods of an action that was seen, and mixes in a share of their prior, as
/// a mind of level 1 does.
pub(crate) fn learn(
    weights: &mut [f64],
    likelihoods: Option<&[f64]>,
    prior: &[f64],
    theory: &TheoryParameters,
) {
    let share = if likelihoods.is_some() { theory.forgetting } else { theory.fading };
    if let Some(likelihoods) = likelihoods {
        for (weight, likelihood) in weights.iter_mut().zip(likelihoods) {
            *weight *= libm::pow(*likelihood, theory.inverse_temperature);
        }
    }
    ascription::normalise(weights, prior.iter().copied(), share);
}
