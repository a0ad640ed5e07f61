//! Bodies followed from frame to frame.

mod known;

use crate::{
    TrackError,
    arena::Stage,
    picture::{Picture, negative},
    shape::{Form, Pose},
    view::View,
};
use known::{Followed, Known};
use phase_model::{Layout, Size};

/// A pose with the standard deviations of its error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Measured {
    /// The pose.
    pub pose: Pose,
    /// Standard deviations of x and y (u), and of the angle (rad).
    pub deviation: [f32; 3],
    /// Whether the body was seen; if not, the pose is where its motion leads it.
    pub seen: bool,
}

/// The bodies at one time, agents first.
#[derive(Clone, PartialEq, Debug)]
pub struct Moment {
    /// Time since the first frame (s of video).
    pub seconds: f64,
    /// Bodies, those of agents first.
    pub bodies: Vec<Measured>,
}

/// A body that is followed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TrackedBody {
    /// Its form.
    pub form: Form,
    /// Its size.
    pub size: Size,
    /// Its colour.
    pub colour: [u8; 3],
}

/// Frames in which the arena may be absent before the video is refused: a title, or a fade.
const LONGEST_LEAD: usize = 300;
/// Frames in which bodies are not looked for after many in which they could not be told apart.
const MOST_SKIPPED: usize = 10;
/// Most that is kept of them (bytes).
const MOST_WAITING: usize = 1 << 26;
/// Greatest length of a video (s).
const LONGEST: u32 = 3600;

/// Follows the bodies of a video frame by frame. It keeps one picture and the poses.
#[derive(Debug)]
pub struct Tracker {
    frames: usize,
    /// Time at which the arena was first seen (s).
    first_seconds: Option<f64>,
    /// The frames since then in which the bodies could not be told apart yet, with their times. They are
    /// followed backwards once the bodies are known.
    waiting: Vec<(f64, Vec<u8>)>,
    /// The frame in which they are looked for next.
    next_attempt: usize,
    known: Option<Known>,
    /// Whether lines are light on a dark ground: pictures are then replaced by their negatives.
    negative: bool,
    /// Why the frames so far were not understood.
    refusal: Option<TrackError>,
    moments: Vec<Moment>,
    least_interval: f64,
    greatest_interval: f64,
    last_seconds: f64,
}

impl Default for Tracker {
    fn default() -> Self {
        Self::new()
    }
}

impl Tracker {
    /// A tracker that has seen nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            frames: 0,
            first_seconds: None,
            waiting: Vec::new(),
            next_attempt: 0,
            known: None,
            negative: false,
            refusal: None,
            moments: Vec::new(),
            least_interval: f64::INFINITY,
            greatest_interval: 0.0,
            last_seconds: 0.0,
        }
    }

    /// Takes the next frame, shown at a time (s).
    ///
    /// # Errors
    /// [`TrackError`] if there is no arena in the first 300 frames, its walls or bodies are not those of an
    /// event, a body is lost for 3 s, the size changes, or the video is longer than an hour.
    pub fn push(&mut self, picture: &Picture<'_>, seconds: f64) -> Result<(), TrackError> {
        let frame = self.frames;
        self.frames += 1;
        if seconds > f64::from(LONGEST) || !seconds.is_finite() {
            return Err(TrackError::Long(LONGEST));
        }
        if frame > 0 {
            let interval = seconds - self.last_seconds;
            self.least_interval = self.least_interval.min(interval);
            self.greatest_interval = self.greatest_interval.max(interval);
        }
        self.last_seconds = seconds;
        if self.first_seconds.is_none() && !self.negative {
            let shows_none = |picture: &Picture<'_>| {
                matches!(Stage::find(picture, frame), Err(TrackError::NoArena { .. }))
            };
            let (width, height) = picture.size();
            self.negative =
                shows_none(picture) && !shows_none(&Picture::new(width, height, &negative(picture))?);
        }
        let bytes = if self.negative { negative(picture) } else { Vec::new() };
        let (width, height) = picture.size();
        let picture = if self.negative { &Picture::new(width, height, &bytes)? } else { picture };
        let Some(known) = &mut self.known else {
            let now = self.first_seconds.map_or(0.0, |first| seconds - first);
            // Looking for bodies takes as long as following them through many frames.
            let begun = match &self.refusal {
                Some(error) if frame < self.next_attempt => Err(error.clone()),
                _ => Known::begin(picture, frame, now, self.negative),
            };
            match begun {
                Ok(known) => {
                    let first = *self.first_seconds.get_or_insert(seconds);
                    self.moments.push(known.moment(seconds - first));
                    let mut known = known;
                    let followed = known.followed.clone();
                    let (width, height) = picture.size();
                    let mut after = now;
                    for (before, bytes) in self.waiting.drain(..).rev() {
                        // Where a body is hidden, nothing is known but its motion afterwards.
                        if let Ok(picture) = Picture::new(width, height, &bytes) {
                            known.follow(&picture, after, before - first)?;
                        }
                        after = before - first;
                        self.moments.push(known.moment(after));
                    }
                    self.moments.reverse();
                    known.followed = followed;
                    self.known = Some(known);
                }
                Err(error) if frame + 1 < LONGEST_LEAD => {
                    // The arena is there, but bodies hide each other: time begins.
                    if !matches!(error, TrackError::NoArena { .. }) {
                        self.first_seconds.get_or_insert(seconds);
                        let kept = self.waiting.len() * picture.bytes().len() < MOST_WAITING;
                        let bytes = if kept { picture.bytes().to_vec() } else { Vec::new() };
                        self.waiting.push((seconds, bytes));
                        if frame >= self.next_attempt {
                            self.next_attempt = frame + 1 + (self.waiting.len() / 4).min(MOST_SKIPPED);
                        }
                    }
                    self.refusal = Some(error);
                }
                Err(error) => return Err(error),
            }
            return Ok(());
        };
        if picture.size() != known.size {
            return Err(TrackError::Resized { frame });
        }
        let now = seconds - self.first_seconds.unwrap_or(seconds);
        let before = self.moments.last().map_or(0.0, |moment| moment.seconds);
        known.follow(picture, before, now)?;
        self.moments.push(known.moment(now));
        Ok(())
    }

    /// The motion seen.
    ///
    /// # Errors
    /// [`TrackError`] if no frame was understood, the times of frames are uneven, there are fewer than 4 or
    /// more than 240 frames a second, or they last less than 0.25 s.
    pub fn finish(self) -> Result<Track, TrackError> {
        let seconds = self.last_seconds - self.first_seconds.unwrap_or(self.last_seconds);
        let short = TrackError::Short { frames: self.frames, seconds };
        let Some(known) = self.known else { return Err(self.refusal.unwrap_or(short)) };
        if self.moments.len() < 3 || seconds < 0.25 {
            return Err(short);
        }
        let least = self.least_interval;
        let greatest = self.greatest_interval;
        // Times of some containers are whole milliseconds.
        if greatest > 1.5 * least + 0.002 {
            return Err(TrackError::Uneven { least, greatest });
        }
        let frame_rate = (self.moments.len() - 1) as f64 / seconds;
        if !(3.95..=240.5).contains(&frame_rate) {
            return Err(TrackError::Rate(frame_rate));
        }
        let body = |followed: &Followed| TrackedBody {
            form: followed.body.form,
            size: followed.size,
            colour: followed.body.colour.map(|channel| {
                let channel = channel.round().clamp(0.0, 255.0) as u8;
                if self.negative { 255 - channel } else { channel }
            }),
        };
        Ok(Track {
            view: known.stage.view,
            landmarks: known.stage.has_landmarks(),
            layout: known.stage.layout,
            bodies: known.followed.iter().map(body).collect(),
            frame_rate,
            moments: self.moments,
        })
    }
}

/// Everything that was read from a video.
#[derive(Clone, PartialEq, Debug)]
pub struct Track {
    /// Place and scale of the arena in the picture.
    pub view: View,
    /// Walls and landmarks.
    pub layout: Layout,
    /// Whether there are landmarks.
    pub landmarks: bool,
    /// The bodies, agents first: at least two, at most four.
    pub bodies: Vec<TrackedBody>,
    /// Frames a second.
    pub frame_rate: f64,
    /// The poses in every frame, at least three.
    pub moments: Vec<Moment>,
}
