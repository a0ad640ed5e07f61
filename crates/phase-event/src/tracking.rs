//! The errors with which the motion of an event was measured.

use crate::{COLUMNS, Row};
use phase_model::json::{Field, FieldError};
use serde::Serialize;

/// Standard deviations of the errors of rows, as root mean squares over an event.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Noise {
    /// Of x and y (u).
    pub position: f32,
    /// Of vx and vy (u/s).
    pub velocity: f32,
    /// Of agents' angles (rad). Angles of objects are not measured.
    pub angle: f32,
}

/// Parts of a video or table that were not to be seen, or that an event cannot have.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Missing {
    /// Whether bodies have other forms than discs and trapezoids, so that headings and outlines are guesses.
    pub forms: bool,
    /// Whether there were no walls that an event can have.
    pub walls: bool,
    /// Whether there were no landmarks.
    pub landmarks: bool,
    /// Bodies that were left out.
    pub bodies: u32,
}

impl Missing {
    /// All that a viewer of the event cannot judge, each as a sentence.
    #[must_use]
    pub fn sentences(self) -> Vec<String> {
        let mut sentences = Vec::new();
        if self.landmarks {
            sentences.push("no landmarks were seen, so goals at landmarks are not judged".into());
        }
        if self.walls {
            sentences.push("no arena was seen: walls are unknown, and the scale is that of the paths".into());
        }
        if self.forms {
            sentences.push("bodies have other forms than in PHASE: sizes and headings are guesses".into());
        }
        match self.bodies {
            0 => {}
            1 => sentences.push("1 more body moves, of which nothing is known here".into()),
            bodies => sentences.push(format!("{bodies} more bodies move, of which nothing is known here")),
        }
        sentences
    }
}

/// Measurement of an event that was read from a video or table: the member `tracking` of its file.
#[derive(Clone, PartialEq, Debug)]
pub struct Tracking {
    /// The errors on the whole.
    pub noise: Noise,
    /// Pictures, or lines of a table.
    pub frames: u32,
    /// Pictures a second.
    pub frame_rate: f64,
    /// Whether rows are what was shown every 0.25 s, because bodies moved straight from row to row; otherwise
    /// they are means over steps.
    pub straight: bool,
    /// Share of all poses that were hidden, 0 to 1.
    pub hidden: f64,
    /// Parts that were not to be seen, or that the event lacks.
    pub missing: Missing,
    /// Standard deviations of the columns of every row, in their units: by body, agents first, as long as the
    /// trajectory.
    pub deviations: Vec<Vec<Row>>,
}

#[derive(Serialize)]
pub(crate) struct TrackingMembers<'a> {
    noise: Noise,
    frames: u32,
    frame_rate: f64,
    straight: bool,
    hidden: f64,
    #[serde(skip_serializing_if = "is_whole")]
    missing: Missing,
    deviations: Deviations<'a>,
}

fn is_whole(missing: &Missing) -> bool {
    *missing == Missing::default()
}

#[derive(Serialize)]
struct Deviations<'a> {
    columns: [&'static str; COLUMNS.len()],
    bodies: &'a [Vec<Row>],
}

impl<'a> TrackingMembers<'a> {
    pub(crate) fn of(tracking: &'a Tracking) -> Self {
        let Tracking { noise, frames, frame_rate, straight, hidden, missing, ref deviations } = *tracking;
        let deviations = Deviations { columns: COLUMNS, bodies: deviations };
        Self { noise, frames, frame_rate, straight, hidden, missing, deviations }
    }
}

/// Reads the member `tracking` of an event, if it has one.
pub(crate) fn tracking(event: &Field<'_>) -> Result<Option<Tracking>, FieldError> {
    let Some(field) = event.optional("tracking")? else { return Ok(None) };
    field.only(&["noise", "frames", "frame_rate", "straight", "hidden", "missing", "deviations"])?;
    let noise = field.required("noise")?;
    noise.only(&["position", "velocity", "angle"])?;
    let deviation = |key| {
        let field = noise.required(key)?;
        let number = field.number()?;
        if (0.0..=100.0).contains(&number) { Ok(number) } else { Err(field.must_be("0 to 100")) }
    };
    let noise = Noise {
        position: deviation("position")?,
        velocity: deviation("velocity")?,
        angle: deviation("angle")?,
    };
    let frame_rate = f64::from(field.required("frame_rate")?.number()?);
    let hidden = f64::from(field.required("hidden")?.number()?);
    let missing = match field.optional("missing")? {
        None => Missing::default(),
        Some(missing) => {
            missing.only(&["forms", "walls", "landmarks", "bodies"])?;
            let flag = |key| {
                let field = missing.required(key)?;
                field.value().as_bool().ok_or_else(|| field.must_be("true or false"))
            };
            Missing {
                forms: flag("forms")?,
                walls: flag("walls")?,
                landmarks: flag("landmarks")?,
                bodies: missing.required("bodies")?.whole(0, 1000)? as u32,
            }
        }
    };
    let straight = field.required("straight")?;
    let straight = straight.value().as_bool().ok_or_else(|| straight.must_be("true or false"))?;
    let frames = field.required("frames")?.whole(0, u32::MAX.into())? as u32;
    let table = field.required("deviations")?;
    table.only(&["columns", "bodies"])?;
    crate::read::columns(&table, &COLUMNS)?;
    let bodies = table.required("bodies")?;
    let rows = |track: Field<'_>| -> Result<Vec<Row>, FieldError> {
        track
            .items()?
            .map(|row| {
                let numbers =
                    row.array()?.iter().map(phase_model::json::finite).collect::<Option<Vec<f32>>>();
                let row_of = numbers.and_then(|numbers| Row::try_from(numbers).ok());
                row_of.ok_or_else(|| row.error("must hold 5 finite numbers"))
            })
            .collect()
    };
    let deviations = bodies.items()?.map(rows).collect::<Result<_, _>>()?;
    Ok(Some(Tracking { noise, frames, frame_rate, straight, hidden, missing, deviations }))
}
