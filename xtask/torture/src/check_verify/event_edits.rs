//! Edits of events, and of what is the same in all of them.

use super::{
    edit::{alter, alter_member, space},
    folder::{EditedCopy, Original, failed},
    kinds::Made,
};
use crate::error::TortureError;
use phase_dataset::{
    manifest::{CARD_FILE, event_path, video_path},
    splits::Split,
};
use phase_event::{Recording, SimulationRecord, Step, to_json};
use phase_model::{Subgoal, random::Pcg64Mcg};
use phase_runs::{error::RunError, event_writer::video, picture::Look};
use phase_sampler::Variant;
use rand::{
    RngExt,
    seq::{IndexedMutRandom, IndexedRandom, IteratorRandom, SliceRandom},
};
use serde_json::Value;
use std::fs;

pub(super) fn in_event(
    copy: &EditedCopy,
    random: &mut Pcg64Mcg,
    change: impl FnOnce(&str, &mut Pcg64Mcg) -> Option<String>,
) -> Made {
    let Some(entry) = copy.some_event(random) else { return Ok(false) };
    let name = event_path(&entry.id);
    let text = String::from_utf8_lossy(&copy.read(&name)?).into_owned();
    let Some(changed) = change(&text, random) else { return Ok(false) };
    copy.write(&name, changed.as_bytes()).map(|()| true)
}

pub(super) fn white_space(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    in_event(copy, random, |text, random| {
        let mut text = text.to_owned();
        space(&mut text, random).then_some(text)
    })
}

pub(super) fn comment(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    in_event(copy, random, |text, _| Some(text.replacen("\"format\"", "\"_comment\":\"\",\"format\"", 1)))
}

/// Changes a member of an event. The file is then written as PHASE writes it, if the event can still be read.
pub(super) fn member(copy: &EditedCopy, random: &mut Pcg64Mcg, member: &str) -> Made {
    in_event(copy, random, |text, random| {
        let changed = alter_member(text, member, random)?;
        let Some(recording) = phase_event::from_json(&changed).ok().and_then(|mut read| read.pop()) else {
            return Some(changed);
        };
        to_json(&[recording]).ok()
    })
}

pub(super) fn one_of(copy: &EditedCopy, random: &mut Pcg64Mcg, members: &[&str]) -> Made {
    let name = members.choose(random).copied().unwrap_or_default();
    member(copy, random, name)
}

pub(super) fn subgoals(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    one_of(copy, random, &["subgoals", "values"])
}

/// Lets an agent pursue another subgoal in one step, with the value that its thoughts give it.
pub(super) fn pursued(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Some(entry) = copy.some_event(random).cloned() else { return Ok(false) };
    let Some(mut simulation) = copy.recording(&entry)?.simulation else { return Ok(false) };
    let Some(step) = simulation.event.steps.choose_mut(random) else { return Ok(false) };
    let Some(thought) = step.thoughts.choose_mut(random) else { return Ok(false) };
    let proposed = thought.subgoals.iter().map(|proposed| proposed.subgoal).chain([Subgoal::Stay]);
    let Some(other) = proposed.filter(|&other| other != thought.subgoal).choose(random) else {
        return Ok(false);
    };
    thought.subgoal = other;
    write_event(copy, &entry.id, simulation).map(|()| true)
}

pub(super) fn labels(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    one_of(copy, random, &["layout", "agents", "objects", "event", "relation", "recorded_steps", "row_0"])
}

/// Changes every event.
pub(super) fn in_all(copy: &EditedCopy, change: impl Fn(&mut SimulationRecord)) -> Made {
    for entry in &copy.manifest.events {
        let recording = copy.recording(entry)?;
        let Some(mut simulation) = recording.simulation else { return Ok(false) };
        change(&mut simulation);
        write_event(copy, &entry.id, simulation)?;
    }
    Ok(true)
}

pub(super) fn write_event(
    copy: &EditedCopy,
    id: &str,
    simulation: SimulationRecord,
) -> Result<(), TortureError> {
    let SimulationRecord { event, generator, settings } = simulation;
    let text = to_json(&[Recording::of_event(id, event, generator, settings)]);
    copy.write(&event_path(id), text.map_err(RunError::from)?.as_bytes())
}

pub(super) fn generator_everywhere(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let generator = format!("phase 0.{}.{}", random.random_range(0..9), random.random_range(1..99));
    copy.manifest.generator.clone_from(&generator);
    in_all(copy, |simulation| simulation.generator.clone_from(&generator))
}

pub(super) fn settings_everywhere(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let mut settings = copy.manifest.settings.clone();
    if !alter(&mut settings, random) {
        return Ok(false);
    }
    let lengths = |key: &str, own: &Value| {
        if settings[key] == copy.manifest.settings[key] { own[key].clone() } else { settings[key].clone() }
    };
    let done = in_all(copy, |simulation| {
        let own = simulation.settings.clone();
        simulation.settings = settings.clone();
        for key in ["min_steps", "max_steps"] {
            simulation.settings[key] = lengths(key, &own);
        }
    });
    copy.manifest.settings = settings.clone();
    done
}

pub(super) fn dataset_seed(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let before = copy.manifest.seed;
    let now = random.random_range(100..1000);
    copy.manifest.seed = now;
    // In the command, too.
    let card = String::from_utf8_lossy(&copy.read(CARD_FILE)?).into_owned();
    let card = card.replace(&format!("--seed {before} "), &format!("--seed {now} "));
    copy.write(CARD_FILE, card.as_bytes()).map(|()| true)
}

pub(super) fn split(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Some(entry) = copy.manifest.events.choose_mut(random) else { return Ok(false) };
    entry.split = Split::ALL.choose(random).copied();
    Ok(true)
}

pub(super) fn variant(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Some(entry) = copy.manifest.events.choose_mut(random) else { return Ok(false) };
    entry.variant = Variant::ALL.choose(random).copied();
    Ok(true)
}

/// Changes the steps of an event, and draws the video again.
fn steps_with_video(
    copy: &EditedCopy,
    random: &mut Pcg64Mcg,
    change: impl FnOnce(&mut Vec<Step>, &mut Pcg64Mcg) -> Option<()>,
) -> Made {
    let Some(entry) = copy.some_event(random) else { return Ok(false) };
    let Some(mut simulation) = copy.recording(entry)?.simulation else { return Ok(false) };
    if change(&mut simulation.event.steps, random).is_none() {
        return Ok(false);
    }
    copy.write(&video_path(&entry.id), &video(&entry.id, &simulation.event, &Look::default())?)?;
    write_event(copy, &entry.id, simulation).map(|()| true)
}

/// Moves something in one frame.
pub(super) fn substeps_with_video(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    steps_with_video(copy, random, |steps, random| {
        let state = steps.choose_mut(random)?.substeps.choose_mut(random)?;
        state.bodies[random.random_range(0..2)].position.x = random.random_range(8.0..24.0);
        Some(())
    })
}

pub(super) fn last_step(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    steps_with_video(copy, random, |steps, _| steps.pop().map(|_| ()))
}

pub(super) fn events_exchanged(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Some((one, other)) = copy.two_events(random) else { return Ok(false) };
    let entries = [one, other].map(|k| copy.manifest.events[k].clone());
    let [first, second] = entries.each_ref().map(|entry| copy.recording(entry).map(|it| it.simulation));
    let (Some(first), Some(second)) = (first?, second?) else { return Ok(false) };
    write_event(copy, &entries[0].id, second)?;
    write_event(copy, &entries[1].id, first)?;
    copy.exchange(&video_path(&entries[0].id), &video_path(&entries[1].id))?;
    let [first, second] = entries;
    (copy.manifest.events[one].variant, copy.manifest.events[one].split) = (second.variant, second.split);
    (copy.manifest.events[other].variant, copy.manifest.events[other].split) = (first.variant, first.split);
    Ok(true)
}

pub(super) fn order(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    copy.manifest.events.shuffle(random);
    Ok(true)
}

/// An event of the other dataset under the name of one of this, with its own seed and video.
pub(super) fn other_event(copy: &mut EditedCopy, random: &mut Pcg64Mcg, original: &Original) -> Made {
    let Some(entry) = copy.some_event(random) else { return Ok(false) };
    for name in [event_path(&entry.id), video_path(&entry.id)] {
        let path = original.other().join(&name);
        let bytes = fs::read(&path).map_err(|source| failed(&path, "read the file", source))?;
        copy.write(&name, &bytes)?;
    }
    Ok(true)
}

/// A date of publication where there was none, in the command, too.
pub(super) fn date(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let date = format!("2026-{:02}-{:02}", random.random_range(1..=12), random.random_range(1..=28));
    let card = String::from_utf8_lossy(&copy.read(CARD_FILE)?).into_owned();
    let mut lines: Vec<String> = card.lines().map(String::from).collect();
    for line in lines.iter_mut().filter(|line| line.starts_with("phase gen-dataset ")) {
        *line += &format!(" --date-published {date}");
    }
    copy.manifest.date_published = Some(date);
    copy.write(CARD_FILE, format!("{}\n", lines.join("\n")).as_bytes()).map(|()| true)
}
