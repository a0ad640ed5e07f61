//! The tables that `simulate` prints.

use phase_dataset::summary::{KindRow, MotionQuartiles, Quartiles};
use phase_model::EventKind;

/// Minimum share of agents with own positive goals whose outcome should be the recorded one.
pub const OWN_SHARE_TARGET: f32 = 0.85;
/// The target range of the median ratio of completion times, simulated to recorded.
pub const TIME_RATIO_TARGET: (f32, f32) = (0.75, 1.33);

const OUTCOMES: &str = "outcomes        events   as recorded        own, positive      reached: recorded  \
                        simulated   median steps: recorded  simulated   time ratio  (agents)\n";
const MOTION: &str = "quartiles       speed (u/s): recorded        simulated   path (u): recorded          simulated   \
                      contact (%): recorded      simulated\n";

/// Both tables and their comparison with the targets, each line ended.
#[must_use]
pub fn table(rows: &[KindRow]) -> String {
    let lines = |line: fn(&KindRow) -> String| rows.iter().map(line).collect::<String>();
    let verdict = rows.last().map(verdict).unwrap_or_default();
    format!("{OUTCOMES}{}\n{MOTION}{}\n{verdict}", lines(outcomes), lines(motion))
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
    let (theirs, ours) = (&row.recorded_motion, &row.simulated_motion);
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

/// Comparison of the row for all kinds with the targets; nothing where there is nothing to judge.
fn verdict(all: &KindRow) -> String {
    let met = |met: bool| if met { "met" } else { "missed" };
    let mut text = String::new();
    if all.own_agents > 0 {
        let share = all.own_matched as f32 / all.own_agents as f32;
        let (percent, target) = (100.0 * share, 100.0 * OWN_SHARE_TARGET);
        let met = met(share >= OWN_SHARE_TARGET);
        text.push_str(&format!(
            "own, positive goals as recorded: {percent:.1} % (target: at least {target:.0} %, {met})\n"
        ));
    }
    if let Some(ratio) = all.time_ratio {
        let (low, high) = TIME_RATIO_TARGET;
        let met = met((low..=high).contains(&ratio.median));
        text.push_str(&format!("time ratio: {:.2} (target: {low} to {high}, {met})\n", ratio.median));
    }
    text
}
