//! The shapes of a video, and the event that they make.

use crate::{
    BodyRows, Roles, TrackError, View,
    event::{event, noise},
    table::{Line, rows, scale},
};
use phase_event::{Missing, Noise, ObservedEvent, Tracking};
use phase_model::{
    Layout, MAX_ENTITIES, Size, Vec2,
    arena::{STEP_SECONDS, STEP_VIDEO_SECONDS},
};
use std::fmt::Write as _;

/// Error of a heading that is that of motion (rad).
const HEADING: f32 = 0.5;

/// A shape that moved.
#[derive(Clone, PartialEq, Debug)]
pub struct Shape {
    /// Its colour.
    pub colour: [u8; 3],
    /// Radius of a disc of its area (pixels).
    pub radius: f32,
    /// The middle of its area in every frame (pixels from the upper left corner).
    pub path: Vec<Vec2>,
    /// Share of the frames in which it was seen; elsewhere its path goes straight.
    pub seen: f64,
    /// Root mean square of the estimated errors of its places (pixels).
    pub error: f32,
}

impl Shape {
    /// The length of its path (pixels), without the trembling of its edges.
    pub(super) fn travelled(&self) -> f32 {
        let mut sum = 0.0;
        let mut from = self.path[0];
        for place in &self.path {
            if place.distance(from) > 0.25 * self.radius {
                sum += place.distance(from);
                from = *place;
            }
        }
        sum
    }
}

/// The shapes of a video, those that moved farthest first.
#[derive(Clone, PartialEq, Debug)]
pub struct ShapeTrack {
    /// Two shapes or more.
    pub shapes: Vec<Shape>,
    /// Time of every frame (s).
    pub seconds: Vec<f64>,
    /// Frames a second.
    pub frame_rate: f64,
    /// The arena, its layout, and whether it has landmarks, if there is one.
    pub(super) stage: Option<(View, Layout, bool)>,
}

impl ShapeTrack {
    /// All places as a table with the columns `time` (s), `body` (a number from 1), `x` and `y` (pixels, y
    /// down).
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = String::from("time,body,x,y\n");
        for (frame, seconds) in self.seconds.iter().enumerate() {
            for (k, shape) in self.shapes.iter().enumerate() {
                let Vec2 { x, y } = shape.path[frame];
                let _ = writeln!(text, "{seconds:.4},{},{x:.2},{y:.2}", k + 1);
            }
        }
        text
    }

    /// An event in which the two shapes that moved farthest are the agents and the next two the objects,
    /// unless roles say otherwise. Agents face where they move. Without an arena, the event has no walls,
    /// paths are fitted into it, and each size is the nearest of the four.
    ///
    /// # Errors
    /// [`TrackError::Map`] if roles name a shape that is not there, [`TrackError::Short`] below one step.
    pub fn event(&self, roles: Option<&Roles>) -> Result<(ObservedEvent, Tracking), TrackError> {
        let all: Vec<[u8; 3]> = self.shapes.iter().map(|shape| shape.colour).collect();
        let order = match roles {
            Some(roles) => roles.order(&all, |_, _| true)?,
            None => (0..self.shapes.len().min(MAX_ENTITIES)).collect(),
        };
        let start = self.seconds.first().copied().unwrap_or_default();
        let steps =
            ((self.seconds.last().copied().unwrap_or(start) - start) / STEP_VIDEO_SECONDS + 1e-6) as usize;
        let lines: Vec<Vec<Line>> = order
            .iter()
            .map(|&k| {
                let line =
                    |(seconds, place): (&f64, &Vec2)| (*seconds, [place.x, place.y].map(f64::from), None);
                self.seconds.iter().zip(&self.shapes[k].path).map(line).collect()
            })
            .collect();
        let (factor, offset) = match &self.stage {
            Some((view, _, _)) => {
                let origin = view.pixel(Vec2::ZERO);
                let factor = 1.0 / f64::from(view.scale);
                (factor, [-f64::from(origin.x) * factor, f64::from(origin.y) * factor])
            }
            None => scale(&lines, None, true)?,
        };
        let mut bodies: Vec<BodyRows> =
            lines.iter().map(|line| rows(line, start, steps, (factor, offset), true)).collect();
        for (body, &k) in bodies.iter_mut().zip(&order) {
            let position = self.shapes[k].error * factor as f32;
            let velocity = position / STEP_SECONDS as f32;
            body.deviations.fill([position, position, velocity, velocity, HEADING]);
        }
        let size = |&k: &usize| {
            let radius = self.shapes[k].radius * factor as f32;
            let off = |size: &Size| (size.radius() - radius).abs();
            Size::ALL.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(Size::Medium)
        };
        let sizes: Vec<Size> = order.iter().map(size).collect();
        let Noise { position, velocity, .. } = noise(&bodies);
        let seen: f64 = order.iter().map(|&k| self.shapes[k].seen).sum();
        let tracking = Tracking {
            noise: Noise { position, velocity, angle: HEADING },
            frames: self.seconds.len() as u32,
            frame_rate: self.frame_rate,
            straight: true,
            hidden: 1.0 - seen / order.len() as f64,
            missing: Missing {
                forms: true,
                walls: self.stage.is_none(),
                landmarks: self.stage.is_none_or(|(_, _, landmarks)| !landmarks),
                bodies: (self.shapes.len() - order.len()) as u32,
            },
            deviations: bodies.iter().map(|body| body.deviations.clone()).collect(),
        };
        let layout = match &self.stage {
            Some((_, layout, _)) => *layout,
            None => Layout::new(0, None).map_err(|_| TrackError::Walls)?,
        };
        Ok((event(layout, &sizes, &bodies)?.with_tracking(&tracking), tracking))
    }
}
