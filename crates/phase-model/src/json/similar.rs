//! The likely intended name for a misspelt one.

/// Longest word that is compared (bytes); no name of ours comes near it.
const LONGEST_WORD: usize = 100;

/// The candidate closest to a word, if it is close enough to be the intended one: up to a third of its
/// letters may be wrong, at most three, ignoring case. Of equally close ones the first.
pub(super) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    // The distance takes time and memory in proportion to the length.
    if word.len() > LONGEST_WORD {
        return None;
    }
    let word = plain(word);
    let distance = |candidate: &str| edit_distance(&word, &plain(candidate));
    let nearest = candidates.iter().copied().min_by_key(|candidate| distance(candidate))?;
    let allowed = (nearest.chars().count() / 3).clamp(1, 3);
    (distance(nearest) <= allowed).then_some(nearest)
}

/// Edit distance of two words: the least number of letters to insert, remove, replace or swap with a
/// neighbour (optimal string alignment). It tells which of several names was probably meant by a misspelt
/// one.
///
/// # Examples
/// ```
/// use phase_model::json::edit_distance;
///
/// assert_eq!(edit_distance("agnet", "agent"), 1);
/// assert_eq!(edit_distance("goal", "goals"), 1);
/// ```
#[must_use]
pub fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
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

fn plain(word: &str) -> String {
    word.to_lowercase().replace(['-', ' '], "_")
}
