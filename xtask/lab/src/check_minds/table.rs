//! A report for people.

use super::{figures::MindFigures, report::MindsReport};

/// A column: its heading, and its text for a row.
type Column = (&'static str, fn(&MindFigures) -> String);

/// A row: its name, and its text for each column.
type Row = (&'static str, Vec<String>);

/// Columns about choices of minds.
const MINDS: [Column; 9] = [
    ("events", |it| it.events.to_string()),
    ("decisions", |it| it.decisions.to_string()),
    ("chance", |it| number(it.choice_probability, 3)),
    ("ll", |it| number(it.log_likelihood_per_step, 3)),
    ("ll .05", |it| number(it.log_likelihood_lapse_05, 3)),
    ("explained", |it| number(it.explained.explained_share, 3)),
    ("chance ex", |it| number(it.explained.choice_probability_explained, 3)),
    ("ll ex", |it| number(it.explained.log_likelihood_per_step_explained, 3)),
    ("stray", |it| beside(it.stray_per_step, it.stray_of_both_per_step, 2)),
];

/// The open loop beside the recordings.
const OPEN_LOOP: [Column; 12] = [
    ("goals", |it| it.open_loop.goals.to_string()),
    ("as recorded", |it| number(it.open_loop.outcomes_as_recorded, 2)),
    ("each other", |it| number(it.open_loop.outcomes_as_each_other, 2)),
    ("any time", |it| number(it.open_loop.outcomes_at_any_time, 2)),
    ("ratio", |it| number(it.open_loop.path_ratio, 2)),
    ("path", |it| beside(it.open_loop.path, it.open_loop.path_recorded, 1)),
    ("speed", |it| beside(it.open_loop.speed, it.open_loop.speed_recorded, 1)),
    ("still", |it| beside(it.open_loop.still_share, it.open_loop.still_share_recorded, 2)),
    ("contact", |it| beside(it.open_loop.contact_share, it.open_loop.contact_share_recorded, 2)),
    ("together", |it| number(it.open_loop.steps_together, 0)),
    ("distance", |it| number(it.open_loop.distance, 2)),
    ("longest still", |it| {
        let own = &it.open_loop;
        beside(own.longest_still_with_open_goal, own.longest_still_with_open_goal_recorded, 1)
    }),
];

/// The cost of the open loop.
const COST: [Column; 2] = [
    ("cpu", |it| number(it.open_loop.cpu_seconds_per_100_steps, 2)),
    ("cpu max", |it| number(it.open_loop.cpu_seconds_per_100_steps_max, 2)),
];

/// The tables of a report.
pub(super) fn print(report: &MindsReport) -> String {
    let open_loop: Vec<Column> = OPEN_LOOP.into_iter().chain(COST).collect();
    format!(
        "minds under the true goals, attitudes and strengths; fitted lapse {:.3}\n\n{}\n\
         chance: of what was done; ll: its log likelihood (nat a step), with the fitted lapse and with .05;\n\
         explained: share of decisions of which inverse dynamics tells what was done; chance ex, ll ex: of these alone;\n\
         stray: u a step, where one agent decides / both do\n\n\
         the same scenes simulated / recorded\n\n{}\n\
         path, speed: medians (u, u/s); still: share of steps in which nobody moves; contact: share of steps;\n\
         together: median number of steps before a body is 1 u from where it was recorded; distance: mean (u);\n\
         longest still: nobody moves while a positive goal is open (s of video); cpu: seconds for 100 steps\n",
        report.lapse,
        table(report, &MINDS),
        table(report, &open_loop),
    )
}

fn table(report: &MindsReport, columns: &[Column]) -> String {
    let row = |(name, figures): &(&'static str, MindFigures)| (*name, cells(figures, columns));
    let groups: [Vec<Row>; 2] =
        [vec![("all", cells(&report.overall, columns))], report.kinds.iter().map(row).collect()];
    let widths: Vec<usize> = columns
        .iter()
        .enumerate()
        .map(|(k, (heading, _))| {
            let cells = groups.iter().flatten().map(|(_, cells)| cells[k].len());
            cells.chain([heading.len()]).max().unwrap_or(0)
        })
        .collect();
    let line = |name: &str, cells: Vec<&str>| {
        let cells = cells.iter().zip(&widths).map(|(cell, &width)| format!("  {cell:>width$}"));
        format!("{name:<13}{}\n", cells.collect::<String>())
    };
    let mut text = line("", columns.iter().map(|(heading, _)| *heading).collect());
    for (group, what) in groups.iter().zip(["", "kind"]) {
        if !what.is_empty() {
            text += &format!("{what}\n");
        }
        for (name, cells) in group {
            text += &line(name, cells.iter().map(String::as_str).collect());
        }
    }
    text
}

fn cells(figures: &MindFigures, columns: &[Column]) -> Vec<String> {
    columns.iter().map(|(_, text)| text(figures)).collect()
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".into(), |value| format!("{value:.digits$}"))
}

fn beside(ours: Option<f64>, recorded: Option<f64>, digits: usize) -> String {
    format!("{}/{}", number(ours, digits), number(recorded, digits))
}
