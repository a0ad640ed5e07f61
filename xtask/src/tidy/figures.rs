//! `tidy --figures`: how much there is of everything, package by package.

use super::{Workspace, scan::Source};

/// A function with more lines is long.
const LONG: usize = 60;
/// Most lines of source: of all packages, and of two that grow easily.
const MOST: [(&str, usize); 3] = [("all", 80_000), ("phase-cli", 6_000), ("xtask", 2_000)];
/// Least lines of tests for a line of source.
const LEAST_TESTS: f64 = 0.4;

const LEGEND: &str = "\
source: lines without tests; ratio: lines of tests for a line of source; median, p90, max: lines of a file; items: public;
doc %: of items; lines: of documentation for an item; panics, tuples: calls that end the program, and `let`s of tuples, in a
thousand lines; long %: functions over 60 lines; lean %: doc comments that do not stand alone. Examples and benches are left out.";

/// The table of all packages, and which goals are met.
pub(super) fn table(workspace: &mut Workspace) -> String {
    let verdict = |is_met: bool| if is_met { "met" } else { "missed" };
    let packages = workspace.all_packages();
    let mut rows: Vec<(&str, Figures)> = Vec::new();
    let mut all: Vec<Source> = Vec::new();
    for package in &packages {
        let first = all.len();
        all.extend(workspace.sources(package).into_iter().filter(|source| !source.is_beside()));
        rows.push((&package.name, Figures::of(&all[first..])));
    }
    rows.push(("all", Figures::of(&all)));
    let titles = rows[0].1.columns().map(|(title, _)| format!("{title:>8}")).concat();
    let mut lines = vec![format!("{:18}{titles}", "package")];
    lines.extend(rows.iter().map(|(name, figures)| {
        let values = figures.columns().map(|(_, value)| format!("{value:>8}")).concat();
        format!("{name:18}{values}")
    }));
    lines.push(format!("\n{LEGEND}\n"));
    for (name, figures) in &rows {
        let found = figures.source();
        for (_, most) in MOST.into_iter().filter(|goal| goal.0 == *name) {
            let verdict = verdict(found <= most);
            lines.push(format!("{name}: {found} lines of source, at most {most}: {verdict}"));
        }
        if *name == "all" {
            let found = share(figures.tests, found);
            let verdict = verdict(found >= LEAST_TESTS);
            lines.push(format!("all: ratio of tests {found:.2}, at least {LEAST_TESTS}: {verdict}"));
        }
    }
    lines.join("\n")
}

fn share(count: usize, of: usize) -> f64 {
    count as f64 / of.max(1) as f64
}

/// Figures of some files.
#[derive(Default)]
struct Figures {
    /// Lines of source of each file, sorted.
    files: Vec<usize>,
    tests: usize,
    /// Lines of documentation of each public item.
    items: Vec<usize>,
    panics: usize,
    /// Lines of each function.
    functions: Vec<usize>,
    tuple_lets: usize,
    /// Of each doc comment, whether it does not stand alone.
    docs: Vec<bool>,
}

impl Figures {
    fn of<'a>(sources: impl IntoIterator<Item = &'a Source>) -> Self {
        let mut figures = Self::default();
        for source in sources {
            let lines = source.source().count();
            figures.files.extend((lines > 0).then_some(lines));
            figures.tests += source.lines().count() - lines;
            figures.items.extend(source.items());
            figures.panics += source.panics();
            figures.functions.extend(source.functions());
            figures.tuple_lets += source.tuple_lets().len();
            figures.docs.extend(source.openings().iter().map(|(_, opening)| opening.is_some()));
        }
        figures.files.sort_unstable();
        figures
    }

    fn source(&self) -> usize {
        self.files.iter().sum()
    }

    fn columns(&self) -> [(&'static str, String); 13] {
        let Self { files, items, functions, docs, .. } = self;
        let source = self.source();
        let place = |share: f64| ((share * files.len() as f64) as usize).min(files.len().saturating_sub(1));
        let of_files = |share: f64| files.get(place(share)).copied().unwrap_or(0).to_string();
        let thousands = |count: usize| format!("{:.2}", 1000.0 * share(count, source));
        let percent = |count: usize, of: usize| format!("{:.1}", 100.0 * share(count, of));
        [
            ("source", source.to_string()),
            ("tests", self.tests.to_string()),
            ("ratio", format!("{:.2}", share(self.tests, source))),
            ("median", of_files(0.5)),
            ("p90", of_files(0.9)),
            ("max", of_files(1.0)),
            ("items", items.len().to_string()),
            ("doc %", percent(items.iter().filter(|lines| **lines > 0).count(), items.len())),
            ("lines", format!("{:.1}", share(items.iter().sum(), items.len()))),
            ("panics", thousands(self.panics)),
            ("long %", percent(functions.iter().filter(|lines| **lines > LONG).count(), functions.len())),
            ("tuples", thousands(self.tuple_lets)),
            ("lean %", percent(docs.iter().filter(|leans| **leans).count(), docs.len())),
        ]
    }
}
