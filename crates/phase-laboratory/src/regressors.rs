//! Motion as regressors, frame by frame.

use phase_evidence::contact;
use phase_model::{
    AGENT_COUNT, AgentId, Entity, PhysicsConfig, Segment, State, Vec2,
    arena::{self, FRAMES_PER_SECOND},
    geometry::{self, Outline},
};
use phase_render::{Frame, RenderError, SceneRenderer, Style};

/// Motion of one agent at one frame. Speeds and accelerations are those that a viewer sees, per second of
/// video; a simulation's physics runs three times as fast.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct AgentMotion {
    /// Speed of its origin since the frame before (u/s).
    pub speed: f64,
    /// Magnitude of the change of its velocity since the frame before (u/s²).
    pub acceleration: f64,
    /// The part of the acceleration that no contact explains: `acceleration` while it touches neither a body
    /// nor a wall, 0 otherwise (u/s²).
    pub self_propelled: f64,
    /// Rate at which it turns, either way (rad/s).
    pub turning: f64,
    /// Cosine of the angle between its heading and the direction to the other agent, −1 to 1.
    pub gaze: f64,
    /// Whether it touches the other agent or an object: 1 or 0.
    pub contact: f64,
}

/// Regressors of one frame.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct FrameMotion {
    /// Both agents.
    pub agents: [AgentMotion; AGENT_COUNT],
    /// Distance between the agents' origins (u).
    pub distance: f64,
    /// Distance between their outlines (u), 0 if they touch.
    pub gap: f64,
    /// Sum of the speeds of all objects (u/s).
    pub objects: f64,
    /// Motion energy: mean change of luminance of a pixel since the frame before, 0 to 255.
    pub energy: f64,
}

/// Names, units and meanings of the columns of [`FrameMotion::values`]. Agents are called by their colours in
/// the published videos.
pub const COLUMNS: [(&str, &str, &str); 2 * AGENTS.len() + REST.len()] = columns();

/// The columns of an agent.
const AGENTS: [(&str, &str, &str); 6] = [
    ("speed", "u/s", "speed of the agent's origin"),
    ("acceleration", "u/s^2", "magnitude of the change of the agent's velocity"),
    ("self_propelled", "u/s^2", "the same while the agent touches neither a body nor a wall, else 0"),
    ("turning", "rad/s", "how fast the agent turns, either way"),
    ("gaze", "", "cosine of the angle between the agent's heading and the direction to the other agent"),
    ("contact", "", "whether the agent touches the other agent or an object"),
];
const RED: [&str; 6] =
    ["red_speed", "red_acceleration", "red_self_propelled", "red_turning", "red_gaze", "red_contact"];
const GREEN: [&str; 6] = [
    "green_speed",
    "green_acceleration",
    "green_self_propelled",
    "green_turning",
    "green_gaze",
    "green_contact",
];
const REST: [(&str, &str, &str); 4] = [
    ("distance", "u", "distance between the agents' origins"),
    ("gap", "u", "distance between the agents' outlines, 0 if they touch"),
    ("object_speed", "u/s", "sum of the speeds of all objects"),
    ("motion_energy", "", "mean absolute change of luminance (0 to 255) of a pixel from the frame before"),
];

const fn columns() -> [(&'static str, &'static str, &'static str); 16] {
    let mut columns = [("", "", ""); 16];
    let mut k = 0;
    while k < 6 {
        columns[k] = (RED[k], AGENTS[k].1, AGENTS[k].2);
        columns[6 + k] = (GREEN[k], AGENTS[k].1, AGENTS[k].2);
        k += 1;
    }
    let mut k = 0;
    while k < 4 {
        columns[12 + k] = REST[k];
        k += 1;
    }
    columns
}

impl FrameMotion {
    /// The values in the order of [`COLUMNS`].
    #[must_use]
    pub fn values(&self) -> [f64; COLUMNS.len()] {
        let [red, green] = self.agents.map(|agent| {
            let AgentMotion { speed, acceleration, self_propelled, turning, gaze, contact } = agent;
            [speed, acceleration, self_propelled, turning, gaze, contact]
        });
        let mut values = [0.0; COLUMNS.len()];
        values[..6].copy_from_slice(&red);
        values[6..12].copy_from_slice(&green);
        values[12..].copy_from_slice(&[self.distance, self.gap, self.objects, self.energy]);
        values
    }
}

/// The regressors of all frames of a video. What compares a frame with the one before is 0 at the first
/// frame, and accelerations are 0 at the second, too.
///
/// # Errors
/// [`RenderError`] if the frames cannot be drawn.
pub fn motion(physics: &PhysicsConfig, states: &[State]) -> Result<Vec<FrameMotion>, RenderError> {
    // Small pictures without the marks of grips, which recordings do not have.
    let style = Style { grips: false, ..Style::with_side(ENERGY_SIDE) };
    let renderer = SceneRenderer::new(physics, style)?;
    let mut before: Option<Vec<u8>> = None;
    let mut frames = Vec::with_capacity(states.len());
    for (k, state) in states.iter().enumerate() {
        let luminance = luminance(&renderer.frame(state, None));
        let energy = before.as_ref().map_or(0.0, |before| change(before, &luminance));
        before = Some(luminance);
        frames.push(FrameMotion { energy, ..moved(physics, states, k) });
    }
    Ok(frames)
}

/// Side of the pictures in which motion energy is measured (pixels).
pub const ENERGY_SIDE: u32 = 240;

/// Mean over frames; zeros without any.
#[must_use]
pub fn mean(frames: &[FrameMotion]) -> [f64; COLUMNS.len()] {
    let mut sum = [0.0; COLUMNS.len()];
    for frame in frames {
        for (sum, value) in sum.iter_mut().zip(frame.values()) {
            *sum += value;
        }
    }
    sum.map(|sum| sum / frames.len().max(1) as f64)
}

fn moved(physics: &PhysicsConfig, states: &[State], k: usize) -> FrameMotion {
    let state = &states[k];
    let rate = f64::from(FRAMES_PER_SECOND);
    let velocity = |entity: Entity, k: usize| {
        let step =
            k.checked_sub(1).map(|before| states[k].position(entity) - states[before].position(entity));
        step.map(|step| [f64::from(step.x) * rate, f64::from(step.y) * rate])
    };
    let length = |[x, y]: [f64; 2]| libm::hypot(x, y);
    let agents = AgentId::ALL.map(|agent| {
        let me = Entity::Agent(agent);
        let other = Entity::Agent(agent.other());
        let now = velocity(me, k);
        let acceleration = match (now, k.checked_sub(1).and_then(|before| velocity(me, before))) {
            (Some(now), Some(before)) => length([now[0] - before[0], now[1] - before[1]]) * rate,
            _ => 0.0,
        };
        let touches =
            physics.entities().any(|entity| entity != me && contact::near(physics, state, me, entity));
        let body = state.body(me);
        let turned =
            k.checked_sub(1).map_or(0.0, |before| f64::from(body.angle - states[before].body(me).angle));
        let to_other = (state.position(other) - body.position).normalize_or_zero();
        AgentMotion {
            speed: now.map_or(0.0, length),
            acceleration,
            self_propelled: if touches || by_a_wall(physics, state, me) { 0.0 } else { acceleration },
            turning: turned.abs() * rate,
            gaze: f64::from(geometry::forward(body.angle).dot(to_other)),
            contact: f64::from(u8::from(touches)),
        }
    });
    let [red, green] = AgentId::ALL.map(Entity::Agent);
    let objects = physics.entities().filter(|entity| matches!(entity, Entity::Object(_)));
    FrameMotion {
        agents,
        distance: f64::from(state.position(red).distance(state.position(green))),
        gap: f64::from(contact::gap(physics, state, red, green)),
        objects: objects.filter_map(|object| velocity(object, k)).map(length).sum(),
        energy: 0.0,
    }
}

/// Whether an inner wall or the boundary is within [`contact::TOUCH_GAP`] of an outline.
fn by_a_wall(physics: &PhysicsConfig, state: &State, entity: Entity) -> bool {
    let outline = Outline::of(physics, entity, state.body(entity));
    let (min, max) = outline.bounds();
    let inside = |point: Vec2| arena::contains(point);
    let reach = Vec2::splat(contact::TOUCH_GAP);
    if !inside(min - reach) || !inside(max + reach) {
        return true;
    }
    physics.walls.iter().any(|&wall| {
        let apart = match outline {
            Outline::Disc { centre, radius } => wall.distance(centre) - radius,
            Outline::Trapezoid(corners) => {
                let edges = (0..4).map(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] });
                let ends = edges.flat_map(|edge| [edge.distance(wall.a), edge.distance(wall.b)]);
                corners.iter().map(|&corner| wall.distance(corner)).chain(ends).fold(f32::INFINITY, f32::min)
            }
        };
        apart <= contact::TOUCH_GAP || outline.overlaps_wall(wall)
    })
}

/// Luminance of every pixel (Rec. 709, gamma-encoded), 0 to 255.
fn luminance(frame: &Frame) -> Vec<u8> {
    let luma = |pixel: &[u8]| {
        let [red, green, blue] = [0, 1, 2].map(|k| u32::from(pixel[k]));
        ((2126 * red + 7152 * green + 722 * blue + 5000) / 10_000) as u8
    };
    frame.rgba().chunks_exact(4).map(luma).collect()
}

fn change(before: &[u8], after: &[u8]) -> f64 {
    let sum: u64 = before.iter().zip(after).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / before.len().max(1) as f64
}
