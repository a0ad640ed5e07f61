//! Golden values on disk: a text file with a name and a value on each line.

use std::{env, fs, io, path::PathBuf};

/// The environment variable that causes the files to be rewritten instead of compared, as `cargo xtask golden
/// --bless` does.
pub const BLESS: &str = "PHASE_GOLDEN_BLESS";

/// Names and values in the order in which they were computed.
#[derive(Clone, Debug)]
pub struct Golden {
    file: PathBuf,
    lines: Vec<(String, String)>,
}

impl Golden {
    /// An empty table that is stored in `tests/golden/NAME.txt` of a crate, whose root is given as
    /// `env!("CARGO_MANIFEST_DIR")`.
    #[must_use]
    pub fn new(root: &str, name: &str) -> Self {
        let file = PathBuf::from(root).join("tests/golden").join(format!("{name}.txt"));
        Self { file, lines: Vec::new() }
    }

    /// Adds a value under a name. Neither may contain a line break, and the name may not contain a space.
    pub fn add(&mut self, name: impl Into<String>, value: impl Into<String>) {
        self.lines.push((name.into(), value.into()));
    }

    /// Compares the table with its file, or rewrites the file where [`BLESS`] is set.
    ///
    /// # Errors
    /// Every line that differs, as text; or why the file cannot be read or written.
    pub fn check(&self) -> Result<(), String> {
        let text: String = self.lines.iter().map(|(name, value)| format!("{name} {value}\n")).collect();
        let cannot = |what: &str, error: io::Error| format!("cannot {what} {}: {error}", self.file.display());
        if env::var_os(BLESS).is_some() {
            if let Some(folder) = self.file.parent() {
                fs::create_dir_all(folder).map_err(|error| cannot("create the folder of", error))?;
            }
            return fs::write(&self.file, text).map_err(|error| cannot("write", error));
        }
        let kept = fs::read_to_string(&self.file).map_err(|error| cannot("read", error))?;
        let differences = differences(&kept, &text);
        if differences.is_empty() {
            return Ok(());
        }
        Err(format!(
            "golden values in {} differ from what is computed now:\n{}\nA change on purpose is recorded with \
             `cargo xtask golden --bless` and in CHANGELOG.md.",
            self.file.display(),
            differences.join("\n")
        ))
    }
}

/// The lines in which two tables differ: `- name value` as stored, `+ name value` as computed.
#[must_use]
pub fn differences(kept: &str, computed: &str) -> Vec<String> {
    let missing = |from: &str, lines: &str, mark: char| -> Vec<String> {
        from.lines()
            .filter(|line| !lines.lines().any(|other| other == *line))
            .map(|line| format!("{mark} {line}"))
            .collect()
    };
    let mut differences = missing(kept, computed, '-');
    differences.extend(missing(computed, kept, '+'));
    if differences.is_empty() && kept != computed {
        differences.push("the same lines in another order or number".into());
    }
    differences
}
