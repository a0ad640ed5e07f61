//! `study new`: a configuration to start from.

use super::{options::NewStudy, videos};
use crate::{context::Context, error::CliError};
use phase_files::{WriteError, atomic, told};
use phase_study::{
    config::{CatchTrial, Stimulus, StudyConfig},
    design::{Design, Experiment},
    forms::{Form, Forms, INTERACTIONS, RELATION},
};
use serde_json::json;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
};

pub(super) fn run(arguments: &NewStudy, context: &Context) -> Result<(), CliError> {
    let out = &arguments.out;
    if out.exists() {
        return Err(CliError::Usage(format!("--out: {} exists; choose another file", out.display())));
    }
    let named = Experiment::ALL.into_iter().find(|experiment| experiment.name() == arguments.experiment);
    let Some(experiment) = named else {
        return Err(CliError::Usage(format!("--experiment: there is no {}", arguments.experiment)));
    };
    let (mut stimuli, copies) = videos::stimuli(arguments, context)?;
    let mut catch_trials = Vec::new();
    for given in &arguments.catch_trials {
        catch_trials.push(catch_trial(given, experiment.form(), &mut stimuli)?);
    }
    let design = Design {
        experiment,
        stimuli,
        catch_trials,
        name: arguments.name.clone(),
        videos_per_rater: arguments.videos_per_rater,
        one_of_each_set: arguments.one_of_each_set,
        seed: arguments.seed,
    };
    let text = design.to_text();
    // What was put together from options and names of files is read as any other configuration.
    let config = Forms::included().map_err(CliError::Forms).and_then(|forms| {
        StudyConfig::read(text.as_bytes(), &forms)
            .map_err(|source| CliError::Study { file: out.clone(), source: Box::new(source) })
    })?;
    if let Some(folder) = out.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|source| {
            CliError::Output(WriteError { path: folder.to_owned(), action: "create the folder", source })
        })?;
    }
    copies.iter().try_for_each(videos::Copy::make)?;
    if !copies.is_empty() {
        context.note(format!("{} videos copied to {}", copies.len(), out.with_file_name("videos").display()));
    }
    atomic::write(out, text.as_bytes()).map_err(CliError::Output)?;
    let value = json!({
        "file": told(out), "form": config.form.name(), "videos": config.stimuli.len(),
        "catch_trials": config.catch_trials.len(), "raters": config.raters,
        "videos_per_rater": config.videos_per_rater, "raters_per_video": config.raters_per_video,
        "raters_per_video_at_most": config.raters_per_video_at_most,
    });
    let text = format!(
        "{}: {} videos, {} raters who see {} each; edit it, then\n{} study check {}",
        out.display(),
        config.stimuli.len(),
        config.raters,
        config.videos_per_rater,
        context.program.name,
        out.display()
    );
    arguments.output.print(text, &value)
}

/// Takes the video of `ID=ANSWER` from the others.
fn catch_trial(given: &str, form: Form, stimuli: &mut Vec<Stimulus>) -> Result<CatchTrial, CliError> {
    let Some((id, answer)) = given.split_once('=') else {
        return Err(CliError::Usage(format!("--catch {given}: must be ID=ANSWER, such as event-1=neutral")));
    };
    let Some(at) = stimuli.iter().position(|stimulus| stimulus.id == id) else {
        return Err(CliError::Usage(format!("--catch {given}: there is no video of the id {id}")));
    };
    let Stimulus { id, video, objects, .. } = stimuli.remove(at);
    let question = if form == Form::Interactions { INTERACTIONS } else { RELATION };
    let expected = BTreeMap::from([(question.to_owned(), BTreeSet::from([answer.to_owned()]))]);
    Ok(CatchTrial { id, video, objects, expected })
}
