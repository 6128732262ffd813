//! Validity of the reduced equations, for a terminal of 80 columns.

use std::fmt::{self, Write};

use quasirigid::dynamics::{IsolatedSpin, SteadySpin, SteadySpins, all_steady_spins, steady_spins};
use quasirigid::elements::{Condensation, Ellipsoid, Part, PartKind};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::{Validity, Verdict};
use quasirigid_io::visible::one_line;
use quasirigid_math::sphere::StationaryKind as Stationary;
use quasirigid_math::sym3;
use quasirigid_math::vec3::{cross, dot, norm, scale};

use super::CheckReport;
use crate::derive::acting;
use crate::layout::paragraph;
use crate::liquids::liquids;
use crate::motion::DISPLACED;
use crate::study::Study;
use crate::words::{criterion, dissipation, range, reasons, significant, time, word};
use crate::{record, shapes, slugs, steady, tanks};

/// Frequencies printed one by one.
const LISTED: usize = 9;

/// The whole answer.
pub(super) fn text(report: &CheckReport) -> String {
    let CheckReport { study, reduced, validity, budget, spins, left_out, .. } = report;
    let Study { model, body, condensation, .. } = study;
    let omega = report.omega;
    let mut text = String::new();
    model.file_notes.iter().for_each(|note| text.push_str(&format!("{}\n", paragraph(note, "", "  "))));
    if !model.file_notes.is_empty() {
        text.push('\n');
    }
    let about = report.about_spin.as_ref().map(|about| about.sentence.as_str());
    let head = format!("{}: {}", one_line(&model.name), report.sentence());
    write(&mut text, (&head, about), reduced, (omega, without(study)), validity)
        .expect("a string takes any text");
    report.start.iter().for_each(|start| text.push_str(&settled(*start, omega)));
    text.push_str(&steady::lines(spins));
    if let Some(words) = &report.under_forces {
        let heading = "Steady state under the forces";
        text.push_str(&format!("\n{heading}\n{}\n", paragraph(words, "  ", "    ")));
    }
    let mut told = |words: &str| text.push_str(&format!("\n{}\n", paragraph(words, "", "  ")));
    if let Some(words) = dissipation(budget).filter(|_| !is_steady(reduced, omega)) {
        let power = significant(reduced.dissipated_power(omega), 3);
        told(&format!("At this spin {power} W are dissipated; {words}."));
    }
    left_out.losses().for_each(|note| told(&note));
    liquids(study, validity.T3.recip()).iter().for_each(|liquid| text.push_str(&liquid.text()));
    study.tanks.iter().for_each(|tank| text.push_str(&tanks::text(tank)));
    study.slugs.iter().for_each(|slug| text.push_str(&slugs::text(study, slug)));
    model.assembly.ellipsoids.iter().for_each(|ellipsoid| text.push_str(&self_gravity(ellipsoid)));
    let mut told = |words: &str| text.push_str(&format!("\n{}\n", paragraph(words, "", "  ")));
    shapes::sentences(study).iter().for_each(|words| told(words));
    record::resolution(study).for_each(|found| told(&found.sentence));
    condensation.iter().for_each(|known| text.push_str(&condensed(known)));
    let mut told = |words: &str| text.push_str(&format!("\n{}\n", paragraph(words, "", "  ")));
    range(body).iter().for_each(|words| told(words));
    model.assembly.parts.iter().for_each(|part| text.push_str(&truncation(part, body.pole())));
    text
}

/// Words for the forces and losses of materials that the steady spins of the reduced equations leave out.
fn without(study: &Study) -> &'static str {
    match (acting(study, None).is_some(), !study.body.viscoelastic().is_empty()) {
        (true, true) => " WITHOUT the forces and the losses of materials",
        (true, false) => " WITHOUT the forces",
        (false, true) => " WITHOUT the losses of materials",
        (false, false) => "",
    }
}

/// Note on the spin that was judged, where internal coordinates do not start on the slow manifold.
fn settled(start: [f64; 3], omega: [f64; 3]) -> String {
    let words = format!(
        "{DISPLACED}. The verdict is for the spin to which it settles, {} rad/s; that at the start is {} rad/s.",
        significant(norm(omega), 4),
        significant(norm(start), 4)
    );
    format!("\n{}\n", paragraph(&words, "", "  "))
}

fn write(
    out: &mut String,
    (head, about_spin): (&str, Option<&str>),
    reduced: &ReducedBody,
    (omega, without): ([f64; 3], &str),
    validity: &Validity,
) -> fmt::Result {
    writeln!(out, "{}", paragraph(head, "", "  "))?;
    for reason in reasons(validity) {
        writeln!(out, "{}", paragraph(&reason, "  - ", "    "))?;
    }
    if let Some(words) = about_spin {
        writeln!(out, "{}", paragraph(words, "  + ", "    "))?;
    }
    times(out, validity)?;
    writeln!(out, "\nCriteria                          symbol                 value  limit  verdict")?;
    for each in &validity.criteria {
        let words = criterion(each, validity);
        let (value, limit) = (significant(each.value, 3), each.limit());
        let verdict = word(each.verdict());
        let shown = if each.verdict() == Verdict::Fails { verdict.to_uppercase() } else { verdict.into() };
        writeln!(out, "  {:<31} {:<18} {value:>9}  {limit:>5}  {shown}", words.name, words.symbol)?;
    }
    vibrations(out, validity)?;
    series(out, reduced.order, validity)?;
    if validity.verdict() == Verdict::Fails {
        return writeln!(
            out,
            "\nSteady spins of the reduced equations are left out: the equations do not hold."
        );
    }
    spin(out, reduced, omega, validity.dissipation() != Verdict::Fails, without)
}

fn times(out: &mut String, validity: &Validity) -> fmt::Result {
    writeln!(out, "\nTimes")?;
    let slowest = if validity.relaxation.longest() < validity.T2 {
        "decay of the slowest vibration"
    } else {
        "decay of the slowest relaxation"
    };
    let rows = [
        ("T1", validity.T1, "period of the slowest vibration"),
        ("T2", validity.T2, slowest),
        ("T3", validity.T3, "the spin, 1/|w|"),
    ];
    rows.iter().try_for_each(|(symbol, seconds, meaning)| {
        writeln!(out, "  {symbol}  {:<16} {meaning}", time(*seconds))
    })
}

fn vibrations(out: &mut String, validity: &Validity) -> fmt::Result {
    let (vibrations, relaxations) = (&validity.vibrations, &validity.relaxation.times);
    if vibrations.frequencies.is_empty() && relaxations.is_empty() {
        return writeln!(out, "\nNo vibrations: the body is rigid.");
    }
    if !vibrations.frequencies.is_empty() {
        writeln!(out, "\nVibrations")?;
        list(out, "frequencies, attitude fixed", &vibrations.frequencies, "rad/s")?;
        list(out, "frequencies, body free", &vibrations.free_frequencies, "rad/s")?;
        list(out, "decay rates", &vibrations.decay_rates, "1/s")?;
    }
    if !relaxations.is_empty() {
        writeln!(out, "\nRelaxations of internal rotors and liquids")?;
        list(out, "times, attitude fixed", relaxations, "s")?;
    }
    Ok(())
}

fn list(out: &mut String, title: &str, values: &[f64], unit: &str) -> fmt::Result {
    let shown: Vec<_> = values.iter().take(LISTED).map(|value| significant(*value, 4)).collect();
    let more =
        if values.len() > LISTED { format!(" and {} more", values.len() - LISTED) } else { String::new() };
    let text = format!("{title} ({unit}): {}{more}", shown.join(" "));
    writeln!(out, "{}", paragraph(&text, "  ", "      "))
}

fn series(out: &mut String, order: usize, validity: &Validity) -> fmt::Result {
    writeln!(out, "\nSize of the terms of w' at this spin (rad/s^2)")?;
    let sizes = validity.degrees.iter().map(|d| format!("f{}={:.1e}", d.degree, d.size));
    let text = sizes.collect::<Vec<_>>().join("   ");
    writeln!(out, "{}", paragraph(&text, "  ", "  "))?;
    let highest = validity.degrees.last().map_or(0, |d| d.degree).saturating_sub(4);
    let best = validity.optimal_order;
    let beyond = if best == highest { " or above" } else { "" };
    writeln!(out, "  terms left out are smallest at order {best}{beyond}; order {order} is judged")
}

fn spin(out: &mut String, reduced: &ReducedBody, omega: [f64; 3], rates: bool, without: &str) -> fmt::Result {
    let principal = Principal::compute(reduced.J);
    let K = reduced.angular_momentum(omega);
    if norm(K) <= MOMENTUM_ROUNDING * norm(sym3::times(reduced.J, omega)) {
        return writeln!(out, "\nThe angular momentum is zero: internal rotors and liquids take it up.");
    }
    let heading = format!("Steady spins at this angular momentum, after the reduced equations{without}");
    writeln!(out, "\n{}", paragraph(&heading, "", "  "))?;
    let names = ["least", "middle", "greatest"];
    let steady = [1.0, -1.0].map(|sense| steady_spins(reduced, sense * norm(K)));
    for (place, name) in names.into_iter().enumerate() {
        let moment = principal.moments[place];
        let about = format!("about the axis of {name} inertia, {} kg m^2:", significant(moment, 5));
        let word = |spin: Option<SteadySpin>| match spin {
            Some(spin) => fate(&spin, rates),
            None if principal.determined()[place] => "none is near it".into(),
            None => "two moments are equal".into(),
        };
        let senses = if dot(K, principal.axes[place]) < 0.0 { [1, 0] } else { [0, 1] };
        let [this, other] = senses.map(|sense| word(steady[sense][place]));
        writeln!(out, "  {about:<51} {this}")?;
        if reduced.has_wheels() {
            writeln!(out, "  {:<51} {other}", "  the other way round:")?;
        }
    }
    let all = all_steady_spins(reduced, norm(K));
    let expected = 2 * principal.determined().iter().filter(|determined| **determined).count();
    if all.isolated.len() != expected || !(all.complete || all.families) {
        isolated(out, &all, rates)?;
    }
    let (off, name) = nearest(&principal, K);
    writeln!(out, "  now {} degrees from the axis of {name} inertia", significant(off.to_degrees(), 4))
}

/// Angle (rad) of a vector from the nearest axis, of equal moments from the nearest in their plane, with the name of its moment.
fn nearest(principal: &Principal, K: [f64; 3]) -> (f64, &'static str) {
    let determined = principal.determined();
    let mut found = (f64::INFINITY, "greatest");
    for (place, name) in [(2, "greatest"), (0, "least"), (1, "middle")] {
        let inside = |k: &usize| *k == place || !determined[place] && !determined[*k];
        let size = |inside: bool, own: &dyn Fn(&usize) -> bool| {
            let parts = (0..3).filter(|k| own(k) == inside).map(|k| dot(principal.axes[k], K));
            parts.fold(0.0_f64, f64::hypot)
        };
        let off = size(false, &inside).atan2(size(true, &inside));
        if off < found.0 - ANGLE_ROUNDING {
            found = (off, name);
        }
    }
    found
}

/// Whether a spin is steady in the reduced equations to rounding, so that nothing is dissipated.
fn is_steady(reduced: &ReducedBody, omega: [f64; 3]) -> bool {
    let K = reduced.angular_momentum(omega);
    !(norm(cross(K, omega)) > STEADY * norm(K) * norm(omega))
}

/// Every steady spin by its direction, where they do not lie near the principal axes one by one.
fn isolated(out: &mut String, all: &SteadySpins, rates: bool) -> fmt::Result {
    let SteadySpins { isolated, families, complete } = all;
    let others = match (families, complete) {
        (true, _) => "others form a family",
        (false, true) => "these are all",
        (false, false) => "more may exist",
    };
    writeln!(out, "  isolated ones by direction of angular momentum, {} in all; {others}", isolated.len())?;
    for IsolatedSpin { spin, angular_momentum, kind } in isolated {
        let [x, y, z] = scale(norm(*angular_momentum).recip(), *angular_momentum);
        let energy = match kind {
            Stationary::Minimum => "least energy",
            Stationary::Maximum => "greatest energy",
            Stationary::Saddle => "saddle",
        };
        let direction = format!("({x:+.4} {y:+.4} {z:+.4}), {energy}:");
        writeln!(out, "    {direction:<45} {}", fate(spin, rates))?;
    }
    Ok(())
}

/// Sine of the angle between angular momentum and velocity that is rounding, and angle (rad) by which two axes are as near.
const STEADY: f64 = 1e-13;
const ANGLE_ROUNDING: f64 = 1e-9;
/// An angular momentum below this share of that of the frozen body is zero.
const MOMENTUM_ROUNDING: f64 = 1e-12;

/// Gravity of an ellipsoid compared with its stiffness: self-gravity is not in the model.
fn self_gravity(ellipsoid: &Ellipsoid) -> String {
    let pressure = ellipsoid.central_pressure();
    let [pressure, share] =
        [pressure, pressure / ellipsoid.material.young].map(|value| significant(value, 2));
    let text = format!(
        "Self-gravity, which is not in the model, presses the centre of {:?} with {pressure} Pa, {share} of Young's modulus.",
        ellipsoid.name
    );
    format!("\n{}\n", paragraph(&text, "", "  "))
}

/// Number of coordinates that hold the slow motion of the parts.
fn condensed(known: &Condensation) -> String {
    let Condensation { unknowns, coordinates, left_out } = known;
    let text = format!(
        "Of the parts' {unknowns} unknowns {coordinates} coordinates are left. They hold the responses to the spin but for {} of their energy.",
        significant(left_out.max(f64::EPSILON), 1)
    );
    format!("\n{}\n", paragraph(&text, "", "  "))
}

/// Bound on the modes that another program did not export.
fn truncation(part: &Part, pole: [f64; 3]) -> String {
    let PartKind::Modes(modes) = &part.kind else { return String::new() };
    let Some(missing) = modes.missing(pole) else { return String::new() };
    let text = format!(
        "{:?}: modes beyond the last could add {} % to the energy of its response to the spin, or less.",
        part.name,
        significant(100.0 * missing, 2)
    );
    format!("\n{}\n", paragraph(&text, "", "  "))
}

/// Fate of a small nutation about a steady spin. Without valid `rates` of dissipation, rates that follow from the dissipation are
/// left out.
fn fate(spin: &SteadySpin, rates: bool) -> String {
    if !rates && spin.frequency > 0.0 {
        if spin.growth > 0.0 { "grows".into() } else { "decays".into() }
    } else if spin.growth == 0.0 {
        "stays".into()
    } else if spin.growth > 0.0 {
        format!("grows e-fold in {}", time(spin.growth.recip()))
    } else {
        format!("decays e-fold in {}", time(-spin.growth.recip()))
    }
}
