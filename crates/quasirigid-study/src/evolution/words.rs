//! Secular evolution in words.

use std::f64::consts::TAU;
use std::fmt::{self, Write};

use quasirigid::averaging::{DriftHistory, DriftStopReason, MeanPower, RotationState, spin_barrier};
use quasirigid::secular::choice::{GrowingVibration, Method};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{Column, EstimateRecord, EvolutionRecord, HomogeneousRecord, ObservedRecord};
use quasirigid_io::visible::one_line;

use super::STEADY_SPIN;
use super::answer::Answer;
use super::table::EvolutionTable;
use crate::layout::paragraph;
use crate::settings::EvolveSettings;
use crate::words::{count, dissipation, significant, time};

/// Rows of the table for people.
const TABLE_ROWS: usize = 11;
/// Relative difference of the two powers above which the paper's theory ends.
const APART: f64 = 0.1;
/// Relative error of a time from which the error is mentioned.
const UNCERTAIN: f64 = 1e-6;
/// Angle (rad) from an axis below which a rotation is called a steady spin.
const STEADY: f64 = 1e-8;
/// Probabilities as near as this are equal.
const EQUAL_PROBABILITIES: f64 = 1e-9;

/// End of an evolution, in a sentence.
pub fn message(rows: &EvolutionTable, asked: &EvolveSettings, ages: bool) -> String {
    let reached = time(rows.last().t);
    let ending = rows.drift.as_ref().map(|drift| drift.ending);
    match (rows.status, ending) {
        ("interrupted", _) => {
            format!("Interrupted when {reached} of the evolution were followed; the table holds up to there.")
        }
        ("finished", Some(DriftStopReason::Target)) => format!("The target was reached after {reached}."),
        ("finished", Some(_)) => format!("The rotation was followed for {reached}, as asked."),
        (_, Some(ending)) => format!("Ended after {reached}: {ending}."),
        _ if !ages => "Nothing is dissipated, so that the end is never reached.".into(),
        _ => finished(rows.last().t, asked),
    }
}

/// End at a time (s) of an evolution that dissipates, in a sentence.
pub fn finished(t: f64, asked: &EvolveSettings) -> String {
    let reached = time(t);
    let ended = asked.duration.is_some_and(|duration| t >= duration * (1.0 - STEADY));
    if ended {
        format!("The rotation was followed for {reached}, as asked.")
    } else if asked.until.is_some() {
        format!("The target was reached after {reached}.")
    } else {
        format!("All but 1 % of the energy of the {} was lost after {reached}.", asked.kind.nutation())
    }
}

/// Sentence for a loss that the equations followed leave out.
pub fn lossless(order: usize, kind: BodyKind) -> String {
    format!(
        "Nothing is dissipated by the reduced equations of order {order}, though the body loses energy in the harmonics of its \
         {}: take a higher order, or the power by harmonics.",
        kind.nutation()
    )
}

/// A time that is known to a few digits only.
pub fn uncertain(rows: &EvolutionTable) -> Option<String> {
    let share = rows.error / rows.last().t;
    (share > UNCERTAIN).then(|| {
        format!(
            "The time is known to {} % only: the mean power could not be computed any better, as the moments of this body are \
             very different, or its resonances very narrow.",
            significant(100.0 * share, 2)
        )
    })
}

/// The answer in a sentence or two.
pub fn sentence(record: &EvolutionRecord, drift: Option<&DriftHistory>, kind: BodyKind) -> String {
    let nutation = kind.nutation();
    let angles = column(&record.columns, "nutation_max");
    let [from, to] = [angles.first(), angles.last()].map(|angle| angle.copied().unwrap_or(f64::NAN));
    let [first, last] = [from, to].map(|angle| significant(angle.to_degrees(), 3));
    if record.time.is_infinite() {
        return "Nothing is dissipated: the rotation stays as it is.".into();
    }
    let range = record.time_range.map_or_else(String::new, |[least, greatest]| {
        format!(" ({} to {} over the ranges of the materials)", time(least), time(greatest))
    });
    let taken = format!("in {}{range}, {} revolutions", time(record.time), count(record.revolutions));
    let crossed = record.separatrix_time.map_or_else(String::new, |seconds| {
        let probability =
            drift.and_then(|drift| drift.passages.first()).map_or(0.5, |passage| passage.probability);
        format!(" It passes the separatrix after {}{}.", time(seconds), odds(probability))
    });
    let drifted = drift.map_or_else(String::new, |drift| {
        let [before, after] =
            [record.angular_momentum, drift.end.angular_momentum].map(|G| significant(G, 4));
        let died_out = drift
            .died_out
            .map_or_else(String::new, |t| format!(" Its {nutation} died out after {}.", time(t)));
        format!("{died_out} The angular momentum went from {before} to {after} N m s.")
    });
    let axis = if record.mode_start == "short-axis" { "greatest" } else { "least" };
    let last = if to < STEADY {
        format!("{last} degrees, that is in the steady spin,")
    } else {
        format!("{last} degrees")
    };
    if record.mode_start != record.mode_end {
        return format!(
            "The rotation goes over from the {} to the {} mode and ends with a {nutation} of {last} {taken}.{crossed}{drifted}",
            record.mode_start, record.mode_end
        );
    }
    if record.separatrix_time.is_some() {
        return format!(
            "The rotation turns over: it comes to circle the other side of the axis of {axis} inertia, and ends with a {nutation} \
             of {last} {taken}.{crossed}{drifted}"
        );
    }
    if from == 0.0 && to == 0.0 {
        return format!("The spin about the axis of {axis} inertia stays steady {taken}.{drifted}");
    }
    let verb = if to > from { "grows" } else { "falls" };
    let changes = if format!("{first} degrees") == last {
        format!("changes by less than its last digit from {last}")
    } else {
        format!("{verb} from {first} to {last}")
    };
    format!(
        "The {nutation} about the axis of {axis} inertia {changes} {taken}, {} mode throughout.{drifted}",
        record.mode_start
    )
}

/// Probability of the side that is entered at the separatrix, in words.
fn odds(probability: f64) -> String {
    if probability > 1.0 - EQUAL_PROBABILITIES {
        String::new()
    } else if (probability - 0.5).abs() < EQUAL_PROBABILITIES {
        "; both senses of the final spin are equally likely".into()
    } else {
        format!("; the sense followed has the probability {}", significant(probability, 2))
    }
}

/// Notes to read before the numbers.
pub fn notes(answer: &Answer, ends: [RotationState; 2], unranged: bool) -> Vec<String> {
    let inputs = answer.inputs;
    let mut notes: Vec<String> =
        answer.parametric.iter().map(|growing| parametric(growing, inputs.kind)).collect();
    if answer.may_be_unstable && !matches!(answer.method, Method::FullSystem) {
        notes.push(
            "Whether a vibration grows in the spin about the axis of greatest inertia is NOT KNOWN: of so many coordinates the slowest modes \
             were found alone, and the energy is not shown to be least in that spin."
                .into(),
        );
    }
    let motions = ends.map(|rotation_state| answer.evolution().motion(rotation_state));
    let powers = &inputs.powers;
    let ratio = powers.response.mean_power(&motions[0]) / powers.polynomial.mean_power(&motions[0]);
    let judged = answer.rates.is_some();
    if !judged && !inputs.viscoelastic && ratio.is_finite() && (ratio - 1.0).abs() > APART {
        notes.push(format!(
            "At the start the harmonics take {} of the power of the reduced equations: the frequencies are not low, or a \
             resonance is near, and the harmonics are right{}.",
            significant(ratio, 3),
            if answer.by_polynomial() { "; this answer takes the polynomial" } else { "" }
        ));
    }
    let first = |motion: &quasirigid::averaging::FreeRotation| motion.harmonics().next();
    let frequencies: Vec<f64> = motions.iter().filter_map(first).map(|harmonic| harmonic.frequency).collect();
    for [low, high] in &inputs.measured {
        if let Some(outside) = frequencies.iter().find(|frequency| !(low..=high).contains(frequency)) {
            notes.push(format!(
                "The polhode frequency, {} rad/s, is outside the range in which a material was measured ({} to {} rad/s); its last value was taken.",
                significant(*outside, 3),
                significant(*low, 3),
                significant(*high, 3)
            ));
        }
    }
    if answer.by_polynomial() && inputs.viscoelastic {
        notes.push("The reduced equations hold no loss of a material that is not Kelvin-Voigt: take it from the harmonics.".into());
    }
    if unranged {
        notes.push("The ranges of the materials are left out under a torque.".into());
    }
    notes
}

/// Relative difference of a nutation from that of the model from which it is told.
const OTHER_NUTATION: f64 = 0.05;

/// Nutation at the start of an answer that is not the one of the model (rad), which is then that of the undeformed body.
pub fn other_nutation(of_model: f64, kind: BodyKind, record: &EvolutionRecord) -> Option<String> {
    let first = *column(&record.columns, "nutation_max").first()?;
    ((first - of_model).abs() > OTHER_NUTATION * of_model).then(|| {
        format!(
            "The model's {}, {} degrees, is that of the undeformed body: its spin moves the parts so far that the motion starts at {} \
             degrees about the steady spin.",
            kind.nutation(),
            significant(of_model.to_degrees(), 4),
            significant(first.to_degrees(), 4)
        )
    })
}

/// An answer that ends with the nutation, before the duration asked for.
pub fn ended_before(asked: &EvolveSettings, record: &EvolutionRecord) -> Option<String> {
    let duration =
        asked.duration.filter(|duration| asked.until.is_none() && *duration > 1.01 * record.time)?;
    (record.status == "finished").then(|| {
        format!(
            "The answer ends after {}, before the {} asked for: all but 1 % of the energy of the {} is lost there, and the rest falls on{}.",
            time(record.time),
            time(duration),
            asked.kind.nutation(),
            if record.damping_time.is_finite() { format!(", e-fold in {}", time(record.damping_time)) } else { String::new() }
        )
    })
}

/// Vibration that grows from nothing, in a sentence.
fn parametric(growing: &GrowingVibration, kind: BodyKind) -> String {
    let GrowingVibration { coordinate, frequency, rate, wobble } = growing;
    format!(
        "Parametric resonance: at a {} of {} degrees a vibration of {coordinate} at {} rad/s grows from nothing, e-fold in {}.",
        kind.nutation(),
        significant(wobble.to_degrees(), 3),
        significant(*frequency, 4),
        time(rate.recip())
    )
}

/// Radius (m) of the ball of the same volume above which asteroids do not spin beyond the barrier.
const LOOSE: f64 = 100.0;

/// Note on a homogeneous body that spins so fast at an end of its evolution, by its angular velocities (rad/s), that gravity does not hold loose
/// material. (A13)
pub fn beyond_gravity(homogeneous: Option<HomogeneousRecord>, spins: [f64; 2]) -> Option<String> {
    let HomogeneousRecord { density, radius, .. } = homogeneous?;
    let barrier = spin_barrier(density);
    let place = spins.iter().position(|spin| *spin > barrier).filter(|_| radius > LOOSE)?;
    Some(format!(
        "At the {} the body turns once in {}, faster than {}, where gravity no longer holds loose material at the equator of a ball of its \
         density: asteroids of this size break up there, and the model, which cannot break, goes on.",
        ["start", "end"][place],
        time(TAU / spins[place]),
        time(TAU / barrier)
    ))
}

/// The answer, the table and the details, for a terminal of 80 columns.
pub fn text(name: &str, kind: BodyKind, record: &EvolutionRecord) -> String {
    let mut text = String::new();
    write(&mut text, &one_line(name), kind, record).expect("a string takes any text");
    text
}

fn write(out: &mut String, name: &str, kind: BodyKind, record: &EvolutionRecord) -> fmt::Result {
    if record.status == "refused" {
        return refused(out, name, kind, record);
    }
    let spaced = |words: &str| if words.is_empty() { String::new() } else { format!("{words} ") };
    let (before, after) = match record.status.as_str() {
        // the message is the verdict
        "does-not-hold" => (spaced(&record.message), String::new()),
        "finished" => (String::new(), spaced(&record.verdict)),
        _ => (spaced(&record.message), spaced(&record.verdict)),
    };
    writeln!(out, "{}", paragraph(&format!("{name}: {before}{}", record.sentence), "", "  "))?;
    if !after.is_empty() {
        writeln!(out, "{}", paragraph(after.trim_end(), "  ", "  "))?;
    }
    table(out, kind, &record.columns)?;
    writeln!(out)?;
    for (place, rotation) in [("start", record.start), ("end", record.end)] {
        if let Some(rotation) = rotation.filter(|rotation| !rotation.rotation_period.is_nan()) {
            writeln!(out, "  {:<25}  {}", format!("periods at the {place}"), periods(&rotation))?;
        }
    }
    if let Some(body) = &record.homogeneous {
        writeln!(out, "{}", paragraph(&made_of(body), "  ", "      "))?;
    }
    writeln!(out, "  mean power at the start    {} W", significant(record.power, 4))?;
    small_nutations(out, kind, record)?;
    estimates(out, record)?;
    if let Some(lingering) = record.lingering {
        writeln!(
            out,
            "  next to the separatrix     {} (nearer than 1 % of the way to an axis)",
            time(lingering)
        )?;
    }
    if let Some(text) = dissipation(&record.dissipation) {
        writeln!(out, "{}", paragraph(&text, "  ", "      "))?;
    }
    harmonics(out, record)?;
    if record.mode_end != STEADY_SPIN {
        resonances(out, record)?;
    }
    writeln!(out, "{}", paragraph(&format!("Power: {}.", record.method), "\n  ", "  "))
}

/// A homogeneous body and its material as read: a unit forgotten in the model is seen here.
fn made_of(body: &HomogeneousRecord) -> String {
    let HomogeneousRecord { mass, radius, density, shear, quality } = body;
    let [mass, radius, density, shear] = [mass, radius, density, shear].map(|number| significant(*number, 4));
    let loss = quality.map_or_else(String::new, |quality| format!(", Q = {}", significant(quality, 4)));
    format!(
        "body                       {mass} kg, as a ball {radius} m in radius, {density} kg/m^3, shear modulus {shear} Pa{loss}"
    )
}

/// An evolution that no method leads along.
fn refused(out: &mut String, name: &str, kind: BodyKind, record: &EvolutionRecord) -> fmt::Result {
    writeln!(out, "{}", paragraph(&format!("{name}: {}", record.sentence), "", "  "))?;
    if record.damping_time.is_nan() && (record.growth_time.is_nan() || record.mode_end == STEADY_SPIN) {
        return Ok(());
    }
    writeln!(out)?;
    small_nutations(out, kind, record)?;
    writeln!(out, "  (from the modes about the steady spins)")
}

/// Published estimates of the decay of the small nutation about the axis of greatest inertia.
fn estimates(out: &mut String, record: &EvolutionRecord) -> fmt::Result {
    if record.estimates.is_empty() || !record.damping_time.is_finite() {
        return Ok(());
    }
    let told = |EstimateRecord { source, least, greatest }: &EstimateRecord| {
        let ours = [*greatest, *least].map(|estimate| significant(record.damping_time / estimate, 2));
        if least == greatest {
            format!("{source} {} (ours is {} of it)", time(*least), ours[0])
        } else {
            format!(
                "{source} {} to {} (ours is {} to {} of it)",
                time(*least),
                time(*greatest),
                ours[0],
                ours[1]
            )
        }
    };
    let told: Vec<String> = record.estimates.iter().map(told).collect();
    writeln!(out, "{}", paragraph(&format!("published estimates of it: {}", told.join("; ")), "  ", "      "))
}

/// The periods that an observer sees, and the energy over the least.
fn periods(rotation: &ObservedRecord) -> String {
    let ObservedRecord { rotation_period, precession_period, energy_ratio, .. } = *rotation;
    let spun = |period: f64| if period.is_finite() { time(period) } else { "none".into() };
    let around = spun(precession_period);
    format!("P_psi {}, P_phi {around}, E/E0 {}", spun(rotation_period), significant(energy_ratio, 5))
}

/// Rates of small nutations about the axes.
fn small_nutations(out: &mut String, kind: BodyKind, record: &EvolutionRecord) -> fmt::Result {
    let mut told = |about: &str, fate: String| {
        writeln!(out, "  {:<26} {fate}", format!("small {}{about}", kind.nutation()))
    };
    let folding = |verb: &str, seconds: f64| match seconds {
        f64::INFINITY => "stays as it is".to_owned(),
        _ if seconds.is_nan() => "is not known".to_owned(),
        _ => format!("{verb} e-fold in {}", time(seconds)),
    };
    if record.mode_end == STEADY_SPIN {
        return told("", folding("falls", record.damping_time));
    }
    told(", short axis", folding("falls", record.damping_time))?;
    told(", long axis", folding("grows", record.growth_time))
}

fn table(out: &mut String, kind: BodyKind, columns: &[Column]) -> fmt::Result {
    let [t, ratio, axis, least, greatest, power, revolutions] =
        ["t", "D_over_I3", "circled_axis", "nutation_min", "nutation_max", "power", "turns"]
            .map(|name| column(columns, name));
    let of_axes = axis.iter().any(|circled| *circled > 0.0);
    let places = if of_axes { "    D/I3  mode   " } else { "" };
    let angles = format!("{}, degrees", kind.nutation());
    writeln!(out, "\n            time revolutions {places}{angles:<20}  power, W")?;
    let rows = t.len();
    let shown = TABLE_ROWS.min(rows);
    for i in 0..shown {
        let row = if shown < 2 { 0 } else { i * (rows - 1) / (shown - 1) };
        let mode = if axis[row] == 3.0 { "short" } else { "long" };
        let place = if of_axes { format!("{:>8.5}  {mode:<5}  ", ratio[row]) } else { String::new() };
        let angles = [least, greatest].map(|angle| significant(angle[row].to_degrees(), 3));
        let angles = if greatest[row].is_nan() {
            format!("over {}", angles[0])
        } else {
            format!("{} to {}", angles[0], angles[1])
        };
        writeln!(
            out,
            "  {:>14} {:>11} {place}{angles:<18} {:>11}",
            time(t[row]),
            count(revolutions[row]),
            significant(power[row], 4)
        )?;
    }
    Ok(())
}

fn harmonics(out: &mut String, record: &EvolutionRecord) -> fmt::Result {
    if record.harmonics.is_empty() {
        return Ok(());
    }
    let list = record.harmonics.iter().map(|harmonic| {
        format!(
            "{} ({} rad/s) {} %",
            harmonic.number,
            significant(harmonic.frequency, 3),
            significant(100.0 * harmonic.share, 3)
        )
    });
    let text = format!("harmonics at the start: {}", list.collect::<Vec<_>>().join(", "));
    writeln!(out, "{}", paragraph(&text, "  ", "      "))
}

fn resonances(out: &mut String, record: &EvolutionRecord) -> fmt::Result {
    if record.resonances.is_empty() {
        let Some(near) = &record.approach else { return writeln!(out, "  resonances on the way: none") };
        let text = format!(
            "resonances on the way: none is passed, but harmonic {} is within {} % of {} rad/s, {}, at D/I3 = {:.5}",
            near.harmonic,
            significant(100.0 * near.distance.abs(), 2),
            significant(near.frequency, 4),
            near.coordinate,
            near.ratio
        );
        return writeln!(out, "{}", paragraph(&text, "  ", "      "));
    }
    writeln!(out, "  resonances on the way:")?;
    record.resonances.iter().try_for_each(|crossing| {
        let text = format!(
            "harmonic {} meets {} rad/s, {}, at D/I3 = {:.5} in the {} mode, with {} % of the power",
            crossing.harmonic,
            significant(crossing.frequency, 4),
            crossing.coordinate,
            crossing.ratio,
            crossing.mode,
            significant(100.0 * crossing.share, 3)
        );
        writeln!(out, "{}", paragraph(&text, "    ", "      "))
    })
}

fn column<'a>(columns: &'a [Column], name: &str) -> &'a [f64] {
    columns.iter().find(|column| column.name == name).map_or(&[], |column| &column.values)
}
