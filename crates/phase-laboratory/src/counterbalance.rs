//! Lists of stimuli, counterbalanced.

use rand::{Rng, seq::SliceRandom};
use thiserror::Error;

/// Why there are no such lists.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum ListError {
    /// Members of a set would meet in a list.
    #[error(
        "set {set} has {members} members, so no list of {lists} can be without two of them; make {members} lists"
    )]
    Members {
        /// The set.
        set: String,
        /// Its size.
        members: usize,
        /// Number of lists.
        lists: usize,
    },
}

/// A stimulus.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Stimulus {
    /// Its id.
    pub id: String,
    /// The set of minimal pairs or triples that it belongs to.
    pub set: Option<String>,
}

/// Places, from 0, of the stimuli in every list. A stimulus without a set is in all lists; of a set, list l
/// has member (s + l) modulo the number of members, where s counts the sets, so that no list has two of them
/// and, over as many lists as there are members, each is in equally many.
///
/// One random order is drawn; list l begins with its stimulus l · n / lists, as the rows of a cyclic Latin
/// square, so that a stimulus is early in one list and late in another.
///
/// # Errors
/// [`ListError`] if a set has more members than there are lists: some member would be in none.
pub fn lists<R: Rng>(
    stimuli: &[Stimulus],
    lists: usize,
    random: &mut R,
) -> Result<Vec<Vec<usize>>, ListError> {
    let mut sets: Vec<(&str, Vec<usize>)> = Vec::new();
    let mut units: Vec<Vec<usize>> = Vec::new();
    for (k, stimulus) in stimuli.iter().enumerate() {
        match &stimulus.set {
            None => units.push(vec![k]),
            Some(set) => match sets.iter_mut().find(|(name, _)| name == set) {
                Some((_, members)) => members.push(k),
                None => sets.push((set, vec![k])),
            },
        }
    }
    if let Some((set, members)) = sets.iter().find(|(_, members)| members.len() > lists) {
        return Err(ListError::Members { set: (*set).to_owned(), members: members.len(), lists });
    }
    // A set's first member differs from one set to the next, so that no list has all of one condition.
    for (shift, (_, mut members)) in sets.into_iter().enumerate() {
        let by = shift % members.len();
        members.rotate_left(by);
        units.push(members);
    }
    units.shuffle(random);
    let list = |l: usize| {
        let start = l * units.len() / lists.max(1);
        let unit = |k: usize| &units[(start + k) % units.len()];
        (0..units.len()).map(|k| unit(k)[l % unit(k).len()]).collect()
    };
    Ok((0..lists).map(list).collect())
}
