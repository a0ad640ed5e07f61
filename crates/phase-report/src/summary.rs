//! The tables that `simulate` prints.

use phase_dataset::summary::{KindRow, MotionQuartiles, Quartiles};
use phase_model::EventKind;

const OUTCOMES: &str = "outcomes        events   as recorded        own, positive      reached: recorded  \
                        simulated   median steps: recorded  simulated   time ratio  (agents)\n";
const MOTION: &str = "quartiles       speed (u/s): recorded        simulated   path (u): recorded          simulated   \
                      contact (%): recorded      simulated\n";

/// Outcomes and motion of simulations beside those of recordings, a row for each kind of event; each line
/// ended.
#[must_use]
pub fn table(rows: &[KindRow]) -> String {
    let lines = |line: fn(&KindRow) -> String| rows.iter().map(line).collect::<String>();
    format!("{OUTCOMES}{}\n{MOTION}{}", lines(outcomes), lines(motion))
}

fn name(row: &KindRow) -> &'static str {
    row.kind.map_or("all", EventKind::name)
}

fn outcomes(row: &KindRow) -> String {
    let share = |part: usize, of: usize| {
        format!("{part:>3} of {of:>3} {:>4.0} %", 100.0 * part as f64 / of.max(1) as f64)
    };
    let steps = |median: Option<f64>| median.map_or_else(|| "-".into(), |steps| format!("{steps:.1}"));
    format!(
        "{:<14} {:>7}   {}   {}   {:>17} {:>10}   {:>22} {:>10}   {:>10}  {:>8}\n",
        name(row),
        row.events,
        share(row.matched, row.agents),
        share(row.own_matched, row.own_agents),
        row.recorded_reached,
        row.simulated_reached,
        steps(row.recorded_steps),
        steps(row.simulated_steps),
        row.time_ratio.map_or_else(|| "-".into(), |ratio| format!("{:.2}", ratio.median)),
        format!("({})", row.timed),
    )
}

fn motion(row: &KindRow) -> String {
    let three = |quartiles: Option<Quartiles>, scale: f32, digits: usize| {
        quartiles.map_or_else(
            || "-".into(),
            |it| {
                let [a, b, c] = [it.p25, it.median, it.p75].map(|number| scale * number);
                format!("{a:.digits$} / {b:.digits$} / {c:.digits$}")
            },
        )
    };
    let speed = |of: &MotionQuartiles| three(of.speed, 1.0, 1);
    let path = |of: &MotionQuartiles| three(of.path, 1.0, 1);
    let contact = |of: &MotionQuartiles| three(of.contact, 100.0, 0);
    let theirs = &row.recorded_motion;
    let ours = &row.simulated_motion;
    format!(
        "{:<14} {:>22} {:>16}   {:>18} {:>18}   {:>21} {:>14}\n",
        name(row),
        speed(theirs),
        speed(ours),
        path(theirs),
        path(ours),
        contact(theirs),
        contact(ours),
    )
}
