//! The interface between a run and the program that started it: notes, details and progress.

/// Hears from a run while it works. All methods do nothing unless they are implemented.
///
/// A run calls it from several threads. [`Silent`] hears nothing; the program `phase` prints on stderr.
pub trait Listener: Sync {
    /// Something that everybody should know, such as a warning about an event, in one line without its end.
    fn note(&self, _line: &str) {}

    /// A detail, such as why a scene was rejected, in one line without its end.
    fn detail(&self, _line: &str) {}

    /// Work begins. The returned value is told what is done of it, and dropped at its end.
    fn begin(&self, _work: &Work<'_>) -> Box<dyn Progress> {
        Box::new(Silent)
    }
}

impl dyn Listener + '_ {
    /// Work on events that take at most `steps_each` steps each begins.
    pub(crate) fn progress(&self, activity: &str, events: usize, steps_each: usize) -> Box<dyn Progress> {
        self.begin(&Work { activity, events, steps: events * steps_each, steps_each })
    }

    /// Work of a number of steps that do not belong to a particular event begins.
    pub(crate) fn progress_over(&self, activity: &str, steps: usize) -> Box<dyn Progress> {
        self.begin(&Work { activity, events: 0, steps, steps_each: 0 })
    }
}

/// A piece of work that takes its time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Work<'a> {
    /// A description, such as `simulating 12 events`.
    pub activity: &'a str,
    /// Events that it consists of and that are reported one by one with [`Progress::event`]; 0 if it is
    /// counted in steps alone.
    pub events: usize,
    /// Its amount (steps).
    pub steps: usize,
    /// Most steps of one event.
    pub steps_each: usize,
}

/// Hears how far a piece of work has come. All methods do nothing unless they are implemented.
pub trait Progress: Send + Sync {
    /// A number of steps is done.
    fn steps(&self, _count: usize) {}

    /// An event is done; `counted` of its steps were reported with [`Progress::steps`]; `line` describes it.
    fn event(&self, _counted: usize, _line: &str) {}

    /// A scene was simulated, and does not show what it is to show: another one is tried.
    fn tried(&self) {}
}

/// Hears nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Silent;

impl Listener for Silent {}

impl Progress for Silent {}
