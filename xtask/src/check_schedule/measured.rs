//! Measured attempts, and what is assumed of those that were not made.

use phase_cli::{
    error::CliError,
    gen_dataset::{
        attempt_times::{self, AttemptTimes, Line},
        schedule::{Need, Part},
    },
};
use phase_files::{FileError, Problem};
use phase_model::{
    AgentId, EventKind,
    random::{Purpose, derive_seed},
};
use phase_sampler::Variant;
use std::{collections::BTreeMap, path::PathBuf};

/// What is measured, by slot.
#[derive(Debug)]
pub(super) struct Measured {
    /// For each slot its attempts, the last of which was accepted.
    pub(super) slots: Vec<Vec<AttemptTimes>>,
    /// Time to complete the dataset, on one core (s).
    pub(super) completing: f64,
    /// Attempts by the variants of their events, from which those that were not made are drawn.
    by_class: BTreeMap<Vec<Variant>, Vec<AttemptTimes>>,
    /// Mean time of an event and of one with an idle agent (s).
    means: [f64; 2],
}

impl Measured {
    /// Reads files; the first slots only, if a number is given.
    pub(super) fn read(files: &[PathBuf], first: Option<usize>) -> Result<Self, CliError> {
        let mut by_slot = BTreeMap::<usize, Vec<AttemptTimes>>::new();
        let mut completing = 0.0;
        for file in files {
            let mut of_file = BTreeMap::<usize, Vec<AttemptTimes>>::new();
            for line in attempt_times::read(file)? {
                match line {
                    Line::Attempt(attempt) => of_file.entry(attempt.slot).or_default().push(attempt),
                    Line::Completing(seconds) => completing = seconds,
                    Line::Format(_) => {}
                }
            }
            for (slot, attempts) in of_file {
                let is_whole = |(k, it): (usize, &AttemptTimes)| {
                    it.attempt == k && it.accepted == (k + 1 == attempts.len())
                };
                if by_slot.contains_key(&slot) || !attempts.iter().enumerate().all(is_whole) {
                    let rule = format!(
                        "the attempts of slot {slot} are not those from the first to the accepted one"
                    );
                    let problem = Problem::Shape { what: "list of attempt times", rule };
                    return Err(FileError { file: file.clone(), problem }.into());
                }
                by_slot.insert(slot, attempts);
            }
        }
        let mut by_class = BTreeMap::<Vec<Variant>, Vec<AttemptTimes>>::new();
        let (mut sums, mut counts) = ([0.0; 2], [0; 2]);
        for attempt in by_slot.values().flatten() {
            by_class.entry(attempt.variants.clone()).or_default().push(attempt.clone());
            for time in &attempt.parts {
                let k = usize::from(matches!(time.part, Part::Idle { .. }));
                sums[k] += time.cpu_seconds;
                counts[k] += 1;
            }
        }
        let means = [0, 1].map(|k| sums[k] / f64::from(counts[k].max(1)));
        let slots = by_slot.into_values().take(first.unwrap_or(usize::MAX)).collect();
        Ok(Self { slots, completing, by_class, means })
    }

    /// Number of attempts that were made.
    pub(super) fn attempts(&self) -> usize {
        self.slots.iter().map(Vec::len).sum()
    }

    /// CPU time of everything (s).
    pub(super) fn cpu_seconds(&self) -> f64 {
        self.slots.iter().flatten().map(AttemptTimes::cpu_seconds).sum::<f64>() + self.completing
    }

    /// An attempt: as it was made, or, after the accepted one, as another of the same class.
    pub(super) fn attempt(&self, slot: usize, number: usize) -> &AttemptTimes {
        let made = &self.slots[slot];
        made.get(number).unwrap_or_else(|| {
            let alike = &self.by_class[&made[0].variants];
            let draw =
                derive_seed(derive_seed(0, Purpose::Event, slot as u64), Purpose::Attempt, number as u64);
            &alike[(draw % alike.len() as u64) as usize]
        })
    }

    /// Time of a simulation, by that of its kind where it was not made (s).
    pub(super) fn seconds(&self, attempt: &AttemptTimes, part: Part) -> f64 {
        let made = attempt.parts.iter().find(|time| time.part == part);
        made.map_or(self.means[usize::from(matches!(part, Part::Idle { .. }))], |time| time.cpu_seconds)
    }
}

/// What an attempt may still take, of which these simulations have been made; the first is certain. Empty if it has a result.
pub(super) fn needs(attempt: &AttemptTimes, is_made: impl Fn(Part) -> bool) -> Vec<Need> {
    let missing: Vec<Part> =
        attempt.parts.iter().map(|time| time.part).filter(|part| !is_made(*part)).collect();
    let events = attempt.variants.len();
    if missing.is_empty() || (0..events).all(|k| is_made(Part::Member(k))) {
        return missing.into_iter().map(|part| Need { part, share: 1.0 }).collect();
    }
    let members = (0..events).map(Part::Member).filter(|part| !is_made(*part));
    let members = members.map(|part| Need { part, share: 1.0 });
    let idle = possibly_idle(attempt).into_iter().filter(|need| !is_made(need.part));
    members.chain(idle).collect()
}

/// Simulations with an idle agent that an attempt may take. Which agent that is does not matter.
fn possibly_idle(attempt: &AttemptTimes) -> Vec<Need> {
    let made: Vec<Part> = attempt.parts.iter().map(|time| time.part).collect();
    let idle = |agent| Part::Idle { member: 0, agent };
    let agents: &[AgentId] = match attempt.variants[0].kind() {
        EventKind::Helping | EventKind::Hindering | EventKind::Chasing => {
            let is_one = made.contains(&idle(AgentId::ONE));
            if is_one { &[AgentId::ONE] } else { &[AgentId::ZERO] }
        }
        EventKind::Competing => &AgentId::ALL,
        EventKind::Collaborating | EventKind::Independent => &[],
    };
    agents.iter().map(|&agent| Need { part: idle(agent), share: 1.0 / agents.len() as f64 }).collect()
}
