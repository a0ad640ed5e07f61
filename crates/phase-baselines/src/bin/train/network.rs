//! Training a network of the baselines: epoch by epoch, each kept, so that the same command goes on after a break.

use crate::{Options, error::TrainError, events::Dataset, remark, tell};
use phase_baselines::training::{
    Epoch, Measure, Network, Published, Run, Settings, TensorsError, measure, to_safetensors,
};
use phase_dataset::{
    atomic,
    checksum::{hexadecimal, sha256},
    json,
    phase_events::Recording,
    splits::Split,
};
use phase_model::ObservedEvent;
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    time::Instant,
};

/// Trains a network on what `sample` makes of events.
///
/// # Errors
/// If the dataset cannot be used, nothing can be learnt or a file cannot be written.
pub(crate) fn run<N: Published>(
    options: &Options,
    settings: Settings,
    sample: impl Fn(&Recording, &ObservedEvent) -> Result<N::Sample, TrainError>,
) -> Result<(), TrainError> {
    let dataset = Dataset::open(&options.data)?;
    let samples = |split| -> Result<Vec<N::Sample>, TrainError> {
        let each = |recording: Result<Recording, TrainError>| {
            let recording = recording?;
            let observed = recording
                .observed()
                .map_err(|source| TrainError::Observed { id: recording.id.clone(), source })?;
            sample(&recording, &observed)
        };
        dataset.events(split)?.map(each).collect()
    };
    let (training, validation) = (samples(Split::Train)?, samples(Split::Validation)?);
    let network = N::published(&mut Run::<N>::first_weights(options.seed)).map_err(TensorsError::from)?;
    let mut run = Run::new(network, options.seed, settings);
    let data = hexadecimal(&sha256(dataset.id().as_bytes()));
    let kept = beside(&options.out, ".checkpoint");
    go_on(&mut run, &kept, &data)?;

    remark(head(N::SCORES));
    run.epochs().iter().for_each(|epoch| remark(line(epoch)));
    while !run.is_finished() {
        let begun = Instant::now();
        let said = line(run.epoch(&training, &validation)?);
        let seconds = begun.elapsed().as_secs_f64();
        let left = (settings.epochs - run.epochs().len()) as f64 * seconds / 60.0;
        remark(format!("{said}  {seconds:.1} s, at most {left:.0} min left"));
        // What is kept is what the next epoch depends on; whoever breaks off loses the epoch at work.
        keep(&run, &kept, &data)?;
        atomic::write(&beside(&options.out, ".curves.csv"), curves(run.epochs(), N::SCORES).as_bytes())?;
    }
    let best = run.best_epoch().map_or(0, |epoch| epoch.number);
    let network = run.into_best().map_err(TensorsError::from)?;
    atomic::write(&options.out, &to_safetensors(&network)?)?;
    atomic::remove(&kept)?;

    tell(format!("the weights are those of epoch {best}"));
    tell(format!("| events | loss | {} |", N::SCORES.join(" | ")));
    tell(format!("|---|---|{}", "---|".repeat(N::SCORES.len())));
    let report = |split: Split, samples: &[N::Sample]| -> Result<(), TrainError> {
        let Measure { loss, scores } =
            measure(&network, samples, settings.batch).map_err(TensorsError::from)?;
        let scores: Vec<String> = scores.iter().map(|score| format!("{score:.3}")).collect();
        tell(format!("| {} | {loss:.3} | {} |", split.name(), scores.join(" | ")));
        Ok(())
    };
    report(Split::Train, &training)?;
    report(Split::Validation, &validation)?;
    if options.test {
        report(Split::Test, &samples(Split::Test)?)?;
    }
    Ok(())
}

/// Takes up a training that was broken off, or keeps the new one: where nothing can be written is to be known before
/// the work.
fn go_on<N: Network>(run: &mut Run<N>, kept: &Path, data: &str) -> Result<(), TrainError> {
    if !kept.exists() {
        return keep(run, kept, data);
    }
    let file = kept.to_owned();
    run.resume(&json::bytes(kept)?, data).map_err(|source| TrainError::Checkpoint { file, source })?;
    remark(format!("going on after epoch {}", run.epochs().len()));
    Ok(())
}

fn keep<N: Network>(run: &Run<N>, kept: &Path, data: &str) -> Result<(), TrainError> {
    let file = kept.to_owned();
    let bytes = run.checkpoint(data).map_err(|source| TrainError::Checkpoint { file, source })?;
    Ok(atomic::write(kept, &bytes)?)
}

/// A file beside another, with something after its whole name.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ending);
    name.into()
}

fn head(scores: &[&str]) -> String {
    let columns: String = scores.iter().map(|score| format!(" {score:>9}")).collect();
    format!("epoch      train{columns}   validation{columns}")
}

fn line(epoch: &Epoch) -> String {
    let measure = |Measure { loss, scores }: &Measure| -> String {
        let scores: String = scores.iter().map(|score| format!(" {score:9.3}")).collect();
        format!("{loss:10.4}{scores}")
    };
    let star = if epoch.best { "*" } else { " " };
    format!("{:5} {} {:>12}{star}", epoch.number, measure(&epoch.training), measure(&epoch.validation))
}

fn curves(epochs: &[Epoch], scores: &[&str]) -> String {
    let columns = |part: &str| -> String {
        core::iter::once("loss").chain(scores.iter().copied()).map(|name| format!(",{part}_{name}")).collect()
    };
    let numbers = |Measure { loss, scores }: &Measure| -> String {
        core::iter::once(loss).chain(scores).map(|number| format!(",{number}")).collect()
    };
    let mut text = format!("epoch{}{},best\n", columns("train"), columns("validation"));
    for epoch in epochs {
        let (training, validation) = (numbers(&epoch.training), numbers(&epoch.validation));
        text += &format!("{}{training}{validation},{}\n", epoch.number, u8::from(epoch.best));
    }
    text
}
