//! A random forest behind two functions.

use smartcore::{
    ensemble::random_forest_classifier::{RandomForestClassifier, RandomForestClassifierParameters},
    error::Failed,
    linalg::basic::matrix::DenseMatrix,
};

/// Trees of a forest.
const TREES: u16 = 100;
/// Minimum number of training events at a leaf.
const MIN_SAMPLES_LEAF: usize = 3;

/// Trains a forest on rows of equal length with their classes, and returns the classes that it predicts for
/// others.
///
/// # Errors
/// If the library cannot train a forest, for example on a single class.
pub(crate) fn predict(
    rows: &[&Vec<f64>],
    classes: &[u32],
    others: &[&Vec<f64>],
    seed: u64,
) -> Result<Vec<u32>, Failed> {
    let matrix =
        |rows: &[&Vec<f64>]| DenseMatrix::from_2d_vec(&rows.iter().map(|&row| row.clone()).collect());
    let parameters = RandomForestClassifierParameters::default()
        .with_n_trees(TREES)
        .with_min_samples_leaf(MIN_SAMPLES_LEAF)
        .with_seed(seed);
    let forest = RandomForestClassifier::fit(&matrix(rows)?, &classes.to_vec(), parameters)?;
    forest.predict(&matrix(others)?)
}
