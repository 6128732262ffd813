//! Liquids that slide along partly full rings: what carries them, what refuses them, and what is to be read before answers.
//! Limits of (U10) to (U14), docs/theory/21-slosh.md.

use quasirigid::elements::Slug;
use quasirigid::model::{Principal, TubeFlow};
use quasirigid::modes::EquilibriumError;
use quasirigid_io::model::{Displacements, Model, System};
use quasirigid_math::vec3::{add, cross, dot, norm, scale};
use serde::Serialize;

use crate::driven;
use crate::error::StudyError;
use crate::layout::paragraph;
use crate::study::Study;
use crate::words::{MAY_NOT_HOLD, significant};

/// Womersley number from which an oscillation is no succession of steady flows: a third of its inertia, that of the profile, is then 4 % of the
/// friction.
const UNSTEADY: f64 = 1.0;
/// Bond number from which weight decides where the liquid lies in its tube.
const HEAVY: f64 = 1.0;
/// Radius of a tube over that of its ring up to which the laws of curved tubes were measured.
const MEASURED: f64 = 1.0 / 15.0;

/// Slug of liquid in a ring.
#[derive(Serialize)]
pub struct SlugObject {
    /// Angle along the ring (rad).
    pub arc: f64,
    /// Of the nutation in the body at the spin of the start (rad/s), with the liquid held; 0 without a spin.
    pub nutation_rate: f64,
    /// Of the slug, sliding at that rate.
    pub reynolds: f64,
    /// Of an oscillation at that rate.
    pub womersley: f64,
    /// `laminar`, `transitional` or `turbulent`, sliding at that rate.
    pub flow: &'static str,
    /// On the carrier about the axis of the ring, sliding at that rate (N m).
    pub friction: f64,
}

impl SlugObject {
    /// A slug, judged at the nutation of a study.
    pub fn of(study: &Study, slug: &Slug) -> Self {
        let rate = nutation_rate(study);
        Self {
            arc: slug.arc,
            nutation_rate: rate,
            reynolds: slug.reynolds(rate),
            womersley: slug.womersley(rate),
            flow: word(slug.friction.flow(rate)),
            friction: slug.friction.at_rest() * rate + slug.friction.beyond(rate),
        }
    }
}

impl Study {
    /// Refuses an answer for which liquids would have to stay where they are.
    pub(crate) fn without_slugs(&self, what: &'static str) -> Result<(), StudyError> {
        if self.body.frictions().is_empty() {
            return Ok(());
        }
        let names = self.body.frictions().iter().map(|friction| friction.name.clone()).collect();
        Err(StudyError::Sliding { names, what })
    }
}

/// Accepts a system that carries the sliding liquids of a study.
pub fn carries(study: &Study, system: System) -> Result<(), StudyError> {
    match system {
        System::Full | System::Rigid => Ok(()),
        System::Reduced | System::SpinManifold => study.without_slugs("reduced equations"),
    }
}

/// The model with its sliding liquids held where they lie at rest and its driven parts locked where they start, and nothing else displaced.
pub fn held(model: &Model) -> Model {
    let mut model = model.clone();
    driven::lock(&mut model);
    model.assembly.tubes.iter_mut().for_each(|tube| tube.held = true);
    model.extremes = None;
    model.initial.displacements = Displacements::SlowManifold;
    model
}

/// Coordinates of a body whose liquids slide or whose parts are driven, from those of the body in which these are held: zero.
pub fn with_slugs(study: &Study, held: Vec<f64>) -> Vec<f64> {
    let body = &study.body;
    let slides = |j: usize| {
        body.frictions().iter().any(|friction| friction.coordinate == j)
            || body.drives().iter().any(|drive| drive.coordinate == j)
    };
    let mut held = held.into_iter();
    let count = study.body.coordinates().len();
    (0..count).map(|j| if slides(j) { 0.0 } else { held.next().unwrap_or_default() }).collect()
}

/// What a judgement of the reduced equations is about, in words; none where nothing slides and nothing is driven.
pub fn unjudged(study: &Study) -> Option<String> {
    let quoted = |names: &mut dyn Iterator<Item = &String>| {
        names.map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
    };
    let sliding = quoted(&mut study.body.frictions().iter().map(|friction| &friction.name));
    let driven = quoted(&mut study.body.drives().iter().map(|drive| &drive.name));
    let why = match (sliding.is_empty(), driven.is_empty()) {
        (true, true) => return None,
        (false, true) => format!("the liquid of {sliding} slides along its ring without a spring"),
        (true, false) => format!("a law over time moves {driven}"),
        (false, false) => {
            format!("a law over time moves {driven}, and the liquid of {sliding} slides along its ring")
        }
    };
    let held = if driven.is_empty() { "this liquid held" } else { "all of this held" };
    Some(format!(
        "NO ANSWER for the body as it is: {why}, so that there are no reduced equations; `simulate --system full` follows it. What is told here is of {held} where it lies at the start."
    ))
}

/// Warning to stand before modes about a steady spin whose nutation has this frequency (rad/s), at which the flow of a liquid is not developed.
pub fn warning(study: &Study, frequency: f64) -> Option<String> {
    let free = study.slugs.iter().filter(|slug| !slug.held);
    let lags =
        free.map(|slug| (slug, slug.womersley(frequency))).find(|(_, womersley)| *womersley > UNSTEADY);
    lags.map(|(slug, womersley)| {
        format!(
            "{MAY_NOT_HOLD}, since small motions of the liquid of tank {:?} are damped as developed laminar flow, and the {} has the Womersley number {} in its tube.",
            slug.name,
            study.model.kind.nutation(),
            significant(womersley, 2)
        )
    })
}

/// Reason for which no steady spin holds a liquid at a place of its ring, in words; none of other errors.
pub fn unrestored(study: &Study, error: &EquilibriumError) -> Option<String> {
    let EquilibriumError::Unrestored { coordinates, .. } = error else { return None };
    (!study.body.frictions().is_empty()).then(|| {
        format!(
            "a steady spin leaves {coordinates} free to lie at any place, or pushes it from all of them, so that there are no modes; `simulate --system full` follows it"
        )
    })
}

/// A slug, for a terminal.
pub fn text(study: &Study, slug: &Slug) -> String {
    let SlugObject { arc, reynolds, flow, friction, .. } = SlugObject::of(study, slug);
    let mut words = format!(
        "{:?}: {} kg of liquid, {} % of the ring, a slug of {} degrees.",
        slug.name,
        significant(slug.liquid_mass, 4),
        significant(100.0 * slug.fill, 4),
        significant(arc.to_degrees(), 4),
    );
    if reynolds > 0.0 {
        words.push_str(&format!(
            " Sliding around with the {} it has the Reynolds number {}: {flow} flow, {} N m.",
            study.model.kind.nutation(),
            significant(reynolds, 3),
            significant(friction, 3),
        ));
    }
    format!("\n{}\n", paragraph(&words, "", "  "))
}

/// What is to be read before answers, what may not hold first.
pub fn notes(study: &Study) -> Vec<String> {
    let mut notes: Vec<String> =
        study.slugs.iter().filter(|slug| !slug.held).flat_map(|slug| of_slug(study, slug)).collect();
    notes.sort_by_key(|note| !note.starts_with(MAY_NOT_HOLD));
    notes
}

fn of_slug(study: &Study, slug: &Slug) -> Vec<String> {
    let (name, nutation) = (&slug.name, study.model.kind.nutation());
    let SlugObject { nutation_rate, reynolds, womersley, flow, .. } = SlugObject::of(study, slug);
    let runs = if nutation_rate > 0.0 {
        format!(
            "; sliding around with the {nutation}, {} rad/s in the body, its flow is {flow}, the Reynolds number {}",
            significant(nutation_rate, 3),
            significant(reynolds, 3)
        )
    } else {
        String::new()
    };
    let mut notes = vec![format!(
        "The liquid of tank {name:?} is one slug that slides along its ring{runs}. Layers that grow after a change of the rate, the ends of the slug and a rough wall are left out."
    )];
    let spin = study.initial().map(|start| start.omega).unwrap_or_default();
    let arm = add(slug.center_of_mass, scale(-1.0, study.body.pole()));
    let bond = slug.bond(norm(cross(spin, cross(spin, arm))));
    if bond > HEAVY {
        let of = if slug.surface_tension.1 {
            " with the surface tension of water, 0.07 N/m, for want of another"
        } else {
            ""
        };
        notes.push(format!(
            "{MAY_NOT_HOLD}: the Bond number of tank {name:?} in the spin of the start is {}{of}: its liquid is taken to fill the tube, and its weight may spread it along the outer side.",
            significant(bond, 2)
        ));
    }
    if flow == word(TubeFlow::Transitional) {
        notes.push(format!(
            "{MAY_NOT_HOLD}: the flow in tank {name:?} is neither laminar nor turbulent there, and its friction a guess between both."
        ));
    }
    let curvature = slug.friction.curvature;
    if curvature > MEASURED {
        notes.push(format!(
            "{MAY_NOT_HOLD}: the tube of tank {name:?} has {} times the radius of its ring; friction in curved tubes was measured up to 1/15.",
            significant(curvature, 2)
        ));
    }
    if womersley > UNSTEADY {
        notes.push(format!(
            "{MAY_NOT_HOLD} for small motions of the liquid of tank {name:?} (modes, linear models, the end of a decay): its flow is taken as laminar and developed at each moment, and at the Womersley \
             number {} of the {nutation} it lags.",
            significant(womersley, 2)
        ));
    }
    notes
}

fn word(flow: TubeFlow) -> &'static str {
    match flow {
        TubeFlow::Laminar => "laminar",
        TubeFlow::Transitional => "transitional",
        TubeFlow::Turbulent => "turbulent",
    }
}

/// Rate (rad/s) of the small nutation in body axes, of the rigid body with the spin of the start along the axis of greatest or of least inertia
/// that it is nearer to; zero without a spin.
fn nutation_rate(study: &Study) -> f64 {
    let Ok(start) = study.initial() else { return 0.0 };
    let Principal { moments: [I1, I2, I3], axes, .. } = Principal::compute(study.body.invariants().J);
    let along = |axis: [f64; 3]| dot(start.omega, axis).abs();
    let square = if along(axes[2]) >= along(axes[0]) {
        (I3 - I1) * (I3 - I2) / (I1 * I2)
    } else {
        (I2 - I1) * (I3 - I1) / (I2 * I3)
    };
    norm(start.omega) * square.max(0.0).sqrt()
}
