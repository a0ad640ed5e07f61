//! Frames of a video, uniformly spaced, and the motion that they show.

use crate::FrameBudget;
use phase_evidence::Track;
use phase_model::{State, arena::STEP_SECONDS};

/// Numbers of frames for which it is tested whether a question can be answered.
pub const BUDGETS: [FrameBudget; 6] = [
    FrameBudget::Frames(4),
    FrameBudget::Frames(8),
    FrameBudget::Frames(16),
    FrameBudget::Frames(32),
    FrameBudget::Frames(64),
    FrameBudget::All,
];

/// The steps that so many frames show, uniformly spaced from the first to the last; all steps where there are
/// no more.
#[must_use]
pub fn shown_steps(steps: usize, budget: FrameBudget) -> Vec<usize> {
    match budget {
        FrameBudget::Frames(frames) if frames <= steps && frames > 1 => {
            (0..frames).map(|k| (2 * k * steps + frames - 1) / (2 * (frames - 1))).collect()
        }
        FrameBudget::Frames(frames) if frames <= steps => vec![0],
        _ => (0..=steps).collect(),
    }
}

/// The motion that somebody sees in a number of frames: bodies go straight from one frame to the next, and
/// what is held in a frame is held until the next.
#[must_use]
pub fn sampled(track: &Track, budget: FrameBudget) -> Track {
    let shown = shown_steps(track.steps(), budget);
    if shown.len() == track.states.len() {
        return track.clone();
    }
    let mut states: Vec<State> = Vec::with_capacity(track.states.len());
    for pair in shown.windows(2) {
        let [from, to] = [&track.states[pair[0]], &track.states[pair[1]]];
        let length = pair[1] - pair[0];
        states.extend((0..length).map(|k| between(from, to, k as f32 / length as f32, length)));
    }
    states.extend(shown.last().and_then(|&last| track.states.get(last)));
    Track { physics: track.physics.clone(), states }
}

/// The motion that the frames alone prove: everything stays as a frame shows it until the next one. What
/// happens between two frames, such as a short touch, is not in it.
#[must_use]
pub fn stills(track: &Track, budget: FrameBudget) -> Track {
    let shown = shown_steps(track.steps(), budget);
    let states = (0..track.states.len()).filter_map(|step| {
        let frame = shown.partition_point(|&it| it <= step).checked_sub(1)?;
        track.states.get(shown[frame]).copied()
    });
    Track { physics: track.physics.clone(), states: states.collect() }
}

/// Frames in another order, shown as if it were theirs.
#[must_use]
pub fn reordered(track: &Track, order: &[usize]) -> Track {
    let states = order.iter().filter_map(|&k| track.states.get(k)).copied().collect();
    let mut track = Track { physics: track.physics.clone(), states };
    with_velocities(&mut track);
    track
}

/// Sets all velocities to what the places of the states say.
fn with_velocities(track: &mut Track) {
    for k in 1..track.states.len() {
        let before = track.states[k - 1];
        for (body, earlier) in track.states[k].bodies.iter_mut().zip(&before.bodies) {
            body.velocity = (body.position - earlier.position) / STEP_SECONDS as f32;
        }
    }
}

/// A state on the way from one to another, `length` steps later.
fn between(from: &State, to: &State, share: f32, length: usize) -> State {
    let mut state = *from;
    for (body, other) in state.bodies.iter_mut().zip(&to.bodies) {
        let way = other.position - body.position;
        body.position += share * way;
        body.angle += share * turn(body.angle, other.angle);
        body.velocity = way / (length as f32 * STEP_SECONDS as f32);
    }
    state
}

/// The shorter turn from one angle to another (rad).
fn turn(from: f32, to: f32) -> f32 {
    let whole = 2.0 * core::f32::consts::PI;
    let turn = (to - from) % whole;
    if turn > whole / 2.0 {
        turn - whole
    } else if turn < -whole / 2.0 {
        turn + whole
    } else {
        turn
    }
}
