//! Comparison of two proportions.

/// Fisher's exact test of two independent proportions, one-sided: the probability, if both groups have the
/// same rate, that the first has as many successes or more, given the number of successes in both together.
/// Each group is (successes, trials); more successes than trials count as all of them. Without trials the
/// answer is 1.
///
/// Fisher, *The Design of Experiments* (1935), chapter 2; `scipy.stats.fisher_exact` with
/// `alternative='greater'`.
#[must_use]
pub fn fisher_exact_greater(first: (usize, usize), second: (usize, usize)) -> f64 {
    let a = first.0.min(first.1);
    let n = first.1;
    let b = second.0.min(second.1);
    let m = second.1;
    let successes = a + b;
    let hypergeometric = |k: usize| {
        let rest = successes.checked_sub(k).filter(|&rest| rest <= m);
        rest.map_or(0.0, |rest| libm::exp(ln_choose(n, k) + ln_choose(m, rest) - ln_choose(n + m, successes)))
    };
    (a..=n.min(successes)).map(hypergeometric).sum::<f64>().min(1.0)
}

/// Natural logarithm of the binomial coefficient.
fn ln_choose(n: usize, k: usize) -> f64 {
    let factorial = |n: usize| libm::lgamma(n as f64 + 1.0);
    factorial(n) - factorial(k) - factorial(n - k)
}
