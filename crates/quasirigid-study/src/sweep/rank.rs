//! Rank correlation after Spearman, with the probability of its size by chance.
//! Ties share the mean of their ranks, so that the coefficient is Pearson's of the ranks and not the short formula, which ties falsify.

use statrs::function::beta::beta_reg;

/// Rank correlation of pairs: the coefficient, none where one side does not vary, and the probability of one as large by chance.
pub(super) fn spearman(pairs: &[(f64, f64)]) -> (Option<f64>, Option<f64>) {
    let x = ranks(pairs.iter().map(|(x, _)| *x).collect());
    let y = ranks(pairs.iter().map(|(_, y)| *y).collect());
    let Some(rho) = pearson(&x, &y) else { return (None, None) };
    (Some(rho), chance(rho, pairs.len()))
}

/// Ranks from 1, the mean of them for equal numbers.
fn ranks(numbers: Vec<f64>) -> Vec<f64> {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
    let mut ranks = vec![0.0; numbers.len()];
    for equal in order.chunk_by(|a, b| numbers[*a] == numbers[*b]).scan(0, |first, equal| {
        let place = (*first, equal);
        *first += equal.len();
        Some(place)
    }) {
        let (first, places) = equal;
        let mean = first as f64 + (places.len() as f64 + 1.0) / 2.0;
        places.iter().for_each(|place| ranks[*place] = mean);
    }
    ranks
}

fn pearson(x: &[f64], y: &[f64]) -> Option<f64> {
    let mean = (x.len() as f64 + 1.0) / 2.0;
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>();
    let rho = product(x, y) / (product(x, x) * product(y, y)).sqrt();
    rho.is_finite().then(|| rho.clamp(-1.0, 1.0))
}

/// Probability of a coefficient as large without dependence, by Student's distribution; none where that means nothing.
fn chance(rho: f64, count: usize) -> Option<f64> {
    if count < 4 {
        return None;
    }
    let degrees = count as f64 - 2.0;
    // P(|T| > t) = I_x(d/2, 1/2) with x = d/(d + t²), and t² = d ρ²/(1 - ρ²) makes x = 1 - ρ²
    Some(beta_reg(degrees / 2.0, 0.5, (1.0 - rho * rho).clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten pairs by hand: squared differences of ranks sum to 194, so ρ = 1 - 6·194/(10·99) = -29/165; the chance of it with 8 degrees
    /// of freedom is 0.627188 (the worked example of many textbooks: intelligence and hours of television).
    #[test]
    fn coefficient_of_a_hand_example() {
        let iq = [106.0, 100.0, 86.0, 101.0, 99.0, 103.0, 97.0, 113.0, 112.0, 110.0];
        let hours = [7.0, 27.0, 2.0, 50.0, 28.0, 29.0, 20.0, 12.0, 6.0, 17.0];
        let pairs: Vec<_> = iq.into_iter().zip(hours).collect();
        let (rho, p) = spearman(&pairs);
        assert!((rho.unwrap_or(9.0) + 29.0 / 165.0).abs() < 1e-15);
        assert!((p.unwrap_or(9.0) - 0.627_188).abs() < 1e-6);
    }

    /// Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: covariance 4.5, variances 4.5 and 5.
    #[test]
    fn ties_share_the_mean_of_their_ranks() {
        let (rho, _) = spearman(&[(1.0, 1.0), (2.0, 2.0), (2.0, 3.0), (9.0, f64::INFINITY)]);
        assert!((rho.unwrap_or(9.0) - 4.5 / (4.5f64 * 5.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn monotone_pairs_have_one_and_constant_ones_none() {
        let pairs: Vec<_> = (0..9).map(|i| (f64::from(i), -f64::from(i).exp())).collect();
        assert_eq!(spearman(&pairs), (Some(-1.0), Some(0.0)));
        assert_eq!(spearman(&[(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]), (None, None));
        assert_eq!(spearman(&[]), (None, None));
    }
}
