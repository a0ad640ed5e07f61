//! Rust files as `rustfmt` leaves them: which characters are code, which lines are tests, and what can be
//! counted there.

use std::path::{Path, PathBuf};

/// First words with which a doc comment must not begin: with them it does not stand alone.
const OPENINGS: [&str; 10] =
    ["The same", "As there", "As above", "What", "How", "Who", "Whoever", "Where", "Which", "When"];
/// Words before the `fn` of a function.
const QUALIFIERS: [&str; 6] = ["pub", "const", "async", "unsafe", "extern", "default"];
/// Words after the `pub` of an item that has a page of its own.
const ITEMS: [&str; 10] =
    ["fn", "struct", "enum", "union", "trait", "type", "const", "static", "unsafe", "async"];
/// Calls that end the program.
const PANICS: [&str; 4] = [".unwrap()", ".expect(", "panic!(", "unreachable!("];

/// A Rust file.
pub(super) struct Source {
    /// Relative to the workspace.
    pub(super) file: PathBuf,
    text: String,
    /// The text with spaces in place of comments, and quotes in place of literals.
    code: String,
    /// Of each line, whether it belongs to tests, examples or benches.
    tests: Vec<bool>,
}

/// A line of a file.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    /// Counted from 1.
    pub(super) number: usize,
    pub(super) text: &'a str,
    pub(super) code: &'a str,
    pub(super) is_test: bool,
}

impl Source {
    pub(super) fn new(file: &Path, text: String) -> Self {
        let code = code_of(&text);
        let parts = ["tests", "tests.rs", "examples", "benches"];
        let is_no_source = file.iter().any(|part| parts.iter().any(|name| part == *name));
        let tests = if is_no_source { vec![true; code.lines().count()] } else { tests_of(&code) };
        Self { file: file.to_owned(), text, code, tests }
    }

    /// Whether it is neither source nor test: an example or a bench.
    pub(super) fn is_beside(&self) -> bool {
        self.file.iter().any(|part| part == "examples" || part == "benches")
    }

    pub(super) fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        let texts = self.text.lines().zip(self.code.lines()).zip(&self.tests).enumerate();
        texts.map(|(k, ((text, code), &is_test))| Line { number: k + 1, text, code, is_test })
    }

    /// The lines that are no tests.
    pub(super) fn source(&self) -> impl Iterator<Item = Line<'_>> {
        self.lines().filter(|line| !line.is_test)
    }

    /// The first lines of doc comments outside of tests, with the words that they must not begin with.
    pub(super) fn openings(&self) -> Vec<(usize, Option<&'static str>)> {
        let mut openings = Vec::new();
        let mut before = None;
        for line in self.source() {
            let doc = doc_of(line.text);
            if let Some((marker, words)) = doc
                && before != Some(marker)
            {
                let leans = |opening: &&str| {
                    words.strip_prefix(opening).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
                };
                openings.push((line.number, OPENINGS.into_iter().find(leans)));
            }
            before = doc.map(|(marker, _)| marker);
        }
        openings
    }

    /// The lines outside of tests in which a `let` binds the parts of a tuple that is written there.
    pub(super) fn tuple_lets(&self) -> Vec<usize> {
        let lets = self.code.match_indices("let (").filter_map(|(place, _)| {
            let before = &self.code[..place];
            let line = before.matches('\n').count();
            let is_statement = before.rsplit('\n').next().is_some_and(|rest| rest.trim().is_empty());
            (is_statement && !self.tests[line] && binds_tuple(&self.code[place + 4..])).then_some(line + 1)
        });
        lets.collect()
    }

    /// The lengths of functions outside of tests (lines).
    pub(super) fn functions(&self) -> Vec<usize> {
        let lines: Vec<Line<'_>> = self.lines().collect();
        let starts = lines.iter().enumerate().filter(|(_, line)| !line.is_test && begins_function(line.code));
        starts.filter_map(|(start, _)| length(&lines[start..])).collect()
    }

    /// The lines of documentation of each public item.
    pub(super) fn items(&self) -> Vec<usize> {
        let mut items = Vec::new();
        let mut documented = 0;
        let mut depth = 0; // of an attribute's brackets
        for line in self.source() {
            let code = line.code.trim();
            if doc_of(line.text).is_some_and(|(marker, _)| marker == "///") {
                documented += 1;
                continue;
            }
            if depth > 0 || code.starts_with("#[") {
                depth += code.matches(['[', '(']).count();
                depth -= depth.min(code.matches([']', ')']).count());
                continue;
            }
            let item = code.strip_prefix("pub ").and_then(|rest| rest.split_whitespace().next());
            if item.is_some_and(|word| ITEMS.contains(&word)) {
                items.push(documented);
            }
            documented = 0;
        }
        items
    }

    /// The number of calls outside of tests that end the program.
    pub(super) fn panics(&self) -> usize {
        self.source().flat_map(|line| PANICS.map(|call| line.code.matches(call).count())).sum()
    }
}

/// The marker of a line of documentation, and its words.
fn doc_of(line: &str) -> Option<(&'static str, &str)> {
    let line = line.trim_start();
    let of = |marker: &'static str| line.strip_prefix(marker).map(|words| (marker, words.trim()));
    of("//!").or_else(|| of("///").filter(|(_, words)| !words.starts_with('/')))
}

fn begins_function(code: &str) -> bool {
    let is_qualifier =
        |word: &&str| QUALIFIERS.contains(word) || word.starts_with("pub(") || word.starts_with('"');
    code.split_whitespace().find(|word| !is_qualifier(word)) == Some("fn")
}

/// The lines of the function that begins in the first of some lines, unless it has no body.
fn length(lines: &[Line<'_>]) -> Option<usize> {
    let first = lines.first()?.code.trim_end();
    if first.ends_with(['}', ';']) {
        return first.ends_with('}').then_some(1);
    }
    let indent = first.len() - first.trim_start().len();
    let (end, line) = lines.iter().enumerate().skip(1).find(|(_, line)| {
        line.code.len() > indent
            && line.code[..indent].trim().is_empty()
            && line.code[indent..].starts_with(['}', ')'])
            && line.code.trim_end().ends_with(['}', ';'])
    })?;
    (line.code.trim() == "}").then_some(end + 1)
}

/// Whether what follows a `let` is a pattern, and then a tuple and nothing else.
fn binds_tuple(code: &str) -> bool {
    let after_pattern = balanced(code).map_or("", |end| &code[end..]);
    let Some((kind, value)) = after_pattern.split_once('=') else { return false };
    let value = value.trim_start();
    let is_plain = kind.trim().is_empty() || kind.trim_start().starts_with(':');
    is_plain && value.starts_with('(') && balanced(value).is_some_and(|end| value[end..].starts_with(';'))
}

/// The length of what a bracket encloses, with both brackets.
fn balanced(code: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (place, letter) in code.char_indices() {
        match letter {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth == 1 => return Some(place + 1),
            ')' | ']' | '}' => depth = depth.checked_sub(1)?,
            _ => {}
        }
    }
    None
}

/// For each line of code, whether it belongs to an item under `#[cfg(test)]`.
fn tests_of(code: &str) -> Vec<bool> {
    let lines: Vec<&str> = code.lines().collect();
    let mut tests = vec![false; lines.len()];
    let mut first = 0;
    while first < lines.len() {
        let mut last = first;
        if lines[first].trim() == "#[cfg(test)]" {
            let indent = |line: &str| line.len() - line.trim_start().len();
            let begins = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
            let item = lines[first..].iter().position(|line| begins(line)).unwrap_or(0);
            let ends =
                |line: &str| indent(line) == indent(lines[first]) && line.trim_end().ends_with([';', '}']);
            let length = lines[first + item..].iter().position(|line| ends(line)).unwrap_or(0);
            last += item + length;
            tests[first..=last].fill(true);
        }
        first = last + 1;
    }
    tests
}

/// A text with spaces in place of comments, and quotes in place of literals.
fn code_of(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    let mut before = ' ';
    while let Some(letter) = rest.chars().next() {
        let is_in_name = before.is_alphanumeric() || before == '_';
        let inert = if is_in_name { literal(rest) } else { raw(rest).max(literal(rest)) };
        let taken = inert.max(letter.len_utf8());
        let mark = if letter == '/' { ' ' } else { '"' };
        let kept = |letter: char| if inert == 0 || letter == '\n' { letter } else { mark };
        code.extend(rest[..taken].chars().map(kept));
        before = letter;
        rest = &rest[taken..];
    }
    code
}

/// The length of the raw text that a text begins with, or 0.
fn raw(text: &str) -> usize {
    let Some(rest) = text.strip_prefix('r') else { return 0 };
    let marks = rest.len() - rest.trim_start_matches('#').len();
    let end = format!("\"{}", "#".repeat(marks));
    let Some(inside) = rest[marks..].strip_prefix('"') else { return 0 };
    inside.find(&end).map_or(0, |place| 1 + marks + 1 + place + end.len())
}

/// The length of the comment, text or character that a text begins with, or 0.
fn literal(text: &str) -> usize {
    if text.starts_with("//") {
        return text.find('\n').unwrap_or(text.len());
    }
    if let Some(inside) = text.strip_prefix("/*") {
        return inside.find("*/").map_or(text.len(), |place| place + 4);
    }
    let Some(quote) = text.chars().next().filter(|letter| ['"', '\''].contains(letter)) else { return 0 };
    let mut letters = text.char_indices().skip(1);
    while let Some((place, letter)) = letters.next() {
        if letter == '\\' {
            letters.next();
        } else if letter == quote {
            return place + 1;
        } else if quote == '\'' && !text[place + letter.len_utf8()..].starts_with('\'') {
            return 0; // a lifetime
        }
    }
    0
}

#[cfg(test)]
mod tests {
    use super::{Source, code_of};
    use std::path::Path;

    fn source(text: &str) -> Source {
        Source::new(Path::new("crates/phase-x/src/lib.rs"), text.to_owned())
    }

    #[test]
    fn comments_and_literals_are_no_code() {
        let quotes = |count| "\"".repeat(count);
        assert_eq!(code_of("a(\"b // c\\\"\"); // d \"e\""), format!("a({});         ", quotes(10)));
        let texts = format!("f::<'a>({}, {}, b{})", quotes(3), quotes(7), quotes(3));
        assert_eq!(code_of("f::<'a>('\"', r#\"\"{\"#, b'x')"), texts);
        assert_eq!(code_of("/* { */ x /* ä"), "        x     ");
        assert_eq!(code_of("\"a\n{\"\n{"), "\"\"\n\"\"\n{");
        assert_eq!(code_of("for\"{\""), format!("for{}", quotes(3)));
    }

    #[test]
    fn only_tuples_that_are_written_there_count() {
        let text = "fn f() {\n    let (a, b) = (1, 2);\n    let (a, b): (u8, u8) =\n        (g(), (h)(1));\n\
                    let (a, b) = g();\n    let (a, b) = (g)(1);\n    if let (1, 2) = (a, b) {}\n\
                    // let (a, b) = (1, 2);\n}\n#[cfg(test)]\nmod tests {\n    let (a, b) = (1, 2);\n}\n";
        assert_eq!(source(text).tuple_lets(), [2, 3]);
    }

    #[test]
    fn doc_comments_begin_once_and_not_in_tests() {
        let text = "//! How.\n\n/// Whatever.\n/// What\n//// When\n/// Where, it.\nfn f() {}\n\
                    #[cfg(test)]\nmod tests {\n    /// Who.\n    fn g() {}\n}\n/// The same.\nfn h() {}\n";
        let expected = [(1, Some("How")), (3, None), (6, Some("Where")), (13, Some("The same"))];
        assert_eq!(source(text).openings(), expected);
    }

    #[test]
    fn functions_are_measured_from_their_names_to_their_ends() {
        let text = "pub const fn f() {}\nimpl X {\n    pub(crate) fn g(\n        a: u8,\n    ) -> u8 {\n\
                    \"\n}\"\n    }\n}\ntrait Y {\n    fn h();\n    fn i(\n    );\n}\n";
        assert_eq!(source(text).functions(), [1, 6]);
    }

    #[test]
    fn items_have_the_documentation_above_their_attributes() {
        let text = "/// A.\n///\n/// B.\n#[derive(\n    Debug,\n)]\npub struct A {\n    /// C.\n    pub b: u8,\n}\n\
                    pub use b::C;\npub(crate) fn d() {}\npub fn e() { x.unwrap() }\n";
        assert_eq!(source(text).items(), [3, 0]);
        assert_eq!(source(text).panics(), 1);
    }
}
