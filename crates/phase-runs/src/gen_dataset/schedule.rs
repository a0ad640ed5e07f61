//! Order of the work: the job that the next free thread takes.
//!
//! An attempt at a slot counts only if all earlier ones are refused. Each is nevertheless independent of the
//! others, so attempts run ahead where threads would be idle otherwise, and so do the simulations within one.
//! Everything that could be done has a chance that its result counts, estimated from the attempts so far; the
//! likeliest comes first. Work that is certain to count comes before any other, and a new slot before work
//! that is not, so nothing is wasted while there are enough slots.
//!
//! There are no threads, files or clocks here: the crew of `gen-dataset` follows the schedule with
//! simulations. What counts does not depend on the order, so neither does the dataset.

use core::ops::Range;
use phase_model::AgentId;
use std::collections::{BTreeMap, BTreeSet};

/// An attempt at a slot.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct AttemptId {
    /// The slot.
    pub slot: usize,
    /// Number of the attempt, from 0.
    pub number: usize,
}

/// One simulation of an attempt.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Part {
    /// An event: the only one, or that of a set with this number.
    Member(usize),
    /// An event with one of its agents idle.
    Idle {
        /// Number of the event.
        member: usize,
        /// The agent that does nothing.
        agent: AgentId,
    },
}

/// Something to be done.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Job {
    /// Find out what is there of a slot; then [`Schedule::opened`] or [`Schedule::closed`].
    Open(usize),
    /// Draw the scenes of an attempt; then [`Schedule::progressed`].
    Begin(AttemptId),
    /// Simulate; then [`Schedule::progressed`].
    Simulate(AttemptId, Part),
    /// Write the files of a slot, or fail, since no attempt follows; then [`Schedule::closed`].
    Finish(usize),
}

/// A simulation that an attempt may take.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Need {
    /// The simulation.
    pub part: Part,
    /// Chance that it is needed if the events of the attempt pass all tests on themselves (0 to 1).
    pub share: f64,
}

/// State of an attempt.
#[derive(Clone, PartialEq, Debug)]
pub enum Standing {
    /// The first of these is certainly needed for a judgement, the others perhaps. Never empty.
    Needs(Vec<Need>),
    /// The next attempt counts.
    Refused,
    /// No further attempt counts: accepted, or failed.
    Final,
}

/// Progress of an attempt.
#[derive(Clone, PartialEq, Debug)]
pub struct Progress {
    /// Events that have passed all tests on themselves.
    pub passed: usize,
    /// State of the attempt.
    pub standing: Standing,
}

/// Consequences of the progress of an attempt.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Consequences {
    /// The attempts that are refused for good, since all before them are.
    pub refused: Range<usize>,
    /// Attempts under way that count no longer.
    pub dropped: Vec<usize>,
}

/// The slots of a run, and what is under way. `C` are classes of slots whose attempts succeed equally often.
#[derive(Clone, Debug)]
pub struct Schedule<C> {
    unopened: Range<usize>,
    opening: BTreeSet<usize>,
    open: BTreeMap<usize, OpenSlot<C>>,
    rates: BTreeMap<C, Rates>,
    attempts: usize,
    most_under_way: usize,
}

#[derive(Clone, Debug)]
struct OpenSlot<C> {
    class: C,
    members: usize,
    /// The first attempt that has not been begun.
    next: usize,
    /// Attempts refused for good.
    refused: usize,
    refused_ahead: BTreeSet<usize>,
    under_way: BTreeMap<usize, UnderWay>,
    /// The lowest attempt after which none counts.
    last: Option<usize>,
    finishing: bool,
}

/// An attempt that has no result yet.
#[derive(Clone, Debug, Default)]
struct UnderWay {
    passed: usize,
    needs: Vec<Need>,
    started: BTreeSet<Part>,
}

/// Attempts under way, for each thread, from which on no attempt is begun ahead: they are kept in memory.
const UNDER_WAY_PER_THREAD: usize = 2;

impl<C: Ord + Clone> Schedule<C> {
    /// Slots 0 to `slots` − 1, each with at most the given number of attempts, for this number of threads.
    #[must_use]
    pub const fn new(slots: usize, attempts: usize, threads: usize) -> Self {
        let most_under_way = UNDER_WAY_PER_THREAD * threads;
        Self {
            unopened: 0..slots,
            opening: BTreeSet::new(),
            open: BTreeMap::new(),
            rates: BTreeMap::new(),
            attempts,
            most_under_way,
        }
    }

    /// The most useful thing to begin now, which is then under way. `None` if there is nothing to do until
    /// something under way is done.
    #[allow(
        clippy::should_implement_trait,
        reason = "what it returns depends on what has been reported since"
    )]
    pub fn next(&mut self) -> Option<Job> {
        let under_way: usize = self.open.values().map(|slot| slot.under_way.len()).sum();
        let may_begin = under_way < self.most_under_way;
        let mut best = None::<(f64, Job)>;
        for (&slot, open) in &self.open {
            let rates = self.rates.get(&open.class).copied().unwrap_or_default();
            for (chance, job) in open.candidates(slot, rates, self.attempts, may_begin) {
                if best.is_none_or(|(most, _)| chance > most) {
                    best = Some((chance, job));
                }
            }
        }
        let certain = best.filter(|(chance, _)| *chance >= 1.0).map(|(_, job)| job);
        let ahead = best.map(|(_, job)| job);
        let job = certain.or_else(|| self.unopened.next().map(Job::Open)).or(ahead)?;
        self.start(job);
        Some(job)
    }

    /// Whether every slot is closed.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.unopened.is_empty() && self.opening.is_empty() && self.open.is_empty()
    }

    /// A slot has to be filled: its class, the number of its events, and how many attempts were refused in an
    /// earlier run.
    pub fn opened(&mut self, slot: usize, class: C, members: usize, refused: usize) {
        let new = OpenSlot {
            class,
            members,
            next: refused,
            refused,
            refused_ahead: BTreeSet::new(),
            under_way: BTreeMap::new(),
            last: None,
            finishing: false,
        };
        self.opening.remove(&slot);
        self.open.insert(slot, new);
    }

    /// There is nothing more to do for a slot.
    pub fn closed(&mut self, slot: usize) {
        self.opening.remove(&slot);
        self.open.remove(&slot);
    }

    /// An attempt has come farther. Reports on attempts that count no longer are ignored.
    pub fn progressed(&mut self, attempt: AttemptId, progress: Progress) -> Consequences {
        let Some(open) = self.open.get_mut(&attempt.slot) else { return Consequences::default() };
        let Some(under_way) = open.under_way.get_mut(&attempt.number) else { return Consequences::default() };
        let Progress { passed, standing } = progress;
        if let Standing::Needs(needs) = standing {
            (under_way.passed, under_way.needs) = (passed, needs);
            return Consequences::default();
        }
        open.under_way.remove(&attempt.number);
        let is_final = standing == Standing::Final;
        self.rates.entry(open.class.clone()).or_default().count(passed, open.members, is_final);
        open.settle(attempt.number, is_final)
    }

    fn start(&mut self, job: Job) {
        match job {
            Job::Open(slot) => {
                self.opening.insert(slot);
            }
            Job::Begin(AttemptId { slot, number }) => {
                if let Some(open) = self.open.get_mut(&slot) {
                    open.next = number + 1;
                    open.under_way.insert(number, UnderWay::default());
                }
            }
            Job::Simulate(AttemptId { slot, number }, part) => {
                let open = self.open.get_mut(&slot);
                if let Some(under_way) = open.and_then(|open| open.under_way.get_mut(&number)) {
                    under_way.started.insert(part);
                }
            }
            Job::Finish(slot) => {
                if let Some(open) = self.open.get_mut(&slot) {
                    open.finishing = true;
                }
            }
        }
    }
}

impl<C> OpenSlot<C> {
    /// Everything that could be done for the slot, each with the chance that its result counts.
    fn candidates(&self, slot: usize, rates: Rates, attempts: usize, may_begin: bool) -> Vec<(f64, Job)> {
        let is_over = self.last == Some(self.refused) || self.refused == attempts;
        if is_over {
            return if self.finishing { Vec::new() } else { vec![(1.0, Job::Finish(slot))] };
        }
        let mut candidates = Vec::new();
        let mut chance = 1.0;
        for (&number, attempt) in &self.under_way {
            let id = AttemptId { slot, number };
            let mut members = 0;
            let mut compared = 0;
            for need in &attempt.needs {
                let needed = need.share * rates.passing(members) * rates.difference(compared);
                match need.part {
                    Part::Member(_) => members += 1,
                    Part::Idle { .. } => compared += 1,
                }
                if !attempt.started.contains(&need.part) {
                    candidates.push((chance * needed, Job::Simulate(id, need.part)));
                }
            }
            chance *= 1.0 - rates.acceptance(self.members - attempt.passed);
        }
        if self.last.is_none() && self.next < attempts && (may_begin || self.under_way.is_empty()) {
            candidates.push((chance, Job::Begin(AttemptId { slot, number: self.next })));
        }
        candidates
    }

    /// An attempt has a result.
    fn settle(&mut self, number: usize, is_final: bool) -> Consequences {
        let before = self.refused;
        let mut dropped = Vec::new();
        if is_final {
            self.last = Some(number);
            dropped.extend(self.under_way.split_off(&number).into_keys());
        } else {
            self.refused_ahead.insert(number);
            while self.refused_ahead.remove(&self.refused) {
                self.refused += 1;
            }
        }
        Consequences { refused: before..self.refused, dropped }
    }
}

/// Numbers of attempts of a class that have passed each stage.
#[derive(Clone, Copy, Debug, Default)]
struct Rates {
    checked: u32,
    passed: u32,
    compared: u32,
    accepted: u32,
}

impl Rates {
    /// Counts an attempt of which some events passed the tests on themselves. If all did, it was compared
    /// with what happens without an agent; otherwise the next one failed.
    fn count(&mut self, passed: usize, members: usize, is_accepted: bool) {
        self.passed += passed as u32;
        self.checked += (passed + 1).min(members) as u32;
        if passed == members {
            self.compared += 1;
            self.accepted += u32::from(is_accepted);
        }
    }

    /// Chance that this number of events pass the tests on themselves.
    fn passing(self, members: usize) -> f64 {
        after_one_of_each(self.passed, self.checked).powi(members as i32)
    }

    /// Chance that this number of comparisons show a difference.
    fn difference(self, comparisons: usize) -> f64 {
        after_one_of_each(self.accepted, self.compared).powi(comparisons as i32)
    }

    /// Chance that an attempt is accepted of which this number of events have not been tested.
    fn acceptance(self, untested: usize) -> f64 {
        self.passing(untested) * self.difference(1)
    }
}

/// The rule of succession: the expected rate, if all rates were equally likely before.
fn after_one_of_each(successes: u32, trials: u32) -> f64 {
    f64::from(successes + 1) / f64::from(trials + 2)
}
