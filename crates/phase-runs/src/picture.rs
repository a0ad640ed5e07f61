//! Events as videos and contact sheets in files.

use crate::error::RunError;
use phase_dataset::form::StimulusForm;
use phase_event::Event;
use phase_files::atomic;
use phase_model::{AgentId, PhysicsConfig, State, arena::FRAMES_PER_SECOND, setting::Setting};
use phase_perception::CellSet;
use phase_render::{
    Annotation, Caption, Course, Frame, Overlay, Palette, PaletteName, RenderError, SceneRenderer, Style,
    VideoEncoder, contact_sheet, palette::SHARES, side_by_side,
};
use std::path::Path;

/// Side of each frame of a contact sheet (pixels).
pub const SHEET_SIDE: u32 = 320;
/// Lines of text below frames that show an agent's decisions.
const CAPTION_LINES: u32 = crate::captions::COUNT as u32;
/// Height of an observer's course, in lines of text.
const COURSE_LINES: u32 = 4;

/// The look of a video.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Look {
    /// Its colours.
    pub palette: Palette,
    /// Side of the square with the arena (pixels): even, 64 to 2000.
    pub size: u32,
    /// Frames a second, 1 to 120.
    pub frame_rate: u32,
}

/// Sides of videos (pixels).
pub const SIZES: Setting = Setting::whole("size", "pixels", 64, 2000);
/// Frames a second.
pub const FRAME_RATES: Setting = Setting::whole("frame_rate", "frames a second", 1, 120);

impl Default for Look {
    /// 480 pixels in the paper's colours, a frame for each substep.
    fn default() -> Self {
        Self { palette: Palette::PAPER, size: Style::default().side, frame_rate: FRAMES_PER_SECOND }
    }
}

impl Look {
    /// The look that a dataset's form asks for.
    ///
    /// # Errors
    /// [`RunError::Usage`] if there is no such palette, or a number is out of its range.
    pub fn of(form: &StimulusForm) -> Result<Self, RunError> {
        let wrong = |rule: String| RunError::Usage(format!("form of the videos: {rule}"));
        let palette = PaletteName::ALL.into_iter().find(|palette| palette.name() == form.palette);
        let palette = palette.ok_or_else(|| wrong(format!("there is no palette {:?}", form.palette)))?;
        for (setting, found) in [(SIZES, form.size), (FRAME_RATES, form.frame_rate)] {
            setting.check(f64::from(found)).map_err(|error| wrong(error.to_string()))?;
        }
        if !form.size.is_multiple_of(2) {
            return Err(wrong(format!("`size` must be even, not {}", form.size)));
        }
        Ok(Self { palette: palette.palette(), size: form.size, frame_rate: form.frame_rate })
    }
}

/// One agent's field of view and belief at one frame.
#[derive(Clone, Debug)]
pub struct BeliefFrame {
    /// The agent.
    pub agent: AgentId,
    /// Its field of view.
    pub visible: CellSet,
    /// Its belief particles.
    pub particles: Vec<State>,
    /// The text above.
    pub title: String,
    /// The text below.
    pub captions: Vec<Caption>,
}

/// Inferences of an observer of an event until a frame.
#[derive(Clone, Debug)]
pub struct ObserverFrame<'a> {
    /// The text above.
    pub title: String,
    /// The text below.
    pub captions: Vec<Caption>,
    /// The shares of the relations so far.
    pub shares: &'a [[f32; SHARES]],
    /// Number of shares at the end of the event.
    pub times: usize,
}

/// A state to draw and the agents' views to draw over it, each in a separate picture beside the others', or
/// what an observer makes of it; without any only the state. Several frames may share a view.
#[derive(Clone, Debug)]
pub struct RenderedState<'a> {
    /// The true state.
    pub state: State,
    /// The views, the same number for every frame of an event.
    pub minds: Vec<&'a BeliefFrame>,
    /// The observer, of all frames of an event or of none.
    pub observer: Option<&'a ObserverFrame<'a>>,
}

/// Items at a frame rate: where that is not the substeps', bodies are moved in straight lines from one
/// substep to the next, and everything else is that of the earlier one.
fn at_rate<'a>(
    items: impl Iterator<Item = RenderedState<'a>>,
    frame_rate: u32,
) -> impl Iterator<Item = RenderedState<'a>> {
    let [rate, substeps] = [frame_rate, FRAMES_PER_SECOND].map(u64::from);
    let mut items = items.peekable();
    let mut current = items.next();
    let mut at = 0; // number of the current item
    let mut number = 0; // of the next frame
    core::iter::from_fn(move || {
        while number * substeps / rate > at {
            current = items.next();
            at += 1;
        }
        let mut item = current.clone()?;
        let share = (number * substeps % rate) as f32 / rate as f32;
        if share > 0.0 {
            // Frames between the last substep and what would follow do not exist.
            item.state = between(&item.state, &items.peek()?.state, share);
        }
        number += 1;
        Some(item)
    })
}

/// A state between two others, `share` of the way from the first.
fn between(from: &State, to: &State, share: f32) -> State {
    let mut state = *from;
    for (body, other) in state.bodies.iter_mut().zip(&to.bodies) {
        body.position += share * (other.position - body.position);
        body.angle += share * (other.angle - body.angle);
    }
    state
}

/// Writes a video. States are drawn as they come, so that they need not be in memory at once; all have the
/// same views. Returns `false`, and leaves no file, if `interrupted`, which is called before each frame,
/// returns `true`.
///
/// # Errors
/// [`RunError::Write`] or [`RunError::Render`]; then there is no file.
pub fn write_video<'a>(
    path: &Path,
    id: &str,
    physics: &PhysicsConfig,
    look: &Look,
    items: impl IntoIterator<Item = RenderedState<'a>>,
    interrupted: &dyn Fn() -> bool,
) -> Result<bool, RunError> {
    match video(id, physics, look, items, interrupted)? {
        Some(mp4) => Ok(atomic::write(path, &mp4).map(|()| true)?),
        None => Ok(false),
    }
}

/// Draws a video in memory; `None` if it was interrupted.
///
/// # Errors
/// [`RunError::Render`].
pub fn video<'a>(
    id: &str,
    physics: &PhysicsConfig,
    look: &Look,
    items: impl IntoIterator<Item = RenderedState<'a>>,
    interrupted: &dyn Fn() -> bool,
) -> Result<Option<Vec<u8>>, RunError> {
    let mp4 = || -> Result<Option<Vec<u8>>, RenderError> {
        let mut items = at_rate(items.into_iter(), look.frame_rate);
        let first = items.next().ok_or(RenderError::NoFrames("video"))?;
        let style = style(Style::with_side(look.size), look.palette, core::slice::from_ref(&first));
        let renderer = SceneRenderer::new(physics, style)?;
        let first = frame(&renderer, &first)?;
        let mut video = VideoEncoder::new(Vec::new(), first.width(), first.height(), look.frame_rate)?;
        video.push(&first)?;
        for item in items {
            if interrupted() {
                return Ok(None);
            }
            video.push(&frame(&renderer, &item)?)?;
        }
        video.finish().map(Some)
    };
    mp4().map_err(|source| RunError::Render { id: id.into(), source })
}

/// Draws in memory a video of several events beside each other, smaller, until the longest ends.
///
/// # Errors
/// [`RunError::Render`].
pub fn beside(id: &str, events: &[&Event], look: &Look) -> Result<Vec<u8>, RunError> {
    let mp4 = || -> Result<Vec<u8>, RenderError> {
        // Two thirds of the size, to the next even number.
        let style =
            Style { palette: look.palette, ..Style::with_side((look.size * 2 / 3).next_multiple_of(2)) };
        let renderers = events.iter().map(|event| SceneRenderer::new(&event.scene.physics(), style));
        let renderers = renderers.collect::<Result<Vec<_>, _>>()?;
        let states = |event: &&Event| -> Vec<State> {
            let items =
                event.frames().map(|&state| RenderedState { state, minds: Vec::new(), observer: None });
            at_rate(items, look.frame_rate).map(|item| item.state).collect()
        };
        let states: Vec<Vec<State>> = events.iter().map(states).collect();
        let count = states.iter().map(Vec::len).max().unwrap_or(0);
        let mut video = None;
        for k in 0..count {
            let beside = renderers.iter().zip(&states).filter_map(|(renderer, states)| {
                states.get(k).or(states.last()).map(|state| renderer.frame(state, None))
            });
            let frame = side_by_side(&beside.collect::<Vec<_>>())?;
            let encoder = match &mut video {
                Some(encoder) => encoder,
                None => video.insert(VideoEncoder::new(
                    Vec::new(),
                    frame.width(),
                    frame.height(),
                    look.frame_rate,
                )?),
            };
            encoder.push(&frame)?;
        }
        video.ok_or(RenderError::NoFrames("video"))?.finish()
    };
    mp4().map_err(|source| RunError::Render { id: id.into(), source })
}

/// Writes one picture of `count` frames evenly spaced from the first to the last.
///
/// # Errors
/// [`RunError::Write`] or [`RunError::Render`]; then there is no file.
pub fn write_sheet(
    path: &Path,
    id: &str,
    physics: &PhysicsConfig,
    palette: Palette,
    items: &[RenderedState<'_>],
    count: usize,
) -> Result<(), RunError> {
    let png = || -> Result<Vec<u8>, RenderError> {
        let renderer = SceneRenderer::new(physics, style(Style::with_side(SHEET_SIDE), palette, items))?;
        let count = count.min(items.len());
        let last = items.len().saturating_sub(1);
        let chosen = (0..count).map(|k| if count > 1 { k * last / (count - 1) } else { last });
        let frames =
            chosen.map(|k| frame(&renderer, &items[k])).collect::<Result<Vec<Frame>, RenderError>>()?;
        let columns = columns(count);
        contact_sheet(&frames, columns)?.png()
    };
    let png = png().map_err(|source| RunError::Render { id: id.into(), source })?;
    Ok(atomic::write(path, &png)?)
}

/// Number of columns for a shape between square and landscape that leaves the fewest places empty.
fn columns(count: usize) -> usize {
    let widest = (1..=count).find(|columns| columns * columns >= 2 * count).unwrap_or(count).max(1);
    let squarest = (1..=widest).find(|columns| columns * columns >= count).unwrap_or(widest);
    (squarest..=widest).min_by_key(|columns| count.next_multiple_of(*columns)).unwrap_or(widest)
}

/// Title and captions are only for views of agents and an observer, the legend for the former, the course for
/// the latter.
fn style(style: Style, palette: Palette, items: &[RenderedState<'_>]) -> Style {
    let explained = items.iter().any(|item| !item.minds.is_empty());
    let observer = items.iter().find_map(|item| item.observer);
    let observed = observer.map_or(0, |observer| observer.captions.len() as u32);
    let caption_lines = if explained { CAPTION_LINES } else { observed };
    let course_lines = if observer.is_some() { COURSE_LINES } else { 0 };
    let title = explained || observer.is_some();
    Style { palette, title, legend: explained, caption_lines, course_lines, ..style }
}

fn frame(renderer: &SceneRenderer, item: &RenderedState<'_>) -> Result<Frame, RenderError> {
    let view = |mind: &&BeliefFrame| {
        let overlay = Overlay {
            agent: mind.agent,
            visible: &mind.visible,
            particles: &mind.particles,
            title: &mind.title,
            captions: &mind.captions,
        };
        renderer.frame(&item.state, Some(&overlay))
    };
    if let Some(ObserverFrame { title, captions, shares, times }) = item.observer {
        let course = Some(Course { shares, times: *times });
        return Ok(renderer.annotated(&item.state, &Annotation { title, captions, course }));
    }
    let mut views: Vec<Frame> = item.minds.iter().map(view).collect();
    match views.len() {
        0 => Ok(renderer.frame(&item.state, None)),
        1 => Ok(views.remove(0)),
        _ => side_by_side(&views),
    }
}
