//! The command line that makes a dataset: its card has it, and `verify --replay` follows it.

use super::Generation;
use crate::effort::{Effort, MindChoice};
use phase_dataset::form::StimulusForm;
use phase_minds::{Foresight, MindKind, PARTICLES, Prior, SIMULATIONS};
use phase_model::{
    arena::STEP_VIDEO_SECONDS,
    setting::{EVENT_STEPS, EVENTS, Setting},
};
use phase_sampler::Starts;
use phase_sim::Engine;

/// Beginning of the command.
const PROGRAM: &str = "phase gen-dataset ";

impl Generation {
    /// The command line that makes this dataset anywhere, with its number of events and its seed.
    pub(super) fn command(&self, events: usize, seed: u64) -> String {
        let name = &self.preset;
        let effort = self.effort.options();
        let no_video = if self.videos { "" } else { " --no-video" };
        let date = self.date_published.as_ref();
        let date = date.map_or_else(String::new, |date| format!(" --date-published {date}"));
        let form = self.form_options();
        format!("{PROGRAM}--preset {name} --events {events} --seed {seed}{effort}{form}{no_video}{date}")
    }

    /// The options for length and look of the events, each with a space before it.
    fn form_options(&self) -> String {
        let usual = StimulusForm::default();
        let StimulusForm { steps, size, palette, frame_rate, starts } = &self.form;
        let seconds = steps.map(|steps| format!(" --seconds {}", f64::from(steps) * STEP_VIDEO_SECONDS));
        let size = (*size != usual.size).then(|| format!(" --size {size}"));
        let palette = (*palette != usual.palette).then(|| format!(" --palette {palette}"));
        let rate = (*frame_rate != usual.frame_rate).then(|| format!(" --frame-rate {frame_rate}"));
        let starts = (*starts != usual.starts).then(|| format!(" --starts {}", starts.name()));
        starts.into_iter().chain(seconds).chain(size).chain(palette).chain(rate).collect()
    }

    /// The dataset that a command line makes; `None` if [`Generation::command`] never says it that way.
    pub(crate) fn of_command(command: &str) -> Option<Self> {
        let mut generation = Self::new("");
        let mut words = command.strip_prefix(PROGRAM)?.split(' ');
        while let Some(word) = words.next() {
            match word {
                "--one-way-turns" => generation.effort.minds.one_way_turns = true,
                "--strongest-coasts" => generation.effort.minds.strongest_coasts = true,
                "--original-random" => generation.effort.minds.original_random = true,
                "--no-video" => generation.videos = false,
                _ => generation.set(word, words.next()?)?,
            }
        }
        let again = generation.command(generation.events?, generation.seed?);
        (again == command).then_some(generation)
    }

    /// Sets the value of an option; `None` if there is no such option or value.
    fn set(&mut self, option: &str, value: &str) -> Option<()> {
        let Effort {
            engine,
            minds: MindChoice { kind, simulations, .. },
            foresight,
            prior,
            particles,
            max_steps,
        } = &mut self.effort;
        match option {
            "--seconds" => self.form.steps = Some(steps_of(value)?),
            "--starts" => self.form.starts = Starts::ALL.into_iter().find(|it| it.name() == value)?,
            "--size" => self.form.size = value.parse().ok()?,
            "--palette" => self.form.palette = value.into(),
            "--frame-rate" => self.form.frame_rate = value.parse().ok()?,
            "--preset" => self.preset = value.into(),
            "--events" => self.events = Some(number(&EVENTS, value)? as usize),
            "--seed" => self.seed = Some(value.parse().ok()?),
            "--date-published" => self.date_published = Some(value.into()),
            "--engine" => *engine = Some(Engine::named(value)?),
            "--minds" => *kind = Some(MindKind::ALL.into_iter().find(|kind| kind.name() == value)?),
            "--foresight" => *foresight = Some(Foresight::ALL.into_iter().find(|it| it.name() == value)?),
            "--prior" => *prior = Some(Prior::ALL.into_iter().find(|it| it.name() == value)?),
            "--particles" => *particles = Some(number(&PARTICLES, value)?),
            "--simulations" => *simulations = Some(number(&SIMULATIONS, value)?),
            "--max-steps" => *max_steps = Some(number(&EVENT_STEPS, value)?),
            _ => return None,
        }
        Some(())
    }
}

/// The number of steps in a time of video, given in seconds; `None` unless that is 1 to 2500, and a whole
/// number of steps.
#[must_use]
pub fn steps_of(seconds: &str) -> Option<u32> {
    let steps = seconds.parse::<f64>().ok().filter(|seconds| *seconds >= 1.0)? / STEP_VIDEO_SECONDS;
    EVENT_STEPS.check(steps).is_ok().then_some(steps as u32)
}

/// A number in the range of a setting.
fn number(setting: &Setting, text: &str) -> Option<u32> {
    text.parse().ok().filter(|number| setting.check(f64::from(*number)).is_ok())
}

#[cfg(test)]
mod tests {
    use super::Generation;

    #[test]
    fn a_command_is_followed_exactly_as_it_was_written() {
        let plain = "phase gen-dataset --preset demo --events 12 --seed 7";
        let every = "phase gen-dataset --preset demo --events 2 --seed 1 --engine forward --minds published --one-way-turns \
                     --foresight exact --prior network --particles 4 --simulations 20 --max-steps 6 --starts grid --seconds 7.5 --size 600 --palette accessible --frame-rate 60 --no-video --date-published 2026-11-23";
        for command in [plain, every] {
            let generation = Generation::of_command(command).expect(command);
            let events = generation.events.expect("events");
            let seed = generation.seed.expect("a seed");
            assert_eq!(generation.command(events, seed), command);
        }
        for command in [
            "phase gen-dataset --preset demo --events 12",
            "phase gen-dataset --seed 7 --preset demo --events 12",
            "phase gen-dataset --preset demo --events 12 --seed 7 --seed 7",
            "phase gen-dataset --preset demo --events 12 --seed 7 --particles 0",
            "phase gen-dataset --preset demo --events 12 --seed 7 --jobs 2",
            "phase gen-dataset --preset demo --events 12 --seed",
            "rm --preset demo --events 12 --seed 7",
        ] {
            assert_eq!(Generation::of_command(command), None, "{command}");
        }
    }
}
