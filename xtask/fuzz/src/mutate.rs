//! Inputs made from others.

use phase_model::random::Pcg64Mcg;
use rand::RngExt;

/// Most changes to one input.
const MOST_CHANGES: usize = 6;
/// Longest piece that is removed or repeated (bytes).
const LONGEST_PIECE: usize = 64;
/// Longest input (bytes).
const LONGEST: usize = 1 << 16;
/// Bytes that readers of texts and numbers are most likely to take amiss.
const TOKENS: [&[u8]; 24] = [
    b"0",
    b"-1",
    b"1e999",
    b"1e-999",
    b"-0.0",
    b"18446744073709551615",
    b"9223372036854775808",
    b"4294967296",
    b"null",
    b"true",
    b"[]",
    b"{}",
    b"\"\"",
    b"[[[[[[[[",
    b"..",
    b"/",
    b"\\u0000",
    b"\xff",
    b"\0\0\0\0",
    b"\xff\xff\xff\xff",
    b"\0\0\xc0\x7f",
    b"\0\0\x80\x7f",
    b",",
    b"\n",
];

/// An input like one of these: some of its bytes are others, removed, repeated, or come from a second one.
#[must_use]
pub(crate) fn mutated(inputs: &[Vec<u8>], random: &mut Pcg64Mcg) -> Vec<u8> {
    let mut input = inputs[random.random_range(0..inputs.len())].clone();
    for _ in 0..random.random_range(1..=MOST_CHANGES) {
        change(&mut input, inputs, random);
    }
    input.truncate(LONGEST);
    input
}

fn change(input: &mut Vec<u8>, inputs: &[Vec<u8>], random: &mut Pcg64Mcg) {
    let at = random.random_range(0..=input.len());
    let end = (at + random.random_range(0..LONGEST_PIECE)).min(input.len());
    match random.random_range(0..7) {
        0 if at < input.len() => input[at] ^= 1 << random.random_range(0..8),
        1 if at < input.len() => input[at] = random.random(),
        2 => drop(input.drain(at..end)),
        3 => {
            let piece = input[at..end].to_vec();
            drop(input.splice(at..at, piece));
        }
        4 => input.truncate(at),
        5 => {
            let other = &inputs[random.random_range(0..inputs.len())];
            input.truncate(at);
            input.extend_from_slice(&other[random.random_range(0..=other.len())..]);
        }
        _ => {
            let token = TOKENS[random.random_range(0..TOKENS.len())];
            // In place of a number or word, where there is one.
            let word = input[at..].iter().take_while(|byte| byte.is_ascii_alphanumeric()).count();
            drop(input.splice(at..at + word, token.iter().copied()));
        }
    }
}
