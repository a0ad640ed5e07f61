//! Pictures and videos.

use crate::{
    error::raise,
    event::Event,
    worlds::{Worlds, lent},
};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use phase_files::atomic;
use phase_model::{PhysicsConfig, State, arena::FRAMES_PER_SECOND};
use phase_render::{Frame, SceneRenderer, Style, VideoEncoder};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

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
