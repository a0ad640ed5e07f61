//! Results of an interrupted run, with which the same command goes on, bit for bit.

use crate::{error::RunError, event_writer::program};
use phase_evidence::Track;
use phase_files::{
    cache::Cache,
    checksum::{hexadecimal, sha256},
    folder::Folder,
    run::canonical,
};
use phase_model::{AGENT_COUNT, AgentId, PhysicsConfig, RoomId, State};
use phase_questions::{Alternative, FrameBudget, Inside, SimulatedFutures};
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Results of a run that are kept until it ends; those of another program are made again.
#[derive(Debug)]
pub(super) struct Kept(Cache);

/// The parts of [`Inside`] that take long to make.
#[derive(Serialize, Deserialize)]
struct KeptInside {
    beliefs: [Vec<Vec<(RoomId, f64)>>; AGENT_COUNT],
    without: Option<(AgentId, Vec<State>)>,
    futures: Option<(usize, usize, Vec<State>)>,
}

impl Kept {
    pub(super) fn new(folder: &Folder) -> Self {
        let made_by = json!({ "program": hexadecimal(&program()) });
        Self(Cache::new(&folder.cache(), sha256(canonical(&made_by).as_bytes())))
    }

    /// Facts of a simulated event, whose states are known already.
    pub(super) fn inside(
        &self,
        id: &str,
        seed: u64,
        physics: &PhysicsConfig,
        states: Vec<State>,
    ) -> Option<Inside> {
        let kept: KeptInside = self.0.load(&file("inside", id), seed)?;
        let without = kept
            .without
            .map(|(idle, states)| Alternative { idle, track: Track { physics: physics.clone(), states } });
        let futures = kept.futures.map(|(step, steps, ends)| SimulatedFutures { step, steps, ends });
        Some(Inside { states, beliefs: kept.beliefs, without, futures })
    }

    pub(super) fn keep_inside(&self, id: &str, seed: u64, inside: &Inside) -> Result<(), RunError> {
        let Inside { beliefs, without, futures, .. } = inside;
        let kept = KeptInside {
            beliefs: beliefs.clone(),
            without: without.as_ref().map(|it| (it.idle, it.track.states.clone())),
            futures: futures.as_ref().map(|it| (it.step, it.steps, it.ends.clone())),
        };
        Ok(self.0.store(&file("inside", id), seed, &kept)?)
    }

    /// The frames that each question needs, as numbers (0 for all), if all were certified.
    pub(super) fn frames(&self, seed: u64) -> Option<Vec<Option<FrameBudget>>> {
        let kept: Vec<Option<usize>> = self.0.load("frames", seed)?;
        let budget = |frames: usize| if frames == 0 { FrameBudget::All } else { FrameBudget::Frames(frames) };
        Some(kept.into_iter().map(|frames| frames.map(budget)).collect())
    }

    pub(super) fn keep_frames(&self, seed: u64, frames: &[Option<FrameBudget>]) -> Result<(), RunError> {
        let numbers: Vec<Option<usize>> = frames.iter().map(|it| it.map(FrameBudget::number)).collect();
        Ok(self.0.store("frames", seed, &numbers)?)
    }

    /// The number of questions that a method, whose answers have been written, left to chance.
    pub(super) fn left_to_chance(&self, method: &str, seed: u64) -> Option<usize> {
        self.0.load(&file("answers", method), seed)
    }

    pub(super) fn keep_left_to_chance(&self, method: &str, seed: u64, left: usize) -> Result<(), RunError> {
        Ok(self.0.store(&file("answers", method), seed, &left)?)
    }

    /// Whether all videos of one name have been written.
    pub(super) fn has_videos(&self, name: &str, seed: u64) -> bool {
        self.0.load::<bool>(&file("videos", name), seed).is_some()
    }

    pub(super) fn keep_videos(&self, name: &str, seed: u64) -> Result<(), RunError> {
        Ok(self.0.store(&file("videos", name), seed, &true)?)
    }
}

/// Names of events are unique without regard to case, and long ones may not fit a name of a file.
fn file(what: &str, name: &str) -> String {
    format!("{what}-{}", hexadecimal(&sha256(name.as_bytes())))
}
