//! From a track to an event without labels.

use crate::{BodyRows, Form, FrameMeaning, Track, TrackError};
use phase_event::{Missing, Noise, ObservedEvent, Row, Tracking};
use phase_model::{AGENT_COUNT, Body, MAX_ENTITIES, Size, Vec2, arena};

/// A body, by what tells it from the others.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Role {
    /// Red, green and blue; of bodies that are not yet taken, the nearest.
    Colour([u8; 3]),
    /// Its number among the bodies that were found, from 1.
    Number(usize),
}

/// Roles of bodies: agents 0 and 1, then objects 0 and 1.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Roles {
    /// The body in each role: two agents and up to two objects.
    pub bodies: Vec<Role>,
}

/// Greatest difference of a colour that is named from that of a body.
const SAME_COLOUR: f32 = 120.0;

impl Roles {
    /// Reads a list such as `red,green,#75d8e6` or `2,1,3`.
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
            if let Some(number) = word.parse().ok().filter(|number| (1..100).contains(number)) {
                return Ok(Role::Number(number));
            }
            let named = NAMES.iter().find(|(name, _)| *name == word).map(|(_, colour)| *colour);
            let digits = word
                .strip_prefix('#')
                .filter(|it| it.len() == 6)
                .and_then(|it| u32::from_str_radix(it, 16).ok());
            let hexadecimal =
                digits.map(|it| [it >> 16, it >> 8 & 255, it & 255].map(|channel| channel as u8));
            named.or(hexadecimal).map(Role::Colour).ok_or_else(|| {
                let names: Vec<&str> = NAMES.iter().map(|(name, _)| *name).collect();
                format!("{word:?} is no body; give its number, #rrggbb or one of {}", names.join(", "))
            })
        };
        let bodies = text.split(',').map(colour).collect::<Result<Vec<_>, _>>()?;
        if !(AGENT_COUNT..=MAX_ENTITIES).contains(&bodies.len()) {
            return Err(format!("must name two agents and up to two objects, not {} bodies", bodies.len()));
        }
        // Several bodies may have one colour, but not one number.
        let is_again = |k: usize| matches!(bodies[k], Role::Number(_)) && bodies[..k].contains(&bodies[k]);
        if let Some(k) = (1..bodies.len()).find(|&k| is_again(k)) {
            let twice = text.split(',').nth(k).unwrap_or_default();
            return Err(format!("gives body {} two roles", twice.trim()));
        }
        Ok(Self { bodies })
    }

    /// The places of bodies of these colours, in the order of the roles; `fits` says whether a body can have
    /// a role.
    pub(crate) fn order(
        &self,
        colours: &[[u8; 3]],
        fits: impl Fn(usize, usize) -> bool,
    ) -> Result<Vec<usize>, TrackError> {
        let hexadecimal = |[red, green, blue]: [u8; 3]| format!("#{red:02x}{green:02x}{blue:02x}");
        let mut order: Vec<usize> = Vec::new();
        for (role, &wanted) in self.bodies.iter().enumerate() {
            let off = |body: usize| match wanted {
                Role::Number(number) => {
                    if body + 1 == number {
                        0.0
                    } else {
                        f32::INFINITY
                    }
                }
                Role::Colour(colour) => {
                    crate::picture::distance(colours[body].map(f32::from), colour.map(f32::from))
                }
            };
            let fitting = (0..colours.len()).filter(|body| !order.contains(body) && fits(role, *body));
            let near = fitting.filter(|&body| off(body) < SAME_COLOUR);
            let Some(body) = near.min_by(|a, b| off(*a).total_cmp(&off(*b))) else {
                let wanted = match wanted {
                    Role::Number(number) => format!("number {number}"),
                    Role::Colour(colour) => hexadecimal(colour),
                };
                let what = if role < AGENT_COUNT { "agent" } else { "object" };
                let found: Vec<String> = colours
                    .iter()
                    .enumerate()
                    .map(|(k, it)| format!("{} {}", k + 1, hexadecimal(*it)))
                    .collect();
                let rule = format!("--map: no {what} is {wanted}; the bodies are {}", found.join(", "));
                return Err(TrackError::Map(rule));
            };
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
            Some(roles) => {
                let colours: Vec<[u8; 3]> = self.bodies.iter().map(|body| body.colour).collect();
                if roles.bodies.len() != colours.len() {
                    let (named, found) = (roles.bodies.len(), colours.len());
                    let rule = format!("--map names {named} bodies, but there are {found}");
                    return Err(TrackError::Map(rule));
                }
                let form = |role| if role < AGENT_COUNT { Form::Trapezoid } else { Form::Disc };
                roles.order(&colours, |role, body| self.bodies[body].form == form(role))?
            }
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
            missing: Missing { landmarks: !self.landmarks, ..Missing::default() },
            deviations: rows.iter().map(|body| body.deviations.clone()).collect(),
        };
        let event = event(self.layout, &sizes, &rows)?;
        Ok((event.with_tracking(&tracking), tracking))
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
