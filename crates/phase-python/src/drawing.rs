//! Pictures and videos.

use crate::{
    arrays::{Target, writing},
    error::raise,
    event::Event,
    observed::Observed,
    scene::agent_of,
    worlds::{Worlds, lent},
};
use numpy::{PyArray1, PyArray3, PyArray4, PyArray5, PyArrayMethods};
use phase_files::atomic;
use phase_model::{
    AGENT_COUNT, AgentId, Body, MAX_ENTITIES, PhysicsConfig, State, Vec2, arena::FRAMES_PER_SECOND,
};
use phase_perception::observe;
use phase_render::{Frame, Overlay, PaletteName, RenderError, SceneRenderer, Style, VideoEncoder};
use phase_sim::{Episode, View};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Red, green and blue.
const COLOURS: usize = 3;

/// Draws worlds and events, seen from above.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Renderer {
    style: Style,
    palette: PaletteName,
}

/// The greatest size of several pictures in memory.
const MOST_BYTES: u64 = 1 << 32;

#[pymethods]
impl Renderer {
    /// Pictures of `side` × `side` pixels, 64 to 2000, in the colours of a palette. `PhaseError` for another
    /// side, and for an unknown palette.
    #[new]
    #[pyo3(signature = (side, palette="paper"))]
    fn new(side: u32, palette: &str) -> PyResult<Self> {
        let found = PaletteName::ALL.into_iter().find(|known| known.name() == palette);
        let palette = found.ok_or_else(|| {
            let known = PaletteName::ALL.map(PaletteName::name).join(" or ");
            raise(format!("palette is {known}, not {palette:?}"))
        })?;
        let style = Style { palette: palette.palette(), ..Style::with_side(side) };
        style.validate().map_err(raise)?;
        Ok(Self { style, palette })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (u32, &'static str)) {
        (slf.get_type().into_any(), (slf.get().style.side, slf.get().palette.name()))
    }

    /// A world as it is now: (side, side, 3), red, green, blue, 0 to 255. `PhaseError` if there is no such
    /// world.
    fn world<'py>(
        &self,
        py: Python<'py>,
        worlds: &Bound<'py, Worlds>,
        world: i64,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let worlds = lent(worlds)?;
        let (physics, state) = worlds.view(world)?;
        let renderer = SceneRenderer::new(physics, self.style).map_err(raise)?;
        let shape = [renderer.height() as usize, renderer.width() as usize, 3];
        PyArray1::from_vec(py, colours(&renderer.frame(state, None)).collect()).reshape(shape)
    }

    /// Writes pictures of what agents observe, (N, agents, side, side, 3). Cells out of sight are dimmed, and
    /// bodies that are not observed are left out, unless `omniscient`. `agents` has the numbers of those
    /// whose pictures are wanted, `chosen` those of the worlds, or all. `PhaseError` for an array of another
    /// shape, and for an agent or a world that there is not.
    #[pyo3(signature = (worlds, agents, omniscient, pictures, chosen=None))]
    fn observe(
        &self,
        py: Python<'_>,
        worlds: &Bound<'_, Worlds>,
        agents: Vec<usize>,
        omniscient: bool,
        pictures: &Bound<'_, PyArray5<u8>>,
        chosen: Option<Vec<i64>>,
    ) -> PyResult<()> {
        let worlds = lent(worlds)?;
        let pool = worlds.pool(py)?;
        let agents: Vec<AgentId> = agents.into_iter().map(agent_of).collect::<PyResult<_>>()?;
        let episodes = worlds.episodes();
        let mut wanted = vec![chosen.is_none(); episodes.len()];
        for world in chosen.into_iter().flatten() {
            wanted[worlds.index(world)?] = true;
        }
        let side = self.style.side as usize;
        let shape = [episodes.len(), agents.len(), side, side, COLOURS];
        let mut pictures = writing("pictures", pictures, &shape)?;
        let mut pictures = Target::new(pictures.as_array_mut());
        let size = (agents.len() * side * side * COLOURS).max(1);
        let view = if omniscient { View::Everything } else { View::Own };
        let tasks = pictures.numbers().chunks_exact_mut(size).zip(episodes).zip(wanted);
        let tasks: Vec<(&mut [u8], &Episode)> =
            tasks.filter(|(_, wanted)| *wanted).map(|(task, _)| task).collect();
        let one = |(out, episode): (&mut [u8], &Episode)| self.see(episode, &agents, view, out);
        py.detach(|| match pool {
            None => tasks.into_iter().try_for_each(one),
            Some(pool) => pool.install(|| tasks.into_par_iter().try_for_each(one)),
        })
        .map_err(raise)
    }

    /// Rows of an event: (rows, side, side, 3), red, green, blue, 0 to 255. `PhaseError` for a row that there
    /// is not, and for pictures of more than 4 GiB.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        observed: PyRef<'py, Observed>,
        rows: Vec<usize>,
    ) -> PyResult<Bound<'py, PyArray4<u8>>> {
        let steps = observed.event.steps();
        let state = |row| {
            let state = observed.event.state(row);
            state.ok_or_else(|| raise(format!("the event has the rows 0 to {steps}, and no row {row}")))
        };
        let states = rows.into_iter().map(state).collect::<PyResult<Vec<_>>>()?;
        self.film(py, &physics_of(&observed), &states)
    }

    /// Frames of the video of an event, as [`video`](Self::video) has them: (frames, side, side, 3).
    /// `PhaseError` for pictures of more than 4 GiB.
    fn clip<'py>(
        &self,
        py: Python<'py>,
        shown: Shown<'py>,
        first: usize,
        count: usize,
    ) -> PyResult<Bound<'py, PyArray4<u8>>> {
        let (physics, states) = shown.film();
        let states: Vec<_> = states.into_iter().skip(first).take(count).collect();
        self.film(py, &physics, &states)
    }

    /// Writes an event as an .mp4 (H.264) with 20 frames a second: five a step; where there are no
    /// substeps, bodies go straight from row to row. `PhaseError` for an odd side, and if the file
    /// cannot be written; an older one of that name is unchanged then.
    fn video(&self, py: Python<'_>, shown: Shown<'_>, path: PathBuf) -> PyResult<()> {
        let (physics, states) = shown.film();
        py.detach(|| self.write(&physics, states, &path)).map_err(raise)
    }
}

/// Something to draw: an event, or the part of one that a viewer sees.
#[derive(FromPyObject)]
pub(crate) enum Shown<'py> {
    Event(PyRef<'py, Event>),
    Observed(PyRef<'py, Observed>),
}

impl Shown<'_> {
    /// The physics, and the state at each frame of a video.
    fn film(&self) -> (PhysicsConfig, Vec<State>) {
        match self {
            Self::Event(event) => (event.recording.scene.physics(), event.recording.frames().collect()),
            Self::Observed(observed) => (physics_of(observed), observed.event.frames()),
        }
    }
}

/// The physics of an event as far as a picture shows it: no force is drawn.
fn physics_of(observed: &Observed) -> PhysicsConfig {
    observed.event.physics([0.0; AGENT_COUNT])
}

/// The colours of a frame, pixel by pixel: red, green, blue.
fn colours(frame: &Frame) -> impl Iterator<Item = u8> {
    frame.rgba().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
}

impl Renderer {
    /// Draws an episode as agents see it, one picture after the other.
    fn see(
        &self,
        episode: &Episode,
        agents: &[AgentId],
        view: View,
        out: &mut [u8],
    ) -> Result<(), RenderError> {
        let renderer = SceneRenderer::new(episode.physics(), self.style)?;
        let whole = (view == View::Everything).then(|| renderer.frame(episode.state(), None));
        let size = out.len() / agents.len().max(1);
        for (&agent, out) in agents.iter().zip(out.chunks_exact_mut(size.max(1))) {
            let seen = || {
                let observation = observe(episode.physics(), episode.state(), agent);
                let overlay = Overlay {
                    agent,
                    visible: &observation.visible,
                    particles: &[],
                    title: "",
                    captions: &[],
                };
                // The renderer leaves out bodies that are nowhere.
                let nowhere = Body { position: Vec2::NAN, ..Body::default() };
                let mut known = State::new([nowhere; MAX_ENTITIES]);
                for entity in observation.observed.iter() {
                    *known.body_mut(entity) = *episode.state().body(entity);
                }
                known.grips = AgentId::ALL.map(|agent| observation.grip(agent).flatten());
                renderer.frame(&known, Some(&overlay))
            };
            let frame = whole.clone().unwrap_or_else(seen);
            out.iter_mut().zip(colours(&frame)).for_each(|(to, from)| *to = from);
        }
        Ok(())
    }

    fn film<'py>(
        &self,
        py: Python<'py>,
        physics: &PhysicsConfig,
        states: &[State],
    ) -> PyResult<Bound<'py, PyArray4<u8>>> {
        let renderer = SceneRenderer::new(physics, self.style).map_err(raise)?;
        let shape = [states.len(), renderer.height() as usize, renderer.width() as usize, 3];
        let bytes = shape.iter().try_fold(1_usize, |bytes, &length| bytes.checked_mul(length));
        let bytes = bytes.filter(|&bytes| bytes as u64 <= MOST_BYTES).ok_or_else(|| {
            raise(format!("{} pictures of this side are more than 4 GiB; ask for fewer", states.len()))
        })?;
        let pixels = py.detach(|| {
            let mut pixels = Vec::with_capacity(bytes);
            states.iter().for_each(|state| pixels.extend(colours(&renderer.frame(state, None))));
            pixels
        });
        PyArray1::from_vec(py, pixels).reshape(shape)
    }

    fn write(&self, physics: &PhysicsConfig, states: Vec<State>, path: &Path) -> Result<(), String> {
        let renderer = SceneRenderer::new(physics, self.style).map_err(|error| error.to_string())?;
        let video = VideoEncoder::new(Vec::new(), renderer.width(), renderer.height(), FRAMES_PER_SECOND);
        let mut video = video.map_err(|error| error.to_string())?;
        for state in states {
            video.push(&renderer.frame(&state, None)).map_err(|error| error.to_string())?;
        }
        let bytes = video.finish().map_err(|error| error.to_string())?;
        atomic::write(path, &bytes).map_err(|error| error.to_string())
    }
}
