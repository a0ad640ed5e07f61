//! Fills slots on several threads, which do what the schedule says.

use super::{
    attempt::{Attempt, Judgement},
    schedule::{AttemptId, Job, Progress, Schedule, Standing},
    slot::{Slots, reasons},
};
use crate::{error::RunError, interrupt, parallel};
use phase_dataset::{acceptance::Refusal, slot_record::SlotRecord};
use phase_sampler::Variant;
use std::{
    collections::BTreeMap,
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::Instant,
};

/// Fills the slots with these numbers in the dataset, resuming where an earlier run stopped; `false` if
/// interrupted. After every attempt that counts the slot's record is written, so no more is ever lost than
/// what is under way.
///
/// # Errors
/// [`RunError::Exhausted`] and any failure of sampling, simulating and writing; of several, that of the
/// lowest slot.
pub(super) fn fill(slots: &Slots<'_>, indices: &[usize], threads: usize) -> Result<bool, RunError> {
    let board = Board {
        schedule: Schedule::new(indices.len(), slots.most_attempts(), threads),
        in_hand: BTreeMap::new(),
        failure: None,
        is_stopped: false,
        dropped: 0,
    };
    let crew = Crew { slots, indices, board: Mutex::new(board), changed: Condvar::new() };
    parallel::on_threads(threads, || crew.work())?;
    let board = crew.board.into_inner().unwrap_or_else(PoisonError::into_inner);
    slots.report_dropped(board.dropped);
    match board.failure {
        Some((_, error)) => Err(error),
        None => Ok(board.schedule.is_done()),
    }
}

struct Crew<'a> {
    slots: &'a Slots<'a>,
    indices: &'a [usize],
    board: Mutex<Board>,
    /// There may be something to do, or nothing ever again.
    changed: Condvar,
}

/// State that all threads share. It is locked for moments only.
struct Board {
    schedule: Schedule<Vec<Variant>>,
    in_hand: BTreeMap<usize, SlotInHand>,
    failure: Option<(usize, RunError)>,
    is_stopped: bool,
    /// Attempts that were begun ahead and do not count.
    dropped: usize,
}

/// A slot that is being filled.
struct SlotInHand {
    begun: Instant,
    record: SlotRecord,
    /// Number of refusals in the record on the disk.
    saved: Arc<Mutex<usize>>,
    under_way: BTreeMap<usize, Arc<Attempt>>,
    /// Results of attempts, until all attempts before them are refused.
    outcomes: BTreeMap<usize, Outcome>,
}

/// The result of an attempt.
enum Outcome {
    Refused(Refusal),
    Accepted(Arc<Attempt>),
    Failed(RunError),
}

/// Something to be done, and the attempt that it belongs to.
struct Assignment {
    job: Job,
    attempt: Arc<Attempt>,
}

impl Crew<'_> {
    /// Does the next job until there is none, in each thread.
    fn work(&self) {
        // Others must not wait for a thread that has panicked.
        let _guard = StopOnPanic(self);
        while let Some(Assignment { job, attempt }) = self.next() {
            let (slot, result) = match job {
                Job::Open(slot) => (slot, self.open(slot)),
                Job::Begin(id) => (id.slot, self.begin(id, &attempt)),
                Job::Simulate(id, part) => (
                    id.slot,
                    self.report_after(id, &attempt, |index| self.slots.simulate(index, &attempt, part)),
                ),
                Job::Finish(slot) => (slot, self.finish(slot)),
            };
            if let Err(error) = result {
                self.fail(slot, error);
            }
        }
    }

    /// Waits for the next job; `None` if there is none any more.
    fn next(&self) -> Option<Assignment> {
        let mut board = self.board();
        loop {
            if interrupt::requested() {
                self.stop(&mut board);
            }
            if board.is_stopped || board.schedule.is_done() {
                return None;
            }
            if let Some(job) = board.schedule.next() {
                let attempt = match job {
                    Job::Begin(id) | Job::Simulate(id, _) => {
                        let slot = board.in_hand.get_mut(&id.slot);
                        slot.map(|slot| Arc::clone(slot.under_way.entry(id.number).or_default()))
                    }
                    Job::Open(_) | Job::Finish(_) => None,
                };
                return Some(Assignment { job, attempt: attempt.unwrap_or_default() });
            }
            board = self.changed.wait(board).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn open(&self, slot: usize) -> Result<(), RunError> {
        let index = self.indices[slot];
        let record = self.slots.load(index);
        if record.is_filled() {
            self.slots.report(&record, "kept");
            self.board().schedule.closed(slot);
        } else {
            let variants = self.slots.variants(index);
            let refused = record.refused.len();
            let mut board = self.board();
            let events = variants.len();
            board.schedule.opened(slot, variants, events, refused);
            let under_way = BTreeMap::new();
            let outcomes = BTreeMap::new();
            let saved = Arc::new(Mutex::new(refused));
            board
                .in_hand
                .insert(slot, SlotInHand { begun: Instant::now(), record, saved, under_way, outcomes });
        }
        self.changed.notify_all();
        Ok(())
    }

    fn begin(&self, id: AttemptId, attempt: &Arc<Attempt>) -> Result<(), RunError> {
        self.report_after(id, attempt, |index| {
            attempt.set_cast(self.slots.cast(index, id.number)?);
            Ok(true)
        })
    }

    /// Does something for an attempt, and draws the consequences.
    fn report_after(
        &self,
        id: AttemptId,
        attempt: &Arc<Attempt>,
        act: impl FnOnce(usize) -> Result<bool, RunError>,
    ) -> Result<(), RunError> {
        match act(self.indices[id.slot]) {
            Ok(true) => self.report(id, attempt),
            Ok(false) => Ok(()),
            // A failure counts only if the attempt does.
            Err(error) => {
                let progress = Progress { passed: 0, standing: Standing::Final };
                self.draw_consequences(id, progress, Some(Outcome::Failed(error)))
            }
        }
    }

    /// Judges an attempt by what is known of it.
    fn report(&self, id: AttemptId, attempt: &Arc<Attempt>) -> Result<(), RunError> {
        let Some(cast) = attempt.cast() else { return Ok(()) };
        // Until the schedule knows, so that it hears of one after the other.
        let results = attempt.results();
        let (passed, judgement) = results.judge(cast);
        let (standing, outcome) = match judgement {
            Judgement::Needs(needs) => (Standing::Needs(needs), None),
            Judgement::Refused(refusal) => (Standing::Refused, Some(Outcome::Refused(refusal))),
            Judgement::Accepted => (Standing::Final, Some(Outcome::Accepted(Arc::clone(attempt)))),
        };
        self.draw_consequences(id, Progress { passed, standing }, outcome)
    }

    fn draw_consequences(
        &self,
        id: AttemptId,
        progress: Progress,
        outcome: Option<Outcome>,
    ) -> Result<(), RunError> {
        let mut guard = self.board();
        let board = &mut *guard;
        let Some(slot) = board.in_hand.get_mut(&id.slot) else { return Ok(()) };
        if !slot.under_way.contains_key(&id.number) {
            return Ok(());
        }
        let consequences = board.schedule.progressed(id, progress);
        self.changed.notify_all();
        let Some(outcome) = outcome else { return Ok(()) };
        if let Some(attempt) = slot.under_way.remove(&id.number) {
            // What else was simulated of it is not needed.
            attempt.abandon();
        }
        if !matches!(outcome, Outcome::Refused(..)) {
            // Nothing after it counts.
            slot.outcomes.split_off(&id.number);
        }
        slot.outcomes.insert(id.number, outcome);
        board.dropped += consequences.dropped.len();
        for number in consequences.dropped {
            if let Some(attempt) = slot.under_way.remove(&number) {
                attempt.abandon();
            }
        }
        let name = self.slots.id(self.indices[id.slot]);
        let before = slot.record.refused.len();
        for number in consequences.refused {
            if let Some(Outcome::Refused(refusal)) = slot.outcomes.remove(&number) {
                self.slots.report_refusal(&name, number, refusal);
                slot.record.refused.push(refusal);
            }
        }
        if slot.record.refused.len() == before {
            return Ok(());
        }
        let record = slot.record.clone();
        let saved = Arc::clone(&slot.saved);
        drop(guard);
        self.save(id.slot, &record, &saved)
    }

    /// Writes the files of a slot of which no further attempt counts.
    fn finish(&self, slot: usize) -> Result<(), RunError> {
        let index = self.indices[slot];
        let taken = {
            let mut board = self.board();
            board.in_hand.remove(&slot)
        };
        let Some(SlotInHand { begun, mut record, saved, mut outcomes, .. }) = taken else { return Ok(()) };
        match outcomes.remove(&record.refused.len()) {
            Some(Outcome::Failed(error)) => return Err(error),
            Some(Outcome::Accepted(attempt)) => {
                let Some(cast) = attempt.cast() else { return Ok(()) };
                let events = attempt.results().take_events();
                self.slots.keep(index, cast, events, &mut record)?;
            }
            Some(Outcome::Refused(..)) | None => {
                let id = self.slots.id(index);
                return Err(RunError::Exhausted { id, reasons: reasons(&record.refused) });
            }
        }
        self.save(slot, &record, &saved)?;
        self.slots.report(&record, &format!("{:.1} s", begun.elapsed().as_secs_f64()));
        self.board().schedule.closed(slot);
        self.changed.notify_all();
        Ok(())
    }

    /// Writes a slot's record, unless a later one has been written.
    fn save(&self, slot: usize, record: &SlotRecord, saved: &Mutex<usize>) -> Result<(), RunError> {
        let mut saved = saved.lock().unwrap_or_else(PoisonError::into_inner);
        if record.is_filled() || record.refused.len() > *saved {
            record.save(&self.slots.record_path(self.indices[slot]))?;
            *saved = if record.is_filled() { usize::MAX } else { record.refused.len() };
        }
        Ok(())
    }

    fn fail(&self, slot: usize, error: RunError) {
        let mut board = self.board();
        if board.failure.as_ref().is_none_or(|(number, _)| slot < *number) {
            board.failure = Some((slot, error));
        }
        self.stop(&mut board);
    }

    /// Nothing is begun any more, and what is under way is given up.
    fn stop(&self, board: &mut Board) {
        board.is_stopped = true;
        for attempt in board.in_hand.values().flat_map(|slot| slot.under_way.values()) {
            attempt.abandon();
        }
        self.changed.notify_all();
    }

    fn board(&self) -> MutexGuard<'_, Board> {
        self.board.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct StopOnPanic<'a>(&'a Crew<'a>);

impl Drop for StopOnPanic<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop(&mut self.0.board());
        }
    }
}
