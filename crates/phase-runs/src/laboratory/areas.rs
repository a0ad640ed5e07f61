//! Areas of interest in the frames of videos, as a table.

use super::{tables::Table, window};
use crate::{error::RunError, interrupt, listener::Listener, source::EventInput, words};
use phase_laboratory::{clip::Cut, interest};
use phase_model::{Vec2, arena::FRAMES_PER_SECOND, words::Names};
use phase_render::{SceneRenderer, Style};
use std::path::PathBuf;

/// A run that writes the areas of interest of all frames.
#[derive(Clone, Debug)]
pub struct AreaRun {
    /// The events.
    pub events: PathBuf,
    /// Only these, if there are any.
    pub ids: Vec<String>,
    /// The clips whose frames are meant, if not those of whole events.
    pub cut: Option<Cut>,
    /// Side of the pictures (pixels).
    pub side: u32,
    /// The table to write, CSV.
    pub out: PathBuf,
}

/// Every name of a column, its unit, and its meaning.
const COLUMNS: [(&str, &str, &str); 9] = [
    ("id", "", "id of the event"),
    ("frame", "", "number of the frame, from 0; empty for landmarks, which do not move"),
    ("time", "s", "when the frame begins to be shown"),
    ("area", "", "the body or landmark"),
    ("left", "px", "left edge of its box, from the left edge of the picture"),
    ("top", "px", "upper edge, from the top of the picture"),
    ("right", "px", "right edge"),
    ("bottom", "px", "lower edge"),
    ("outline", "px", "corners of its outline: x y of each"),
];

impl AreaRun {
    /// Writes the table, and returns the number of its rows.
    ///
    /// # Errors
    /// If the events cannot be used, the file cannot be written, or a stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<usize, RunError> {
        let source = EventInput::open(&self.events, &self.ids, listener)?;
        let mut table = Table::default();
        for (name, unit, meaning) in COLUMNS {
            table.column(name, unit, meaning);
        }
        let names = Names::PAPER;
        let progress =
            listener.progress(&format!("measuring {}", words::events(source.len())), source.len(), 1);
        for index in 0..source.len() {
            if interrupt::requested() {
                return Err(RunError::Stopped(None));
            }
            let recording = source.load(index)?;
            let physics = recording.scene.physics();
            let renderer = SceneRenderer::new(&physics, Style::with_side(self.side))
                .map_err(|source| RunError::Render { id: recording.id.clone(), source })?;
            let window = window(self.cut, &recording.id, recording.trajectory.steps())?;
            for (landmark, area) in interest::landmarks(&renderer) {
                table.rows.push(row(&recording.id, None, names.landmark(landmark), &area));
            }
            // The last state of a whole event is a frame, too; a clip ends before it.
            let states: Vec<_> = match self.cut {
                Some(_) => window.frames(&recording).collect(),
                None => recording.frames().collect(),
            };
            for (k, state) in states.iter().enumerate() {
                for (entity, area) in interest::bodies(&physics, state, &renderer) {
                    table.rows.push(row(&recording.id, Some(k), names.entity(entity), &area));
                }
            }
            progress.event(0, &recording.id);
        }
        drop(progress);
        table.write_csv(&self.out)?;
        Ok(table.rows.len())
    }
}

fn row(id: &str, frame: Option<usize>, area: String, place: &interest::Area) -> Vec<String> {
    let pixels = |value: f32| format!("{value:.2}");
    let corner = |corner: &Vec2| format!("{} {}", pixels(corner.x), pixels(corner.y));
    vec![
        id.to_owned(),
        frame.map_or_else(String::new, |frame| frame.to_string()),
        frame.map_or_else(String::new, |frame| format!("{:.2}", frame as f64 / f64::from(FRAMES_PER_SECOND))),
        area,
        pixels(place.min.x),
        pixels(place.min.y),
        pixels(place.max.x),
        pixels(place.max.y),
        place.outline.iter().map(corner).collect::<Vec<_>>().join(" "),
    ]
}
