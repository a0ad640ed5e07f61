//! Events as videos and contact sheets in files.

use crate::error::CliError;
use phase_dataset::atomic;
use phase_model::{AgentId, Physique, State, arena::FRAMES_PER_SECOND};
use phase_perception::CellSet;
use phase_render::{
    Caption, Frame, Overlay, Palette, RenderError, Stage, Style, VideoEncoder, contact_sheet, side_by_side,
};
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
    /// What to write above.
    pub title: String,
    /// What to write below.
    pub captions: Vec<Caption>,
}

/// A state to draw and the minds to draw over it, each in a picture of its own beside the others'; without any the state
/// alone. Several frames may share a mind.
#[derive(Clone, Debug)]
pub struct Shot<'a> {
    /// The true state.
    pub state: State,
    /// The minds, as many for every frame of an event.
    pub minds: Vec<&'a Mind>,
}

/// Writes a video.
///
/// # Errors
/// [`CliError::Write`] or [`CliError::Render`]; then there is no file.
pub fn write_video(
    path: &Path,
    id: &str,
    physique: &Physique,
    palette: Palette,
    shots: &[Shot<'_>],
) -> Result<(), CliError> {
    let mp4 = || -> Result<Vec<u8>, RenderError> {
        let stage = Stage::new(physique, style(Style::default(), palette, shots))?;
        let mut frames = shots.iter().map(|shot| frame(&stage, shot));
        let first = frames.next().ok_or(RenderError::NoFrames("video"))??;
        let mut video = VideoEncoder::new(Vec::new(), first.width(), first.height(), FRAMES_PER_SECOND)?;
        video.push(&first)?;
        for frame in frames {
            video.push(&frame?)?;
        }
        video.finish()
    };
    let mp4 = mp4().map_err(|source| CliError::Render { id: id.into(), source })?;
    Ok(atomic::write(path, &mp4)?)
}

/// Writes one picture of `count` frames spread evenly from the first to the last.
///
/// # Errors
/// [`CliError::Write`] or [`CliError::Render`]; then there is no file.
pub fn write_sheet(
    path: &Path,
    id: &str,
    physique: &Physique,
    palette: Palette,
    shots: &[Shot<'_>],
    count: usize,
) -> Result<(), CliError> {
    let png = || -> Result<Vec<u8>, RenderError> {
        let stage = Stage::new(physique, style(Style::with_side(SHEET_SIDE), palette, shots))?;
        let count = count.min(shots.len());
        let last = shots.len().saturating_sub(1);
        let chosen = (0..count).map(|k| if count > 1 { k * last / (count - 1) } else { last });
        let frames = chosen.map(|k| frame(&stage, &shots[k])).collect::<Result<Vec<Frame>, RenderError>>()?;
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

/// Title, legend and captions are for minds.
fn style(style: Style, palette: Palette, shots: &[Shot<'_>]) -> Style {
    let explained = shots.iter().any(|shot| !shot.minds.is_empty());
    let caption_lines = if explained { CAPTION_LINES } else { 0 };
    Style { palette, title: explained, legend: explained, caption_lines, ..style }
}

fn frame(stage: &Stage, shot: &Shot<'_>) -> Result<Frame, RenderError> {
    let view = |mind: &&Mind| {
        let overlay = Overlay {
            agent: mind.agent,
            visible: &mind.visible,
            particles: &mind.particles,
            title: &mind.title,
            captions: &mind.captions,
        };
        stage.frame(&shot.state, Some(&overlay))
    };
    let mut views: Vec<Frame> = shot.minds.iter().map(view).collect();
    match views.len() {
        0 => Ok(stage.frame(&shot.state, None)),
        1 => Ok(views.remove(0)),
        _ => side_by_side(&views),
    }
}
