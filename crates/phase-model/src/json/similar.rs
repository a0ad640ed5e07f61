//! The likely intended name for a misspelt one.

/// The candidate closest to a word, if it is close enough to be the intended one: up to a third of its
/// letters may be wrong, at most three, ignoring case. Of equally close ones the first.
pub(super) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let word = plain(word);
    let distance = |candidate: &str| edits(&word, &plain(candidate));
    let nearest = candidates.iter().copied().min_by_key(|candidate| distance(candidate))?;
    let allowed = (nearest.chars().count() / 3).clamp(1, 3);
    (distance(nearest) <= allowed).then_some(nearest)
}

fn plain(word: &str) -> Vec<char> {
    word.to_lowercase().replace(['-', ' '], "_").chars().collect()
}

/// Minimum number of letters to insert, remove, replace or swap with a neighbour (optimal string alignment).
fn edits(a: &[char], b: &[char]) -> usize {
    // Row i holds the edits from the first i letters of `a` to the first j of `b`.
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}
