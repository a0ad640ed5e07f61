//! Results kept for a later run of the same program, in `bincode`.
//!
//! No other module knows the encoding. An entry that is foreign, damaged, or of another program or other
//! settings is no error: it is ignored, and the result is computed again.

use crate::{WriteError, atomic, checksum::sha256, regular};
use serde::{Serialize, de::DeserializeOwned};
use std::path::{Path, PathBuf};

/// First bytes of every cache file; the last is the version of what follows.
const MAGIC: [u8; 8] = *b"PHASEch1";
/// No result comes near this size (bytes); a greater length indicates damage.
const LIMIT: usize = 1 << 28;

/// A folder of cached results that were all computed in one way.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
    fingerprint: [u8; 32],
}

impl Cache {
    /// A cache in a folder, which must exist when something is stored. `fingerprint` is a digest of
    /// everything that determines a result besides its id and seed: the program and its settings.
    #[must_use]
    pub fn new(folder: &Path, fingerprint: [u8; 32]) -> Self {
        Self { folder: folder.to_owned(), fingerprint }
    }

    /// The result stored under an id and seed, if there is a valid one.
    #[must_use]
    pub fn load<T: DeserializeOwned>(&self, id: &str, seed: u64) -> Option<T> {
        let bytes = regular::bytes(&self.path(id)).ok()?;
        let payload = bytes.strip_prefix(&self.head(id, seed)[..])?;
        let (sum, payload) = payload.split_first_chunk::<32>()?;
        if *sum != sha256(payload) {
            return None;
        }
        let config = bincode::config::standard().with_limit::<LIMIT>();
        let (cached, read): (T, usize) = bincode::serde::decode_from_slice(payload, config).ok()?;
        (read == payload.len()).then_some(cached)
    }

    /// Stores a result under an id and seed. Its type must not need to describe itself: `bincode` writes no
    /// names of fields.
    ///
    /// # Errors
    /// If the result cannot be encoded or the file cannot be written.
    pub fn store(&self, id: &str, seed: u64, result: &impl Serialize) -> Result<(), WriteError> {
        let path = self.path(id);
        let config = bincode::config::standard().with_limit::<LIMIT>();
        let payload = bincode::serde::encode_to_vec(result, config).map_err(|error| {
            let source = std::io::Error::other(error);
            WriteError { path: path.clone(), action: "encode the result", source }
        })?;
        let bytes = [&self.head(id, seed)[..], &sha256(&payload), &payload].concat();
        atomic::write(&path, &bytes)
    }

    fn path(&self, id: &str) -> PathBuf {
        self.folder.join(format!("{id}.bin"))
    }

    /// The header of every valid cache file.
    fn head(&self, id: &str, seed: u64) -> Vec<u8> {
        let key = [&self.fingerprint[..], id.as_bytes(), &seed.to_le_bytes()].concat();
        [&MAGIC[..], &sha256(&key)].concat()
    }
}
