//! Videos that a page decodes, picture by picture.

use crate::sentence;
use phase_event::{ObservedEvent, Tracking, observed_to_json};
use phase_model::Size;
use phase_track::{Form, Picture, Shape, ShapeTracker, Survey, TrackError, Tracker};
use serde_json::{Value, json};

/// Reads what a video shows in up to three passes: as an arena with agents, and, where it is none, for what
/// stays and for shapes that move.
#[derive(Debug)]
pub struct PageTracker {
    pass: Pass,
}

#[derive(Debug)]
enum Pass {
    Bodies(Box<Tracker>),
    /// No arena with agents; the rest of the pass is passed over.
    Refused(TrackError),
    Survey(Survey, TrackError),
    Shapes(Box<ShapeTracker>),
    Done,
}

impl Default for PageTracker {
    fn default() -> Self {
        Self { pass: Pass::Bodies(Box::default()) }
    }
}

impl PageTracker {
    /// Takes the next picture of a pass: red, green, blue and opacity of each pixel, and its time (s).
    ///
    /// # Errors
    /// A sentence if the video cannot be read at all.
    pub fn push(&mut self, width: usize, height: usize, rgba: &[u8], seconds: f64) -> Result<(), String> {
        let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let picture = Picture::new(width, height, &rgb).map_err(sentence)?;
        match &mut self.pass {
            Pass::Bodies(tracker) => match tracker.push(&picture, seconds) {
                Err(why) if is_foreign(&why) => self.pass = Pass::Refused(why),
                other => other.map_err(sentence)?,
            },
            Pass::Survey(survey, _) => survey.push(&picture).map_err(sentence)?,
            Pass::Shapes(tracker) => tracker.push(&picture, seconds).map_err(sentence)?,
            Pass::Refused(_) | Pass::Done => {}
        }
        Ok(())
    }

    /// Ends a pass. `None` if the video has to be watched once more, or else JSON with `document`, a file of
    /// the event under a name, `seconds` of all frames, and `bodies`, agents first, each with `colour`,
    /// `radius` (pixels), `agent` (whether it has a heading) and `path` ([x, y in pixels, angle in rad] for
    /// each frame); and `notes`, what cannot be judged, as sentences.
    ///
    /// # Errors
    /// A sentence if the video cannot be read.
    pub fn finish(&mut self, id: &str) -> Result<Option<String>, String> {
        let id = name_of(id);
        match core::mem::replace(&mut self.pass, Pass::Done) {
            Pass::Bodies(tracker) => match tracker.finish() {
                Ok(track) => {
                    let (observed, tracking) = track.event(track.meaning(), None).map_err(sentence)?;
                    let body = |k: usize| {
                        let body = track.bodies[k];
                        let place = |moment: &phase_track::Moment| {
                            let pose = moment.bodies[k].pose;
                            let at = track.view.pixel(pose.position);
                            json!([at.x, at.y, pose.angle])
                        };
                        json!({
                            "colour": body.colour,
                            "radius": Size::radius(body.size) * track.view.scale,
                            "agent": body.form == Form::Trapezoid,
                            "path": track.moments.iter().map(place).collect::<Vec<_>>(),
                        })
                    };
                    let bodies = (0..track.bodies.len()).map(body).collect();
                    let seconds: Vec<f64> = track.moments.iter().map(|moment| moment.seconds).collect();
                    answer(&id, &observed, &tracking, &seconds, bodies).map(Some)
                }
                Err(why) if is_foreign(&why) => {
                    self.pass = Pass::Survey(Survey::new(), why);
                    Ok(None)
                }
                Err(error) => Err(sentence(error)),
            },
            Pass::Refused(why) => {
                self.pass = Pass::Survey(Survey::new(), why);
                Ok(None)
            }
            Pass::Survey(survey, why) => {
                let tracker = survey.finish().map_err(|error| format!("{why}; and {error}"))?;
                self.pass = Pass::Shapes(Box::new(tracker));
                Ok(None)
            }
            Pass::Shapes(tracker) => {
                let track = tracker.finish().map_err(sentence)?;
                let (observed, tracking) = track.event(None).map_err(sentence)?;
                let body = |Shape { colour, radius, path, .. }: &Shape| {
                    let path: Vec<_> = path.iter().map(|place| json!([place.x, place.y, 0.0])).collect();
                    json!({ "colour": colour, "radius": radius, "agent": false, "path": path })
                };
                let bodies = track.shapes.iter().map(body).collect();
                answer(&id, &observed, &tracking, &track.seconds, bodies).map(Some)
            }
            Pass::Done => Err("the video has been read already".into()),
        }
    }
}

const fn is_foreign(why: &TrackError) -> bool {
    matches!(
        why,
        TrackError::NoArena { .. } | TrackError::Walls | TrackError::Covered | TrackError::Bodies { .. }
    )
}

/// A name that events can have.
fn name_of(text: &str) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '-' };
    let name: String = text.chars().take(60).map(plain).collect();
    let name = name.trim_matches('-');
    if name.is_empty() { "video".into() } else { name.into() }
}

fn answer(
    id: &str,
    observed: &ObservedEvent,
    tracking: &Tracking,
    seconds: &[f64],
    bodies: Vec<Value>,
) -> Result<String, String> {
    let document = observed_to_json(&[(id, observed, Some(tracking))]).map_err(sentence)?;
    let notes = tracking.missing.sentences();
    Ok(json!({ "document": document, "seconds": seconds, "bodies": bodies, "notes": notes }).to_string())
}
