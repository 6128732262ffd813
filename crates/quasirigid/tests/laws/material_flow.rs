//! Flow of materials under the mean load of a rotation, against displacements of the elastic body and closed forms. (G21)

use quasirigid::averaging::{FreeRotation, MaterialFlow, Response};
use quasirigid::elements::{Assembly, Carrier, Ellipsoid, End, Material};
use quasirigid::model::{FlexibleBody, Rheology};

use crate::support::parts::{diagonal, spring};
use crate::support::{Sprung, sprung_body};

const TIME: f64 = 7e3;
const SHARE: f64 = 0.1;
const MAXWELL: Rheology = Rheology::Maxwell { time: TIME };

fn rock(rheology: Rheology) -> FlexibleBody {
    let material = Material { rheology, ..Material::new(1900.0, 1e6, 0.3) };
    Assembly::default().with(Ellipsoid::new("rock", [170.0, 141.0, 120.0], material)).body().unwrap()
}

fn flow(body: &FlexibleBody, omega: [f64; 3]) -> Option<MaterialFlow> {
    let response = Response::compute(body).unwrap();
    let principal = response.principal();
    let motion = FreeRotation::through(principal.moments, principal.components(omega)).unwrap();
    response.material_flow(&motion, SHARE)
}

/// Size of the change of the inertia tensor by the displacements of the elastic body under the mean load, over the difference of its moments.
fn elastic_change(body: &FlexibleBody, omega: [f64; 3]) -> f64 {
    let response = Response::compute(body).unwrap();
    let principal = response.principal();
    let motion = FreeRotation::through(principal.moments, principal.components(omega)).unwrap();
    let in_body =
        |omega: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|i| omega[i] * principal.axes[i][k]).sum::<f64>());
    let mean = |i: usize, k: usize| motion.mean(2, |omega| in_body(omega)[i] * in_body(omega)[k]);
    let products = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]].map(|[i, k]| mean(i, k));
    let moved = body.full_inertia_at(&body.displaced_by(products).unwrap());
    let square: f64 =
        (0..6).map(|i| if i < 3 { 1.0 } else { 2.0 } * (moved[i] - body.invariants().J[i]).powi(2)).sum();
    square.sqrt() / (principal.moments[2] - principal.moments[0])
}

/// Maxwell's law adds the elastic displacement once in each of its times.
#[test]
fn a_maxwell_body_flows_by_its_elastic_displacement_in_each_time() {
    for omega in [[0.0, 0.0, 5e-4], [3e-4, -2e-4, 5e-4], [5e-4, 1e-5, 1e-5]] {
        let found = flow(&rock(MAXWELL), omega).unwrap();
        let expected = TIME * SHARE / elastic_change(&rock(Rheology::Elastic), omega);
        assert!((found.time / expected - 1.0).abs() < 1e-5, "{found:?} {expected}");
        assert_eq!(found.name, "rock");
    }
}

/// The creep of Andrade's law comes before its flow, and laws that hold a load do not flow.
#[test]
fn laws_that_hold_a_load_do_not_flow() {
    let omega = [3e-4, -2e-4, 5e-4];
    for holds in [
        Rheology::Elastic,
        Rheology::KelvinVoigt { time: TIME },
        Rheology::QualityFactor { factor: 2.0 },
        Rheology::StandardLinear { time: TIME, strength: 3.0 },
    ] {
        assert_eq!(flow(&rock(holds), omega), None);
    }
    let andrade = Rheology::Andrade { time: TIME, creep_time: TIME, exponent: 0.4 };
    let creep = |t: f64| (t / TIME).powf(0.4) + t / TIME;
    let (found, times) =
        (flow(&rock(andrade), omega).unwrap(), SHARE / elastic_change(&rock(MAXWELL), omega));
    let grown = creep(found.time);
    assert!(grown / times > 0.88 && grown / times < 1.13, "{grown} {times}");
}

/// Point on a Maxwell spring of each axis beside an elastic one of so many times its stiffness; axes and units are odd.
fn held(beside: f64) -> FlexibleBody {
    let carrier = Carrier {
        mass: 40.0,
        center_of_mass: [0.0, 0.1, 0.0],
        inertia: [[9.0, 0.5, -0.2], [0.5, 13.0, 0.3], [-0.2, 0.3, 16.0]],
    };
    let stiffness = [0.5, 0.4, 0.6];
    let mass = Sprung {
        mass: 2.0,
        position: [0.9, 0.3, 0.5],
        stiffness: stiffness.map(|k| beside * k),
        damping: [0.0; 3],
    };
    let mut assembly = sprung_body(carrier, &[mass]);
    let mut flowing = spring(End::Point(0), End::Carrier, diagonal(stiffness, [0.0; 3]));
    flowing.rheology = MAXWELL;
    flowing.name = "dashpot in series".into();
    assembly.springs.push(flowing);
    assembly.body().unwrap()
}

/// Beside an elastic spring the flow ends: `x = F[1/k₁ − (1/k₁ − 1/(k₁ + k))e^{−t/τ'}]` with `τ' = τ(k₁ + k)/k₁`. The stiffness at `1/t` is within a
/// quarter of it, and a flow that ends before the share is none.
#[test]
fn flow_ends_where_an_elastic_spring_takes_the_load() {
    let omega = [2e-2, -1e-2, 4e-2];
    let body = held(0.01);
    let elastic = elastic_change(&body, omega);
    let found = flow(&body, omega).unwrap();
    let grown = 100.0 * (1.0 - (-found.time * 0.01 / (1.01 * TIME)).exp());
    assert!((grown * elastic / SHARE - 1.0).abs() < 0.25, "{grown} {elastic} {found:?}");
    assert_eq!(found.name, "dashpot in series");
    assert_eq!(flow(&held(3.0), omega), None);
}
