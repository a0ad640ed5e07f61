//! Reading the commands that documents show.

/// The lines of blocks of shell code, with continued ones in one piece.
pub(crate) fn shell(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut inside = false;
    let mut continued = String::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            inside = matches!(line.trim(), "```sh" | "```bash" | "```console");
        } else if inside {
            continued.push_str(line.trim_end_matches('\\'));
            if !line.ends_with('\\') {
                lines.push(std::mem::take(&mut continued));
            }
        }
    }
    lines
}

/// The words of each simple command of a line, without comments, quotes and assignments before it.
pub(crate) fn commands(line: &str) -> Vec<Vec<String>> {
    let line = line.split(" #").next().unwrap_or_default();
    if line.starts_with('#') {
        return Vec::new();
    }
    let simple = line.split("&&").flat_map(|part| part.split([';', '|', '>', '&']));
    let words = simple.map(|command| {
        let words = command.split_whitespace().map(|word| word.replace(['"', '\''], ""));
        words.skip_while(|word| word.contains('=') && !word.starts_with('-')).collect()
    });
    words.filter(|words: &Vec<String>| !words.is_empty()).collect()
}
