//! An asteroid whose wobble is damped over millions of years, as 99942 Apophis's may be.

use std::f64::consts::TAU;

use quasirigid_io::record::*;

/// Principal moments over the greatest.
pub const ASTEROID: [f64; 3] = [0.61, 0.965, 1.0];
/// Greatest principal moment (kg·m²).
const GREATEST: f64 = 5e14;
/// Angular momentum (N·m·s): a precession period of some 27 h.
const MOMENTUM: f64 = 3.2e10;
/// Mean power between the axes (W).
const POWER: f64 = 4e-11;
/// `D/I₃` at which the spin counts as steady.
const END: f64 = 0.9999;
const ROWS: usize = 400;
/// Steps of time between rows.
const STEPS: usize = 50;

const COLUMNS: [(&str, &str); 12] = [
    ("t", "s"),
    ("D_over_I3", "1"),
    ("circled_axis", "1"),
    ("nutation_min", "rad"),
    ("nutation_max", "rad"),
    ("energy", "J"),
    ("momentum", "N m s"),
    ("polhode_period", "s"),
    ("precession_period", "s"),
    ("power", "W"),
    ("polynomial_power", "W"),
    ("turns", "1"),
];

/// The evolution from a given `D/I₃` to the steady spin; below 0.965 it starts in the long-axis mode.
pub fn evolution(ratio_start: f64) -> EvolutionRecord {
    let energies = [ratio_start, END].map(|ratio| 1.0 / ratio - 1.0); // energies above the least, over `|K|²/2I₃`
    let energy = |part: f64| energies[0] * (energies[1] / energies[0]).powf(part);
    let mut columns =
        COLUMNS.map(|(name, unit)| Column { name: name.into(), unit: unit.into(), values: vec![] });
    let [mut t, mut revolutions, mut lingering] = [0.0; 3];
    let mut separatrix_time = None;
    for row in 0..ROWS {
        if row > 0 {
            for step in 0..STEPS {
                let part = |step: usize| ((row - 1) * STEPS + step) as f64 / ((ROWS - 1) * STEPS) as f64;
                let (before, after) = (energy(part(step)), energy(part(step + 1)));
                let ratio = 1.0 / (1.0 + 0.5 * (before + after));
                let time = (before - after) * scale() / power(ratio);
                t += time;
                revolutions += time / precession_period(ratio);
                lingering += if (ratio / ASTEROID[1] - 1.0).abs() < 0.01 { time } else { 0.0 };
                if ratio_start < ASTEROID[1] && ratio >= ASTEROID[1] {
                    separatrix_time.get_or_insert(t);
                }
            }
        }
        let ratio = 1.0 / (1.0 + energy(row as f64 / (ROWS - 1) as f64));
        let [least, greatest] = nutation(ratio);
        let values = [
            t,
            ratio,
            if ratio < ASTEROID[1] { 1.0 } else { 3.0 },
            least,
            greatest,
            scale() / ratio,
            MOMENTUM,
            polhode_period(ratio),
            precession_period(ratio),
            power(ratio),
            0.97 * power(ratio),
            revolutions,
        ];
        columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
    }
    let mode = |ratio: f64| if ratio < ASTEROID[1] { "long-axis" } else { "short-axis" };
    EvolutionRecord {
        sentence: "Dissipation turns the rotation into a steady spin about the axis of greatest inertia, within 1 % of the \
                   energy that the wobble can lose."
            .into(),
        road: "average".into(),
        verdict: "Averaged along the polhode.".into(),
        method: "harmonics of the polhode through the linear response of the body, with the rheology of each material".into(),
        status: "finished".into(),
        message: "The target was reached.".into(),
        angular_momentum: MOMENTUM,
        mode_start: mode(ratio_start).into(),
        mode_end: mode(END).into(),
        ratio_start,
        ratio_end: END,
        start: observed(&columns, 0),
        end: observed(&columns, usize::MAX),
        time: t,
        time_error: Some(0.002),
        time_range: Some([0.31 * t, 27.0 * t]),
        revolutions,
        power: power(ratio_start),
        dissipation: super::shares(),
        separatrix_time,
        lingering: (lingering > 0.0).then_some(lingering),
        damping_time: 0.12 * t,
        growth_time: 0.07 * t,
        not_known: vec![],
        homogeneous: None,
        estimates: vec![EstimateRecord { source: "Harris 1994".into(), least: 0.3 * t, greatest: 0.3 * t }],
        harmonics: [0.061, 0.912, 0.0032, 0.0237, 7.1e-5]
            .into_iter()
            .zip(1..)
            .map(|(share, number)| HarmonicRecord {
                number,
                frequency: number as f64 * TAU / polhode_period(ratio_start),
                share,
                dissipation: super::shares().into_iter().map(|(name, part)| (name, part * share)).collect(),
            })
            .collect(),
        resonances: [(7, "slosh.x", 0.9671, 0.113), (12, "boulder.angle", 0.9654, 3.4e-4)]
            .map(|(harmonic, coordinate, ratio, share)| CrossingRecord {
                harmonic,
                frequency: harmonic as f64 * TAU / polhode_period(ratio),
                coordinate: coordinate.into(),
                ratio,
                mode: mode(ratio).into(),
                share,
            })
            .into(),
        approach: None,
        columns: columns.into(),
    }
}

/// `|K|²/2I₃`, the least energy (J).
fn scale() -> f64 {
    0.5 * MOMENTUM * MOMENTUM / GREATEST
}

/// Least and greatest angle between the angular momentum and the axis that it circles.
fn nutation(ratio: f64) -> [f64; 2] {
    let [a, b, c, d] = [1.0 / ASTEROID[0], 1.0 / ASTEROID[1], 1.0 / ASTEROID[2], 1.0 / ratio];
    let squares = if ratio < ASTEROID[1] {
        [(a - d) / (a - c), (a - d) / (a - b)]
    } else {
        [(d - c) / (a - c), (d - c) / (b - c)]
    };
    squares.map(|square: f64| square.clamp(0.0, 1.0).sqrt().asin())
}

fn precession_period(ratio: f64) -> f64 {
    TAU * GREATEST * ratio / MOMENTUM
}

/// Factor of the polhode period, which grows as a logarithm near the separatrix.
fn near_separatrix(ratio: f64) -> f64 {
    1.0 + 0.3 * (1.0 + 0.01 / (ratio - ASTEROID[1]).abs().max(1e-12)).ln()
}

fn polhode_period(ratio: f64) -> f64 {
    6.0 * precession_period(ratio) * near_separatrix(ratio)
}

/// Mean power: zero at either axis, reduced near the separatrix.
fn power(ratio: f64) -> f64 {
    POWER * (1.0 / ratio - 1.0) * (1.0 / ASTEROID[0] - 1.0 / ratio) / near_separatrix(ratio).powi(2)
}

/// A row as observers describe it; the last one if there are fewer.
fn observed(columns: &[Column], row: usize) -> Option<ObservedRecord> {
    let at = |column: usize| {
        let values = &columns[column].values;
        values[row.min(values.len() - 1)]
    };
    Some(ObservedRecord {
        rotation_period: at(7),
        precession_period: at(8),
        nutation_least: at(3),
        nutation_greatest: at(4),
        energy_ratio: at(1).recip(),
    })
}
