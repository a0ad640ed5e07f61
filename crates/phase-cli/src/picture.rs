//! Events as videos and contact sheets in files.

use crate::error::CliError;
use phase_dataset::atomic;
use phase_model::{AgentId, Physique, State, arena::FRAMES_PER_SECOND};
use phase_perception::CellSet;
use phase_render::{Caption, Frame, Overlay, RenderError, Stage, Style, VideoEncoder, contact_sheet};
use std::path::Path;

/// Side of each frame of a contact sheet (pixels).
const SHEET_SIDE: u32 = 320;
/// Lines of text below frames that show a mind at work.
const CAPTION_LINES: u32 = crate::captions::COUNT as u32;

/// One agent's mind at one frame.
#[derive(Clone, Debug)]
pub struct Mind {
    /// Whose.
    pub agent: AgentId,
    /// What it sees.
    pub visible: CellSet,
    /// What it holds possible.
    pub particles: Vec<State>,
    /// What to write below.
    pub captions: Vec<Caption>,
}

/// A state to draw and the mind to draw over it, if any. Several frames may share a mind.
#[derive(Clone, Debug)]
pub struct Shot<'a> {
    /// The true state.
    pub state: State,
    /// The mind.
    pub mind: Option<&'a Mind>,
}

/// Writes a video.
///
/// # Errors
/// [`CliError::Write`] or [`CliError::Render`]; then there is no file.
pub fn write_video(path: &Path, id: &str, physique: &Physique, shots: &[Shot<'_>]) -> Result<(), CliError> {
    let failed = |source| CliError::Render { id: id.into(), source };
    let stage = Stage::new(physique, style(Style::default(), shots)).map_err(failed)?;
    let mut bytes = Vec::new();
    let mut video =
        VideoEncoder::new(&mut bytes, stage.width(), stage.height(), FRAMES_PER_SECOND).map_err(failed)?;
    for shot in shots {
        video.push(&frame(&stage, shot)).map_err(failed)?;
    }
    video.finish().map_err(failed)?;
    Ok(atomic::write(path, &bytes)?)
}

/// Writes one picture of `count` frames spread evenly from the first to the last.
///
/// # Errors
/// [`CliError::Write`] or [`CliError::Render`]; then there is no file.
pub fn write_sheet(
    path: &Path,
    id: &str,
    physique: &Physique,
    shots: &[Shot<'_>],
    count: usize,
) -> Result<(), CliError> {
    let png = || -> Result<Vec<u8>, RenderError> {
        let stage = Stage::new(physique, style(Style::with_side(SHEET_SIDE), shots))?;
        let count = count.min(shots.len());
        let last = shots.len().saturating_sub(1);
        let chosen = (0..count).map(|k| if count > 1 { k * last / (count - 1) } else { last });
        let frames: Vec<Frame> = chosen.map(|k| frame(&stage, &shots[k])).collect();
        let columns = columns(count);
        contact_sheet(&frames, columns)?.png()
    };
    let png = png().map_err(|source| CliError::Render { id: id.into(), source })?;
    Ok(atomic::write(path, &png)?)
}

/// Columns for a shape between a square and a page on its side that leaves the fewest places empty.
fn columns(count: usize) -> usize {
    let widest = (1..=count).find(|columns| columns * columns >= 2 * count).unwrap_or(count).max(1);
    let squarest = (1..=widest).find(|columns| columns * columns >= count).unwrap_or(widest);
    (squarest..=widest).min_by_key(|columns| count.next_multiple_of(*columns)).unwrap_or(widest)
}

fn style(style: Style, shots: &[Shot<'_>]) -> Style {
    let caption_lines = if shots.iter().any(|shot| shot.mind.is_some()) { CAPTION_LINES } else { 0 };
    Style { caption_lines, ..style }
}

fn frame(stage: &Stage, shot: &Shot<'_>) -> Frame {
    let overlay = shot.mind.map(|mind| Overlay {
        agent: mind.agent,
        visible: &mind.visible,
        particles: &mind.particles,
        captions: &mind.captions,
    });
    stage.frame(&shot.state, overlay.as_ref())
}
