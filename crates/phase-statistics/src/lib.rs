//! The statistics of all PHASE reports: means, quantiles, confidence intervals and tests, each defined once.
//!
//! - [`mean`] and [`standard_error`] of a sample.
//! - [`percentile`] and [`quartiles`] by nearest rank, and the conventional [`median`], the midpoint of the
//!   two central values.
//! - [`wilson_interval`] for a proportion, [`bootstrap_mean`] for the mean of anything,
//!   [`bootstrap_difference`] for that of two, [`bootstrap`] for any statistic.
//! - [`pearson`], [`spearman`] and [`kendall`] correlations, the [`semipartial`] one, and [`spearman_brown`]
//!   for the reliability of a whole.
//! - [`krippendorff_alpha`] for the agreement of raters, [`standard_deviation`] of a sample,
//!   [`population_variance`] of all there is.
//! - [`fisher_exact_greater`] to compare two proportions.
//! - [`log_sum_exp`], [`log_softmax`], [`softmax`] and [`logistic`] between probabilities and their
//!   logarithms; [`entropy`].
//!
//! Key design decision: every function takes plain slices and counts and names its definition. Nine quantile
//! definitions and half a dozen intervals for a proportion are in use, and two reports are comparable only if
//! both use the same ones. Random numbers come from a generator that the caller seeds, and transcendental
//! functions from `libm`, so that a report is the same on every platform. The trade-off is that a statistic
//! of a structure needs a vector of numbers first, and that percentiles sort a copy for each call.
//!
//! # Example
//!
//! ```
//! use phase_statistics::{fisher_exact_greater, percentile, wilson_interval};
//!
//! // Newcombe (1998), Table I: 81 successes in 263 trials.
//! let interval = wilson_interval(81, 263);
//! assert!((interval.low - 0.2553).abs() < 5e-5 && (interval.high - 0.3662).abs() < 5e-5);
//!
//! // Fisher's tea-tasting experiment: 3 of 4 cups recognised against 1 of 4 mistaken.
//! let p = fisher_exact_greater((3, 4), (1, 4));
//! assert!((p - 17.0 / 70.0).abs() < 1e-9);
//!
//! assert_eq!(percentile(&[15.0, 20.0, 35.0, 40.0, 50.0], 30), Some(20.0));
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod agreement;
mod bootstrap;
mod correlation;
mod fisher;
mod interval;
mod logarithms;
mod mean;
mod proportion;
mod quantile;

pub use agreement::krippendorff_alpha;
pub use bootstrap::{bootstrap, bootstrap_difference, bootstrap_mean};
pub use correlation::{kendall, pearson, semipartial, spearman, spearman_brown};
pub use fisher::fisher_exact_greater;
pub use interval::Interval;
pub use logarithms::{entropy, log_softmax, log_sum_exp, logistic, softmax};
pub use mean::{mean, population_variance, standard_deviation, standard_error};
pub use proportion::wilson_interval;
pub use quantile::{median, percentile, quartiles};
