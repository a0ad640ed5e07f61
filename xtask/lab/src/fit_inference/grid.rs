//! SIMPLE's answers for all combinations of weights.

use super::{
    case::{Answer, InferenceCase, LogChoices},
    weights::Weights,
};
use phase_model::EventKind;

/// The answers to all events for all weights.
pub(super) struct Grid {
    weights: Vec<Weights>,
    events: Vec<(String, EventKind)>,
    /// By event and weights.
    answers: Vec<Vec<Answer>>,
}

impl Grid {
    pub(super) fn of(cases: &[InferenceCase], present: &Weights) -> Self {
        let weights = Weights::all(present);
        let answers = cases.iter().map(|case| answers(case, &weights)).collect();
        let events = cases.iter().map(|case| (case.id.clone(), case.kind)).collect();
        Self { weights, events, answers }
    }

    /// Id and kind of each event.
    pub(super) fn events(&self) -> impl Iterator<Item = (&str, EventKind)> {
        self.events.iter().map(|(id, kind)| (id.as_str(), *kind))
    }

    /// The weights under which the mean log posterior of the truth of these events is greatest; the first of
    /// equals.
    pub(super) fn fit(&self, events: &[usize]) -> Weights {
        self.fit_among(events, |_| true)
    }

    /// The best of some weights, as [`Grid::fit`] finds that of all; the first of all if there are none.
    pub(super) fn fit_among(&self, events: &[usize], among: impl Fn(&Weights) -> bool) -> Weights {
        let sum = |k: usize| -> f64 {
            events.iter().map(|&event| self.answers[event][k].recognition.log_posterior).sum()
        };
        let mut best = (f64::NEG_INFINITY, &self.weights[0]);
        for (k, weights) in self.weights.iter().enumerate().filter(|(_, weights)| among(weights)) {
            let sum = sum(k);
            if sum > best.0 {
                best = (sum, weights);
            }
        }
        best.1.clone()
    }

    /// The answer to an event for weights of the grid; `None` for others.
    pub(super) fn answer(&self, event: usize, weights: &Weights) -> Option<&Answer> {
        let k = self.weights.iter().position(|it| it == weights)?;
        self.answers.get(event)?.get(k)
    }

    /// Number of events.
    pub(super) const fn len(&self) -> usize {
        self.events.len()
    }
}

/// The answers to one event.
fn answers(case: &InferenceCase, weights: &[Weights]) -> Vec<Answer> {
    // Lapse rates are few, and their logarithms are most of the work.
    let mut known: Vec<Vec<(f64, LogChoices)>> = (0..case.kinds()).map(|_| Vec::new()).collect();
    for weights in weights {
        for (kind, (known, rate)) in known.iter_mut().zip(&weights.lapse_rates).enumerate() {
            if known.iter().all(|(it, _)| it != rate) {
                known.push((*rate, case.log_choices(kind, *rate)));
            }
        }
    }
    let rate = weights.first().and_then(|weights| weights.comparison_lapse_rate);
    let compared: Option<Vec<LogChoices>> =
        rate.map(|rate| (0..case.kinds()).map(|kind| case.log_choices(kind, rate)).collect());
    let answer = |weights: &Weights| {
        let of = |(known, rate): (&'_ Vec<(f64, LogChoices)>, &f64)| {
            known.iter().position(|(it, _)| it == rate).unwrap_or_default()
        };
        let places: Vec<usize> = known.iter().zip(&weights.lapse_rates).map(of).collect();
        let choices: Vec<&LogChoices> =
            known.iter().zip(places).map(|(known, place)| &known[place].1).collect();
        case.answer(&choices, compared.as_deref(), weights)
    };
    weights.iter().map(answer).collect()
}
