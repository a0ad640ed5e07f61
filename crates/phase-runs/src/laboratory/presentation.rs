//! Times at which videos were shown, from the table of a run.

use super::tables::{MISSING, Sheet, unusable};
use crate::error::RunError;
use std::path::Path;

/// A time at which a video was shown.
pub(super) struct Presentation {
    /// Its beginning (s).
    pub(super) onset: f64,
    /// The time for which it was shown (s), if the table says so.
    pub(super) duration: Option<f64>,
    /// The file of the video.
    pub(super) stimulus: String,
}

/// Greatest size of times in tables (s): thirty years.
const MOST_SECONDS: f64 = 1e9;

impl Presentation {
    /// Reads the table of a run.
    pub(super) fn read(path: &Path) -> Result<Vec<Self>, RunError> {
        let sheet = Sheet::read(path)?;
        let column =
            |name: &str| sheet.column(name).ok_or_else(|| unusable(path, &format!("has no column {name}")));
        let (onset, stimulus) = (column("onset")?, column("stim_file")?);
        let duration = sheet.column("duration");
        let of = |(k, row): (usize, &Vec<String>)| {
            let seconds = |column: usize, least: f64| {
                let time = row[column].parse::<f64>().ok();
                time.filter(|time| (least..=MOST_SECONDS).contains(time)).ok_or_else(|| {
                    let (name, cell) = (&sheet.names[column], &row[column]);
                    let rule =
                        format!("row {}: {name} must be {least} to {MOST_SECONDS} s, not {cell:?}", k + 1);
                    unusable(path, &rule)
                })
            };
            let told = duration.filter(|&column| row[column] != MISSING);
            Ok(Self {
                onset: seconds(onset, -MOST_SECONDS)?,
                duration: told.map(|column| seconds(column, 0.0)).transpose()?,
                stimulus: row[stimulus].clone(),
            })
        };
        // Rests and responses have no stimulus.
        let shown = sheet.rows.iter().enumerate().filter(|(_, row)| row[stimulus] != MISSING);
        let shown: Vec<Self> = shown.map(of).collect::<Result<_, RunError>>()?;
        if shown.is_empty() {
            return Err(unusable(path, "shows no video: no row has a stim_file"));
        }
        Ok(shown)
    }

    /// Whether this is the video of an event, or of a clip of it.
    pub(super) fn is_of(&self, id: &str) -> bool {
        Path::new(&self.stimulus).file_stem().is_some_and(|stem| stem == id)
    }
}
