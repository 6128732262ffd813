//! Printed verdicts do not know the axes of the file, its units, or the order of the parts: words, names, refusals, and rates beyond tolerance,
//! of bodies of many kinds. (M1), (M12), (Q15)

use quasirigid_io::record::{ModeRecord, SteadySpinRecord};
use quasirigid_math::random::Random;
use quasirigid_math::vec3::norm;
use quasirigid_study::modes::{Modes, PrincipalAxis, SteadySpinSettings};

use crate::support::any_body::{AnyBody, Told};
use crate::support::{study, try_evolve};

/// Bodies of a run of the tests, and those of them that are followed to the end of their wobble.
const BODIES: u64 = 40;
const EVOLVED: u64 = 8;
/// Relative change of a number that no printed digit shows.
const SHOWN: f64 = 1e-4;
/// Rounding of moments of inertia, over a relative difference of two.
const ROUNDING: f64 = 1e-14;
/// Units of time in which words tell a number.
const TIMES: [&str; 9] = ["ms", "s", "min", "h", "d", "yr", "kyr", "Myr", "Gyr"];

/// A verdict: its words without numbers, and its numbers with their sizes, in the first unit of time.
#[derive(Debug, Default, PartialEq)]
struct Verdict {
    words: Vec<String>,
    numbers: Vec<[f64; 2]>,
}

/// Words of a text, without numbers and the units of time behind them.
#[track_caller]
fn words(text: &str) -> String {
    assert!(!text.contains("NaN"), "{text}");
    let mut told: Vec<&str> = Vec::new();
    for word in text.split_whitespace() {
        let bare = word.trim_matches(|letter: char| ",.;:()[]%".contains(letter));
        let number = bare.parse::<f64>().is_ok() || bare.split(',').all(|part| part.parse::<f64>().is_ok());
        let unit = told.last() == Some(&"#") && TIMES.contains(&bare);
        if !unit {
            told.push(if number {
                "#"
            } else {
                word.trim_end_matches(|letter: char| ",.;:".contains(letter))
            });
        }
    }
    told.join(" ")
}

/// A mode in words, the coordinates of which have the names of axes, with its decay rate and frequency.
fn told(mode: &ModeRecord, time: f64) -> (String, [f64; 2]) {
    let name = if mode.name.starts_with("nutation") { &*mode.name } else { "another" };
    let words = format!("{name} {} {}", mode.neutral, mode.time_constant.is_some());
    (words, [mode.decay_rate, mode.frequency].map(|rate| rate * time))
}

fn of_spin(spin: &SteadySpinRecord, time: f64) -> Verdict {
    let mut verdict = Verdict {
        words: vec![format!("{}: {}, {}", spin.axis, words(&spin.sentence), spin.stable)],
        ..Verdict::default()
    };
    let Some(omega) = spin.spin else { return verdict };
    let rate = norm(omega) * time;
    verdict.numbers.push([rate, rate]);
    let mut modes: Vec<(String, [f64; 2])> = spin.modes.iter().map(|mode| told(mode, time)).collect();
    modes.sort_by(|a, b| a.0.cmp(&b.0).then(a.1[1].total_cmp(&b.1[1])).then(a.1[0].total_cmp(&b.1[0])));
    for (words, [decay, frequency]) in modes {
        verdict.numbers.push([frequency, frequency.abs() + decay.abs()]);
        if words.starts_with("nutation") {
            verdict.numbers.push([decay, decay.abs()]);
        }
        verdict.words.push(words);
    }
    verdict
}

fn of_modes(model: &str, time: f64, axis: Option<PrincipalAxis>) -> Verdict {
    match study(model).modes(SteadySpinSettings { axis, ..SteadySpinSettings::default() }) {
        Err(refused) => Verdict { words: vec![words(&refused.to_string())], ..Verdict::default() },
        Ok(Modes { spins, .. }) => spins.iter().fold(Verdict::default(), |mut all, spin| {
            let Verdict { words, numbers } = of_spin(spin, time);
            all.words.extend(words);
            all.numbers.extend(numbers);
            all
        }),
    }
}

/// The verdict of `check`, and the steady spins that it tells with their modes.
fn of_check(model: &str) -> Verdict {
    let study = study(model);
    let told = study.check().map_or_else(|refused| refused.to_string(), |found| found.text());
    let (head, rest) = told.split_once("\n\n").unwrap_or((&told, ""));
    let verdict = head.split("\n  - ").next().unwrap_or_default();
    let spins = rest.split("\n\n").filter(|part| part.contains("with the modes about them"));
    Verdict { words: [verdict].into_iter().chain(spins).map(words).collect(), ..Verdict::default() }
}

fn of_evolution(model: &str, time: f64) -> Verdict {
    match try_evolve(&study(model), |_| {}) {
        Err(refused) => Verdict { words: vec![words(&refused)], ..Verdict::default() },
        Ok(found) => {
            let record = found.record;
            let lasts = record.time / time;
            let told = words(&record.sentence);
            assert!(!told.is_empty());
            let words = vec![record.status.clone(), words(&record.message)];
            Verdict { words, numbers: vec![[lasts, lasts]] }
        }
    }
}

/// What differs between two verdicts, beyond a tolerance of numbers.
fn difference(own: &Verdict, other: &Verdict, tolerance: f64) -> Option<String> {
    if let Some((a, b)) = own.words.iter().zip(&other.words).find(|(a, b)| a != b) {
        return Some(format!("\n    {a}\n    {b}"));
    }
    if own.words.len() != other.words.len() || own.numbers.len() != other.numbers.len() {
        return Some(format!("\n    {own:?}\n    {other:?}"));
    }
    let apart = own.numbers.iter().zip(&other.numbers).find(|([a, own], [b, other])| {
        let gap = (a - b).abs();
        gap > tolerance * own.max(*other)
    });
    apart.map(|([a, _], [b, _])| format!("{a:e} and {b:e}"))
}

/// Kinds of parts of which a body is followed within a second.
fn is_quick(body: &AnyBody) -> bool {
    !body.kinds.iter().any(|kind| ["liquid", "hinge", "ring", "wheel"].contains(kind))
}

fn count() -> u64 {
    std::env::var("PROPTEST_CASES").ok().and_then(|count| count.parse().ok()).unwrap_or(BODIES)
}

/// Bodies of which a question is answered otherwise in other axes, units or order.
fn changed(
    count: u64,
    asked: impl Fn(&AnyBody) -> bool,
    answer: impl Fn(&Told) -> Verdict,
    shown: f64,
) -> Vec<String> {
    let mut found = Vec::new();
    for seed in 0..count {
        let mut random = Random::new(seed);
        let body = AnyBody::draw(&mut random);
        if !asked(&body) {
            continue;
        }
        let tolerance = shown + ROUNDING / body.apart.max(1e-13);
        let [first, others @ ..] = body.told(&mut random);
        let own = answer(&first);
        for other in &others {
            if let Some(what) = difference(&own, &answer(other), tolerance) {
                found.push(format!("{seed} {:?} {:e} {}: {what}", body.kinds, body.apart, other.how));
            }
        }
    }
    found
}

#[track_caller]
fn none_of(found: &[String]) {
    assert!(found.is_empty(), "{}:\n{}", found.len(), found.join("\n"));
}

#[test]
fn modes_do_not_depend_on_axes_units_and_order() {
    none_of(&changed(count(), |_| true, |told| of_modes(&told.model, told.time, None), SHOWN));
}

#[test]
fn modes_about_an_axis_do_not_depend_on_axes_units_and_order() {
    for axis in PrincipalAxis::ALL {
        none_of(&changed(count() / 2, |_| true, |told| of_modes(&told.model, told.time, Some(axis)), SHOWN));
    }
}

#[test]
fn checks_do_not_depend_on_axes_units_and_order() {
    none_of(&changed(count() / 2, |_| true, |told| of_check(&told.model), SHOWN));
}

/// The end of a wobble is known to a percent or so.
#[test]
fn evolutions_do_not_depend_on_axes_units_and_order() {
    let count = if count() == BODIES { EVOLVED } else { count() };
    none_of(&changed(count, is_quick, |told| of_evolution(&told.model, told.time), 2e-2));
}
