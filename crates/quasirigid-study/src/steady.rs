//! Steady spins and the modes about them: search, record and text.

use std::fmt::{self, Write};

use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::modes::{
    EquilibriumError, ModeRange, NEARLY_EQUAL, RelativeEquilibrium, SpinMagnitude, SpinMode, SpinModes, acts,
};
use quasirigid::secular::GyrostatSpins;
use quasirigid_io::model::{BodyKind, Named};
use quasirigid_io::record::{ModeList, ModeRecord, SlowModesRecord, SteadySpinRecord, place_of_spin};
use quasirigid_io::visible::one_line;
use quasirigid_math::rotation::angle;
use quasirigid_math::vec3::{add, cross, dot, norm, scale, unit};

use crate::error::StudyError;
use crate::layout::paragraph;
use crate::liquids::unanswered;
use crate::modes::PrincipalAxis;
use crate::motion::Motion;
use crate::study::Study;
use crate::words::{significant, tidied, time};
use crate::{equal_moments, sheets, slugs, tanks};

/// Coordinates of a body on curved paths whose modes take longer than a moment.
const MAX_COORDINATES: usize = 700;
/// Coordinates of a body up to which every mode is found if asked for.
const MOST_FOUND: usize = SpinModes::MAX_COORDINATES;
/// Modes listed for people.
const LISTED: usize = 12;
/// Longest name in the row of its mode; a longer one has a line of its own.
const NAME: usize = 24;
/// Shares of parts and dissipators listed for people.
const SHARES: usize = 4;
/// Names of the steady spins about the axes of greatest and of least inertia.
pub(crate) const GREATEST: &str = "greatest";
pub(crate) const LEAST: &str = "least";
/// Name of the steady spin about the axis of middle inertia.
pub(crate) const MIDDLE: &str = "middle";
/// The same spins of a body with momentum wheels the other way round, which are others.
const GREATEST_OPPOSITE: &str = "greatest, opposite sense";
const LEAST_OPPOSITE: &str = "least, opposite sense";
/// Names of the steady spins of a body with momentum wheels: of the extremes of the energy, and of those that are extremes beside them only.
const LEAST_ENERGY: &str = "least energy";
const LOCALLY_LEAST_ENERGY: &str = "locally least energy";
const GREATEST_ENERGY: &str = "greatest energy";
const LOCALLY_GREATEST_ENERGY: &str = "locally greatest energy";
/// Share of an energy by which two of them differ by rounding, and of an angular velocity for two of them.
const SAME_ENERGY: f64 = 1e-9;
const SAME_SPIN: f64 = 1e-6;
/// Least cosine of the angle between a spin and the axis of inertia whose name it has.
const ALONG: f64 = 0.66;
/// Angle (rad) of a steady spin from the one asked for that is told.
const TOLD_ANGLE: f64 = 2e-3;

/// The steady spins about the axes of greatest and of least inertia; those of least and of greatest energy where momentum wheels turn the
/// spin away from these axes.
#[derive(Default)]
pub struct Poles {
    /// Records, the one next to the start first.
    pub records: Vec<SteadySpinRecord>,
    /// Modes of each, if they were found.
    pub modes: Vec<Option<SpinModes>>,
}

impl Poles {
    /// Modes of the steady spin next to the start, if they were found.
    pub fn nearest(&self) -> Option<&SpinModes> {
        self.modes.first()?.as_ref()
    }
}

/// The steady spins about the axes of greatest and of least inertia, or those that momentum wheels leave, the one next to an angular velocity
/// first.
pub fn poles(study: &Study, omega: [f64; 3], given: SpinMagnitude, all: bool) -> Poles {
    told_of(study, found(study, omega, given), omega, all)
}

/// The steady spin about a principal axis, next to an angular velocity where wheels or equal moments leave a choice; where wheels leave none
/// about that of greatest inertia the spin of least energy, and that of greatest energy in place of the one about that of least.
pub fn about_axis(
    study: &Study,
    axis: PrincipalAxis,
    omega: [f64; 3],
    given: SpinMagnitude,
    all: bool,
) -> Poles {
    let mut found = found(study, omega, given);
    found.retain(|named| named.axis() == axis);
    found.truncate(1);
    if axis == PrincipalAxis::Middle {
        let spin = RelativeEquilibrium::middle_towards(&study.body, given, omega);
        found.push(NamedSpin { name: axis.name(), spin });
    }
    told_of(study, found, omega, all)
}

fn told_of(study: &Study, found: Vec<NamedSpin>, omega: [f64; 3], all: bool) -> Poles {
    let told = found.into_iter().map(|NamedSpin { name, spin }| {
        let (record, modes) = told(study, (name, &place_of_spin(name)), spin, all);
        equal_moments::noted(study, omega, record, modes)
    });
    let (records, modes) = told.unzip();
    Poles { records, modes }
}

/// A steady spin by its name: of an axis of inertia, or of an energy.
pub(crate) struct NamedSpin {
    pub name: &'static str,
    pub spin: Result<RelativeEquilibrium, EquilibriumError>,
}

impl NamedSpin {
    /// Axis of inertia of the spin, or the one about which a body without wheels has such an energy.
    pub fn axis(&self) -> PrincipalAxis {
        match self.name {
            GREATEST | GREATEST_OPPOSITE | LEAST_ENERGY | LOCALLY_LEAST_ENERGY => PrincipalAxis::Greatest,
            _ => PrincipalAxis::Least,
        }
    }

    /// This spin with the name that it has beside those about the axes of inertia; none if it is one of them.
    fn beside_those(self, by_axis: &[Self], principal: &Principal) -> Option<Self> {
        let spin = self.spin.as_ref().ok()?;
        let found = |named: &Self| named.spin.as_ref().ok().map(|spin| spin.omega);
        let is_it = |omega: [f64; 3]| norm(add(spin.omega, scale(-1.0, omega))) <= SAME_SPIN * norm(omega);
        if by_axis.iter().filter_map(found).any(is_it) {
            return None;
        }
        let (mode, opposite) = match self.axis() {
            PrincipalAxis::Greatest => (Mode::ShortAxis, GREATEST_OPPOSITE),
            _ => (Mode::LongAxis, LEAST_OPPOSITE),
        };
        let alike = by_axis.iter().find(|named| named.axis() == self.axis()).and_then(found);
        let axis = (*principal).beside(mode, alike.unwrap_or(spin.omega)).axes[mode.circled()];
        let turned = alike.is_some_and(|omega| dot(omega, axis) * dot(spin.omega, axis) < 0.0);
        let along = dot(unit(spin.omega), axis).abs() >= ALONG;
        Some(Self { name: if turned && along { opposite } else { self.name }, ..self })
    }
}

/// The steady spins about the axes of greatest and of least inertia, the one next to an angular velocity first; of a body with momentum wheels
/// those of extreme energy that these leave out as well, and alone where wheels turn the spin away from an axis, or the three moments are
/// nearly equal, so that wheels set the axes. (Q15)
pub(crate) fn found(study: &Study, omega: [f64; 3], given: SpinMagnitude) -> Vec<NamedSpin> {
    let body = &study.body;
    let principal = Principal::compute(body.invariants().J);
    let mut by_axis = Vec::from(principal.nearest(omega).map(|mode| NamedSpin {
        name: if mode == Mode::ShortAxis { GREATEST } else { LEAST },
        spin: RelativeEquilibrium::extreme_towards(body, mode, given, omega),
    }));
    let by_energy = of_gyrostat(body, omega, given);
    if by_energy.is_empty() {
        return by_axis;
    }
    let [I1, _, I3] = principal.moments;
    let lost = by_axis.iter().any(|named| named.spin.is_err());
    if lost || I3 - I1 <= NEARLY_EQUAL * I3 {
        return by_energy;
    }
    let others: Vec<NamedSpin> =
        by_energy.into_iter().filter_map(|named| named.beside_those(&by_axis, &principal)).collect();
    by_axis.extend(others);
    by_axis
}

/// The steady spin next to an angular velocity, of those about the axes of greatest and of least inertia or those that momentum wheels leave.
pub(crate) fn next_to(
    study: &Study,
    omega: [f64; 3],
    given: SpinMagnitude,
) -> Result<RelativeEquilibrium, EquilibriumError> {
    let first = found(study, omega, given).swap_remove(0);
    first.spin
}

/// The steady spin beside an angular velocity (rad/s): about the principal axis next to it, or with momentum wheels, which leave spins about
/// other axes, the one whose axis is nearest. (M27)
///
/// # Errors
/// [`EquilibriumError`] if there is none.
pub(crate) fn beside(
    study: &Study,
    omega: [f64; 3],
    given: SpinMagnitude,
) -> Result<RelativeEquilibrium, EquilibriumError> {
    let body = &study.body;
    let axis = Principal::compute(body.invariants().J).axis_beside(omega);
    if body.wheels().is_empty() {
        return RelativeEquilibrium::near(body, axis, given);
    }
    RelativeEquilibrium::beside(body, omega, given)
        .or_else(|_| RelativeEquilibrium::near(body, axis, given))
        .or_else(|_| next_to(study, omega, given))
}

/// The steady spins of extreme energy of a body with momentum wheels, the one next to an angular velocity first; none of a body without them.
/// (Q15)
fn of_gyrostat(body: &FlexibleBody, omega: [f64; 3], given: SpinMagnitude) -> Vec<NamedSpin> {
    let SpinMagnitude::AngularMomentum(G) = given else { return Vec::new() };
    if norm(body.wheels().angular_momentum(0.0)) == 0.0 {
        return Vec::new();
    }
    let GyrostatSpins { minima, maxima, .. } = GyrostatSpins::compute(body, G);
    let least = named(minima, |energy| energy, [LEAST_ENERGY, LOCALLY_LEAST_ENERGY]);
    let greatest = named(maxima, |energy| -energy, [GREATEST_ENERGY, LOCALLY_GREATEST_ENERGY]);
    let mut spins: Vec<_> = least.into_iter().chain(greatest).collect();
    let away = |(_, spin): &(_, RelativeEquilibrium)| norm(add(spin.omega, scale(-1.0, omega)));
    spins.sort_by(|a, b| away(a).total_cmp(&away(b)));
    // of mirror images, which are as far, the one on the side of the vector across the start and the wheels
    let across = cross(omega, body.wheels().angular_momentum(0.0));
    for place in 1..spins.len() {
        let [near, far] = [&spins[place - 1], &spins[place]];
        let as_far = away(far) - away(near) <= SAME_SPIN * away(far);
        if as_far && dot(near.1.omega, across) < dot(far.1.omega, across) {
            spins.swap(place - 1, place);
        }
    }
    spins.into_iter().map(|(name, spin)| NamedSpin { name, spin: Ok(spin) }).collect()
}

/// Spins of one kind of extreme with their names: that of the lowest by a measure, and of others above it.
fn named(
    spins: Vec<RelativeEquilibrium>,
    height: fn(f64) -> f64,
    [lowest, above]: [&'static str; 2],
) -> Vec<(&'static str, RelativeEquilibrium)> {
    let bottom = spins.iter().map(|spin| height(spin.energy)).fold(f64::INFINITY, f64::min);
    let name = |spin: &RelativeEquilibrium| {
        if height(spin.energy) - bottom > SAME_ENERGY * bottom.abs() { above } else { lowest }
    };
    spins.into_iter().map(|spin| (name(&spin), spin)).collect()
}

/// The steady spins with the angular momentum of the start; none where moments act, of a body without angular momentum, and of bodies
/// of more coordinates than are analysed unasked.
pub fn at_start(motion: &Motion, study: &Study) -> Result<Poles, StudyError> {
    if acts(&study.body, &study.forces) { Ok(Poles::default()) } else { without_forces(motion, study) }
}

/// The steady spins with the angular momentum of the start, were no force to act; none of a body without angular momentum, and of bodies of
/// more coordinates than are analysed unasked.
pub fn without_forces(motion: &Motion, study: &Study) -> Result<Poles, StudyError> {
    let many = study.body.paths().is_some() && study.body.coordinates().len() > MAX_COORDINATES;
    if norm(motion.start.omega) == 0.0 || many {
        return Ok(Poles::default());
    }
    Ok(match motion.angular_momentum()? {
        0.0 => Poles::default(),
        angular_momentum => {
            poles(study, motion.start.omega, SpinMagnitude::AngularMomentum(angular_momentum), false)
        }
    })
}

/// Results of the steady spins, a paragraph each.
pub fn lines(spins: &[SteadySpinRecord]) -> String {
    if spins.is_empty() {
        return String::new();
    }
    let line = |spin: &SteadySpinRecord| format!("{}\n", paragraph(&spin.sentence, "  ", "    "));
    format!(
        "\nSteady spins at this angular momentum, with the modes about them\n{}",
        spins.iter().map(line).collect::<String>()
    )
}

/// The steady spin beside an angular velocity (rad/s), with its modes.
pub fn spin(study: &Study, name: &str, omega: [f64; 3], given: SpinMagnitude, all: bool) -> Poles {
    let found = beside(study, omega, given);
    let away = found.as_ref().map_or(0.0, |spin| angle(spin.omega, omega));
    let place = if away > TOLD_ANGLE { place_beside(name, away) } else { place_of_spin(name) };
    let (record, modes) = told(study, (name, &place), found, all);
    Poles { records: vec![record], modes: vec![modes] }
}

/// Place of a steady spin at an angle (rad) from the one that was asked for, in words.
fn place_beside(name: &str, away: f64) -> String {
    let degrees = significant(away.to_degrees(), 3);
    format!("the steady spin next to {}, {degrees} degrees from it,", place_of_spin(name))
}

/// Record of a steady spin with its modes, or of its absence, and the modes themselves; by its name, and its place in words.
fn told(
    study: &Study,
    (name, place): (&str, &str),
    found: Result<RelativeEquilibrium, EquilibriumError>,
    all: bool,
) -> (SteadySpinRecord, Option<SpinModes>) {
    let body = &study.body;
    let unfound = |message: String| missing(name, format!("About {}: {message}.", place_of_spin(name)));
    let equilibrium = match found {
        Ok(equilibrium) => equilibrium,
        Err(error) => {
            let words = slugs::unrestored(study, &error).unwrap_or_else(|| error.to_string());
            return (unfound(words), None);
        }
    };
    if let Some(left) = body.left_range(&equilibrium.q) {
        return (unfound(format!("no answer, since in the steady spin {left}")), None);
    }
    let modes = if all { SpinModes::all_about } else { SpinModes::about };
    let modes = match modes(body, equilibrium) {
        Ok(modes) => modes,
        Err(error) => return (unfound(error.to_string()), None),
    };
    let frequency = modes.nutation().map_or(0.0, |nutation| nutation.frequency);
    if let Some(message) = unanswered(study, modes.equilibrium.omega, frequency) {
        return (unfound(format!("no answer, since {message}")), Some(modes));
    }
    let coordinates = body.coordinates().iter().zip(&modes.equilibrium.q).take(body.elastic());
    let record = SteadySpinRecord {
        sentence: sheets::warning(&study.model.assembly, modes.equilibrium.omega)
            .into_iter()
            .chain(tanks::warning(study, modes.equilibrium.omega))
            .chain(slugs::warning(study, frequency))
            .chain([sentence(place, study.model.kind, &modes)])
            .collect::<Vec<_>>()
            .join(" "),
        axis: name.into(),
        spin: Some(tidied(modes.equilibrium.omega)),
        angular_momentum: Some(tidied(modes.equilibrium.angular_momentum)),
        energy: Some(modes.equilibrium.energy),
        displacements: coordinates.map(|(coordinate, q)| (coordinate.name.clone(), *q)).collect(),
        stable: modes.stable(),
        modes: modes.modes.iter().map(|mode| recorded(mode, modes.seen_from_outside(mode))).collect(),
        slowest: slowest(modes.range),
    };
    (record, Some(modes))
}

/// A mode, and the rates (rad/s) at which it is seen from outside.
pub fn recorded(mode: &SpinMode, seen_from_outside: [f64; 2]) -> ModeRecord {
    ModeRecord {
        name: mode.name.clone(),
        nutation: mode.nutation,
        neutral: mode.neutral,
        overdamped: mode.overdamped(),
        decay_rate: mode.decay_rate,
        rate_bound: Some(mode.rate_bound).filter(|bound| *bound > 0.0),
        frequency: mode.frequency,
        time_constant: Some(mode.time_constant()).filter(|time| time.is_finite()),
        damping_ratio: mode.damping_ratio(),
        seen_from_outside,
        moves: mode.moves.iter().cloned().collect(),
        dissipation: mode.dissipation.iter().cloned().collect(),
    }
}

/// The record of a steady spin that was not found.
pub fn missing(name: &str, sentence: String) -> SteadySpinRecord {
    SteadySpinRecord {
        sentence,
        axis: name.into(),
        spin: None,
        angular_momentum: None,
        energy: None,
        displacements: std::collections::BTreeMap::new(),
        stable: false,
        modes: Vec::new(),
        slowest: None,
    }
}

/// Which modes of a body of many coordinates were found.
fn slowest(range: ModeRange) -> Option<SlowModesRecord> {
    match range {
        ModeRange::All => None,
        ModeRange::Slowest(slow) => Some(SlowModesRecord {
            rate: slow.rate,
            missing: slow.missing,
            positive_energy: slow.positive_energy,
        }),
    }
}

/// Modes that were found of a body of many coordinates, and what they say of the others.
fn beyond(slow: &SlowModesRecord, unstable: bool) -> String {
    let rate = significant(slow.rate, 4);
    let found = match slow.missing {
        Some(0) => format!("These are all motions slower than {rate} rad/s, by a count"),
        Some(missing) => {
            format!(
                "Of the motions slower than {rate} rad/s {missing} eigenvalues are MISSING here, by a count"
            )
        }
        None => format!(
            "These are motions slower than {rate} rad/s, which were not counted: others may be among them"
        ),
    };
    let others = match (unstable, slow.positive_energy) {
        (true, _) => "",
        (false, true) => "; no other grows, since the energy is least in this spin",
        (false, false) => {
            "; whether others grow is NOT KNOWN, since the energy is not shown to be least in this spin"
        }
    };
    format!("{found}{others}.")
}

/// Result of a steady spin at a place in words, instability first.
fn sentence(place: &str, kind: BodyKind, modes: &SpinModes) -> String {
    let own = sentence_on_found(place, kind, modes);
    match slowest(modes.range) {
        Some(slow) => format!("{own} {}", beyond(&slow, modes.unstable())),
        None => own,
    }
}

fn sentence_on_found(place: &str, kind: BodyKind, modes: &SpinModes) -> String {
    let about = format!("About {place}");
    let growing = modes.modes.iter().filter(|mode| mode.grows());
    let fastest = growing.max_by(|a, b| b.decay_rate.total_cmp(&a.decay_rate));
    let nutation = modes
        .nutation()
        .map_or_else(|| format!("there is no {}", kind.nutation()), |mode| nutation(kind, mode));
    match fastest {
        Some(mode) if !mode.nutation => format!(
            "{about} the spin is UNSTABLE: a motion of {} {}; {nutation}.",
            mode.name,
            fate(mode.decay_rate)
        ),
        Some(_) => format!("{about} the spin is UNSTABLE: {nutation}."),
        None => format!("{about} {nutation}."),
    }
}

/// Nutation in words.
fn nutation(kind: BodyKind, mode: &SpinMode) -> String {
    let noun = kind.nutation();
    if mode.neutral {
        return format!(
            "the {noun} is neutral to rounding and has no time constant, since the spins beside this one are steady too"
        );
    }
    let frequency = match mode.frequency {
        0.0 => "which does not oscillate,".into(),
        frequency => format!("{} rad/s in the body,", significant(frequency, 4)),
    };
    format!("the {noun}, {frequency} {}", fate_of(mode))
}

/// Fate of a mode, whose rate rounding may hide.
pub fn fate_of(mode: &SpinMode) -> String {
    if mode.rate_bound == 0.0 {
        return fate(mode.decay_rate);
    }
    format!("decays or grows, which rounding hides, e-fold in no less than {}", time(mode.rate_bound.recip()))
}

/// Fate of a small motion with this decay rate (1/s).
pub fn fate(decay_rate: f64) -> String {
    if decay_rate > 0.0 {
        format!("decays e-fold in {}", time(decay_rate.recip()))
    } else if decay_rate < 0.0 {
        format!("GROWS e-fold in {}", time(-decay_rate.recip()))
    } else {
        "neither decays nor grows".into()
    }
}

/// Steady spins with their modes, for a terminal of 80 columns; every mode if asked for all, else the first, and overdamped ones in a line.
pub fn text(name: &str, kind: BodyKind, spins: &[SteadySpinRecord], all: bool) -> String {
    let mut text = String::new();
    for spin in spins {
        write(&mut text, &one_line(name), spin, (kind, all)).expect("a string takes any text");
    }
    text
}

fn write(
    out: &mut String,
    name: &str,
    record: &SteadySpinRecord,
    (kind, all): (BodyKind, bool),
) -> fmt::Result {
    if !out.is_empty() {
        writeln!(out)?;
    }
    writeln!(out, "{}", paragraph(&format!("{name}: {}", record.sentence), "", "  "))?;
    let Some(spin) = record.spin else { return Ok(()) };
    let spin = spin.map(|component| significant(component, 6)).join(", ");
    writeln!(out, "  steady spin ({spin}) rad/s")?;
    if let Some((name, moved)) = record.displacements.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())) {
        writeln!(out, "  largest displacement {}: {}", name, significant(*moved, 3))?;
    }
    writeln!(out, "\n  {:<NAME$} {:>12} {:>9} {:>14}  seen from outside", "mode", "rad/s", "zeta", "e-fold")?;
    let modes = record.mode_list();
    if all {
        return modes.listed.iter().chain(&modes.folded).try_for_each(|mode| row(out, kind, mode));
    }
    let listed = if record.slowest.is_some() { modes.listed.len() } else { LISTED };
    modes.listed.iter().take(listed).try_for_each(|mode| row(out, kind, mode))?;
    if modes.listed.len() > listed {
        writeln!(out, "  and {} more (--all lists them)", modes.listed.len() - listed)?;
    }
    if record.slowest.is_some() {
        writeln!(out, "  and others, faster (--all finds every mode of up to {MOST_FOUND} coordinates)")?;
    }
    if !modes.folded.is_empty() {
        writeln!(out, "{}", paragraph(&folded(&modes, &record.modes), "  ", "      "))?;
    }
    Ok(())
}

/// Overdamped modes in a line: how many, what moves, and the range of their times.
fn folded(modes: &ModeList, all: &[ModeRecord]) -> String {
    let first = |mode: &ModeRecord| {
        let counts = |name: &str| mode.name.strip_prefix(name).is_some_and(|rest| rest.starts_with(", "));
        all.iter()
            .find(|other| counts(&other.name))
            .map_or_else(|| mode.name.clone(), |other| other.name.clone())
    };
    let mut names: Vec<String> = modes.folded.iter().map(|mode| first(mode)).collect();
    names.sort_unstable();
    names.dedup();
    let more = if names.len() > SHARES { " and others" } else { "" };
    names.truncate(SHARES);
    let [least, most] = modes.folded_times().map(time);
    format!(
        "{} overdamped motions, of {}{more}, fall e-fold in {least} to {most} (--all lists them)",
        modes.folded.len(),
        names.join(", "),
    )
}

fn row(out: &mut String, kind: BodyKind, mode: &ModeRecord) -> fmt::Result {
    let fold = match mode.time_constant {
        None if mode.neutral => "neutral".into(),
        None if let Some(bound) = mode.rate_bound => format!("over {}", time(bound.recip())),
        Some(constant) if constant < 0.0 => format!("GROWS {}", time(-constant)),
        Some(constant) => time(constant),
        None => "never".into(),
    };
    let [slow, fast] = mode.seen_from_outside.map(|rate| significant(rate, 4));
    let seen = if mode.frequency > 0.0 { format!("{slow}, {fast}") } else { String::new() };
    let told = kind.mode_name(&mode.name);
    let mut name = &*told;
    if name.chars().count() > NAME {
        writeln!(out, "  {name}")?;
        name = "";
    }
    let [rate, zeta] =
        [(mode.frequency, 5), (mode.damping_ratio, 2)].map(|(value, digits)| significant(value, digits));
    writeln!(out, "  {name:<NAME$} {rate:>12} {zeta:>9} {fold:>14}  {seen}")?;
    if let Some(shares) = shares(&mode.dissipation) {
        writeln!(out, "{}", paragraph(&format!("dissipated by {shares}"), "      ", "        "))?;
    }
    Ok(())
}

/// Shares by name in words, the largest first; none if there are none.
fn shares(shares: &std::collections::BTreeMap<String, f64>) -> Option<String> {
    let mut list: Vec<_> = shares.iter().collect();
    list.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let words = list.iter().take(SHARES).map(|(name, share)| {
        let gives = if **share < 0.0 { "gives " } else { "" };
        format!("{name} {gives}{} %", significant(100.0 * share.abs(), 3))
    });
    let words = words.collect::<Vec<_>>().join(", ");
    (!words.is_empty()).then_some(words)
}
