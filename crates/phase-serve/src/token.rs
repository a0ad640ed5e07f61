//! Tokens: what somebody has to know to be let in.

use sha2::{Digest as _, Sha256};

/// A token that nobody can guess: 128 random bits as 32 hexadecimal digits.
///
/// # Errors
/// If the operating system has no random numbers.
pub(crate) fn new() -> Result<String, getrandom::Error> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes)?;
    Ok(hex(&bytes))
}

/// A name for something that is not secret: 32 random bits as 8 hexadecimal digits.
///
/// # Errors
/// If the operating system has no random numbers.
pub(crate) fn short() -> Result<String, getrandom::Error> {
    let mut bytes = [0; 4];
    getrandom::fill(&mut bytes)?;
    Ok(hex(&bytes))
}

/// Heads or tails.
///
/// # Errors
/// If the operating system has no random numbers.
pub(crate) fn coin() -> Result<bool, getrandom::Error> {
    let mut byte = [0];
    getrandom::fill(&mut byte)?;
    Ok(byte[0] & 1 == 1)
}

/// The SHA-256 of a token, which is kept in its place so that whoever reads the server's files or memory
/// cannot use it. Tokens are random, so neither salt nor a slow hash is needed, and a lookup by it says
/// nothing by its duration.
#[must_use]
pub(crate) fn kept(token: &str) -> String {
    hex(&Sha256::digest(token.as_bytes()))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_differ_and_are_kept_as_sha_256() {
        let (a, b) = (new().unwrap(), new().unwrap());
        assert_eq!((a.len(), b.len()), (32, 32));
        assert_ne!(a, b);
        // FIPS 180-2, Appendix B.1.
        assert_eq!(kept("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
