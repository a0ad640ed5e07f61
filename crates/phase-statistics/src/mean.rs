//! Means and their standard errors.

/// The arithmetic mean, summed from first to last; `None` for an empty slice.
#[must_use]
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The sample standard deviation, with n − 1 degrees of freedom. `None` below two values.
#[must_use]
pub fn standard_deviation(values: &[f64]) -> Option<f64> {
    variance(values).map(libm::sqrt)
}

/// The standard error of the mean: the sample standard deviation over √n. `None` below two values.
#[must_use]
pub fn standard_error(values: &[f64]) -> Option<f64> {
    variance(values).map(|variance| libm::sqrt(variance / values.len() as f64))
}

/// The variance of all values there are, the mean square of the differences from their mean: n degrees of
/// freedom, not n − 1 as for a sample. `None` for an empty slice.
#[must_use]
pub fn population_variance(values: &[f64]) -> Option<f64> {
    Some(squares(values)? / values.len() as f64)
}

fn variance(values: &[f64]) -> Option<f64> {
    let squares = squares(values)?;
    (values.len() > 1).then(|| squares / (values.len() as f64 - 1.0))
}

/// The sum of the squares of the differences from the mean.
fn squares(values: &[f64]) -> Option<f64> {
    let mean = mean(values)?;
    Some(values.iter().map(|value| (value - mean) * (value - mean)).sum())
}
