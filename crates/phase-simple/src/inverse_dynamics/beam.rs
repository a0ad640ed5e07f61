//! All paths through an event that are followed at once.

use super::{
    interpolation,
    path::Path,
    reading::Reading,
    replay::Replay,
    search::{Before, Explanation, explanations},
};
use phase_event::{ObservedError, ObservedEvent};
use phase_model::{Body, MAX_ENTITIES, State};

/// Paths that are followed at once.
const BEAM_WIDTH: usize = 8;
/// Greatest number of paths with the same grips among them.
const SAME_GRIPS: usize = 3;
/// Paths whose cost exceeds that of the best by more, about one step that is not explained, are given up.
const GIVE_UP: f64 = 5.0;
/// Mean cost of a step (nat) up to which a path counts as exact. It is 0.1 on average on recordings, which
/// this physics explains, and about 2.5 where another made the motion.
const EXACT_COST: f64 = 1.0;
/// Free steps that this mean takes in beside those of the path.
const EXACT_STEPS: usize = 4;

/// All paths that were followed, and which of them still are.
#[derive(Clone, Debug)]
pub(super) struct Beam {
    /// By reading, with its states between steps by interpolation.
    readings: Vec<(Replay, Vec<State>)>,
    /// Every path that was kept, by number.
    paths: Vec<Path>,
    /// The numbers of those that are followed, cheapest first: at least one.
    followed: Vec<usize>,
    /// The last step is followed without the row after it, so it is followed again when that row has come.
    /// `None` before the first step.
    before_last: Option<BeforeLast>,
}

/// The paths before the last step.
#[derive(Clone, Debug)]
struct BeforeLast {
    /// Their number.
    paths: usize,
    /// The numbers of those that were followed.
    followed: Vec<usize>,
    /// The explanations of the step, for each of those. They do not depend on the row after it.
    explanations: Vec<Vec<Explanation>>,
}

impl Beam {
    /// All readings of an event, followed to its last row.
    pub(super) fn new(observed: &ObservedEvent) -> Self {
        let reading = |reading: Reading| {
            let between = interpolation::states(&reading);
            (Replay::new(reading), between)
        };
        let readings: Vec<_> = Reading::all(observed).into_iter().map(reading).collect();
        let starts =
            readings.iter().enumerate().map(|(number, (replay, _))| Path::start(number, replay)).collect();
        let mut beam = Self { readings, paths: Vec::new(), followed: Vec::new(), before_last: None };
        beam.keep(starts);
        for t in 1..observed.steps() {
            beam.advance(t);
        }
        beam.advance_to_last(observed.steps());
        beam
    }

    /// Follows the event to its next row, as it was observed. Whether the paths, but for their last steps,
    /// are continued; if not, [`Beam::new`] has to begin again, since the row tells how earlier rows are to
    /// be read.
    pub(super) fn push(&mut self, row: &[Body; MAX_ENTITIES]) -> Result<bool, ObservedError> {
        let mut read_anew = false;
        for (replay, between) in &mut self.readings {
            read_anew |= replay.reading.push(row)?;
            between.pop();
            let rows = replay.reading.event.rows().len();
            between.extend((rows - 2..rows).map(|t| interpolation::state(&replay.reading, t)));
        }
        if read_anew {
            return Ok(false);
        }
        let last = self.readings[0].0.reading.event.steps();
        if let Some(BeforeLast { paths, followed, explanations }) = self.before_last.take() {
            self.paths.truncate(paths);
            self.followed = followed;
            self.extend(last - 1, explanations);
        }
        self.advance_to_last(last);
        Ok(true)
    }

    /// Follows all paths to the last row, `t`, if that is not row 0.
    fn advance_to_last(&mut self, t: usize) {
        if t > 0 {
            let explanations = self.explanations(t);
            let paths = self.paths.len();
            let followed = self.followed.clone();
            self.extend(t, explanations.clone());
            self.before_last = Some(BeforeLast { paths, followed, explanations });
        }
    }

    /// Follows all paths by one step, to row `t`.
    fn advance(&mut self, t: usize) {
        self.extend(t, self.explanations(t));
    }

    /// The explanations of the step to row `t`, for each path that is followed.
    fn explanations(&self, t: usize) -> Vec<Vec<Explanation>> {
        let of_path = |&number: &usize| {
            let path = &self.paths[number];
            let (replay, _) = &self.readings[path.reading];
            let before = Before {
                tracked: &path.tracked,
                strengths: path.strengths,
                actions: path.actions,
                exact: path.cost <= EXACT_COST * (t + EXACT_STEPS) as f64,
            };
            explanations(replay, &before, replay.row(t))
        };
        self.followed.iter().map(of_path).collect()
    }

    /// Extends all paths by what explains the step to row `t`.
    fn extend(&mut self, t: usize, explanations: Vec<Vec<Explanation>>) {
        let mut longer = Vec::new();
        for (&number, explanations) in self.followed.iter().zip(explanations) {
            let path = &self.paths[number];
            let (replay, between) = &self.readings[path.reading];
            for explanation in explanations {
                longer.extend(path.extended(number, replay, explanation, &between[t]));
            }
        }
        self.keep(longer);
    }

    /// Keeps the cheapest paths, one for each state.
    fn keep(&mut self, mut paths: Vec<Path>) {
        paths.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let limit = paths.first().map_or(0.0, |path| path.cost) + GIVE_UP;
        self.followed.clear();
        for path in paths.into_iter().take_while(|path| path.cost.total_cmp(&limit).is_le()) {
            let kept = || self.followed.iter().map(|&number| (number, &self.paths[number]));
            if let Some((number, _)) = kept().find(|(_, kept)| kept.same_state(&path)) {
                // A push that moves nothing tells nothing about strength.
                let kept = &mut self.paths[number];
                if kept.before == path.before {
                    for (strengths, others) in kept.strengths.iter_mut().zip(path.strengths) {
                        *strengths |= others;
                    }
                }
            } else if self.followed.len() < BEAM_WIDTH
                && kept().filter(|(_, kept)| kept.same_grips(&path)).count() < SAME_GRIPS
            {
                self.followed.push(self.paths.len());
                self.paths.push(path);
            }
        }
    }

    /// The numbers of the cheapest path and of those before it, from its start on.
    pub(super) fn best(&self) -> Vec<usize> {
        // There is always one: every path has a continuation, and the cheapest is kept.
        let mut best = vec![self.followed[0]];
        while let Some(before) = best.last().and_then(|&number| self.path(number).before) {
            best.push(before);
        }
        best.reverse();
        best
    }

    /// Row 0 as it was observed.
    pub(super) fn first_row(&self) -> &[Body; MAX_ENTITIES] {
        // The first reading takes the rows as they are.
        self.readings[0].0.row(0)
    }

    /// The path of a number.
    pub(super) fn path(&self, number: usize) -> &Path {
        &self.paths[number]
    }

    /// The physics that a path follows.
    pub(super) fn replay(&self, path: &Path) -> &Replay {
        &self.readings[path.reading].0
    }
}
