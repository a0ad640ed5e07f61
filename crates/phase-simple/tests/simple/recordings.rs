//! Inverse dynamics of the published recordings, where they are available.

use phase_event::{Recording, from_json};
use phase_model::{Action, AgentId};
use phase_simple::InverseDynamics;
use std::{fs, path::Path};

/// Residual added by what was done in place of what was found, up to which they have the same effect (u).
const SAME_EFFECT: f32 = 1e-3;
/// Of the recordings without recovered actions, every so many are explained.
const THINNED: usize = 8;

/// The recorder turned every agent counter-clockwise, whichever way it intended to turn.
fn turned(action: Action) -> Action {
    if action == Action::TurnRight { Action::TurnLeft } else { action }
}

/// The number of recovered actions that do not explain the motion as well as what was found.
fn missed(recording: &Recording, motion: &InverseDynamics) -> usize {
    let Some(recovered) = &recording.recovered_actions else { return 0 };
    let alternatives = motion.alternatives();
    let steps = recovered.steps.iter().zip(&alternatives).zip(&motion.residuals);
    let missed = |((done, residuals), found): ((&[Action; 2], &[[f32; 14]; 2]), &f32)| {
        let misses =
            |&agent: &AgentId| residuals[agent.index()][turned(done[agent]).index()] > found + SAME_EFFECT;
        AgentId::ALL.iter().filter(|agent| misses(agent)).count()
    };
    steps.map(missed).sum()
}

#[test]
fn nearly_every_step_is_explained_and_every_known_action_found() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/real-phase/dev.json");
    if !path.is_file() {
        println!("skipped: the published recordings are not at hand");
        return;
    }
    let recordings = from_json(&fs::read_to_string(&path).expect("a text")).expect("the recordings");
    let mut steps = 0;
    let mut explained = 0;
    for (number, recording) in recordings.iter().enumerate() {
        let known = recording.recovered_actions.is_some();
        if !known && number % THINNED != 0 {
            continue;
        }
        let motion = InverseDynamics::new(&recording.observed().expect("a sound event"));
        assert_eq!(missed(recording, &motion), 0, "{}", recording.id);
        assert_eq!(motion.strengths(), recording.scene.agents.each_ref().map(|agent| agent.strength));
        assert_eq!(motion.late_start, recording.scene.layout.flip().is_some(), "{}", recording.id);
        steps += motion.residuals.len();
        explained += motion.explained().filter(|explained| *explained).count();
    }
    assert!(explained * 100 >= steps * 98, "{explained} of {steps} steps");
}
