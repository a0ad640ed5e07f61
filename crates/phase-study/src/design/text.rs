//! A configuration as text, laid out for people.

use super::{Design, Experiment};
use crate::config::{MINUTES, PARAMETERS, STUDY_FORMAT, Stimulus};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// The text of a file.
pub(super) fn file(design: &Design) -> String {
    let numbers = design.numbers();
    let stimuli: Vec<Value> = design.stimuli.iter().map(stimulus).collect();
    let catch_trials = design.catch_trials.iter().map(|trial| {
        let expected =
            trial.expected.iter().map(|(question, choices)| (question.clone(), one_or_more(choices)));
        let expected: Map<String, Value> = expected.collect();
        json!({"id": trial.id, "video": trial.video, "objects": trial.objects, "expected": expected})
    });
    let members: Vec<(&str, String)> = vec![
        ("format", line(&json!(STUDY_FORMAT))),
        ("_comment", lines(comments().into_iter().map(Value::from))),
        ("name", line(&json!(design.name.as_deref().unwrap_or(design.experiment.name())))),
        ("title", line(&json!(title(design.experiment)))),
        ("form", line(&json!(design.experiment.form().name()))),
        ("introduction", lines(introduction().into_iter().map(Value::from))),
        ("consent", lines(consent().into_iter().map(Value::from))),
        ("instructions", lines(instructions(design.experiment).into_iter().map(Value::from))),
        ("demographics", "[]".into()),
        ("raters_per_video", numbers.raters_per_video.to_string()),
        ("raters_per_video_at_most", numbers.raters_per_video_at_most.to_string()),
        ("videos_per_rater", numbers.videos_per_rater.to_string()),
        ("raters", numbers.raters.to_string()),
        ("between_sources", design.between_sources().to_string()),
        ("one_of_each_set", design.one_of_each_set.to_string()),
        ("answer_before_end", "false".into()),
        ("minutes", MINUTES.to_string()),
        ("parameters", line(&json!(PARAMETERS))),
        ("identity_required", "false".into()),
        ("completion", line(&json!({"code": null, "url": null}))),
        ("seed", design.seed.to_string()),
        ("catch_failures_allowed", "0".into()),
        ("catch_trials", lines(catch_trials)),
        ("stimuli", lines(stimuli.into_iter())),
    ];
    let members: Vec<String> =
        members.into_iter().map(|(name, value)| format!("\"{name}\": {value}")).collect();
    format!("{{\n{}\n}}\n", members.join(",\n"))
}

fn line(value: &Value) -> String {
    value.to_string()
}

/// A list with each item on a line of its own.
fn lines(items: impl Iterator<Item = Value>) -> String {
    let items: Vec<String> = items.map(|item| format!("  {item}")).collect();
    if items.is_empty() { "[]".into() } else { format!("[\n{}\n]", items.join(",\n")) }
}

fn one_or_more(choices: &BTreeSet<String>) -> Value {
    let mut all = choices.iter();
    match (all.next(), all.next()) {
        (Some(only), None) => json!(only),
        _ => json!(choices),
    }
}

fn stimulus(stimulus: &Stimulus) -> Value {
    let mut value = json!({
        "id": stimulus.id, "video": stimulus.video, "source": stimulus.source, "objects": stimulus.objects,
    });
    if let Some(goals) = &stimulus.labels.goals {
        value["goals"] = goals.iter().map(one_or_more).collect();
    }
    for (name, label) in [
        ("set", &stimulus.set),
        ("condition", &stimulus.condition),
        ("relation", &stimulus.labels.relation),
        ("kind", &stimulus.labels.kind),
    ] {
        if let Some(label) = label {
            value[name] = json!(label);
        }
    }
    value
}

const fn title(experiment: Experiment) -> &'static str {
    match experiment {
        Experiment::Interactions => "What happens in these videos?",
        Experiment::HumanLikeness => "What do they want, and would people do the same?",
        Experiment::Relations => "What is the relationship between these two?",
    }
}

fn comments() -> Vec<&'static str> {
    vec![
        "Edit this file, then: phase study check FILE. Members whose names begin with _ are ignored; docs/reference/formats/studies.md describes all others.",
        "Texts: lists of paragraphs, plain text. Replace what stands in [brackets]; the texts of introduction and consent are examples, not \
         what your ethics board wants.",
        "demographics: nothing is asked unless it is here. A question is {name, text, kind, required}: kind whole (from, to), one (choices) or \
         text (longest).",
        "Each video is wanted by raters_per_video raters and gets no more than raters_per_video_at_most. The study is full when raters have \
         finished. A rater who gives no sign for this many minutes loses their places to others.",
        "one_of_each_set: whether a rater sees no two videos of a set. answer_before_end: whether a rater may answer before the video has ended.",
        "parameters: members of the address that are kept, such as Prolific's.",
        "completion: a code, and an https address, shown at the end. With Prolific: https://app.prolific.com/submissions/complete?cc=CODE.",
        "catch_trials: {id, video, objects, expected}, such as expected {\"relation\": \"neutral\"}. Raters who fail more than \
         catch_failures_allowed do not count.",
        "stimuli: video is relative to this file; condition is what the report compares; goals, relation and kind are the right answers. Raters \
         see none of these.",
    ]
}

fn introduction() -> Vec<&'static str> {
    vec![
        "You will watch short animations of two simple shapes, a red and a green agent, and answer questions about them. [State who is \
         responsible for the study, how long it takes, and what participants are paid.]",
    ]
}

fn consent() -> Vec<&'static str> {
    vec![
        "Taking part is voluntary. You can withdraw at any time with the button at the bottom of the page; your answers are then deleted. \
         [State whom to contact, and the approval of your ethics board.]",
        "Your answers are stored without your name. If you came here from a recruiting service, the identifiers in the address are stored with \
         them. [State how long data is kept and who will see it.]",
        "Do you agree to take part?",
    ]
}

fn instructions(experiment: Experiment) -> Vec<&'static str> {
    let mut all = vec![
        "Each animation shows a red and a green agent seen from above. They can push and turn, and they can take hold of and carry the round \
         objects. Coloured squares are places that an agent may want to be at, or to bring an object to. Black lines are \
         walls. Each agent sees only what is in front of it.",
        "Watch each animation to its end; you can watch it again as often as you like. Then answer.",
    ];
    all.push(match experiment {
        Experiment::Interactions => "Choose every description that fits what the two do. Several may fit.",
        Experiment::HumanLikeness => {
            "Say what each of them wants, how they relate to each other, and how likely people would be to move like this if they had these \
             goals."
        }
        Experiment::Relations => {
            "Say how the two relate to each other: friendly if one helps the other or they work together, adversarial if one hinders the other \
             or they work against each other, neutral otherwise."
        }
    });
    all
}
