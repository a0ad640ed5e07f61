//! Progress of a run: a bar with the remaining time on a terminal; elsewhere a line for each event, or now
//! and then.

use crate::console::print_message;
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use phase_model::foreign;
use std::{
    fmt::Write,
    io::IsTerminal,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    time::{Duration, Instant},
};

/// The bar. The part that may be cut to the width of the terminal comes last.
const TEMPLATE: &str = "{bar:16} {percent:>3} %{times} · {wide_msg}";
/// Time after which the bar is drawn again while nothing happens.
const TICK: Duration = Duration::from_millis(500);
/// Time between lines where there is no terminal and no event is reported.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// Progress on stderr, from the first moment on: the current activity, and how much of it is done. The bar is
/// cleared when this is dropped, so results must be printed afterwards.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    lines: Option<Lines>,
    quiet: bool,
    events: usize,
    steps_each: usize,
    finished: AtomicUsize,
    activity: String,
    /// Scenes that were tried in vain, and when that was last told.
    tried: AtomicUsize,
    told: Mutex<Instant>,
}

/// Progress by steps, where there is no terminal.
#[derive(Debug)]
struct Lines {
    activity: String,
    steps: usize,
    begun: Instant,
    done: AtomicUsize,
    last: Mutex<Instant>,
}

impl Lines {
    fn new(activity: &str, steps: usize) -> Self {
        let begun = Instant::now();
        let last = Mutex::new(begun);
        Self { activity: activity.to_owned(), steps, begun, done: AtomicUsize::new(0), last }
    }

    fn add(&self, count: usize) {
        let done = count + self.done.fetch_add(count, Ordering::Relaxed);
        // Somebody else is just writing a line, or has failed to.
        let Ok(mut last) = self.last.try_lock() else { return };
        if done < self.steps && last.elapsed() >= BETWEEN_LINES {
            *last = Instant::now();
            print_message(line(&self.activity, done, self.steps, self.begun.elapsed()));
        }
    }
}

/// Text of a line where there is no terminal: how much of `steps` is done, and the time that took and will
/// take.
#[must_use]
pub fn line(activity: &str, done: usize, steps: usize, elapsed: Duration) -> String {
    let share = (done as f64 / steps.max(1) as f64).min(1.0);
    let remaining = (share > 0.0).then(|| elapsed.mul_f64((1.0 - share) / share));
    format!("{activity}: {:.0} %{}", 100.0 * share, times(elapsed, remaining))
}

impl Progress {
    /// Nothing done yet. `activity` describes the work; `steps` is its total amount, of which each of the
    /// `events` is at most `steps_each`.
    #[must_use]
    pub fn new(activity: &str, events: usize, steps: usize, steps_each: usize, quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        if !quiet && !terminal {
            print_message(activity);
        }
        let bar = (!quiet && terminal).then(|| {
            let bar = ProgressBar::new(steps as u64);
            if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
                let write = |state: &ProgressState, text: &mut dyn Write| {
                    let done = state.fraction() >= 1.0;
                    let remaining = (state.pos() > 0 && !done).then(|| state.eta());
                    let _ = text.write_str(&times(state.elapsed(), remaining));
                };
                bar.set_style(style.with_key("times", write));
            }
            bar.set_message(foreign::message(activity).into_owned());
            bar.enable_steady_tick(TICK);
            bar.tick();
            bar
        });
        let lines = (!quiet && !terminal && events == 0).then(|| Lines::new(activity, steps));
        let activity = activity.to_owned();
        let finished = AtomicUsize::new(0);
        let tried = AtomicUsize::new(0);
        let told = Mutex::new(Instant::now());
        Self { bar, lines, quiet, events, steps_each, finished, activity, tried, told }
    }

    /// One step of some event is done.
    pub fn step(&self) {
        self.steps(1);
    }

    /// The given number of steps is done.
    pub fn steps(&self, count: usize) {
        if let Some(bar) = &self.bar {
            bar.inc(count as u64);
        }
        if let Some(lines) = &self.lines {
            lines.add(count);
        }
    }

    /// An event is done. `counted` of its steps were reported with [`Progress::step`]; `line` describes it.
    pub fn event(&self, counted: usize, line: &str) {
        let number = 1 + self.finished.fetch_add(1, Ordering::Relaxed);
        let text = format!("{number}/{} {line}", self.events);
        match &self.bar {
            Some(bar) => {
                bar.inc(self.steps_each.saturating_sub(counted) as u64);
                bar.println(foreign::message(&text));
            }
            None if self.quiet => {}
            None => print_message(&text),
        }
    }
}

impl Progress {
    /// A scene was tried in vain: the bar counts them, and elsewhere a line does, now and then.
    pub fn tried(&self) {
        let tried = 1 + self.tried.fetch_add(1, Ordering::Relaxed);
        if let Some(bar) = &self.bar {
            let activity = foreign::message(&self.activity);
            bar.set_message(format!("{activity}; scenes tried that do not show their label: {tried}"));
        } else if !self.quiet
            && let Ok(mut told) = self.told.try_lock()
            && told.elapsed() >= BETWEEN_LINES
        {
            *told = Instant::now();
            let finished = self.finished.load(Ordering::Relaxed);
            let events = self.events;
            print_message(format!(
                "{}: {finished} of {events} done; scenes tried that do not show their label: {tried}",
                self.activity
            ));
        }
    }
}

impl phase_runs::listener::Progress for Progress {
    fn steps(&self, count: usize) {
        Self::steps(self, count);
    }

    fn event(&self, counted: usize, line: &str) {
        Self::event(self, counted, line);
    }

    fn tried(&self) {
        Self::tried(self);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// The elapsed and the remaining time, as far as known: nothing in the first second, and no remaining time
/// until it can be estimated.
#[must_use]
pub fn times(elapsed: Duration, remaining: Option<Duration>) -> String {
    if elapsed < Duration::from_secs(1) {
        return String::new();
    }
    let remaining = remaining.filter(|remaining| *remaining >= Duration::from_secs(1));
    let remaining = remaining.map_or_else(String::new, |it| format!(", about {} remaining", duration(it)));
    format!(" · {} elapsed{remaining}", duration(elapsed))
}

/// A duration in its two largest units, such as `2 h 5 min`, `3 min 20 s` or `45 s`.
fn duration(duration: Duration) -> String {
    let seconds = duration.as_secs();
    match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds} s"),
        (hours, minutes, _) => format!("{hours} h {minutes} min"),
    }
}
