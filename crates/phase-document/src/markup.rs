//! Text inside HTML, SVG, scripts and Markdown.

/// Text escaped for use between tags and inside quoted attributes.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            letter => safe.push(letter),
        }
    }
    safe
}

/// Text escaped for use within a line or a cell of Markdown: it stays text, whatever it contains. Letters
/// that would be markup get a backslash, those of HTML are written as entities, and line breaks become
/// spaces.
#[must_use]
pub fn escape_markdown(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '\\' | '`' | '*' | '|' => safe.extend(['\\', letter]),
            // Other brackets, such as those of intervals, are no links.
            ']' if matches!(letters.peek(), Some('(' | '[' | ':')) => safe.push_str("\\]"),
            letter if letter.is_control() || matches!(letter, '\u{2028}' | '\u{2029}') => safe.push(' '),
            letter => safe.push(letter),
        }
    }
    safe
}

/// JSON escaped for use inside a script element: `<` occurs only within strings, where it can be escaped.
#[must_use]
pub fn escape_script(json: &str) -> String {
    json.replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}
