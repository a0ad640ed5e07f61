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
    deviations: Deviations<'a>,
}

#[derive(Serialize)]
struct Deviations<'a> {
    columns: [&'static str; COLUMNS.len()],
    bodies: &'a [Vec<Row>],
}

impl<'a> TrackingMembers<'a> {
    pub(crate) fn of(tracking: &'a Tracking) -> Self {
        let Tracking { noise, frames, frame_rate, straight, hidden, ref deviations } = *tracking;
        let deviations = Deviations { columns: COLUMNS, bodies: deviations };
        Self { noise, frames, frame_rate, straight, hidden, deviations }
    }
}

/// Reads the member `tracking` of an event, if it has one.
pub(crate) fn tracking(event: &Field<'_>) -> Result<Option<Tracking>, FieldError> {
    let Some(field) = event.optional("tracking")? else { return Ok(None) };
    field.only(&["noise", "frames", "frame_rate", "straight", "hidden", "deviations"])?;
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
    Ok(Some(Tracking { noise, frames, frame_rate, straight, hidden, deviations }))
}
