//! Growing and decaying motions of the equations of motion: materials that leave no dashpots, and a boom that whirls. (M4)

use std::ops::ControlFlow;

use quasirigid::elements::{
    Assembly, Frame, FrameNode, HingeCoefficient, Hinged, Material, Part, PartKind, PartReduction,
    SectionShape,
};
use quasirigid::model::{FlexibleBody, Mode, Rheology};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes, whirl_onset};
use quasirigid::problems::AxialMass;
use quasirigid::secular::{EnergyRange, Pole, Poles};

use super::common::turned_axes;
use crate::support::parts;

/// A hub with two unlike booms whose material alone dissipates, and, if wanted, a dashpot between mass and speed of one.
pub fn booms(braked: f64) -> FlexibleBody {
    let node = |name: &str, place: [f64; 3]| FrameNode {
        name: name.to_owned(),
        position: (turned_axes() * nalgebra::Vector3::from(place)).into(),
    };
    let boom = |name: &str, to: [f64; 3], per_mass: f64| {
        let rheology = Rheology::QualityFactor { factor: 40.0 };
        let material = Material { density: 1600.0, young: 9e9, poisson: 0.3, rheology };
        let member =
            parts::member([0, 1], SectionShape::Rectangle { height: 0.02, width: 0.014 }, material, 5);
        let nodes = vec![node("root", [0.1, -0.2, 0.3]), node("tip", to)];
        let kind = PartKind::Frame(Frame { nodes, members: vec![member] });
        Part { name: name.to_owned(), kind, masses: Vec::new(), attached: vec![0], rayleigh: [per_mass, 0.0] }
    };
    let carrier =
        parts::carrier(40.0, [0.1, -0.05, 0.02], [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]]);
    let parts = vec![boom("long", [2.9, 0.8, 0.4], 0.0), boom("short", [-1.8, 1.1, 0.2], braked)];
    let reduction = PartReduction { order: 3, modes: 12 };
    Assembly { carrier: Some(carrier), parts, reduction, ..Assembly::default() }.body().unwrap()
}

fn poles(body: &FlexibleBody, spin: f64) -> Poles {
    let principal = quasirigid::model::Principal::compute(body.invariants().J);
    Poles::compute(body, &EnergyRange::compute(body, spin * principal.moments[2]).unwrap()).unwrap()
}

fn internal(pole: Option<&Pole>) -> &SpinModes {
    &pole.unwrap().modes
}

/// No dashpot, no decay, to the last digit: the eigenvalues of such motions have real parts of either sign by rounding.
#[test]
fn a_body_of_viscoelastic_material_alone_has_no_motion_that_grows_in_its_equations() {
    let body = booms(0.0);
    let poles = poles(&body, 0.05);
    for mode in [Mode::LongAxis, Mode::ShortAxis] {
        let modes = internal(poles.of_mode(mode));
        assert!(modes.internal.len() > 10);
        assert!(modes.internal.iter().all(|[decay, _]| *decay == 0.0), "{mode:?}: {:?}", modes.internal);
    }
}

/// With a dashpot every internal motion decays, and none grows below the critical spin.
#[test]
fn a_dashpot_makes_every_internal_motion_decay() {
    let body = booms(1e-3);
    let poles = poles(&body, 0.05);
    for mode in [Mode::LongAxis, Mode::ShortAxis] {
        let decays = &internal(poles.of_mode(mode)).internal;
        assert!(decays.iter().all(|[decay, _]| *decay > 0.0 && *decay < 1e-3), "{mode:?}: {decays:?}");
    }
}

/// A boom along the axis of least inertia of a stage at 50 rpm: above its critical spin a whirl grows by its own damping. An
/// independent code has it grow e-fold in 364 s.
#[test]
fn a_boom_above_its_critical_spin_whirls() {
    let body = stage();
    let spin = 50.0 * std::f64::consts::TAU / 60.0;
    let angular_momentum = spin * quasirigid::model::Principal::compute(body.invariants().J).moments[0];
    let poles = Poles::compute(&body, &EnergyRange::compute(&body, angular_momentum).unwrap()).unwrap();
    let long = internal(poles.long.as_ref());
    let slowest = long.internal.iter().map(|[decay, _]| *decay).fold(f64::INFINITY, f64::min);
    let grown = long.modes.iter().filter(|mode| mode.grows() && !mode.nutation).count();
    println!("{slowest:e} {grown}");
    assert!(slowest < 0.0 && grown == 1, "{:?}", long.internal);
    assert!((-1.0 / slowest / 364.0 - 1.0).abs() < 0.05, "{slowest}");
}

/// The onset of whirl lies where the slowest internal motion neither grows nor decays: of the two spins around it one whirls. (M9)
#[test]
fn the_onset_of_whirl_parts_spins_that_whirl_from_those_that_do_not() {
    let body = stage();
    let onset = whirl_onset(&body, Mode::LongAxis, [0.5, 20.0], &mut |_| ControlFlow::Continue(())).unwrap();
    let decay = |spin: f64| {
        let steady = RelativeEquilibrium::extreme(&body, Mode::LongAxis, SpinMagnitude::Rate(spin)).unwrap();
        let modes = SpinModes::about(&body, steady).unwrap();
        modes.internal.iter().map(|[decay, _]| *decay).fold(f64::INFINITY, f64::min)
    };
    println!("{onset:?} {:e} {:e}", decay(0.999 * onset.spin), decay(1.001 * onset.spin));
    assert!(decay(0.999 * onset.spin) > 0.0 && decay(1.001 * onset.spin) < 0.0, "{onset:?}");
    assert!(onset.spin < 50.0 * std::f64::consts::TAU / 60.0, "{onset:?}");
}

/// Onset of whirl by the modes of every spin alone.
fn onset_by_modes(body: &FlexibleBody, mode: Mode, [from, to]: [f64; 2]) -> Option<f64> {
    let grows = |spin: f64| {
        let steady = RelativeEquilibrium::extreme(body, mode, SpinMagnitude::Rate(spin)).ok()?;
        let modes = SpinModes::about(body, steady).ok()?.modes;
        Some(modes.iter().any(|mode| !mode.nutation && mode.decay_rate < -1e-12 * mode.frequency))
    };
    let mut stable = None;
    for i in 0..=48 {
        let mut high = from * (to / from).powf(48_f64.recip()).powi(i);
        match grows(high) {
            Some(true) => {
                let Some(mut low) = stable else { return Some(high) };
                while high - low > 1e-10 * high {
                    let middle = 0.5 * (low + high);
                    match grows(middle) {
                        Some(true) => high = middle,
                        Some(false) => low = middle,
                        None => break,
                    }
                }
                return Some(high);
            }
            Some(false) => stable = Some(high),
            None => {}
        }
    }
    None
}

/// The eigenvalues by which spins are passed over change neither spin nor motion: about the axis of greatest inertia, where all may decay, and
/// about that of least, where the nutation grows.
#[test]
fn the_onset_of_whirl_is_that_of_the_modes() {
    let on_axis = AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.3 }
        .assembly()
        .body()
        .unwrap();
    let onset = |body: &FlexibleBody, mode: Mode, range: [f64; 2]| {
        let found =
            whirl_onset(body, mode, range, &mut |_| ControlFlow::Continue(())).map(|onset| onset.spin);
        assert_eq!(found, onset_by_modes(body, mode, range), "{mode:?}");
        found
    };
    assert!(onset(&on_axis, Mode::ShortAxis, [0.5, 60.0]).is_some());
    assert!(onset(&on_axis, Mode::ShortAxis, [0.5, 6.0]).is_none());
    assert!(onset(&stage(), Mode::LongAxis, [0.5, 20.0]).is_some());
    assert!(onset(&stage(), Mode::ShortAxis, [0.5, 20.0]).is_none());
}

/// A stage with a boom along its axis of least inertia.
fn stage() -> FlexibleBody {
    let boom = Hinged {
        name: "boom".to_owned(),
        mass: 3.5,
        center_of_mass: [0.0, 0.0, 7.5],
        inertia: parts::diag([0.5, 0.5, 0.01]),
        hinge: [0.0, 0.0, 1.5],
        axes: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        stiffness: HingeCoefficient::PerAxis(vec![472.748_094; 2]),
        damping: HingeCoefficient::PerAxis(vec![0.472_748_094; 2]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    };
    let carrier = parts::carrier(900.0, [0.0; 3], parts::diag([1100.0, 1150.0, 300.0]));
    Assembly { carrier: Some(carrier), hinged: vec![boom], ..Assembly::default() }.body().unwrap()
}
