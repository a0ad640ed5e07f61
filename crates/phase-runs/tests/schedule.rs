//! What is done next when a dataset is made, with simulations of which only the result is known.

use phase_model::{
    AgentId,
    random::{Purpose, derive_seed},
};
use phase_runs::gen_dataset::schedule::{
    AttemptId, Consequences, Job, Need, Part, Progress, Schedule, Standing,
};
use std::collections::{BTreeMap, BTreeSet};

const MEMBER: Part = Part::Member(0);
const IDLE: Part = Part::Idle { member: 0, agent: AgentId::ZERO };
const SLOTS: usize = 30;
const MOST_ATTEMPTS: usize = 40;

/// How an attempt ends, by its numbers alone.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Fate {
    RefusedAlone,
    RefusedBeside,
    Accepted,
}

fn draw(seed: u64, id: AttemptId, outcomes: u64) -> u64 {
    derive_seed(derive_seed(seed, Purpose::Event, id.slot as u64), Purpose::Attempt, id.number as u64)
        % outcomes
}

/// Slots with an even number are easy, the others hard.
fn fate(seed: u64, id: AttemptId) -> Fate {
    match draw(seed, id, if id.slot.is_multiple_of(2) { 4 } else { 12 }) {
        0 => Fate::Accepted,
        1 => Fate::RefusedBeside,
        _ => Fate::RefusedAlone,
    }
}

/// Threads that take turns in an order that depends on the seed.
struct Crew {
    seed: u64,
    schedule: Schedule<usize>,
    under_way: Vec<Job>,
    made: BTreeSet<(AttemptId, Part)>,
    refused: BTreeMap<usize, usize>,
    /// Attempts that have no result yet.
    unsettled: BTreeSet<AttemptId>,
    /// Everything that was begun, in order.
    begun: Vec<Job>,
}

impl Crew {
    fn new(seed: u64, threads: usize) -> Self {
        let schedule = Schedule::new(SLOTS, MOST_ATTEMPTS, threads);
        let (made, refused, unsettled) = (BTreeSet::new(), BTreeMap::new(), BTreeSet::new());
        Self { seed, schedule, under_way: Vec::new(), made, refused, unsettled, begun: Vec::new() }
    }

    /// Begins what this number of threads can, then ends one thing.
    fn turn(&mut self, threads: usize, number: usize) -> bool {
        while self.under_way.len() < threads
            && let Some(job) = self.schedule.next()
        {
            self.begun.push(job);
            if let Job::Begin(id) = job {
                self.unsettled.insert(id);
            }
            self.under_way.push(job);
        }
        if self.under_way.is_empty() {
            return false;
        }
        let turn = AttemptId { slot: number, number };
        let job = self.under_way.swap_remove(draw(self.seed, turn, self.under_way.len() as u64) as usize);
        self.end(job);
        true
    }

    fn end(&mut self, job: Job) {
        match job {
            Job::Open(slot) => self.schedule.opened(slot, slot % 2, 1, 0),
            Job::Finish(slot) => self.schedule.closed(slot),
            Job::Begin(id) => self.report(id),
            Job::Simulate(id, part) => {
                assert!(self.made.insert((id, part)), "{job:?} twice");
                self.report(id);
            }
        }
    }

    fn report(&mut self, id: AttemptId) {
        let fate = fate(self.seed, id);
        let [alone, beside] = [MEMBER, IDLE].map(|part| self.made.contains(&(id, part)));
        let need = |part| Need { part, share: 1.0 };
        let standing = match (alone, beside, fate) {
            (false, false, _) => Standing::Needs(vec![need(MEMBER), need(IDLE)]),
            (false, true, _) => Standing::Needs(vec![need(MEMBER)]),
            (true, _, Fate::RefusedAlone) => Standing::Refused,
            (true, false, _) => Standing::Needs(vec![need(IDLE)]),
            (true, true, Fate::RefusedBeside) => Standing::Refused,
            (true, true, Fate::Accepted) => Standing::Final,
        };
        let passed = usize::from(alone && fate != Fate::RefusedAlone);
        if !matches!(standing, Standing::Needs(_)) {
            self.unsettled.remove(&id);
        }
        let Consequences { refused, dropped } = self.schedule.progressed(id, Progress { passed, standing });
        self.unsettled.retain(|it| it.slot != id.slot || !dropped.contains(&it.number));
        let count = self.refused.entry(id.slot).or_default();
        assert!(refused.is_empty() || refused.start == *count, "refusals out of order");
        *count += refused.len();
    }
}

/// Whatever the number of threads and the order in which they end, every slot is filled with its first good
/// attempt.
#[test]
fn the_first_good_attempt_counts_for_any_threads() {
    for (seed, threads) in (0..60).flat_map(|seed| [1, 2, 3, 8, 40].map(|threads| (seed, threads))) {
        let mut crew = Crew::new(seed, threads);
        let mut turns = 0;
        while crew.turn(threads, turns) {
            turns += 1;
        }
        assert!(crew.schedule.is_done(), "seed {seed}, {threads} threads: stuck");
        for slot in 0..SLOTS {
            let first =
                (0..MOST_ATTEMPTS).find(|&number| fate(seed, AttemptId { slot, number }) == Fate::Accepted);
            assert_eq!(
                crew.refused.get(&slot).copied().unwrap_or(0),
                first.unwrap_or(MOST_ATTEMPTS),
                "{slot}"
            );
        }
    }
}

/// One thread does what counts, in order, and nothing else.
#[test]
fn one_thread_does_one_thing_after_the_other() {
    let mut crew = Crew::new(7, 1);
    let mut expected = Vec::new();
    for slot in 0..SLOTS {
        expected.push(Job::Open(slot));
        for number in 0..MOST_ATTEMPTS {
            let id = AttemptId { slot, number };
            expected.extend([Job::Begin(id), Job::Simulate(id, MEMBER)]);
            if fate(7, id) != Fate::RefusedAlone {
                expected.push(Job::Simulate(id, IDLE));
            }
            if fate(7, id) == Fate::Accepted {
                break;
            }
        }
        expected.push(Job::Finish(slot));
    }
    let mut turns = 0;
    while crew.turn(1, turns) {
        turns += 1;
    }
    assert!(crew.begun == expected);
}

/// While a slot has not been opened, only what is certain to count is begun; then attempts run ahead, but not
/// beyond what memory is meant to hold.
#[test]
fn nothing_runs_ahead_while_there_are_slots() {
    for seed in 0..40 {
        let threads = 6;
        let mut crew = Crew::new(seed, threads);
        let (mut turns, mut ahead) = (0, 0);
        loop {
            let before = crew.begun.len();
            if !crew.turn(threads, turns) {
                break;
            }
            turns += 1;
            let opened = crew.begun.iter().filter(|job| matches!(job, Job::Open(_))).count();
            for job in &crew.begun[before..] {
                let Job::Begin(id) = job else { continue };
                let settled = crew.refused.get(&id.slot).copied().unwrap_or(0);
                assert!(opened == SLOTS || id.number <= settled, "{job:?} before all slots are open");
                ahead = ahead.max(id.number.saturating_sub(settled));
            }
            assert!(crew.unsettled.len() <= 2 * threads, "{:?}", crew.unsettled);
        }
        assert!(ahead > 1, "nothing ran ahead");
    }
}

/// Of two slots, the one whose attempts fail more often gets the idle threads.
#[test]
fn what_is_likely_to_count_comes_first() {
    let mut schedule = Schedule::<&str>::new(3, MOST_ATTEMPTS, 5);
    let id = |slot, number| AttemptId { slot, number };
    let after = |passed, standing| Progress { passed, standing };
    let needs = || after(0, Standing::Needs(vec![Need { part: MEMBER, share: 1.0 }]));
    for (slot, class) in ["easy", "hard", "easy"].into_iter().enumerate() {
        assert_eq!(schedule.next(), Some(Job::Open(slot)));
        schedule.opened(slot, class, 1, 0);
        assert_eq!(schedule.next(), Some(Job::Begin(id(slot, 0))));
    }
    // Experience: an accepted attempt of the easy class, a refused one of the hard class.
    schedule.progressed(id(2, 0), after(1, Standing::Final));
    assert_eq!(schedule.next(), Some(Job::Finish(2)));
    schedule.closed(2);
    schedule.progressed(id(1, 0), after(0, Standing::Refused));
    // What is certain comes first.
    assert_eq!(schedule.next(), Some(Job::Begin(id(1, 1))));
    schedule.progressed(id(0, 0), needs());
    assert_eq!(schedule.next(), Some(Job::Simulate(id(0, 0), MEMBER)));
    schedule.progressed(id(1, 1), needs());
    assert_eq!(schedule.next(), Some(Job::Simulate(id(1, 1), MEMBER)));
    // Chances: by the rule of succession an easy attempt is accepted with 2/3 · 2/3, a hard one with 1/3 ·
    // 1/2.
    let begun: Vec<Job> = core::iter::from_fn(|| schedule.next()).take(4).collect();
    let expected = [id(1, 2), id(1, 3), id(1, 4), id(0, 1)].map(Job::Begin);
    assert_eq!(begun, expected);
}
