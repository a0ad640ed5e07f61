//! The videos of questions, and those of their controls.

use crate::{error::RunError, interrupt, laboratory::create};
use phase_files::atomic;
use phase_model::{
    PhysicsConfig, State,
    arena::FRAMES_PER_SECOND,
    random::{Purpose, stream},
};
use phase_questions::Control;
use phase_render::{Frame, RenderError, SceneRenderer, Style, VideoEncoder, side_by_side};
use rand::seq::SliceRandom;
use std::path::Path;

/// Substeps from one frame to the next.
const STRIDE: usize = 2;
/// Frames a second.
pub(super) const FRAME_RATE: u32 = FRAMES_PER_SECOND / STRIDE as u32;
/// Frames for which the first frame is shown alone.
const STILL: usize = FRAME_RATE as usize;
/// Controls that are videos, and their folders.
pub(super) const FOLDERS: [(Control, &str); 4] = [
    (Control::Video, "videos"),
    (Control::FirstFrame, "videos-first-frame"),
    (Control::Shuffled, "videos-shuffled"),
    (Control::Reversed, "videos-reversed"),
];

/// One event of a video: its bodies and the states of all its frames.
pub(super) struct Shown {
    pub(super) physics: PhysicsConfig,
    pub(super) states: Vec<State>,
}

/// Writes the videos of one name: one event, or two side by side. The shuffled one depends on the seed alone.
pub(super) fn write(out: &Path, name: &str, shown: &[Shown], side: u32, seed: u64) -> Result<(), RunError> {
    let failed = |source: RenderError| RunError::Render { id: name.to_owned(), source };
    let frames = frames(shown, side).map_err(failed)?;
    let all: Vec<usize> = (0..frames.len()).collect();
    for (control, folder) in FOLDERS {
        if interrupt::requested() {
            return Err(RunError::Stopped(None));
        }
        let order = match control {
            Control::FirstFrame => vec![0; STILL],
            Control::Shuffled => {
                let mut order = all.clone();
                order.shuffle(&mut stream(seed, Purpose::Evaluation, frames.len() as u64));
                order
            }
            Control::Reversed => all.iter().rev().copied().collect(),
            _ => all.clone(),
        };
        create(&out.join(folder))?;
        let mp4 = encoded(&frames, &order).map_err(failed)?;
        atomic::write(&out.join(folder).join(format!("{name}.mp4")), &mp4)?;
    }
    Ok(())
}

fn frames(shown: &[Shown], side: u32) -> Result<Vec<Frame>, RenderError> {
    let renderers = shown
        .iter()
        .map(|it| SceneRenderer::new(&it.physics, Style::with_side(side)))
        .collect::<Result<Vec<_>, _>>()?;
    let count = shown.iter().map(|it| it.states.len()).max().unwrap_or_default();
    let mut frames = Vec::with_capacity(count / STRIDE + 1);
    for k in (0..count).step_by(STRIDE) {
        let each = renderers.iter().zip(shown).filter_map(|(renderer, it)| {
            it.states.get(k).or(it.states.last()).map(|state| renderer.frame(state, None))
        });
        let mut each: Vec<Frame> = each.collect();
        frames.push(match each.len() {
            1 => each.remove(0),
            _ => side_by_side(&each)?,
        });
    }
    Ok(frames)
}

fn encoded(frames: &[Frame], order: &[usize]) -> Result<Vec<u8>, RenderError> {
    let first = frames.first().ok_or(RenderError::NoFrames("video"))?;
    let mut video = VideoEncoder::new(Vec::new(), first.width(), first.height(), FRAME_RATE)?;
    for frame in order.iter().filter_map(|&k| frames.get(k)) {
        video.push(frame)?;
    }
    video.finish()
}
