//! Length and look of the events of a dataset, where somebody asked for other than the usual ones.

use phase_model::arena::{FRAMES_PER_SECOND, SUBSTEPS};
use phase_sampler::Starts;
use serde::{Deserialize, Serialize};

/// Length and look of a dataset's events.
///
/// The default is what datasets have unless asked: lengths by the preset's rules, and videos of 480 pixels in
/// the paper's colours, with a frame for each substep. Manifests and shards say nothing of it then.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StimulusForm {
    /// The length of every event (steps of 0.25 s of video), if it is fixed.
    pub steps: Option<u32>,
    /// Side of a video (pixels); of those of sets, two thirds of it for each event.
    pub size: u32,
    /// Name of the palette.
    pub palette: String,
    /// Frames a second of video. Bodies move in straight lines between substeps, of which there are 20 a
    /// second.
    pub frame_rate: u32,
    /// Places of bodies at the start.
    #[serde(skip_serializing_if = "is_near")]
    pub starts: Starts,
}

/// Whether bodies start near the points of the grid, which files do not say.
fn is_near(starts: &Starts) -> bool {
    *starts == Starts::Near
}

impl Default for StimulusForm {
    fn default() -> Self {
        Self {
            steps: None,
            size: 480,
            palette: "paper".into(),
            frame_rate: FRAMES_PER_SECOND,
            starts: Starts::Near,
        }
    }
}

impl StimulusForm {
    /// Whether it is the usual one.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Number of frames of the video of an event of so many steps: the first state, and those until the end.
    #[must_use]
    pub fn frames(&self, steps: usize) -> usize {
        let substeps = steps.saturating_mul(SUBSTEPS);
        1 + substeps.saturating_mul(self.frame_rate as usize) / FRAMES_PER_SECOND as usize
    }
}

#[cfg(test)]
mod tests {
    use super::StimulusForm;

    #[test]
    fn ten_seconds_have_as_many_frames_as_the_rate_says_and_the_first() {
        let at = |frame_rate| StimulusForm { frame_rate, ..StimulusForm::default() }.frames(40);
        assert_eq!([at(10), at(20), at(24), at(30), at(60)], [101, 201, 241, 301, 601]);
        assert!(StimulusForm::default().is_default());
    }
}
