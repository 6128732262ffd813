//! Partly full tanks of a model: their slosh in words and numbers, and what is to be read before it.
//! Limits of (U3), (U7) and (U9), docs/theory/21-slosh.md.

use quasirigid::dynamics::Start;
use quasirigid::elements::{SettledTank, Settling, Slug, TankMode};
use quasirigid::model::force::{Force, ForceLaw, KinematicState};
use quasirigid::model::{Marker, MotionState, Principal, Support};
use quasirigid_math::vec3::{cross, dot, minus, norm, scale};
use serde::Serialize;

use crate::error::StudyError;
use crate::layout::paragraph;
use crate::slugs::SlugObject;
use crate::study::Study;
use crate::words::{MAY_NOT_HOLD, significant, time};

/// Angle between the effective gravity and the axis of a tank (rad) that is told.
const TILTED: f64 = 1e-4;
/// Bond number below which capillarity is told.
const CAPILLARY: f64 = 100.0;
/// Damping ratio of a layer at the wall that is not thin.
const THICK: f64 = 0.05;
/// Keulegan–Carpenter numbers at which the drag of plates was measured. (U17)
const PLATES: [f64; 2] = [2.0, 20.0];
/// Relative difference of two grids that is told.
const COARSE: f64 = 1e-3;
/// Relative change of what settled a liquid, or of its slosh or inertia by the spin, that is told.
pub const NOTABLE: f64 = 0.01;
/// Relative change of the effective gravity of a liquid by a spin that is told: 1 degree.
const OTHER_GRAVITY: f64 = 0.0175;
/// The same above which an evolution does not hold.
const MOST_OTHER_GRAVITY: f64 = 0.25;
/// Share of the lowest frequency of slosh at which a model without a spin is judged.
const SLOW: f64 = 1e-3;

/// Tank with its liquid settled, for machines; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Serialize)]
pub struct TankObject<'a> {
    /// Name.
    pub name: &'a str,
    /// Share of the volume.
    pub fill: f64,
    /// Of the liquid (kg).
    pub liquid_mass: f64,
    /// Of the liquid (m), file's frame.
    pub center_of_mass: [f64; 3],
    /// Modes, slowest first; none in a ring.
    pub slosh: Vec<SloshObject>,
    /// In a ring, or `null`.
    pub slug: Option<SlugObject>,
}

/// Slosh mode of a tank.
#[derive(Serialize)]
pub struct SloshObject {
    /// Frequency squared over gravity (1/m).
    pub wavenumber: f64,
    /// In a tank at rest (rad/s).
    pub frequency: f64,
    /// Of the bob (kg).
    pub mass: f64,
    /// Of the pendulum (m).
    pub length: f64,
    /// Of the bob along `axis`, from `center` (m).
    pub height: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
}

impl<'a> TankObject<'a> {
    /// The tanks of a study, those of revolution first.
    pub fn all(study: &'a Study) -> Vec<Self> {
        study
            .tanks
            .iter()
            .map(Self::of)
            .chain(study.slugs.iter().map(|slug| Self::of_ring(study, slug)))
            .collect()
    }

    /// A ring.
    fn of_ring(study: &Study, slug: &'a Slug) -> Self {
        let Slug { name, fill, liquid_mass, center_of_mass, .. } = slug;
        Self {
            name,
            fill: *fill,
            liquid_mass: *liquid_mass,
            center_of_mass: *center_of_mass,
            slosh: Vec::new(),
            slug: Some(SlugObject::of(study, slug)),
        }
    }

    /// A settled tank.
    fn of(tank: &'a SettledTank) -> Self {
        let mode = |mode: &TankMode| {
            let TankMode { wavenumber, frequency, mass, length, height, damping_ratio } = *mode;
            SloshObject { wavenumber, frequency, mass, length, height, damping_ratio }
        };
        let SettledTank { name, fill, liquid_mass, center_of_mass, slosh, .. } = tank;
        Self {
            name,
            fill: *fill,
            liquid_mass: *liquid_mass,
            center_of_mass: *center_of_mass,
            slosh: slosh.iter().map(mode).collect(),
            slug: None,
        }
    }
}

/// The slosh of a tank, for a terminal.
pub fn text(tank: &SettledTank) -> String {
    let SettledTank { name, fill, liquid_mass, gravity, slosh, .. } = tank;
    let head = format!(
        "{name:?}: {} kg of liquid, {} % of the tank, under an effective gravity of {} m/s^2 along {}.",
        significant(*liquid_mass, 4),
        significant(100.0 * fill, 4),
        significant(norm(*gravity), 4),
        direction(*gravity),
    );
    let mut text = format!(
        "\n{}\n  slosh  frequency (rad/s)  mass (kg)  length (m)  height (m)  damping ratio\n",
        paragraph(&head, "", "  ")
    );
    for (number, mode) in (1..).zip(slosh) {
        let [frequency, mass, length, height, damping] =
            [mode.frequency, mode.mass, mode.length, mode.height, mode.damping_ratio]
                .map(|value| significant(value, 5));
        text.push_str(&format!(
            "  {number:<5}  {frequency:>17}  {mass:>9}  {length:>10}  {height:>10}  {damping:>13}\n"
        ));
    }
    text
}

/// What is to be read before answers about tanks, what may not hold first.
pub fn notes(study: &Study) -> Vec<String> {
    if study.tanks.is_empty() {
        return Vec::new();
    }
    let spin = study.initial().map(|start| start.omega).unwrap_or_default();
    let felt = felt(study);
    let mut notes: Vec<String> = study
        .tanks
        .iter()
        .flat_map(|tank| of_settling(study, tank, spin, felt).into_iter().chain(of_flow(tank)))
        .collect();
    notes.sort_by_key(|note| !note.starts_with(MAY_NOT_HOLD));
    notes
}

/// Notes on what the liquid has settled under, and what the model does to it.
fn of_settling(study: &Study, tank: &SettledTank, spin: [f64; 3], felt: [f64; 3]) -> Vec<String> {
    let name = &tank.name;
    let mut notes = Vec::new();
    match tank.settled_by {
        Settling::Acceleration(settled) => {
            if norm(minus(felt, settled)) > NOTABLE * norm(settled) {
                notes.push(format!(
                    "{MAY_NOT_HOLD}: the liquid of tank {name:?} has settled under {} m/s^2, and at the start the forces of the model press it with {} m/s^2. Where \
                     this is less, the weight of the liquid that slosh displaces has less moment on the body, or none: write the thrust as a [[force]].",
                    vector(settled),
                    vector(felt),
                ));
            }
            notes.extend(change_at(study, tank, spin).map(|share| {
                format!(
                    "{MAY_NOT_HOLD}: the spin at the start presses the liquid of tank {name:?} with {} % of the acceleration under which it has settled, and neither its \
                     level nor its slosh follows the spin.",
                    significant(100.0 * share, 2)
                )
            }));
            if spin != [0.0; 3] {
                // friction alone, or the layers that the spin keeps thin, whichever is sooner
                let soonest = |drag: f64| drag.min((drag / norm(spin)).sqrt());
                let after = tank
                    .drag_time
                    .map_or_else(String::new, |drag| format!(" in about {}", time(soonest(drag))));
                notes.push(format!(
                    "The liquid of tank {name:?} is ideal: that friction carries it along about the axis of the tank{after} is left out."
                ));
            }
        }
        Settling::Spin(settled) => {
            notes.push(format!(
                "The liquid of tank {name:?} has settled under a spin of {} rad/s and turns with the body; its slosh is known near this spin alone.",
                vector(settled)
            ));
            if norm(felt) > OTHER_GRAVITY * norm(tank.gravity) {
                notes.push(format!(
                    "{MAY_NOT_HOLD}: beside the spin the forces of the model press the liquid of tank {name:?} with {} m/s^2 at the start, and its level does not follow them.",
                    vector(felt)
                ));
            }
            if tank.spin_share > NOTABLE {
                notes.push(format!(
                    "{MAY_NOT_HOLD}: Coriolis forces and the curvature of its surface change the slosh of tank {name:?} by about {} %.",
                    significant(100.0 * tank.spin_share, 2)
                ));
            }
            if tank.inertia_share > NOTABLE {
                notes.push(format!(
                    "{MAY_NOT_HOLD}: the liquid of tank {name:?} turns with the body here; where it is left behind by fast motions, its moments of inertia are smaller by up \
                     to {} % of the differences of the body's.",
                    significant(100.0 * tank.inertia_share, 2)
                ));
            }
        }
    }
    notes
}

/// Notes on the flow: tilt, capillarity, viscosity, resolution.
fn of_flow(tank: &SettledTank) -> Vec<String> {
    let name = &tank.name;
    let mut notes = Vec::new();
    if tank.tilt > TILTED {
        notes.push(format!(
            "The liquid of tank {name:?} is pressed {} degrees off its axis; its slosh is that along the axis.",
            significant(tank.tilt.to_degrees(), 2)
        ));
    }
    let (bond, assumed) = tank.bond;
    if bond < CAPILLARY {
        let of =
            if assumed { " with the surface tension of water, 0.07 N/m, for want of another" } else { "" };
        notes.push(format!(
            "{MAY_NOT_HOLD}: the Bond number of tank {name:?} is {}{of}: capillarity raises the frequencies of its slosh by several per cent.",
            significant(bond, 3)
        ));
    }
    if tank.layer > THICK {
        notes.push(format!(
            "{MAY_NOT_HOLD}: the layer at the wall of tank {name:?} is not thin: it damps the slosh by {} of critical.",
            significant(tank.layer, 2)
        ));
    }
    notes.extend(of_baffles(tank));
    if tank.error > COARSE {
        notes.push(format!(
            "The slosh of tank {name:?} is known to about {} %.",
            significant(100.0 * tank.error, 1)
        ));
    }
    notes
}

/// Notes on the amplitude by which baffles damp, and on the flow past them.
fn of_baffles(tank: &SettledTank) -> Vec<String> {
    let (Some((numbers, amplitude)), name) = (&tank.baffles, &tank.name) else { return Vec::new() };
    let [least, most] = PLATES;
    let unknown = numbers.iter().find(|number| !(least..=most).contains(*number));
    let doubt = unknown.map(|number| {
        format!(
            "{MAY_NOT_HOLD}: the flow past a baffle of tank {name:?} has the Keulegan-Carpenter number {}: the drag of plates was measured from {least} to {most}.",
            significant(*number, 2)
        )
    });
    let told = format!(
        "The baffles of tank {name:?} damp as they do a wave of the amplitude {} m; smaller waves are damped less.",
        significant(*amplitude, 3)
    );
    doubt.into_iter().chain([told]).collect()
}

/// Warning to stand before an answer about a steady spin (rad/s) under which the liquid of a tank has not settled.
pub fn warning(study: &Study, spin: [f64; 3]) -> Option<String> {
    study.tanks.iter().find_map(|tank| {
        let share = change_at(study, tank, spin)?;
        Some(match tank.settled_by {
            Settling::Acceleration(_) => format!(
                "{MAY_NOT_HOLD}, since this spin presses the liquid of tank {:?} with {} % of the acceleration under which it has settled.",
                tank.name,
                significant(100.0 * share, 2)
            ),
            Settling::Spin(settled) => format!(
                "{MAY_NOT_HOLD}, since the liquid of tank {:?} has settled under another spin, {} rad/s.",
                tank.name,
                vector(settled)
            ),
        })
    })
}

/// The start of a model, or a slow spin about its axis of greatest inertia where it has tanks and no spin, and whether it is that one.
///
/// # Errors
/// As [`Study::initial`].
pub fn spun_slowly(study: &Study) -> Result<(Start, bool), StudyError> {
    let start = study.initial();
    let rests = match (&start, study.model.initial.rotation) {
        (Ok(start), _) => norm(start.omega) == 0.0,
        (Err(_), given) => given.is_none(),
    };
    let slowest =
        study.tanks.iter().flat_map(|tank| &tank.slosh).map(|mode| mode.frequency).min_by(f64::total_cmp);
    match slowest.filter(|_| rests) {
        None => start.map(|start| (start, false)),
        Some(slowest) => {
            let [.., greatest] = Principal::compute(study.body.invariants().J).axes;
            Ok((Start::new(scale(SLOW * slowest, greatest), study.model.initial.attitude), true))
        }
    }
}

/// Tank whose liquid an evolution does not leave where it has settled, in words: the mean spin is about one of these axes at the start and about
/// another at the end, at these rates (rad/s); none if every liquid stays.
pub fn left(study: &Study, axes: [[f64; 3]; 2], rates: [f64; 2]) -> Option<String> {
    let ends = [0, 1].map(|end| scale(rates[end], axes[end]));
    study.tanks.iter().find_map(|tank| {
        let change = |spin: [f64; 3]| change_at(study, tank, spin).unwrap_or(0.0);
        let share = ends.map(change).into_iter().fold(0.0, f64::max);
        (share > MOST_OTHER_GRAVITY).then(|| {
            format!(
                "the mean spin of this evolution changes the effective gravity of tank {:?} by {} % of that under which its liquid has settled.",
                tank.name,
                significant(100.0 * share, 2)
            )
        })
    })
}

/// Change of the effective gravity of a liquid from that under which it has settled to that at a spin (rad/s), over the former, where it
/// is notable.
fn change_at(study: &Study, tank: &SettledTank, spin: [f64; 3]) -> Option<f64> {
    let arm = minus(tank.center_of_mass, study.body.pole());
    let flung = |spin: [f64; 3]| scale(-1.0, cross(spin, cross(spin, arm)));
    let change = match tank.settled_by {
        // at the rim of the surface, wherever that is about the middle of the liquid
        Settling::Acceleration(_) => norm(flung(spin)) + dot(spin, spin) * tank.surface_radius,
        Settling::Spin(settled) => norm(minus(flung(spin), flung(settled))),
    };
    let share = change / norm(tank.gravity);
    (share > OTHER_GRAVITY).then_some(share)
}

/// Acceleration (m/s²) that liquids feel at the start beside that of the spin, body axes: the recoil of a free body from its forces, the
/// gravity on a body that is held.
pub fn felt(study: &Study) -> [f64; 3] {
    let body = &study.body;
    let free = *body.support() == Support::Free;
    let weighs = |force: &Force<Marker>| {
        matches!(force.law.timed().0, ForceLaw::UniformGravity { .. } | ForceLaw::CentralGravity { .. })
    };
    let forces: Vec<_> = study.forces.iter().filter(|force| weighs(force) != free).cloned().collect();
    let still = vec![0.0; body.coordinates().len()];
    let kinematics = KinematicState {
        t: 0.0,
        attitude: study.model.initial.attitude,
        pole: [0.0; 3],
        pole_velocity: [0.0; 3],
        motion: MotionState { omega: [0.0; 3], q: &still, rate: &still },
    };
    let per_mass = if free { -1.0 } else { 1.0 } / body.invariants().mass;
    scale(per_mass, body.loads(&forces, &kinematics).force)
}

/// A vector in words.
fn vector(v: [f64; 3]) -> String {
    format!("[{}]", v.map(|entry| significant(entry, 4)).join(", "))
}

/// A direction in words.
fn direction(v: [f64; 3]) -> String {
    vector(scale(norm(v).recip(), v))
}
