use super::projection::Projection;
use crate::math::eigen::{Dense, Modes, NoConvergence, eigenvectors, modes, squares};
use crate::model::FlexibleBody;

/// Free vibrations of a body that does not turn: all of them, or for a body of many coordinates the slow ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibrations {
    /// Undamped natural frequencies with the attitude held (rad/s), ascending. (V2)
    pub frequencies: Vec<f64>,
    /// Undamped natural frequencies with the body free to recoil in rotation (rad/s), ascending; not below the others.
    pub free_frequencies: Vec<f64>,
    /// Decay rates of the damped vibrations with the attitude held (1/s), ascending, two to a coordinate. (V3)
    pub decay_rates: Vec<f64>,
    /// Largest `β` of `B x = β C x` (s). (V5)
    pub damping_time: f64,
    /// The coordinate that moves most in the slowest vibration.
    pub softest: Option<String>,
}

/// Undamped natural frequencies with the attitude held (rad/s), ascending: all, or the slow ones of a body of many
/// coordinates. (V2)
///
/// # Errors
/// [`NoConvergence`] if the eigenvalue solver fails.
pub fn frequencies(body: &FlexibleBody) -> Result<Vec<f64>, NoConvergence> {
    let projection = Projection::of(body)?;
    let held = modes(&projection.A, &projection.C)?;
    Ok(slow(held.frequencies, projection.trusted))
}

impl Vibrations {
    /// Free vibrations of a body.
    ///
    /// # Errors
    /// [`NoConvergence`] if an eigenvalue solver fails.
    pub fn of(body: &FlexibleBody) -> Result<Self, NoConvergence> {
        let projection = Projection::of(body)?;
        let Projection { A, recoiling, B, C, trusted, .. } = &projection;
        let held = modes(A, C)?;
        let softest = projection.largest_share(&held).map(|row| body.coordinates()[row].name.clone());
        Ok(Self {
            decay_rates: slow(decay_rates(&held, B)?, 2 * trusted),
            damping_time: modes(B, C)?.frequencies.first().map_or(0.0, |lowest| lowest.powi(-2)),
            free_frequencies: slow(modes(recoiling, C)?.frequencies, *trusted),
            frequencies: slow(held.frequencies, *trusted),
            softest,
        })
    }
}

/// Those that are trusted and finite: a coordinate whose mass is lost in rounding follows at once.
fn slow(mut ascending: Vec<f64>, trusted: usize) -> Vec<f64> {
    ascending.truncate(trusted);
    ascending.retain(|value| value.is_finite());
    ascending
}

/// Decay rates of `λ²A + λB + C` but for those that are infinite. (V3)
///
/// From `μ = 1/λ`, whose first-order form in the undamped modes, `z` and `v = z/Ω`, has bounded entries however fast some vibrations are:
/// `μ u = −GᵀG u − Ω⁻¹v`, `μ v = Ω⁻¹u` with `u = μz`, `B = GᵀG`. A motion that oscillates has the rate of its balance of energy,
/// `|Gu|² / 2|v|²`, which is never negative.
fn decay_rates(modes: &Modes, B: &Dense) -> Result<Vec<f64>, NoConvergence> {
    let size = modes.frequencies.len();
    let damping = between(modes, &squares(B)?);
    let mut system = Dense::zero(2 * size);
    for (k, frequency) in modes.frequencies.iter().enumerate() {
        system.add(k, size + k, -frequency.recip());
        system.add(size + k, k, frequency.recip());
        for row in 0..size {
            system.add(
                row,
                k,
                -(0..size).map(|form| damping.at(form, row) * damping.at(form, k)).sum::<f64>(),
            );
        }
    }
    let (values, vectors) = eigenvectors(&system)?;
    let largest = values.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    let rounding = 2.0 * size as f64 * f64::EPSILON * largest;
    let rate = |([re, im], x): (&[f64; 2], &Vec<[f64; 2]>)| {
        let square = re * re + im * im;
        if im.abs() <= re.abs() {
            return (-re > rounding).then(|| -re / square);
        }
        let (u, v) = x.split_at(size);
        let part = |i: usize| damping.times(&u.iter().map(|entry| entry[i]).collect::<Vec<_>>());
        let lost: f64 = [part(0), part(1)].iter().flatten().map(|entry| entry * entry).sum();
        let kinetic: f64 = v.iter().flatten().map(|entry| entry * entry).sum();
        (im.abs() > rounding).then(|| 0.5 * lost / (kinetic * square))
    };
    let mut rates: Vec<f64> = values.iter().zip(&vectors).filter_map(rate).collect();
    rates.sort_by(f64::total_cmp);
    Ok(rates)
}

/// Linear forms of the displacements in the undamped modes, each with a unit of elastic energy.
fn between(modes: &Modes, forms: &Dense) -> Dense {
    let size = modes.frequencies.len();
    let unit = |k: usize| if modes.frequencies[k].is_finite() { modes.frequencies[k].recip() } else { 1.0 };
    let mut between = Dense::zero(size);
    for column in 0..size {
        let shape: Vec<f64> = (0..size).map(|j| unit(column) * modes.shapes.at(j, column)).collect();
        forms.times(&shape).iter().enumerate().for_each(|(form, value)| between.add(form, column, *value));
    }
    between
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dense(rows: &[&[f64]]) -> Dense {
        let mut matrix = Dense::zero(rows.len());
        for (i, row) in rows.iter().enumerate() {
            row.iter().enumerate().for_each(|(j, entry)| matrix.add(i, j, *entry));
        }
        matrix
    }

    /// An oscillator, one 10⁹ times faster that loses nothing, and a coordinate without mass on a spring and a dashpot; turned, so that
    /// no matrix is diagonal.
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

    /// Beside a very fast dashpot a slow decay keeps its digits.
    #[test]
    fn a_slow_decay_is_not_lost_beside_a_fast_one() {
        let A = dense(&[&[1.0, 0.3], &[0.3, 1.0]]);
        let B = dense(&[&[1e-3, 0.0], &[0.0, 1e14]]);
        let C = dense(&[&[4.0, 0.0], &[0.0, 1e14]]);
        let rates = decay_rates(&modes(&A, &C).unwrap(), &B).unwrap();
        // The second coordinate creeps at 1/s, the first oscillates at 2 rad/s and loses 1e-3/2 beside it.
        assert!((rates[0] / 5e-4 - 1.0).abs() < 1e-6 && (rates[2] - 1.0).abs() < 1e-6, "{rates:?}");
    }
}
