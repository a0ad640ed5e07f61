//! The letters are letters.

use phase_render::font::{GLYPH_HEIGHT, GLYPH_WIDTH, glyph};
use std::collections::BTreeSet;

/// A glyph as rows of dots.
fn picture(character: char) -> Vec<String> {
    let dot = |bits: u8, column: usize| if bits >> (GLYPH_WIDTH - 1 - column) & 1 == 1 { '#' } else { '.' };
    glyph(character)
        .into_iter()
        .map(|bits| (0..GLYPH_WIDTH).map(|column| dot(bits, column)).collect())
        .collect()
}

#[test]
fn glyphs_are_upright_and_not_mirrored() {
    let cases = [
        ('L', ["#....", "#....", "#....", "#....", "#....", "#....", "#####", ".....", "....."]),
        ('7', ["#####", "....#", "...#.", "...#.", "..#..", "..#..", "..#..", ".....", "....."]),
        ('p', [".....", ".....", "####.", "#...#", "#...#", "#...#", "####.", "#....", "#...."]),
    ];
    for (character, rows) in cases {
        assert_eq!(picture(character), rows, "{character}");
    }
}

#[test]
fn printable_ascii_is_complete_and_distinct() {
    let glyphs: BTreeSet<[u8; GLYPH_HEIGHT]> = (' '..='~').map(glyph).collect();
    assert_eq!(glyphs.len(), 95);
    for character in ' '..='~' {
        let rows = glyph(character);
        assert!(rows.iter().all(|row| row >> GLYPH_WIDTH == 0), "{character} is too wide");
        assert_eq!(rows.iter().all(|&row| row == 0), character == ' ', "{character}");
        let below = rows[7] | rows[8] != 0;
        assert_eq!(below, "gjpqy,;_".contains(character), "{character} below the base line");
    }
}

#[test]
fn everything_else_is_a_question_mark() {
    for character in ['\0', '\n', '\u{7f}', 'é', 'λ', '\u{10ffff}'] {
        assert_eq!(glyph(character), glyph('?'), "{character:?}");
    }
}
