//! Events as a viewer sees them.

use crate::{arrays::reading, error::raise, event::Event, scene::Scene};
use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray4, PyUntypedArrayMethods};
use phase_event::{COLUMNS, Missing, Noise, ObservedEvent, check_id, parse_observed};
use phase_files::{FileError, Problem, json};
use phase_model::{
    AGENT_COUNT, Body, Flip, Layout, LayoutError, MAX_ENTITIES, MAX_OBJECTS, Size, Vec2, arena,
};
use phase_runs::track::TrackRun;
use phase_track::{Picture, Roles, TableOptions, Tracker};
use pyo3::{PyTypeInfo, prelude::*};
use std::{path::PathBuf, sync::Arc};

/// Walls, sizes and motion of an event, without labels. Users see it as `phase_events.ObservedEvent`.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Observed {
    pub(crate) id: String,
    pub(crate) event: Arc<ObservedEvent>,
}

/// Columns of a row: x, y (u), vx, vy (u/s), angle (rad).
pub(crate) const ROW_COLUMNS: usize = COLUMNS.len();

/// Base and reflection of a layout.
type LayoutNumbers = (u64, Option<u64>);
/// Standard deviations of position (u), velocity (u/s) and angle (rad).
type NoiseNumbers = (f32, f32, f32);
/// Whether forms, walls and landmarks were missing, and the number of bodies that were left out.
type MissingParts = (bool, bool, bool, u32);

#[pymethods]
impl Observed {
    /// An event of a layout, of agents and objects of these size levels, and of these rows, (steps + 1,
    /// entities, 5), columns x, y (u), vx, vy (u/s), angle (rad). `PhaseError` names the part and the rule.
    /// `noise` has the standard deviations of position (u), velocity (u/s) and angle (rad), if there are any,
    /// and `missing` what was not to be seen: forms, walls, landmarks, and a number of bodies.
    #[new]
    #[pyo3(signature = (id, layout, agent_sizes, object_sizes, rows, noise = None, missing = None))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        id: String,
        layout: LayoutNumbers,
        agent_sizes: [u8; AGENT_COUNT],
        object_sizes: Vec<u8>,
        rows: &Bound<'_, PyArray3<f32>>,
        noise: Option<NoiseNumbers>,
        missing: Option<MissingParts>,
    ) -> PyResult<Self> {
        check_id(&id).map_err(|rule| raise(format!("id {rule}, not {id:?}")))?;
        let (base, flip) = layout;
        let flip =
            flip.map(|flip| usize::try_from(flip).ok().and_then(|flip| Flip::ALL.get(flip)).ok_or(flip));
        let flip = flip.transpose().map_err(|flip| raise(LayoutError::Flip(flip)))?.copied();
        let base = u8::try_from(base).map_err(|_| raise(LayoutError::Base(base)))?;
        let layout = Layout::new(base, flip).map_err(raise)?;
        let size = |level: u8| {
            Size::from_level(level).ok_or_else(|| raise(format!("a size level is 0 to 3, not {level}")))
        };
        let [first, second] = agent_sizes;
        let objects = object_sizes.into_iter().map(size).collect::<PyResult<Vec<_>>>()?;
        if objects.len() > MAX_OBJECTS {
            return Err(raise(format!("there are at most {MAX_OBJECTS} objects, not {}", objects.len())));
        }
        let rows = read_rows(rows, AGENT_COUNT + objects.len())?;
        let event = ObservedEvent::new(layout, [size(first)?, size(second)?], objects, rows);
        let noise = noise.map(|(position, velocity, angle)| Noise { position, velocity, angle });
        let event = event.map_err(raise)?.with_noise(noise);
        let missing =
            missing.map(|(forms, walls, landmarks, bodies)| Missing { forms, walls, landmarks, bodies });
        Ok(Self { id, event: Arc::new(event.with_missing(missing.unwrap_or_default())) })
    }

    /// The part of an event that a viewer sees.
    #[staticmethod]
    fn of_event(event: PyRef<'_, Event>) -> PyResult<Self> {
        let recording = &event.recording;
        Ok(Self { id: recording.id.clone(), event: Arc::new(recording.observed().map_err(raise)?) })
    }

    /// Rows that were seen in a scene, of which only layout and sizes are looked at.
    #[staticmethod]
    fn in_scene(scene: PyRef<'_, Scene>, rows: &Bound<'_, PyArray3<f32>>) -> PyResult<Self> {
        let rows = read_rows(rows, scene.scene.physics().entities().count())?;
        let event = ObservedEvent::in_scene(&scene.scene, rows).map_err(raise)?;
        Ok(Self { id: "scene".into(), event: Arc::new(event) })
    }

    /// The events of a file of the form phase-events/1, whose labels may be absent. `PhaseError` names the
    /// file, the event, the field and the rule.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Vec<Self>> {
        let read = py.detach(|| {
            let bytes = json::bytes(&path)?;
            parse_observed(&bytes).map_err(|error| FileError { file: path, problem: Problem::content(error) })
        });
        let read = read.map_err(raise)?;
        Ok(read.into_iter().map(|(id, event)| Self { id, event: Arc::new(event) }).collect())
    }

    /// The event that a video, a folder of pictures at this rate, or a table shows; `map` names the bodies.
    #[staticmethod]
    fn track(py: Python<'_>, path: PathBuf, frame_rate: f64, map: Option<&str>) -> PyResult<Self> {
        let roles = map.map(Roles::read).transpose().map_err(|rule| raise(format!("map: {rule}")))?;
        let run = TrackRun {
            input: path,
            id: None,
            frame_rate,
            meaning: None,
            roles,
            table: TableOptions::default(),
        };
        let tracked = py.detach(|| run.read()).map_err(raise)?;
        Ok(Self { id: tracked.id, event: Arc::new(tracked.observed) })
    }

    /// The event that frames show, (frames, height, width, 3), so many a second.
    #[staticmethod]
    fn track_frames(id: String, frames: PyReadonlyArray4<'_, u8>, frame_rate: f64) -> PyResult<Self> {
        let &[_, height, width, _] = frames.shape() else {
            return Err(raise("frames must have 4 dimensions"));
        };
        let mut tracker = Tracker::new();
        for (k, frame) in frames.as_array().outer_iter().enumerate() {
            let bytes: Vec<u8> = frame.iter().copied().collect();
            let picture = Picture::new(width, height, &bytes).map_err(raise)?;
            tracker.push(&picture, k as f64 / frame_rate).map_err(raise)?;
        }
        let track = tracker.finish().map_err(raise)?;
        let (event, _) = track.event(track.meaning(), None).map_err(raise)?;
        Ok(Self { id, event: Arc::new(event) })
    }

    /// Standard deviations of position (u), velocity (u/s) and angle (rad), if the event was tracked.
    #[getter]
    fn noise(&self) -> Option<NoiseNumbers> {
        self.event.noise().map(|noise| (noise.position, noise.velocity, noise.angle))
    }

    /// Likely mistakes in the motion, each as a sentence.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.event.warnings().iter().map(ToString::to_string).collect()
    }

    /// All that cannot be judged of the event, each as a sentence.
    #[getter]
    fn not_judged(&self) -> Vec<String> {
        self.event.missing().sentences()
    }

    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(
        Bound<'py, PyAny>,
        (
            String,
            LayoutNumbers,
            [u8; AGENT_COUNT],
            Vec<u8>,
            Bound<'py, PyArray3<f32>>,
            Option<NoiseNumbers>,
            MissingParts,
        ),
    )> {
        let agents = self.event.agent_sizes().map(Size::level);
        let objects = self.event.object_sizes().iter().map(|size| size.level()).collect();
        let Missing { forms, walls, landmarks, bodies } = self.event.missing();
        let missing = (forms, walls, landmarks, bodies);
        let rows = self.trajectory(py)?;
        let arguments = (self.id.clone(), self.layout(), agents, objects, rows, self.noise(), missing);
        Ok((Self::type_object(py).into_any(), arguments))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    /// The name of the event.
    #[getter]
    fn id(&self) -> &str {
        &self.id
    }

    /// The number of steps of 0.25 s.
    #[getter]
    fn steps(&self) -> usize {
        self.event.steps()
    }

    /// Base (0 to 21) and reflection (0 to 3, or `None`) of the layout.
    #[getter]
    fn layout(&self) -> LayoutNumbers {
        let layout = self.event.layout();
        (layout.base().into(), layout.flip().map(|flip| u8::from(flip).into()))
    }

    /// The size level of every entity, agents first.
    #[getter]
    fn size_levels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let levels = self.sizes().map(|size| size.level().into());
        PyArray1::from_iter(py, levels.collect::<Vec<_>>())
    }

    /// The radius of every entity (u), agents first.
    #[getter]
    fn radii<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        PyArray1::from_iter(py, self.sizes().map(Size::radius).collect::<Vec<_>>())
    }

    /// The inner walls, (walls, 2, 2): both ends of each, x and y (u).
    #[getter]
    fn walls<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let walls = self.event.layout().walls();
        let ends = |point: Vec2| point.to_array().to_vec();
        let rows: Vec<_> = walls.iter().map(|wall| vec![ends(wall.a), ends(wall.b)]).collect();
        if rows.is_empty() {
            return Ok(PyArray3::zeros(py, [0, 2, 2], false));
        }
        PyArray3::from_vec3(py, &rows).map_err(raise)
    }

    /// The rows, (steps + 1, entities, 5), columns x, y (u), vx, vy (u/s), angle (rad).
    fn trajectory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let entities = self.event.entities().count();
        let row = |bodies: &[Body; MAX_ENTITIES]| {
            let bodies = bodies[..entities].iter();
            bodies
                .map(|body| {
                    let Body { position, velocity, angle, .. } = *body;
                    vec![position.x, position.y, velocity.x, velocity.y, angle]
                })
                .collect()
        };
        let rows: Vec<Vec<Vec<f32>>> = self.event.rows().iter().map(row).collect();
        PyArray3::from_vec3(py, &rows).map_err(raise)
    }

    /// The first steps of the event; the whole event if it has no more.
    fn prefix(&self, steps: usize) -> Self {
        Self { id: self.id.clone(), event: Arc::new(self.event.prefix(steps)) }
    }
}

impl Observed {
    /// The sizes of all entities, agents first.
    fn sizes(&self) -> impl Iterator<Item = Size> {
        self.event.agent_sizes().into_iter().chain(self.event.object_sizes().iter().copied())
    }
}

/// The centres of the four landmarks, (4, 2): x and y (u).
pub(crate) fn landmarks(py: Python<'_>) -> PyResult<Bound<'_, PyArray2<f32>>> {
    let centres = arena::LANDMARKS.map(|centre| centre.to_array().to_vec());
    PyArray2::from_vec2(py, &centres).map_err(raise)
}

/// Rows, (any, entities, 5).
///
/// # Errors
/// `PhaseError` for another shape, and for places outside the arena.
fn read_rows(rows: &Bound<'_, PyArray3<f32>>, entities: usize) -> PyResult<Vec<[Body; MAX_ENTITIES]>> {
    let count = rows.shape().first().copied().unwrap_or_default();
    let rows = reading("trajectory", rows, &[count, entities, ROW_COLUMNS])?;
    let mut read = Vec::with_capacity(count);
    for (t, row) in rows.as_array().outer_iter().enumerate() {
        let numbers: Vec<_> =
            row.outer_iter().map(|body| core::array::from_fn(|column| body[column])).collect();
        let bodies = bodies(&numbers);
        check_inside(&bodies[..entities], |k| format!("trajectory[{t}, {k}]"))?;
        read.push(bodies);
    }
    Ok(read)
}

/// Checks that bodies, of which `name` names each by its index, are in the arena. Numbers that are not finite
/// are left to others.
pub(crate) fn check_inside(bodies: &[Body], name: impl Fn(usize) -> String) -> PyResult<()> {
    let outside = |body: &Body| body.is_finite() && !arena::contains(body.position);
    let Some(k) = bodies.iter().position(outside) else { return Ok(()) };
    let Vec2 { x, y } = bodies[k].position;
    let name = name(k);
    Err(raise(format!("{name} must lie inside the arena (x 6 to 26, y 2 to 22), not at ({x}, {y})")))
}

/// The bodies of a row.
pub(crate) fn bodies(row: &[[f32; ROW_COLUMNS]]) -> [Body; MAX_ENTITIES] {
    let mut bodies = [Body::default(); MAX_ENTITIES];
    for (body, &[x, y, vx, vy, angle]) in bodies.iter_mut().zip(row) {
        *body = Body { position: Vec2::new(x, y), velocity: Vec2::new(vx, vy), angle, angular_velocity: 0.0 };
    }
    bodies
}
