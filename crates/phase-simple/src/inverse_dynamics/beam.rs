//! All paths through an event that are followed at once.

use super::{interpolation, path::Path, reading::Reading, replay::Replay, search::explanations};
use phase_event::ObservedEvent;
use phase_model::State;

/// Paths that are followed at once.
const BEAM_WIDTH: usize = 16;
/// Those of them with the same grips.
const SAME_GRIPS: usize = 8;
/// Paths whose cost exceeds that of the best by more are given up.
const GIVE_UP: f64 = 15.0;

/// All paths that were followed, and which of them still are.
pub(super) struct Beam {
    /// By reading, with its states between steps by interpolation.
    readings: Vec<(Replay, Vec<State>)>,
    /// Every path that was kept, by number.
    paths: Vec<Path>,
    /// The numbers of those that are followed, cheapest first: at least one.
    followed: Vec<usize>,
}

impl Beam {
    /// All readings of an event, at its start.
    pub(super) fn new(observed: &ObservedEvent) -> Self {
        let reading = |reading: Reading| {
            let between = interpolation::states(&reading);
            (Replay::new(reading), between)
        };
        let readings: Vec<_> = Reading::all(observed).into_iter().map(reading).collect();
        let starts =
            readings.iter().enumerate().map(|(number, (replay, _))| Path::start(number, replay)).collect();
        let mut beam = Self { readings, paths: Vec::new(), followed: Vec::new() };
        beam.keep(starts);
        beam
    }

    /// Follows all paths by one step, to row `t`.
    pub(super) fn advance(&mut self, t: usize) {
        let mut longer = Vec::new();
        for &number in &self.followed {
            let path = &self.paths[number];
            let (replay, between) = &self.readings[path.reading];
            for explanation in
                explanations(replay, &path.tracked, replay.row(t), path.strengths, path.actions)
            {
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

    /// The cheapest path, from its start on, and the physics that it follows.
    pub(super) fn into_best(mut self) -> (Vec<Path>, Replay) {
        // There is always one: every path has a continuation, and the cheapest is kept.
        let mut number = Some(self.followed[0]);
        let reading = self.paths[self.followed[0]].reading;
        let mut best = Vec::new();
        while let Some(path) = number.and_then(|number| self.paths.get(number)) {
            best.push(path.clone());
            number = path.before;
        }
        best.reverse();
        (best, self.readings.swap_remove(reading).0)
    }
}
