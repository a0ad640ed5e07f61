//! From a track to an event without labels.

use crate::{BodyRows, Form, FrameMeaning, Track, TrackError};
use phase_event::{Noise, ObservedEvent, Row, Tracking};
use phase_model::{AGENT_COUNT, Body, MAX_ENTITIES, Size, Vec2, arena};

/// Roles of bodies, by their colours: agents 0 and 1, then objects 0 and 1.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Roles {
    /// Red, green and blue of each: two agents, and as many objects as there are.
    pub colours: Vec<[u8; 3]>,
}

/// Greatest difference of a colour that is named from that of a body.
const SAME_COLOUR: f32 = 120.0;

impl Roles {
    /// Reads a list such as `red,green,#75d8e6`.
    ///
    /// # Errors
    /// The rule that it violates.
    pub fn read(text: &str) -> Result<Self, String> {
        const NAMES: [(&str, [u8; 3]); 8] = [
            ("red", [255, 0, 0]),
            ("green", [0, 200, 0]),
            ("blue", [0, 0, 255]),
            ("pink", [255, 153, 153]),
            ("cyan", [117, 216, 230]),
            ("yellow", [240, 228, 66]),
            ("orange", [230, 120, 0]),
            ("black", [0, 0, 0]),
        ];
        let colour = |word: &str| {
            let word = word.trim();
            let named = NAMES.iter().find(|(name, _)| *name == word).map(|(_, colour)| *colour);
            let digits = word
                .strip_prefix('#')
                .filter(|it| it.len() == 6)
                .and_then(|it| u32::from_str_radix(it, 16).ok());
            let hexadecimal =
                digits.map(|it| [it >> 16, it >> 8 & 255, it & 255].map(|channel| channel as u8));
            named.or(hexadecimal).ok_or_else(|| {
                let names: Vec<&str> = NAMES.iter().map(|(name, _)| *name).collect();
                format!("{word:?} is no colour; give #rrggbb or one of {}", names.join(", "))
            })
        };
        let colours = text.split(',').map(colour).collect::<Result<Vec<_>, _>>()?;
        if !(AGENT_COUNT..=MAX_ENTITIES).contains(&colours.len()) {
            return Err(format!(
                "must name the colours of two agents and up to two objects, not {}",
                colours.len()
            ));
        }
        Ok(Self { colours })
    }

    /// The places of the bodies of a track, in the order of the roles.
    fn order(&self, track: &Track) -> Result<Vec<usize>, TrackError> {
        let mut left: Vec<usize> = (0..track.bodies.len()).collect();
        if self.colours.len() != left.len() {
            let rule =
                format!("--map names {} colours, but there are {} bodies", self.colours.len(), left.len());
            return Err(TrackError::Map(rule));
        }
        let mut order = Vec::new();
        for (role, colour) in self.colours.iter().enumerate() {
            let form = if role < AGENT_COUNT { Form::Trapezoid } else { Form::Disc };
            let off = |body: usize| {
                let found = track.bodies[body].colour.map(f32::from);
                crate::picture::distance(found, colour.map(f32::from))
            };
            let fitting = left
                .iter()
                .copied()
                .filter(|&body| track.bodies[body].form == form && off(body) < SAME_COLOUR);
            let Some(body) = fitting.min_by(|a, b| off(*a).total_cmp(&off(*b))) else {
                let [red, green, blue] = colour;
                let what = if form == Form::Trapezoid { "agent" } else { "object" };
                return Err(TrackError::Map(format!("--map: no {what} is #{red:02x}{green:02x}{blue:02x}")));
            };
            left.retain(|other| *other != body);
            order.push(body);
        }
        Ok(order)
    }
}

impl Track {
    /// The event that the video shows, and how well it was measured.
    ///
    /// # Errors
    /// [`TrackError::Short`], and [`TrackError::Map`] if roles do not fit the bodies.
    pub fn event(
        &self,
        meaning: FrameMeaning,
        roles: Option<&Roles>,
    ) -> Result<(ObservedEvent, Tracking), TrackError> {
        let order = match roles {
            Some(roles) => roles.order(self)?,
            None => (0..self.bodies.len()).collect(),
        };
        let rows = self.rows(meaning)?;
        let rows: Vec<BodyRows> = order.iter().map(|&body| rows[body].clone()).collect();
        let sizes: Vec<Size> = order.iter().map(|&body| self.bodies[body].size).collect();
        let hidden = self.moments.iter().flat_map(|moment| &moment.bodies).filter(|body| !body.seen).count();
        let tracking = Tracking {
            noise: noise(&rows),
            frames: self.moments.len() as u32,
            frame_rate: self.frame_rate,
            straight: meaning != FrameMeaning::Substeps,
            hidden: hidden as f64 / (self.moments.len() * self.bodies.len()).max(1) as f64,
            deviations: rows.iter().map(|body| body.deviations.clone()).collect(),
        };
        let event = event(self.layout, &sizes, &rows)?;
        Ok((event.with_noise(Some(tracking.noise)), tracking))
    }
}

/// Root mean squares of the deviations of all rows.
pub(crate) fn noise(bodies: &[BodyRows]) -> Noise {
    let mean = |columns: &[usize], bodies: &[BodyRows]| {
        let values: Vec<f32> = bodies
            .iter()
            .flat_map(|body| &body.deviations)
            .flat_map(|row| columns.iter().map(|&column| row[column] * row[column]))
            .collect();
        (values.iter().sum::<f32>() / values.len().max(1) as f32).sqrt().min(100.0)
    };
    let agents = &bodies[..AGENT_COUNT.min(bodies.len())];
    Noise { position: mean(&[0, 1], bodies), velocity: mean(&[2, 3], bodies), angle: mean(&[4], agents) }
}

/// An event of these rows, agents first. Places just outside the arena are moved to its edge.
pub(crate) fn event(
    layout: phase_model::Layout,
    sizes: &[Size],
    bodies: &[BodyRows],
) -> Result<ObservedEvent, TrackError> {
    let body = |&[x, y, vx, vy, angle]: &Row| Body {
        position: Vec2::new(x, y).clamp(arena::MIN, arena::MAX),
        velocity: Vec2::new(vx, vy),
        angle,
        angular_velocity: 0.0,
    };
    let steps = bodies.first().map_or(0, |body| body.rows.len());
    let row = |t: usize| {
        core::array::from_fn(|k| bodies.get(k).map(|rows| body(&rows.rows[t])).unwrap_or_default())
    };
    let agents = [sizes[0], sizes[1]];
    ObservedEvent::new(layout, agents, sizes[AGENT_COUNT..].to_vec(), (0..steps).map(row).collect())
        .map_err(|error| TrackError::Table(error.to_string()))
}
