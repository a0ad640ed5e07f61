//! `eval`: how well a method perceives events.

pub mod options;

use crate::{context::Context, error::CliError, interrupt, output::print_result};
use options::Eval;
use phase_files::{json, shown, told};
use phase_model::{AgentId, RelationProbabilities};
use phase_render::PaletteName;
use phase_runs::{
    eval::{
        Answered, Answers, Evaluated, Evaluation, REPORT_FILE,
        compare::{self, MEASURES},
        networks,
    },
    words,
};
use serde_json::{Value, json};
use std::path::Path;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Eval, context: &Context) -> Result<(), CliError> {
    let answers = Answers::from(arguments);
    if let Answers::Method { name, .. } = &answers
        && networks::is_network(name)
    {
        require_networks(context)?;
    }
    let common = arguments.common();
    common.json.check(arguments.inputs())?;
    // Before the work.
    let others = arguments.compare().iter().map(|file| Ok((file.as_path(), json::read(file)?)));
    let others: Others<'_> = others.collect::<Result<_, CliError>>()?;
    interrupt::listen();
    let evaluation = Evaluation::from(arguments);
    match arguments {
        Eval::Goals(_) => match evaluation.unlabelled()? {
            Some(_) if !others.is_empty() => {
                let file = evaluation.events.display();
                Err(CliError::Usage(format!("{file}: has no labels, which --compare needs")))
            }
            Some(events) => {
                let (answered, file) = evaluation.answers(&answers, &events, context)?;
                common.json.print(&json!({ "events": answered }), answers_text(&answered, &file))
            }
            None => announce(evaluation.goals(&answers, context)?, arguments, &others),
        },
        Eval::Beliefs(options) => {
            announce(evaluation.beliefs(&answers, options.order(), context)?, arguments, &others)
        }
        Eval::Intents(_) => announce(evaluation.intents(&answers, context)?, arguments, &others),
        Eval::Trajectories(_) => announce(evaluation.trajectories(&answers, context)?, arguments, &others),
    }
}

/// A method's answers to events without labels: the likeliest goals and relation of each.
fn answers_text(answered: &[Answered], file: &Path) -> String {
    let names = PaletteName::default().palette().names;
    let mut text = String::new();
    for Answered { id, answer, details, not_judged, .. } in answered {
        text += &format!("{id}:\n");
        for (agent, goals) in AgentId::ALL.into_iter().zip(&answer.goals) {
            if let Some(likeliest) = goals.first() {
                text += &format!(
                    "  {:.2} the {} {}\n",
                    likeliest.p,
                    names.agents[agent],
                    names.wants(likeliest.goal, agent)
                );
            }
        }
        let RelationProbabilities { friendly, adversarial, neutral } = answer.relation;
        text += &format!("  friendly {friendly:.2}, adversarial {adversarial:.2}, neutral {neutral:.2}\n");
        not_judged.iter().for_each(|sentence| text += &format!("  {sentence}\n"));
        if let Some(explained) = details["motion"]["explained"].as_f64() {
            let error = details["motion"]["error"].as_f64().unwrap_or_default();
            text += &format!(
                "  PHASE's physics explains {:.0} % of the steps (median error {error:.3} u){}\n",
                100.0 * explained,
                if details["motion"]["foreign"] == true {
                    ": the answer is that of the intent network and of distances, without simulations"
                } else {
                    ""
                }
            );
        }
    }
    format!("{text}\nno labels, so nothing is scored; answers in {}", file.display())
}

/// Checks that this program has networks.
///
/// # Errors
/// [`CliError::NotBuilt`].
pub(crate) const fn require_networks(context: &Context) -> Result<(), CliError> {
    if networks::INCLUDED {
        return Ok(());
    }
    Err(CliError::NotBuilt { part: "neural networks", hint: context.program.networks_hint })
}

/// Results of other methods, with their files.
type Others<'a> = Vec<(&'a Path, Value)>;

/// Prints the table and comparisons, writes the results to the other requested places, and says where the
/// report is.
fn announce<A>(done: Option<Evaluated<A>>, arguments: &Eval, others: &Others<'_>) -> Result<(), CliError> {
    let Some(done) = done else {
        return print_result(
            "this part is done; give the same command with --merge and the folders of all parts",
        );
    };
    let folder = &done.folder;
    let line = if done.is_new {
        format!("{}; report in {}", words::events(done.events.len()), folder.join(REPORT_FILE).display())
    } else {
        format!("{} holds this evaluation already", folder.display())
    };
    let mut text = format!("{}\n", done.document.first_table().trim_end());
    let mut results = done.results;
    let seed = arguments.common().seed;
    let mut comparison = Vec::new();
    for (file, other) in others {
        let difference = compare::difference(arguments.task(), results.clone(), other.clone(), seed)
            .map_err(|rule| CliError::Usage(format!("--compare: {}: {rule}", shown(file))))?;
        text += &format!("less {}: {}\n", shown(file), sentence(arguments.task(), &difference));
        comparison.push(json!({ "results": told(file), "difference": difference }));
    }
    if !comparison.is_empty() {
        results["comparison"] = comparison.into();
    }
    arguments.common().json.print(&results, text + &line)
}

/// Differences with their intervals.
fn sentence(task: &str, difference: &Value) -> String {
    let measures = MEASURES.iter().filter(|(of, _)| *of == task).flat_map(|(_, names)| names);
    let number = |measure: &str, part: &str| difference[measure][part].as_f64().unwrap_or(f64::NAN);
    let one = |measure: &&str| {
        let [value, low, high] = ["value", "low", "high"].map(|part| number(measure, part));
        format!("{measure} {value:+.3} [{low:+.3}, {high:+.3}]")
    };
    measures.map(one).collect::<Vec<_>>().join(", ")
}
