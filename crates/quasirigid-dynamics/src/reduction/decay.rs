//! Quadratic eigenvalue problem of damped vibrations: decay rates over any range of magnitudes.
//! One linearisation for `λ` and one for `1/λ`, because each keeps the digits of one half of the eigenvalues; a single one loses slow
//! decays beside fast ones.
//! Equation (V3), docs/theory/04-validity.md; linearisation `[@tisseur2001]`.

use crate::math::eigen::{Dense, Eigenmodes, NoConvergence, eigenvectors, squares};

/// Damped vibration: the magnitude of its eigenvalue and its decay rate (1/s).
#[derive(Clone, Copy)]
struct Decay {
    magnitude: f64,
    rate: f64,
}

/// Decay rates of `λ²A + λB + C`, ascending, without infinite ones. (V3)
///
/// Two first-order forms in the undamped modes, with `B = GᵀG`: one for `1/λ`, accurate where `λ` is small, and one for `λ`, accurate
/// where it is large. They are joined in the middle. A coordinate without mass has the first form alone.
pub(super) fn decay_rates(modes: &Eigenmodes, B: &Dense) -> Result<Vec<f64>, NoConvergence> {
    let forms = between(modes, &squares(B)?);
    let mut decays = of_periods(modes, &forms)?;
    if modes.frequencies.iter().all(|frequency| frequency.is_finite()) {
        decays = joined(decays, of_rates(modes, &forms)?);
    }
    let finite = decays.iter().filter(|decay| decay.magnitude.is_finite());
    let mut rates: Vec<f64> = finite.map(|decay| decay.rate).collect();
    rates.sort_by(f64::total_cmp);
    Ok(rates)
}

/// Linear forms of the displacements in the undamped modes, each with a unit of elastic energy.
fn between(modes: &Eigenmodes, forms: &Dense) -> Dense {
    let size = modes.frequencies.len();
    let unit = |k: usize| if modes.frequencies[k].is_finite() { modes.frequencies[k].recip() } else { 1.0 };
    let mut between = Dense::zero(size);
    for column in 0..size {
        let shape: Vec<f64> = (0..size).map(|j| unit(column) * modes.shapes.at(j, column)).collect();
        forms.times(&shape).iter().enumerate().for_each(|(form, value)| between.add(form, column, *value));
    }
    between
}

/// From `μ = 1/λ`: `μ u = −GᵀG u − Ω⁻¹v`, `μ v = Ω⁻¹u`, whose entries are bounded however fast some vibrations are.
fn of_periods(modes: &Eigenmodes, forms: &Dense) -> Result<Vec<Decay>, NoConvergence> {
    let periods: Vec<f64> = modes.frequencies.iter().map(|frequency| frequency.recip()).collect();
    let (values, vectors) = eigenvectors(&first_order(forms, &periods))?;
    let largest = values.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    let rounding = values.len() as f64 * f64::EPSILON * largest;
    let decay = |([re, im], x): (&[f64; 2], &Vec<[f64; 2]>)| {
        let magnitude = re.hypot(*im);
        let rate = if oscillates(*re, *im) { lost(forms, x) } else { -re } / magnitude.powi(2);
        match magnitude > rounding {
            true => Decay { magnitude: magnitude.recip(), rate },
            false => Decay { magnitude: f64::INFINITY, rate: f64::INFINITY },
        }
    };
    Ok(sorted(values.iter().zip(&vectors).map(decay).collect()))
}

/// From `λ`: `λ v = −GᵀG v − Ω y`, `λ y = Ω v`, with `G` in the modes of unit mass.
fn of_rates(modes: &Eigenmodes, forms: &Dense) -> Result<Vec<Decay>, NoConvergence> {
    let size = modes.frequencies.len();
    let mut heavy = Dense::zero(size);
    for (form, k) in (0..size).flat_map(|form| (0..size).map(move |k| (form, k))) {
        heavy.add(form, k, forms.at(form, k) * modes.frequencies[k]);
    }
    let (values, vectors) = eigenvectors(&first_order(&heavy, &modes.frequencies))?;
    let decay = |([re, im], x): (&[f64; 2], &Vec<[f64; 2]>)| Decay {
        magnitude: re.hypot(*im),
        rate: if oscillates(*re, *im) { lost(&heavy, x) } else { -re },
    };
    Ok(sorted(values.iter().zip(&vectors).map(decay).collect()))
}

/// Matrix of rows `−GᵀG`, `−d` and `d`, `0`.
fn first_order(forms: &Dense, diagonal: &[f64]) -> Dense {
    let size = diagonal.len();
    let mut system = Dense::zero(2 * size);
    for (k, entry) in diagonal.iter().enumerate() {
        system.add(k, size + k, -entry);
        system.add(size + k, k, *entry);
        for row in 0..size {
            system.add(row, k, -(0..size).map(|form| forms.at(form, row) * forms.at(form, k)).sum::<f64>());
        }
    }
    system
}

/// True if the motion oscillates: its decay rate then is that of the energy balance, `|Gu|² / 2|v|²`, never negative.
fn oscillates(re: f64, im: f64) -> bool {
    im.abs() > re.abs()
}

/// Half the loss over the energy of the second half of an eigenvector, which has the magnitude of the first.
fn lost(forms: &Dense, x: &[[f64; 2]]) -> f64 {
    let (u, v) = x.split_at(forms.size());
    let part = |i: usize| forms.times(&u.iter().map(|entry| entry[i]).collect::<Vec<_>>());
    let lost: f64 = [part(0), part(1)].iter().flatten().map(|entry| entry * entry).sum();
    0.5 * lost / v.iter().flatten().map(|entry| entry * entry).sum::<f64>()
}

fn sorted(mut decays: Vec<Decay>) -> Vec<Decay> {
    decays.sort_by(|a, b| a.magnitude.total_cmp(&b.magnitude));
    decays
}

/// Relative difference of magnitudes below which the lists are not split between them.
const APART: f64 = 1e-6;

/// Joins the slow decays of the first list and the fast ones of the second at the gap nearest to the middle of the magnitudes.
fn joined(slow: Vec<Decay>, fast: Vec<Decay>) -> Vec<Decay> {
    let (Some(least), Some(most)) = (slow.first(), fast.last()) else { return slow };
    let middle = 0.5 * (least.magnitude.ln() + most.magnitude.ln());
    let apart = |list: &[Decay], at: usize| list[at].magnitude > list[at - 1].magnitude * (1.0 + APART);
    let off = |at: usize| (0.5 * (fast[at].magnitude.ln() + slow[at - 1].magnitude.ln()) - middle).abs();
    let gaps = (1..slow.len()).filter(|at| apart(&slow, *at) && apart(&fast, *at));
    match gaps.min_by(|a, b| off(*a).total_cmp(&off(*b))) {
        Some(at) => slow.into_iter().take(at).chain(fast.into_iter().skip(at)).collect(),
        None => slow,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::eigen::modes;

    fn dense(rows: &[&[f64]]) -> Dense {
        let mut matrix = Dense::zero(rows.len());
        for (i, row) in rows.iter().enumerate() {
            row.iter().enumerate().for_each(|(j, entry)| matrix.add(i, j, *entry));
        }
        matrix
    }

    /// Three parts: an oscillator, one 10⁹ times faster without loss, and a coordinate without mass on a spring and a dashpot; rotated,
    /// so that no matrix is diagonal.
    #[test]
    fn decay_rates_are_those_of_their_parts_however_fast_some_are() {
        let (sine, cosine) = 0.7_f64.sin_cos();
        let turn = [[cosine, -sine, 0.0], [0.8 * sine, 0.8 * cosine, 0.6], [-0.6 * sine, -0.6 * cosine, 0.8]];
        let turned = |diagonal: [f64; 3]| {
            let entry = |i: usize, j: usize| (0..3).map(|k| turn[i][k] * diagonal[k] * turn[j][k]).sum();
            let rows: Vec<Vec<f64>> = (0..3).map(|i| (0..3).map(|j| entry(i, j)).collect()).collect();
            dense(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>())
        };
        let (A, B, C) = (turned([2.0, 2e-8, 0.0]), turned([0.4, 0.0, 5.0]), turned([18.0, 18e10, 3.0]));
        let rates = decay_rates(&modes(&A, &C).unwrap(), &B).unwrap();
        let slow: Vec<f64> = rates.iter().copied().filter(|rate| *rate > 1e-3 && *rate < 1e3).collect();
        for (found, expected) in slow.iter().zip([0.1, 0.1, 0.6]) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{rates:?}");
        }
        assert_eq!(slow.len(), 3, "{rates:?}");
        assert!(rates.iter().all(|rate| *rate >= 0.0), "{rates:?}");
    }

    /// A slow decay and a very fast one keep their digits beside each other.
    #[test]
    fn neither_a_slow_decay_nor_a_fast_one_is_lost_beside_the_other() {
        let A = dense(&[&[1.0, 0.3], &[0.3, 1.0]]);
        let B = dense(&[&[1e-3, 0.0], &[0.0, 1e14]]);
        let C = dense(&[&[4.0, 0.0], &[0.0, 1e14]]);
        let rates = decay_rates(&modes(&A, &C).unwrap(), &B).unwrap();
        // The second coordinate creeps at 1/s, the first oscillates at 2 rad/s and loses 1e-3/2 beside it.
        assert!((rates[0] / 5e-4 - 1.0).abs() < 1e-6 && (rates[2] - 1.0).abs() < 1e-6, "{rates:?}");
        let B = dense(&[&[1e-3, 0.0], &[0.0, 1e9]]);
        let C = dense(&[&[4.0, 0.0], &[0.0, 1e4]]);
        let rates = decay_rates(&modes(&A, &C).unwrap(), &B).unwrap();
        // Now the creep takes 10⁵ s, and the fast decay is that of the dashpot on the mass not coupled to the first, 10⁹/(1 − 0.3²).
        assert!(
            (rates[0] / 1e-5 - 1.0).abs() < 1e-6 && (rates[3] * 0.91 / 1e9 - 1.0).abs() < 1e-9,
            "{rates:?}"
        );
    }
}
