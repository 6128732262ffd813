//! Inverse cumulative distributions, so that every sampling draws through one function of a number between 0 and 1.
//! A truncated normal distribution is inverted in its lower tail, where the probabilities keep their digits; a range above the middle is
//! mirrored there.

use std::f64::consts::SQRT_2;

use quasirigid_io::study_file::Distribution;
use statrs::function::erf::erfc_inv;

/// The number below which a distribution has the probability `u`, between 0 and 1.
pub(super) fn quantile(distribution: &Distribution, u: f64) -> f64 {
    match distribution {
        Distribution::Uniform([least, greatest]) => (least + (greatest - least) * u).clamp(*least, *greatest),
        Distribution::LogUniform([least, greatest]) => {
            (least * (greatest / least).powf(u)).clamp(*least, *greatest)
        }
        Distribution::Normal { mean, deviation, range: [least, greatest] } => {
            let z = truncated([(least - mean) / deviation, (greatest - mean) / deviation], u);
            (mean + deviation * z).clamp(*least, *greatest)
        }
        Distribution::LogNormal { median, sigma, range: [least, greatest] } => {
            let standard = |end: f64| if end > 0.0 { (end / median).ln() / sigma } else { f64::NEG_INFINITY };
            let z = truncated([standard(*least), standard(*greatest)], u);
            (median * (sigma * z).exp()).clamp(*least, *greatest)
        }
    }
}

/// Quantile of the standard normal distribution truncated to a range.
fn truncated([least, greatest]: [f64; 2], u: f64) -> f64 {
    if least > 0.0 {
        return -truncated([-greatest, -least], 1.0 - u);
    }
    let below = cumulative(least);
    if greatest <= 0.0 {
        // the range may be far in the tail, where its probability is no difference from one
        return standard(below + u * (cumulative(greatest) - below)).clamp(least, greatest);
    }
    let above = cumulative(-greatest);
    // the probability is counted from the nearer end, so that neither tail is lost in rounding
    let lower = below + u * (1.0 - above - below);
    let z = if lower <= 0.5 { standard(lower) } else { -standard(above + (1.0 - u) * (1.0 - above - below)) };
    z.clamp(least, greatest)
}

/// Probability that a standard normal number is below `x`.
fn cumulative(x: f64) -> f64 {
    0.5 * libm::erfc(-x / SQRT_2)
}

/// Quantile of the standard normal distribution for a probability up to a half.
fn standard(probability: f64) -> f64 {
    -SQRT_2 * erfc_inv(2.0 * probability)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE_RANGE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    /// Quantiles of the normal distribution to 15 digits: Wichura's tables for AS 241 (1988), and 5 sigma from its definition.
    #[test]
    fn quantiles_are_those_of_tables() {
        let normal = |range| Distribution::Normal { mean: 10.0, deviation: 2.0, range };
        for (u, z) in [
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_814),
            (1e-20, -9.262_340_089_798_408),
        ] {
            assert!((quantile(&normal(WHOLE_RANGE), u) - (10.0 + 2.0 * z)).abs() < 1e-14 * 10.0, "{u}");
        }
        assert!(
            (quantile(&normal(WHOLE_RANGE), 0.75) - (10.0 + 2.0 * 0.674_489_750_196_081_7)).abs() < 1e-13
        );
        let log =
            Distribution::LogNormal { median: 100.0, sigma: std::f64::consts::LN_10, range: WHOLE_RANGE };
        assert!(
            (quantile(&log, 0.841_344_746_068_542_9) / 1000.0 - 1.0).abs() < 1e-13,
            "one decade above the median"
        );
        assert_eq!(quantile(&Distribution::Uniform([2.0, 6.0]), 0.25), 3.0);
        assert!((quantile(&Distribution::LogUniform([1.0, 1e4]), 0.25) - 10.0).abs() < 1e-13);
    }

    /// The probability of the quantile, by the cumulative distribution and not by its inverse, is the one asked for.
    #[test]
    fn truncated_quantiles_divide_the_probability_that_is_left() {
        for range in [[8.0, 11.0], [12.0, 13.0], [9.0, f64::INFINITY], [f64::NEG_INFINITY, 4.0], [28.0, 29.0]]
        {
            let law = Distribution::Normal { mean: 10.0, deviation: 2.0, range };
            let standard = |x: f64| (x - 10.0) / 2.0;
            let mirrored = range[0] > 10.0;
            let below = |x: f64| if mirrored { -cumulative(-standard(x)) } else { cumulative(standard(x)) };
            let all = below(range[1]) - below(range[0]);
            for u in [0.01, 0.3, 0.5, 0.9, 0.999] {
                let x = quantile(&law, u);
                assert!((range[0]..=range[1]).contains(&x), "{range:?} {u}: {x}");
                let found = (below(x) - below(range[0])) / all;
                assert!((found - u).abs() < 1e-11, "{range:?} {u}: {found}"); // 1e-14 of 9 sigma is 1e-12 of a tail
            }
        }
    }
}
