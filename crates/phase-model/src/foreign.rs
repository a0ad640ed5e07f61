//! Texts that others wrote, in messages: nothing in them steers a terminal, turns the order of the letters
//! around, or fills a screen.

use std::{borrow::Cow, fmt::Write as _};

/// Longest foreign name or value in a message (letters).
const LONGEST_NAME: usize = 100;
/// Longest foreign sentence in a message (letters), such as that of a library about a file.
const LONGEST_SENTENCE: usize = 1000;

/// Whether a letter does something other than being seen: control characters, and those that change the
/// direction of what follows or are invisible.
fn is_unseen(letter: char) -> bool {
    letter.is_control()
        || matches!(letter,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e0fff}')
}

/// A text with all that is unseen written out, such as `\u{1b}`; `kept` stays.
fn seen(text: &str, kept: impl Fn(char) -> bool) -> Cow<'_, str> {
    let unseen = |letter: char| is_unseen(letter) && !kept(letter);
    if !text.contains(unseen) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if unseen(letter) {
            shown.extend(letter.escape_default());
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

fn cut(text: Cow<'_, str>, longest: usize) -> Cow<'_, str> {
    match text.char_indices().nth(longest) {
        Some((end, _)) => Cow::Owned(format!("{}…", &text[..end])),
        None => text,
    }
}

/// A name or value that others wrote, for a message: on one line, every unseen letter written out, cut after
/// 100 letters.
///
/// # Examples
/// ```
/// use phase_model::foreign::name;
///
/// assert_eq!(name("agents"), "agents");
/// assert_eq!(name("\u{1b}[2J\u{202e}x"), "\\u{1b}[2J\\u{202e}x");
/// assert_eq!(name(&"a".repeat(1000)).chars().count(), 101);
/// ```
#[must_use]
pub fn name(text: &str) -> Cow<'_, str> {
    short(text, LONGEST_NAME)
}

/// As [`name`], cut after so many letters.
#[must_use]
pub fn short(text: &str, longest: usize) -> Cow<'_, str> {
    // What is cut off need not be written out.
    let end = text.char_indices().nth(longest + 1).map_or(text.len(), |(end, _)| end);
    cut(seen(&text[..end], |_| false), longest)
}

/// A sentence of somebody else's with names of theirs in it, for a message: as [`name`], cut after 1000
/// letters.
#[must_use]
pub fn sentence(text: &str) -> Cow<'_, str> {
    short(text, LONGEST_SENTENCE)
}

/// A message of the library `csv` about a table, in the words of other messages.
///
/// # Examples
/// ```
/// use phase_model::foreign::table;
///
/// let said = "CSV error: record 1 (line: 2, byte: 4): found record with 1 fields, \
///     but the previous record has 2 fields";
/// assert_eq!(table(said), "line 2: has 1 cell, the lines before have 2");
/// ```
#[must_use]
pub fn table(said: &str) -> String {
    let said = said.strip_prefix("CSV error: ").unwrap_or(said);
    let parts = said.split_once(" (line: ").and_then(|(_, rest)| {
        let (line, rest) = rest.split_once(", ")?;
        Some((line, rest.split_once("): ")?.1))
    });
    let Some((line, problem)) = parts else { return said.to_owned() };
    let cells = problem.strip_prefix("found record with ").and_then(|rest| {
        let (found, rest) = rest.split_once(" fields, but the previous record has ")?;
        Some((found, rest.strip_suffix(" fields")?))
    });
    match cells {
        Some((found, before)) => {
            let noun = if found == "1" { "cell" } else { "cells" };
            format!("line {line}: has {found} {noun}, the lines before have {before}")
        }
        None => format!("line {line}: {problem}"),
    }
}

/// A whole message, of any length, as it may go to a terminal: line breaks and tabs stay, all other unseen
/// letters are written out.
#[must_use]
pub fn message(text: &str) -> Cow<'_, str> {
    seen(text, |letter| matches!(letter, '\n' | '\t'))
}

/// JSON, as it may go to a terminal: unseen letters, which only its texts can have, as JSON writes them out.
/// It has the same meaning.
#[must_use]
pub fn json(text: &str) -> Cow<'_, str> {
    let unseen = |letter: char| is_unseen(letter) && letter != '\n';
    if !text.contains(unseen) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if unseen(letter) {
            for unit in letter.encode_utf16(&mut [0; 2]) {
                // Writing to a string cannot fail.
                let _ = write!(shown, "\\u{unit:04x}");
            }
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}
