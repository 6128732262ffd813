//! Errors that evolutions tell of their times cover the true ones: bodies with two equal moments about an axis in no symmetry, in odd units.
//! Equations (Q17), (Q18), docs/theory/16-methods.md.

use quasirigid_io::model::{EvolveMethod, Power, System};
use quasirigid_study::settings::PartialRun;

use crate::support::{column, ellipsoid, evolved, history, spinning, study, table};

/// Axis of revolution, and a direction across it.
const AXIS: [f64; 3] = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
const ACROSS: [f64; 3] = [6.0 / 7.0, 2.0 / 7.0, -3.0 / 7.0];

/// A carrier of revolution with a damped mass on its axis, and the time (s) of some hundred revolutions.
struct Revolution {
    model: String,
    duration: f64,
}

impl Revolution {
    /// Body of a number: oblate and prolate by turns, softer and stiffer, wobbling little and much, from grams and millimetres to tonnes.
    fn numbered(number: u32) -> Self {
        // shares that fill the cube of parameters evenly
        let share = |factor: f64| (0.5 + f64::from(number) * factor).fract();
        let [mass, length, time] = [(0.8191725134, 6.0), (0.6710436067, 4.0), (0.5497004779, 4.0)]
            .map(|(factor, decades)| 10f64.powf(decades * (share(factor) - 0.5)));
        let ratio =
            if number.is_multiple_of(2) { 1.5 + 0.45 * share(0.4503) } else { 0.25 + 0.5 * share(0.4503) };
        let moments = [4.0, 4.0 * ratio].map(|moment| moment * mass * length * length);
        let inertia: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let across = if i == j { moments[0] } else { 0.0 };
                across + (moments[1] - moments[0]) * AXIS[i] * AXIS[j]
            })
        });
        let (spin, tilt) = (1.0 / time, 0.3 + 0.9 * share(0.3688));
        let omega: [f64; 3] = std::array::from_fn(|i| spin * (tilt.cos() * AXIS[i] + tilt.sin() * ACROSS[i]));
        let (carrier, point) = (20.0 * mass, mass * (1.0 + share(0.3021)));
        let place = AXIS.map(|e| length * (0.4 + 0.5 * share(0.2474)) * e);
        let frequency = spin / (0.06 + 0.07 * share(0.2027));
        let stiffness = carrier * point / (carrier + point) * frequency * frequency;
        let damping = 2.0 * (0.2 + 0.5 * share(0.166)) * stiffness / frequency;
        let model = format!(
            "[carrier]\nmass = {carrier:e}\ncenter_of_mass = [0, 0, 0]\ninertia = {inertia:?}\n\
             [[point]]\nname = \"mass\"\nmass = {point:e}\nposition = {place:?}\n\
             [[spring]]\nfrom = \"mass\"\nto = \"carrier\"\nstiffness = {stiffness:e}\ndamping = {damping:e}\n{}",
            spinning(omega)
        );
        Self { model, duration: 5e3 * time }
    }
}

/// The full system takes the time on levels to the same energy, but for what is told.
#[test]
fn times_on_levels_are_as_good_as_told() {
    for number in 1..=10 {
        let Revolution { model, duration } = Revolution::numbered(number);
        let found = evolved(&study(&model), |asked| {
            (asked.method, asked.duration) = (Some(EvolveMethod::Levels), Some(duration));
        })
        .record;
        assert_eq!((&*found.road, &*found.status), ("levels", "finished"), "{number}: {}", found.message);
        assert!(found.verdict.contains("the time is good to"), "{}", found.verdict);
        let energy = column(&found.columns, "energy").last().unwrap();
        let stopped = study(&format!("{model}[run]\nstop = {{ energy = {energy:e} }}\n"));
        let tight = PartialRun { tolerance: Some(1e-11), ..PartialRun::default() };
        let full = history(&stopped, &table(System::Full, &[0.0, 1.5 * duration]), tight);
        assert_eq!(full.status, "event", "{number}: {}", full.message);
        let (off, told) = ((found.time / full.run.last.t - 1.0).abs(), found.time_error.unwrap());
        assert!(off <= told && told < 0.03, "{number}: {off:e}, told {told:e}");
    }
}

/// A Kelvin–Voigt spheroid, run x5 of `data/published/quillen_2019`, at wide and narrow wobbles and spins up to a ninth of its slowest
/// frequency: averages that are asked for, beside levels, which the full system confirms.
#[test]
fn averages_of_wide_wobbles_are_as_good_as_told() {
    let model = ellipsoid(
        "[1.2599210498948732, 1.2599210498948732, 0.6299605249474366]",
        [0.238732414637843, 0.25],
        "young = 3.244183",
        "kind = \"kelvin-voigt\", time = 0.01476",
    );
    for (omega, power) in [
        ([0.24, 0.0, 0.26], Power::Polynomial),
        ([0.42, 0.0, 0.2], Power::Harmonics),
        ([0.0, 0.53, 0.25], Power::Harmonics),
    ] {
        let study = study(&(model.clone() + &spinning(omega)));
        let by = |method, power| {
            evolved(&study, |asked| (asked.method, asked.power) = (Some(method), power)).record
        };
        let (levels, average) = (by(EvolveMethod::Levels, None), by(EvolveMethod::Average, Some(power)));
        let told = average.time_error.unwrap();
        for (found, known) in [(average.power, levels.power), (average.time, levels.time)] {
            let off = (found / known - 1.0).abs();
            assert!(off <= told, "{omega:?}: {off:e}, told {told:e}");
        }
        assert!(levels.time_error.unwrap() < told);
    }
}
