//! Pictures in the style of the published videos, drawn from the definitions of the shapes by code that
//! shares nothing with the renderer of PHASE or with the tracker.

use phase_event::{ObservedEvent, Recording};
use phase_model::{AGENT_COUNT, Body, Layout, MAX_ENTITIES, Segment, State, Vec2, arena};

type Rgb = [f32; 3];

const LANDMARKS: [Rgb; 4] =
    [[45.0, 45.0, 180.0], [50.0, 150.0, 50.0], [180.0, 45.0, 45.0], [180.0, 180.0, 45.0]];
const BODIES: [Rgb; MAX_ENTITIES] =
    [[255.0, 0.0, 0.0], [0.0, 255.0, 0.0], [117.0, 216.0, 230.0], [255.0, 153.0, 153.0]];

/// A style, and what is wrong with the pictures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub(super) name: &'static str,
    /// Width and height (pixels).
    pub(super) size: (usize, usize),
    /// Pixels of a unit.
    pub(super) scale: f32,
    /// Every one of so many frames is shown, of 20 a second.
    pub(super) every: usize,
    /// Whether edges are grey, or each pixel has one colour.
    pub(super) smooth: bool,
    /// Whether agents have eyes.
    pub(super) eyes: bool,
    /// Width of walls (pixels at native size).
    pub(super) wall: f32,
    /// Whether every row is shown until the next.
    pub(super) held: bool,
    /// Whether the video is compressed by x264 with CRF 35.
    pub(super) compressed: bool,
}

const PUBLISHED: Style = Style {
    name: "published, native size",
    size: (640, 480),
    scale: 20.0,
    every: 1,
    smooth: true,
    eyes: true,
    wall: 5.0,
    held: false,
    compressed: false,
};

/// The styles, the published one first.
pub(super) const STYLES: [Style; 6] = [
    PUBLISHED,
    Style { name: "without grey edges", smooth: false, ..PUBLISHED },
    Style { name: "without eyes, thin walls", eyes: false, wall: 2.0, ..PUBLISHED },
    Style { name: "10 frames a second", every: 2, ..PUBLISHED },
    Style { name: "rows held", held: true, ..PUBLISHED },
    Style { name: "half size, CRF 35", size: (320, 240), scale: 10.0, compressed: true, ..PUBLISHED },
];

/// Draws the frames of an event.
pub(super) struct Drawing {
    style: Style,
    walls: Vec<Segment>,
    radii: Vec<f32>,
    ground: Vec<u8>,
}

impl Drawing {
    pub(super) fn new(style: Style, event: &ObservedEvent) -> Self {
        let agents = event.agent_sizes();
        let sizes = agents.iter().chain(event.object_sizes());
        let radii = sizes.map(|size| size.radius()).collect();
        let mut drawing = Self { style, walls: walls(event.layout()), radii, ground: Vec::new() };
        let (width, height) = style.size;
        let pixels = (0..width * height).flat_map(|k| drawing.pixel(k % width, k / width, &[]));
        let ground = pixels.collect();
        drawing.ground = ground;
        drawing
    }

    /// The frames of a recording, in order, with their times (s).
    pub(super) fn frames(&self, recording: &Recording) -> Vec<(f64, State)> {
        let states: Vec<State> = recording.frames().collect();
        let rows = recording.trajectory.states();
        let shown =
            |k: usize| if self.style.held { rows.get(k / 5).copied() } else { states.get(k).copied() };
        let frames = (0..states.len()).step_by(self.style.every);
        frames.filter_map(|k| Some((k as f64 / 20.0, shown(k)?))).collect()
    }

    /// Red, green and blue of each pixel, row by row.
    pub(super) fn draw(&self, state: &State) -> Vec<u8> {
        let mut bytes = self.ground.clone();
        let (width, height) = self.style.size;
        let bodies = &state.bodies[..self.radii.len()];
        for (body, radius) in bodies.iter().zip(&self.radii) {
            let [left, top] = self.corner();
            let centre = Vec2::new(left, top)
                + Vec2::new(body.position.x - arena::MIN.x, arena::MAX.y - body.position.y)
                    * self.style.scale;
            let reach = 2.0 * radius * self.style.scale;
            let range = |centre: f32, end: usize| {
                (centre - reach).clamp(0.0, end as f32) as usize
                    ..(centre + reach).clamp(0.0, end as f32) as usize
            };
            for y in range(centre.y, height) {
                for x in range(centre.x, width) {
                    let k = 3 * (y * width + x);
                    bytes[k..k + 3].copy_from_slice(&self.pixel(x, y, bodies));
                }
            }
        }
        bytes
    }

    /// Left and upper edge of the arena, in the middle of the picture.
    fn corner(&self) -> [f32; 2] {
        let (width, height) = self.style.size;
        [width, height].map(|side| 0.5 * (side as f32 - arena::SIDE * self.style.scale))
    }

    fn pixel(&self, x: usize, y: usize, bodies: &[Body]) -> [u8; 3] {
        const SMOOTH: [(f32, f32); 4] = [(0.125, 0.375), (0.375, 0.875), (0.625, 0.125), (0.875, 0.625)];
        let places: &[(f32, f32)] = if self.style.smooth { &SMOOTH } else { &[(0.5, 0.5)] };
        let [left, top] = self.corner();
        let mut sum = [0.0; 3];
        for (dx, dy) in places {
            let (across, down) = (x as f32 + dx - left, y as f32 + dy - top);
            let point =
                Vec2::new(arena::MIN.x + across / self.style.scale, arena::MAX.y - down / self.style.scale);
            let colour = self.colour(point, bodies);
            sum = [0, 1, 2].map(|k| sum[k] + colour[k]);
        }
        sum.map(|channel| (channel / places.len() as f32).round() as u8)
    }

    fn colour(&self, point: Vec2, bodies: &[Body]) -> Rgb {
        for k in (AGENT_COUNT..bodies.len()).rev() {
            if point.distance(bodies[k].position) < self.radii[k] {
                return BODIES[k];
            }
        }
        for k in (0..AGENT_COUNT.min(bodies.len())).rev() {
            let (sin, cos) = (libm::sinf(bodies[k].angle), libm::cosf(bodies[k].angle));
            let off = point - bodies[k].position;
            let x = ((cos * off.x + sin * off.y) / self.radii[k]).abs();
            let y = (cos * off.y - sin * off.x) / self.radii[k];
            let from = |b: f32| libm::hypotf(x - 0.5, y - b);
            if self.style.eyes && from(0.7) < 0.224 {
                return [0.0; 3];
            }
            if self.style.eyes && from(0.5) < 0.335 {
                return if from(0.5) < 0.291 { [255.0; 3] } else { [0.0; 3] };
            }
            if y.abs() < 1.0 && x < 1.0 - 0.5 * y {
                return BODIES[k];
            }
        }
        let half = 0.025 * self.style.wall;
        let near = |wall: &Segment| {
            let along = wall.b - wall.a;
            let share = ((point - wall.a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (point - wall.a - along * share).abs().max_element() < half
        };
        let edge = (point - arena::CENTRE).abs().max_element() - 0.5 * arena::SIDE;
        if edge.abs() < half || self.walls.iter().any(near) {
            return [0.0; 3];
        }
        let on = |centre: &Vec2| (point - *centre).abs().max_element() < arena::LANDMARK_HALF_SIDE;
        arena::LANDMARKS.iter().position(on).map_or([255.0; 3], |landmark| LANDMARKS[landmark])
    }
}

fn walls(layout: Layout) -> Vec<Segment> {
    layout.walls().to_vec()
}
