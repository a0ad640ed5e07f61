//! Runs that go on in their folders, and parts of a run that are made in several.

use crate::{error::RunError, listener::Listener};
use phase_files::{
    folder::{self, Contents},
    run::Run,
};
use std::path::Path;

/// Whether a run is finished in a folder, as the file says that is written last. An unfinished run there has
/// to be this one, which then goes on.
pub(crate) fn is_finished(
    out: &Path,
    last_file: &str,
    run: &Run,
    listener: &dyn Listener,
) -> Result<bool, RunError> {
    match folder::inspect(out, last_file)? {
        Contents::Finished => Ok(true),
        Contents::Unfinished(other) => {
            run.check(out, "an unfinished", &other)?;
            listener.note(&format!("continuing in {}", out.display()));
            Ok(false)
        }
        Contents::Nothing => Ok(false),
    }
}

/// Checks that the shards of a run, sorted by their numbers from 1, are all there and each once.
pub(crate) fn check_complete<'a>(
    of: usize,
    shards: impl Iterator<Item = (usize, &'a Path)>,
) -> Result<(), RunError> {
    let mut last: Option<(usize, &Path)> = None;
    for (number, folder) in shards {
        let expected = last.map_or(1, |(number, _)| number + 1);
        if let Some((_, other)) = last.filter(|(before, _)| *before == number) {
            let (one, two) = (other.display(), folder.display());
            return Err(RunError::Usage(format!("{one} and {two} are both shard {number}")));
        }
        if number > expected {
            return Err(missing(expected, of));
        }
        last = Some((number, folder));
    }
    let count = last.map_or(0, |(number, _)| number);
    if count < of { Err(missing(count + 1, of)) } else { Ok(()) }
}

fn missing(number: usize, of: usize) -> RunError {
    RunError::Usage(format!("shard {number} of {of} is missing"))
}

#[cfg(test)]
mod tests {
    use super::check_complete;
    use std::path::Path;

    #[test]
    fn a_missing_and_a_repeated_shard_are_named() {
        let told = |of, numbers: &[usize]| {
            let folders = ["a", "b", "c"].map(Path::new);
            let shards = numbers.iter().copied().zip(folders);
            check_complete(of, shards).map_err(|error| error.to_string())
        };
        let missing = |number, of| Err(format!("shard {number} of {of} is missing"));
        assert_eq!(told(3, &[1, 2, 3]), Ok(()));
        assert_eq!(told(2, &[]), missing(1, 2));
        assert_eq!(told(2, &[2]), missing(1, 2));
        assert_eq!(told(3, &[1, 3]), missing(2, 3));
        assert_eq!(told(3, &[1, 2]), missing(3, 3));
        assert_eq!(told(2, &[1, 1]), Err("a and b are both shard 1".into()));
    }
}
