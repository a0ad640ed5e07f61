//! How far a run has come: a bar with the time left on a terminal, a line for each event elsewhere.

use crate::console::remark;
use indicatif::{ProgressBar, ProgressStyle};
use std::{
    io::IsTerminal,
    sync::atomic::{AtomicUsize, Ordering},
    time::Duration,
};

/// Progress over events that take a known greatest number of steps each. Goes to stderr.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    events: usize,
    steps_each: usize,
    finished: AtomicUsize,
}

impl Progress {
    /// Nothing done yet.
    #[must_use]
    pub fn new(events: usize, steps_each: usize) -> Self {
        let mut progress = Self::over(events * steps_each, events);
        progress.steps_each = steps_each;
        progress
    }

    /// Nothing done yet of so many steps that belong to no event in particular.
    #[must_use]
    pub fn over(steps: usize, events: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(steps as u64);
            let style = ProgressStyle::with_template(
                "{bar:30} {percent:>3} % of {msg} · {elapsed} gone, about {eta} left",
            );
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_message(format!("{events} events"));
            bar.enable_steady_tick(Duration::from_millis(500));
            bar
        });
        Self { bar, events, steps_each: 0, finished: AtomicUsize::new(0) }
    }

    /// One step of some event is done.
    pub fn step(&self) {
        self.steps(1);
    }

    /// So many steps are done.
    pub fn steps(&self, count: usize) {
        if let Some(bar) = &self.bar {
            bar.inc(count as u64);
        }
    }

    /// An event is done. `counted` of its steps were reported with [`Progress::step`]; `line` says what it is.
    pub fn event(&self, counted: usize, line: &str) {
        let number = 1 + self.finished.fetch_add(1, Ordering::Relaxed);
        let text = format!("{number}/{} {line}", self.events);
        match &self.bar {
            Some(bar) => {
                bar.inc(self.steps_each.saturating_sub(counted) as u64);
                bar.println(text);
            }
            None => remark(&text),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
