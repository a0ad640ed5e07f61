//! Cores that do what the schedule says, in simulated time.

use super::measured::{Measured, needs};
use phase_cli::gen_dataset::schedule::{AttemptId, Job, Part, Progress, Schedule, Standing};
use std::collections::BTreeSet;

/// What a run takes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Run {
    /// Wall time (s).
    pub(super) seconds: f64,
    /// CPU time of what was not needed (s).
    pub(super) in_vain: f64,
}

/// Something under way.
#[derive(Clone, Copy, Debug)]
struct Busy {
    since: f64,
    until: f64,
    job: Job,
}

/// Simulates a run on a number of cores, with attempts that run ahead or without.
pub(super) fn simulate(measured: &Measured, cores: usize, ahead: bool) -> Run {
    let schedule = Schedule::new(measured.slots.len(), usize::MAX, cores);
    let mut schedule = if ahead { schedule } else { schedule.in_sequence() };
    let mut made = BTreeSet::<(AttemptId, Part)>::new();
    let mut busy: Vec<Busy> = Vec::new();
    let (mut now, mut spent) = (0.0, 0.0);
    loop {
        while busy.len() < cores
            && let Some(job) = schedule.next()
        {
            busy.push(Busy { since: now, until: now + seconds(measured, job), job });
        }
        let Some(next) = (0..busy.len()).min_by(|&a, &b| busy[a].until.total_cmp(&busy[b].until)) else {
            break;
        };
        let done = busy.swap_remove(next);
        now = done.until;
        spent += done.until - done.since;
        for id in settled(measured, &mut schedule, &mut made, done.job) {
            // What is under way for an attempt that has a result, or does not count, is given up.
            busy.retain(|it| {
                let is_of = matches!(it.job, Job::Begin(other) | Job::Simulate(other, _) if other == id);
                spent += if is_of { now - it.since } else { 0.0 };
                !is_of
            });
        }
    }
    let needed = measured.cpu_seconds() - measured.completing;
    Run { seconds: now + measured.completing, in_vain: spent - needed }
}

/// How long something takes (s).
fn seconds(measured: &Measured, job: Job) -> f64 {
    match job {
        // Reading a file.
        Job::Open(_) => 0.0,
        Job::Begin(id) => measured.attempt(id.slot, id.number).scenes,
        Job::Simulate(id, part) => measured.seconds(measured.attempt(id.slot, id.number), part),
        Job::Finish(slot) => measured.slots[slot].last().map_or(0.0, |accepted| accepted.files),
    }
}

/// Reports to the schedule what is done, and returns the attempts of which nothing more is needed.
fn settled(
    measured: &Measured,
    schedule: &mut Schedule<Vec<phase_sampler::Variant>>,
    made: &mut BTreeSet<(AttemptId, Part)>,
    job: Job,
) -> Vec<AttemptId> {
    let id = match job {
        Job::Open(slot) => {
            let variants = measured.slots[slot][0].variants.clone();
            let events = variants.len();
            schedule.opened(slot, variants, events, 0);
            return Vec::new();
        }
        Job::Finish(slot) => {
            schedule.closed(slot);
            return Vec::new();
        }
        Job::Begin(id) => id,
        Job::Simulate(id, part) => {
            made.insert((id, part));
            id
        }
    };
    let attempt = measured.attempt(id.slot, id.number);
    let needs = needs(attempt, |part| made.contains(&(id, part)));
    let (passed, standing) = if needs.is_empty() {
        (attempt.passed, if attempt.accepted { Standing::Final } else { Standing::Refused })
    } else {
        let passed = (0..attempt.passed).take_while(|&k| made.contains(&(id, Part::Member(k)))).count();
        (passed, Standing::Needs(needs))
    };
    let is_settled = !matches!(standing, Standing::Needs(_));
    let dropped = schedule.progressed(id, Progress { passed, standing }).dropped;
    let dropped = dropped.into_iter().map(|number| AttemptId { number, ..id });
    dropped.chain(is_settled.then_some(id)).collect()
}
