//! Tracks of videos that are drawn here, pixel by pixel from the definitions of the shapes, and damaged.

use phase_model::{Layout, Segment, Size, Vec2, arena};
use phase_track::{Form, FrameMeaning, Picture, Pose, Roles, Track, TrackError, Tracker};

type Rgb = [f32; 3];

const LANDMARKS: [Rgb; 4] =
    [[45.0, 45.0, 180.0], [50.0, 150.0, 50.0], [180.0, 45.0, 45.0], [180.0, 180.0, 45.0]];
const COLOURS: [Rgb; 4] =
    [[255.0, 0.0, 0.0], [0.0, 255.0, 0.0], [117.0, 216.0, 230.0], [255.0, 153.0, 153.0]];

/// A video in the published style, and what is wrong with it.
#[derive(Clone, Copy)]
struct Video {
    width: usize,
    height: usize,
    /// Pixels of a unit, and where the arena begins.
    scale: f32,
    corner: (f32, f32),
    frame_rate: f32,
    /// Amplitude of noise.
    noise: f32,
    /// Rows of black above and below.
    bars: usize,
    /// Distance of the axes around the arena (u); none at 0.
    axes: f32,
    /// Edges of the line around the arena (u outwards from its edge).
    boundary: [f32; 2],
    layout: (u8, usize),
    radii: [f32; 4],
}

const PUBLISHED: Video = Video {
    width: 640,
    height: 480,
    scale: 20.0,
    corner: (120.0, 40.0),
    frame_rate: 20.0,
    noise: 0.0,
    bars: 0,
    axes: 0.0,
    boundary: [-0.125, 0.125],
    layout: (20, 1),
    radii: RADII,
};

const RADII: [f32; 4] = [1.2, 0.8, 1.6, 1.01];

impl Video {
    fn layout(&self) -> Layout {
        let flip = [None, Some(phase_model::Flip::UpDown), Some(phase_model::Flip::Diagonal)][self.layout.1];
        Layout::new(self.layout.0, flip).expect("a layout")
    }

    /// The colour at a world point.
    fn colour(&self, walls: &[Segment], point: Vec2, poses: &[Pose; 4]) -> Rgb {
        for k in [3, 2] {
            if point.distance(poses[k].position) < self.radii[k] {
                return COLOURS[k];
            }
        }
        for k in [1, 0] {
            let (sin, cos) = (poses[k].angle.sin(), poses[k].angle.cos());
            let off = point - poses[k].position;
            let x = (cos * off.x + sin * off.y) / self.radii[k];
            let y = (cos * off.y - sin * off.x) / self.radii[k];
            let from = |a: f32, b: f32| ((x.abs() - a).powi(2) + (y - b).powi(2)).sqrt();
            if from(0.5, 0.7) < 0.224 {
                return [0.0; 3];
            }
            if from(0.5, 0.5) < 0.335 {
                return if from(0.5, 0.5) < 0.291 { [255.0; 3] } else { [0.0; 3] };
            }
            if y.abs() < 1.0 && x.abs() < 1.0 - 0.5 * y {
                return COLOURS[k];
            }
        }
        let off = (point - arena::CENTRE).abs();
        let near_wall = |a: Vec2, b: Vec2| {
            let along = b - a;
            let share = ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (point - a - along * share).abs().max_element() < 0.125
        };
        let [inner, outer] = self.boundary.map(|edge| 10.0 + edge);
        if (inner..outer).contains(&off.max_element()) || walls.iter().any(|wall| near_wall(wall.a, wall.b)) {
            return [0.0; 3];
        }
        let landmark = arena::LANDMARKS.iter().position(|centre| (point - *centre).abs().max_element() < 2.5);
        landmark.map_or([255.0; 3], |landmark| LANDMARKS[landmark])
    }

    /// Axes, as plotting programs draw them, are lines a pixel wide.
    fn is_axis(&self, point: Vec2) -> bool {
        let off = (point - arena::CENTRE).abs().max_element() - 10.0 - self.axes;
        self.axes > 0.0 && off.abs() * self.scale < 0.5
    }

    fn draw(&self, poses: &[Pose; 4], frame: usize) -> Vec<u8> {
        let mut bytes = Vec::new();
        let walls = self.layout().walls();
        // A generator of pseudo-random numbers of its own.
        let mut state = 88_172_645_463_325_252_u64 ^ (frame as u64 + 1);
        for y in 0..self.height {
            for x in 0..self.width {
                let mut sum = [0.0; 3];
                for (dx, dy) in [(0.125, 0.375), (0.375, 0.875), (0.625, 0.125), (0.875, 0.625)] {
                    let (px, py) = (
                        (x as f32 + dx - self.corner.0) / self.scale,
                        (y as f32 + dy - self.corner.1) / self.scale,
                    );
                    let point = Vec2::new(6.0 + px, 22.0 - py);
                    let colour =
                        if self.is_axis(point) { [0.0; 3] } else { self.colour(&walls, point, poses) };
                    sum = [0, 1, 2].map(|k| sum[k] + 0.25 * colour[k]);
                }
                let is_bar = y < self.bars || y >= self.height - self.bars;
                for channel in sum {
                    state ^= state << 13;
                    state ^= state >> 7;
                    state ^= state << 17;
                    let noise = self.noise * ((state >> 40) as f32 / (1 << 23) as f32 - 1.0);
                    bytes.push(if is_bar { 0 } else { (channel + noise).clamp(0.0, 255.0).round() as u8 });
                }
            }
        }
        bytes
    }

    fn track(&self, seconds: f32, poses: impl Fn(f32) -> [Pose; 4]) -> Result<Track, TrackError> {
        let mut tracker = Tracker::new();
        for frame in 0..=(seconds * self.frame_rate) as usize {
            let at = frame as f32 / self.frame_rate;
            let bytes = self.draw(&poses(at), frame);
            tracker.push(&Picture::new(self.width, self.height, &bytes)?, f64::from(at))?;
        }
        tracker.finish()
    }
}

/// Agent 0 walks and turns, and passes below object 1; agent 1 turns on the spot; object 0 rests on a
/// landmark.
fn walk(seconds: f32) -> [Pose; 4] {
    let pose = |x: f32, y: f32, angle: f32| Pose { position: Vec2::new(x, y), angle };
    [
        pose(9.0 + 3.0 * seconds, 16.0 + 0.3 * seconds * seconds, 0.4 + 1.5 * seconds),
        pose(22.0, 8.0, -2.0 * seconds),
        pose(8.3, 19.2, 0.0),
        pose(13.0, 16.3, 0.0),
    ]
}

/// Greatest errors over all frames: place (u), angle of agents (rad).
fn errors(track: &Track, truth: impl Fn(f32) -> [Pose; 4]) -> (f32, f32) {
    let (mut place, mut turn) = (0.0_f32, 0.0_f32);
    for moment in &track.moments {
        for (k, (found, truth)) in moment.bodies.iter().zip(truth(moment.seconds as f32)).enumerate() {
            place = place.max(found.pose.position.distance(truth.position));
            if k < 2 {
                turn = turn.max((found.pose.angle - truth.angle).sin().abs());
            }
        }
    }
    (place, turn)
}

#[test]
fn the_published_style_is_read_to_a_fraction_of_a_pixel() {
    let track = PUBLISHED.track(1.6, walk).expect("a track");
    assert_eq!(track.layout.walls(), PUBLISHED.layout().walls());
    let sizes: Vec<f32> = track.bodies.iter().map(|body| body.size.radius()).collect();
    assert_eq!(sizes, RADII);
    let forms: Vec<Form> = track.bodies.iter().map(|body| body.form).collect();
    assert_eq!(forms, [Form::Trapezoid, Form::Trapezoid, Form::Disc, Form::Disc]);
    let (place, turn) = errors(&track, walk);
    assert!(place < 0.1 && turn < 0.05, "{place} u, {turn} rad");
    assert_eq!(track.meaning(), FrameMeaning::Substeps);
}

/// A line around the arena says the same of its size as landmarks, wherever it is drawn.
#[test]
fn the_arena_is_as_large_as_its_landmarks_say() {
    let half = Video { width: 320, height: 240, scale: 10.0, corner: (60.0, 20.0), ..PUBLISHED };
    for video in [PUBLISHED, half] {
        let outside = Video { boundary: [0.0, 0.1], ..video }.track(0.6, walk).expect("a track");
        assert!((outside.view.scale / video.scale - 1.0).abs() < 1e-3, "{:?}", outside.view);
        let along = video.track(0.6, walk).expect("a track");
        assert!((along.view.scale / video.scale - 1.0).abs() < 1e-3, "{:?}", along.view);
    }
}

/// Agents of the smallest size have few pixels of plain colour at half size.
#[test]
fn small_agents_in_small_pictures_are_found() {
    let radii = [0.8, 0.8, 1.01, 1.01];
    let half = Video { width: 320, height: 240, scale: 5.0, corner: (60.0, 20.0), radii, ..PUBLISHED };
    let slowly = |seconds: f32| walk(0.2 * seconds);
    let track = Video { frame_rate: 8.0, ..half }.track(2.5, slowly).expect("a track");
    let (place, turn) = errors(&track, slowly);
    assert!(place < 0.15 && turn < 0.1, "{place} u, {turn} rad");
}

/// The negative of a picture has light lines on a dark ground.
#[test]
fn light_lines_on_a_dark_ground_are_read() {
    let mut tracker = Tracker::new();
    for frame in 0..8 {
        let seconds = frame as f32 / 20.0;
        let mut bytes = PUBLISHED.draw(&walk(seconds), frame);
        bytes.iter_mut().for_each(|channel| *channel = 255 - *channel);
        let picture = Picture::new(640, 480, &bytes).expect("a picture");
        tracker.push(&picture, f64::from(seconds)).expect("tracked");
    }
    let track = tracker.finish().expect("a track");
    // Red is now cyan, and still told by its own colour.
    let cyan = track.bodies.iter().position(|body| body.colour[0] < 60 && body.colour[1] > 200);
    assert_eq!(cyan, Some(1));
    let order = |seconds: f32| {
        let mut poses = walk(seconds);
        poses.swap(0, 1);
        poses
    };
    let objects_too = errors(&track, |seconds| {
        let mut poses = order(seconds);
        if track.bodies[2].size == Size::Medium {
            poses.swap(2, 3);
        }
        poses
    });
    assert!(objects_too.0 < 0.1 && objects_too.1 < 0.05, "{objects_too:?}");
}

#[test]
fn small_noisy_letter_boxed_and_slow_videos_are_read_too() {
    let damaged = [
        Video { width: 320, height: 240, scale: 10.0, corner: (60.0, 20.0), ..PUBLISHED },
        Video { noise: 25.0, ..PUBLISHED },
        Video { height: 600, corner: (120.0, 100.0), bars: 50, ..PUBLISHED },
        Video { frame_rate: 10.0, ..PUBLISHED },
        Video { axes: 1.0, scale: 18.0, ..PUBLISHED },
        Video { layout: (7, 2), ..PUBLISHED },
    ];
    for video in damaged {
        let track = video.track(0.6, walk).expect("a track");
        assert_eq!(track.layout.walls(), video.layout().walls());
        let (place, turn) = errors(&track, walk);
        assert!(place < 0.15 && turn < 0.1, "{place} u, {turn} rad at {} pixels", video.width);
    }
}

/// Frames between rows lie on straight lines.
#[test]
fn rows_are_told_from_motion() {
    let rows = |t: usize| {
        let t = t as f32;
        let angle = 0.3 * t;
        let pose = |x: f32, y: f32, angle: f32| Pose { position: Vec2::new(x, y), angle };
        [
            pose(9.0 + 0.9 * t * (0.9 * t).cos().abs(), 16.0 + (1.7 * t).sin(), angle),
            pose(21.0 + (1.3 * t).sin(), 8.0 + (2.1 * t).cos(), -angle),
            pose(8.3, 19.2, 0.0),
            pose(13.0 + (2.3 * t).sin(), 6.0, 0.0),
        ]
    };
    let at = |seconds: f32| rows((4.0 * seconds + 1e-3) as usize);
    let held = Video { frame_rate: 15.0, ..PUBLISHED }.track(1.5, at).expect("a track");
    assert_eq!(held.meaning(), FrameMeaning::Held);
    let (event, _) = held.event(held.meaning(), None).expect("an event");
    // A single frame shows the last row, after a leap.
    for (t, row) in event.rows().iter().enumerate().take(6) {
        for (found, truth) in row.iter().zip(rows(t)) {
            assert!(found.position.distance(truth.position) < 0.05, "row {t}: {found:?}, {truth:?}");
        }
    }
    let between = |seconds: f32| {
        let steps = 4.0 * seconds;
        let (a, b) = (rows(steps as usize), rows(steps as usize + 1));
        core::array::from_fn(|k| Pose {
            position: a[k].position.lerp(b[k].position, steps.fract()),
            angle: a[k].angle + (b[k].angle - a[k].angle) * steps.fract(),
        })
    };
    // 12.5 frames a second show few of the rows themselves.
    let slow = Video { frame_rate: 12.5, ..PUBLISHED }.track(1.2, between).expect("a track");
    let (event, _) = slow.event(FrameMeaning::Rows, None).expect("an event");
    for (t, row) in event.rows().iter().enumerate() {
        for (found, truth) in row.iter().zip(rows(t)) {
            assert!(found.position.distance(truth.position) < 0.1, "row {t}: {found:?}, {truth:?}");
        }
    }
    let track = PUBLISHED.track(2.0, between).expect("a track");
    assert_eq!(track.meaning(), FrameMeaning::Rows);
    let (event, tracking) = track.event(track.meaning(), None).expect("an event");
    assert_eq!((event.steps(), tracking.straight), (8, true));
    for (t, row) in event.rows().iter().enumerate() {
        for (found, truth) in row.iter().zip(rows(t)) {
            assert!(found.position.distance(truth.position) < 0.05, "row {t}: {found:?}, {truth:?}");
        }
    }
    // The second agent first.
    let roles = Roles::read("#00ff00,red,cyan,pink").expect("roles");
    let (swapped, _) = track.event(track.meaning(), Some(&roles)).expect("an event");
    assert_eq!(swapped.rows()[3][0], event.rows()[3][1]);
    let missing = Roles::read("green,blue,cyan,pink").expect("roles");
    let refused = track.event(track.meaning(), Some(&missing)).expect_err("no blue agent").to_string();
    assert_eq!(
        refused,
        "--map: no agent is #0000ff; the bodies are 1 #ff0000, 2 #00ff00, 3 #75d8e6, 4 #ff9999"
    );
}

#[test]
fn what_is_no_event_is_refused_by_a_sentence() {
    let refusal = |width: usize, height: usize, pixel: &dyn Fn(usize, usize) -> [u8; 3]| {
        let bytes: Vec<u8> = (0..width * height).flat_map(|k| pixel(k % width, k / width)).collect();
        let mut tracker = Tracker::new();
        for frame in 0..10 {
            tracker.push(&Picture::new(width, height, &bytes)?, f64::from(frame) / 20.0)?;
        }
        tracker.finish()
    };
    let white = refusal(640, 480, &|_, _| [255; 3]).expect_err("nothing is there").to_string();
    assert!(white.contains("shows no arena"), "{white}");
    let photo = refusal(320, 200, &|x, y| [(x * y % 251) as u8, (x + 2 * y) as u8, (x * 7 % 256) as u8]);
    assert!(photo.is_err());
    assert!(refusal(640, 480, &|_, _| [0; 3]).is_err());
    assert!(matches!(Picture::new(7680, 4320, &[]), Err(TrackError::Size { .. })));
    assert!(matches!(Tracker::new().finish(), Err(TrackError::Short { frames: 0, .. })));
    let video = Video { layout: (0, 0), ..PUBLISHED };
    let bytes = video.draw(&walk(0.0), 0);
    let uneven = || {
        let picture = Picture::new(video.width, video.height, &bytes)?;
        let mut tracker = Tracker::new();
        for seconds in [0.0, 0.05, 0.1, 0.3, 0.35] {
            tracker.push(&picture, seconds)?;
        }
        tracker.finish()
    };
    assert!(matches!(uneven(), Err(TrackError::Uneven { .. })));
}

/// The red agent stands on the red landmark and covers more than half of it.
#[test]
fn an_agent_on_a_landmark_of_its_colour_is_told_from_it() {
    let poses = |seconds: f32| {
        let mut poses = walk(0.0);
        poses[0] = Pose { position: Vec2::new(23.4 - 4.0 * seconds, 4.1), angle: 0.2 };
        poses
    };
    let half = Video { width: 320, height: 240, scale: 10.0, corner: (60.0, 20.0), ..PUBLISHED };
    let video = Video { radii: [1.6, 0.8, 1.2, 1.01], ..half };
    let mut tracker = Tracker::new();
    for frame in 0..12 {
        let seconds = frame as f32 / 20.0;
        let bytes = video.draw(&poses(seconds), frame);
        let picture = Picture::new(320, 240, &bytes).expect("a picture");
        tracker.push(&picture, f64::from(seconds)).expect("tracked");
    }
    let (place, turn) = errors(&tracker.finish().expect("a track"), poses);
    assert!(place < 0.15 && turn < 0.1, "{place} u, {turn} rad");
}
