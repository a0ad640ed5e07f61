//! Pictures and videos.

use crate::{
    arrays::{Target, writing},
    error::raise,
    event::Event,
    scene::agent_of,
    worlds::{Worlds, lent},
};
use numpy::{PyArray1, PyArray3, PyArray5, PyArrayMethods};
use phase_files::atomic;
use phase_model::{AgentId, Body, MAX_ENTITIES, PhysicsConfig, State, Vec2, arena::FRAMES_PER_SECOND};
use phase_perception::observe;
use phase_render::{Frame, Overlay, RenderError, SceneRenderer, Style, VideoEncoder};
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
}

#[pymethods]
impl Renderer {
    /// Pictures of `side` × `side` pixels, 64 to 2000. `PhaseError` for another side.
    #[new]
    fn new(side: u32) -> PyResult<Self> {
        let style = Style::with_side(side);
        style.validate().map_err(raise)?;
        Ok(Self { style })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (u32,)) {
        (slf.get_type().into_any(), (slf.get().style.side,))
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
        self.array(py, &self.frame(physics, state)?)
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

    /// An event at a row, 0 to its number of steps: (side, side, 3), red, green, blue, 0 to 255. `PhaseError`
    /// for another row.
    fn event<'py>(
        &self,
        py: Python<'py>,
        event: PyRef<'py, Event>,
        row: usize,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let recording = &event.recording;
        let steps = recording.trajectory.steps();
        let state = recording.trajectory.state(row);
        let state =
            state.ok_or_else(|| raise(format!("the event has the rows 0 to {steps}, and no row {row}")))?;
        self.array(py, &self.frame(&recording.scene.physics(), &state)?)
    }

    /// Writes an event as an .mp4 (H.264) with 20 frames a second: five a step, or for a recording, which has
    /// no substeps, one a step shown five times. `PhaseError` for an odd side, and if the file
    /// cannot be written; an older one of that name is unchanged then.
    fn video(&self, py: Python<'_>, event: PyRef<'_, Event>, path: PathBuf) -> PyResult<()> {
        let recording = event.recording.clone();
        py.detach(|| {
            let physics = recording.scene.physics();
            let states = match &recording.simulation {
                Some(simulation) => {
                    let substeps = simulation.event.steps.iter().flat_map(|step| step.substeps);
                    core::iter::once(simulation.event.initial).chain(substeps).collect()
                }
                None => recording.trajectory.states().into_iter().flat_map(|state| [state; 5]).collect(),
            };
            self.write(&physics, states, &path)
        })
        .map_err(raise)
    }
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
            for (to, from) in out.chunks_exact_mut(COLOURS).zip(frame.rgba().chunks_exact(4)) {
                to.copy_from_slice(&from[..COLOURS]);
            }
        }
        Ok(())
    }

    fn frame(&self, physics: &PhysicsConfig, state: &State) -> PyResult<Frame> {
        Ok(SceneRenderer::new(physics, self.style).map_err(raise)?.frame(state, None))
    }

    fn array<'py>(&self, py: Python<'py>, frame: &Frame) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let pixels: Vec<u8> =
            frame.rgba().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let shape = [frame.height() as usize, frame.width() as usize, 3];
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
