//! Names of videos in addresses.

use sha2::{Digest, Sha256};

/// Bytes of a digest that a name has.
const BYTES: usize = 16;

/// Names videos so that nobody can tell or guess one from another, or from what it shows.
pub(super) struct Names {
    secret: Vec<u8>,
}

impl Names {
    /// The names of a study with these random bytes.
    pub(super) const fn new(secret: Vec<u8>) -> Self {
        Self { secret }
    }

    /// The name of the video of an id: 32 hexadecimal digits.
    pub(super) fn of(&self, id: &str) -> String {
        // Twice, so that a digest of a longer text cannot be made from that of a shorter one.
        let inner = Sha256::new().chain_update(&self.secret).chain_update(id).finalize();
        let digest = Sha256::new().chain_update(&self.secret).chain_update(inner).finalize();
        digest.iter().take(BYTES).map(|byte| format!("{byte:02x}")).collect()
    }
}

impl core::fmt::Debug for Names {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.write_str("Names")
    }
}
