//! Means and their standard errors.

/// The arithmetic mean, summed from first to last; `None` for an empty slice.
#[must_use]
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The standard error of the mean: the sample standard deviation (with n − 1 degrees of freedom) over √n. `None`
/// below two values.
#[must_use]
pub fn standard_error(values: &[f64]) -> Option<f64> {
    let (mean, count) = (mean(values)?, values.len() as f64);
    let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    (values.len() > 1).then(|| libm::sqrt(squares / (count - 1.0) / count))
}
