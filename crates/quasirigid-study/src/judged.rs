//! Order of the reduced equations: the one asked for, or the lowest one at which they hold.

use std::sync::Arc;

use quasirigid::dynamics::{Form, SlowEquations, load_ratio_at_start};
use quasirigid::model::ReducedBody;
use quasirigid::modes::SpinModes;
use quasirigid::reduction::{Comparison, Criterion, Validity, Verdict};
use quasirigid::verification::wobble_difference;
use quasirigid_io::model::PartialRun;
use quasirigid_io::record::Column;
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::incomplete::beyond;
use crate::motion::Motion;
use crate::settings::RunSettings;
use crate::steady::{self, Poles};
use crate::study::Study;
use crate::words::fastest_doubt;

/// Reduced equations of one order with their validity.
#[derive(Debug)]
pub(crate) struct Judged {
    pub order: usize,
    pub reduced: Arc<ReducedBody>,
    /// Angular velocity that is judged (rad/s).
    pub omega: [f64; 3],
    pub validity: Validity,
}

/// Highest order that is tried where nobody asked for one.
const HIGHEST_ORDER: usize = 7;
/// Coordinates of a body whose modes are found before every history.
const QUICK_COORDINATES: usize = 100;

/// The order of the study; where nobody asked for it, the motion holds and its dissipation or rates do not, the lowest order at which all
/// hold and nothing of the body is left out, if there is one.
pub(crate) fn at_an_order_that_holds(motion: &Motion, poles: &Poles) -> Result<Judged, StudyError> {
    from_an_order(motion, poles, motion.study().order)
}

/// The order for a motion that is followed in a form. Under forces the order of the torque-free part is the one that is raised, where the
/// form has one: the cost of the series along the flow grows steeply with its order. (E6)
pub(crate) fn for_motion(motion: &Motion, poles: &Poles, form: Form) -> Result<Judged, StudyError> {
    let (study, system) = (motion.study(), motion.system());
    if !system.acts() {
        return at_an_order_that_holds(motion, poles);
    }
    let Some(above) = SlowEquations::torque_free_order(system, form, study.order) else {
        return judged(motion, &Seen { modes: Vec::new(), loads: loads(motion) }, study.order);
    };
    let quick = study.body.coordinates().len() <= QUICK_COORDINATES;
    let free = if quick { steady::without_forces(motion, study)? } else { Poles::default() };
    let found = from_an_order(motion, &free, above)?;
    if found.order > above {
        return Ok(found);
    }
    Ok(Judged { order: study.order, reduced: study.reduced(study.order)?, ..found })
}

fn from_an_order(motion: &Motion, poles: &Poles, lowest: usize) -> Result<Judged, StudyError> {
    let study = motion.study();
    let seen = Seen { modes: poles.modes.iter().take(2).flatten().collect(), loads: loads(motion) };
    let own = judged(motion, &seen, lowest)?;
    if study.order_given || own.validity.verdict() == Verdict::Fails || own.holds() {
        return Ok(own);
    }
    let complete = |order: &usize| beyond(&study.model.assembly, *order).is_none();
    for order in (lowest + 1..=HIGHEST_ORDER).take_while(complete) {
        let next = judged(motion, &seen, order)?;
        if next.validity.verdict() <= own.validity.verdict() && next.holds() {
            return Ok(next);
        }
    }
    Ok(own)
}

/// The steady spins next to a start, of a body whose modes take a moment.
pub(crate) fn poles_in_a_moment(motion: &Motion) -> Result<Poles, StudyError> {
    let study = motion.study();
    let few = study.body.coordinates().len() <= QUICK_COORDINATES;
    if few { steady::at_start(motion, study) } else { Ok(Poles::default()) }
}

/// The order of the study, judged at an angular velocity (rad/s) in place of that of the start.
pub(crate) fn at(motion: &Motion, omega: [f64; 3]) -> Result<Judged, StudyError> {
    let study = motion.study();
    let reduced = study.reduced(study.order)?;
    let mut validity = Validity::assess_reduced(&study.body, &reduced, omega)?;
    place(&mut validity, Comparison::Power, (Comparison::Loads, loads(motion)));
    Ok(Judged { order: study.order, reduced, omega, validity })
}

/// The note on an order above that of the study, which nobody asked for.
pub(crate) fn raised(study: &Study, order: usize) -> Option<String> {
    let default = study.order;
    let equations = if study.forces.is_empty() {
        "The reduced equations are"
    } else {
        "The torque-free part of the reduced equations is"
    };
    (order > default).then(|| {
        format!(
            "{equations} of order {order}: at order {default}, the default, dissipation or rates do not hold."
        )
    })
}

impl Judged {
    fn holds(&self) -> bool {
        self.validity.dissipation() == Verdict::Holds
    }
}

/// What every order is compared with.
struct Seen<'a> {
    /// Modes about the steady spins.
    modes: Vec<&'a SpinModes>,
    /// Change of the loads by displacements, where forces act. (V13)
    loads: Option<f64>,
}

fn judged(motion: &Motion, seen: &Seen, order: usize) -> Result<Judged, StudyError> {
    let study = motion.study();
    let reduced = study.reduced(order)?;
    let omega = motion.judged_spin(&reduced)?;
    let mut validity = Validity::assess_reduced(&study.body, &reduced, omega)?;
    // losses of materials are left out of the reduced equations, and are told of elsewhere
    let complete = study.body.viscoelastic().is_empty();
    let compared = seen.modes.iter().filter(|_| complete);
    let differences = compared.filter_map(|modes| wobble_difference(&reduced, modes));
    place(&mut validity, Comparison::Power, (Comparison::Loads, seen.loads));
    place(&mut validity, Comparison::Levels, (Comparison::Wobbles, differences.reduce(f64::max)));
    Ok(Judged { order, reduced, omega, validity })
}

/// Change of the loads by displacements at the start, over the forces of the file's own duration. (V13)
fn loads(motion: &Motion) -> Option<f64> {
    if !motion.system().acts() {
        return None;
    }
    let settings = RunSettings::resolve(&PartialRun::default(), motion.study()).ok();
    let duration = settings.and_then(|settings| settings.duration(motion.start.omega).ok());
    let ratio = load_ratio_at_start(motion.system(), motion.start, duration.unwrap_or_default());
    (ratio != 0.0).then_some(ratio)
}

/// Verdict on reduced equations along a motion on which displacements have changed the loads by a ratio. (E7), (V13)
pub(crate) fn along_the_motion(load_ratio: f64) -> Verdict {
    Criterion { comparison: Comparison::Loads, value: load_ratio }.verdict()
}

/// Puts a criterion that needs more than the body before another one.
fn place(validity: &mut Validity, next: Comparison, (comparison, value): (Comparison, Option<f64>)) {
    let Some(value) = value else { return };
    let place = validity.criteria.iter().position(|criterion| criterion.comparison == next);
    let place = place.unwrap_or(validity.criteria.len());
    validity.criteria.insert(place, Criterion { comparison, value });
}

/// Fastest rotation of a history, where the reduced equations that were followed do not hold as they do at the start.
pub(crate) struct Fastest {
    /// Time (s).
    pub t: f64,
    /// Angular velocity (rad/s).
    pub omega: [f64; 3],
    pub validity: Validity,
}

impl Fastest {
    /// Whether the equations fail there.
    pub fn fails(&self) -> bool {
        self.validity.verdict() == Verdict::Fails
    }

    /// The doubt in words.
    pub fn doubt(&self) -> String {
        fastest_doubt(self.t, norm(self.omega), &self.validity)
    }
}

/// Growth of the spin beyond that of the start from which reduced equations under forces are judged again.
const FASTER: f64 = 1.05;

/// Judges reduced equations under forces at the fastest row of a history, since forces may spin a body up beyond the range in which it started.
pub(crate) fn at_the_fastest(motion: &Motion, columns: &[Column]) -> Result<Option<Fastest>, StudyError> {
    let column = |name: &str| columns.iter().find(|column| column.name == name);
    let (Some(t), [Some(x), Some(y), Some(z)]) = (column("t"), ["wx", "wy", "wz"].map(column)) else {
        return Ok(None);
    };
    let rates = x.values.iter().zip(&y.values).zip(&z.values).map(|((x, y), z)| [*x, *y, *z]);
    let rows = t.values.iter().zip(rates).filter(|(_, omega)| norm(*omega).is_finite());
    let Some((t, omega)) = rows.max_by(|(_, a), (_, b)| norm(*a).total_cmp(&norm(*b))) else {
        return Ok(None);
    };
    let study = motion.study();
    let reduced = study.reduced(study.order)?;
    if !motion.system().acts() || norm(omega) <= FASTER * norm(motion.judged_spin(&reduced)?) {
        return Ok(None);
    }
    let validity = Validity::assess_reduced(&study.body, &reduced, omega)?;
    let worse = validity.verdict() != Verdict::Holds;
    Ok(worse.then_some(Fastest { t: *t, omega, validity }))
}
