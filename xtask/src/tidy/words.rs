//! Lines, doc comments and bindings: rules of `CONTRIBUTING.md` that neither `rustfmt` nor clippy checks.

use super::{Package, Workspace, scan::Source};

/// Greatest width of a line (characters).
const WIDTH: usize = 110;
/// A word or literal of this width excuses the line that it stands on (characters).
const UNBREAKABLE: usize = 60;

/// Checks the Rust files of all packages.
pub(super) fn check(workspace: &mut Workspace) {
    for package in workspace.all_packages() {
        let sources = workspace.sources(&package);
        for source in &sources {
            check_lines(workspace, &package, source);
        }
        check_tuples(workspace, &package, &sources);
    }
}

/// The package that reads files.
const READER: &str = "phase-files";
/// Calls that open or read a file of any kind.
const READS: [&str; 3] = ["fs::read(", "fs::read_to_string(", "File::open("];

fn check_lines(workspace: &mut Workspace, package: &Package, source: &Source) {
    if !package.is_exempt("width") {
        for line in source.lines().filter(|line| line.text.chars().count() > WIDTH) {
            if !is_unbreakable(line.text, line.code) {
                workspace.report(&source.file, line.number, format!("is wider than {WIDTH} characters"));
            }
        }
    }
    if !package.is_of_xtask() && package.name != READER && !package.is_exempt("reads") {
        for line in source.source().filter(|line| reads(line.code)) {
            let rule = format!("files are read by {READER} alone, which refuses pipes and devices");
            workspace.report(&source.file, line.number, rule);
        }
    }
    if !package.is_exempt("openings") {
        let openings = source.openings().into_iter();
        for (line, opening) in openings.filter_map(|(line, opening)| Some((line, opening?))) {
            let rule = format!("a doc comment that begins with “{opening}” does not stand alone");
            workspace.report(&source.file, line, rule);
        }
    }
}

/// Whether code opens or reads a file of any kind.
fn reads(code: &str) -> bool {
    let whole_word =
        |at: usize| !code[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_');
    READS.iter().any(|call| code.match_indices(call).any(|(at, _)| whole_word(at)))
}

/// Whether a line is wide because of a word, or of a text that `rustfmt` does not break.
fn is_unbreakable(text: &str, code: &str) -> bool {
    let words = text.split_whitespace().map(|word| word.chars().count());
    let literals = code.split(|letter| letter != '"').map(str::len);
    words.chain(literals).any(|width| width >= UNBREAKABLE)
}

/// At most one `let` of a tuple in a thousand lines.
fn check_tuples(workspace: &mut Workspace, package: &Package, sources: &[Source]) {
    if package.is_exempt("tuples") {
        return;
    }
    let lines: usize = sources.iter().map(|source| source.source().count()).sum();
    let lets = |source| Source::tuple_lets(source).into_iter().map(|line| (&source.file, line));
    let found: Vec<_> = sources.iter().flat_map(lets).collect();
    if found.len() > lines.div_ceil(1000) {
        let rule = format!("one `let` binds one thing; {} has {} of tuples", package.name, found.len());
        for (file, line) in found {
            workspace.report(file, line, &rule);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::is_unbreakable;

    #[test]
    fn words_and_texts_may_be_wide() {
        let word = "x".repeat(60);
        assert!(is_unbreakable(&format!("/// {word}"), ""));
        assert!(is_unbreakable("f(\"…\");", &format!("f({});", "\"".repeat(60))));
        assert!(!is_unbreakable(&"x ".repeat(60), &"x ".repeat(60)));
    }
}
