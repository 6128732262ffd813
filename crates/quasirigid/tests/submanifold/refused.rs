//! Bodies and plans without reduced equations about a spin, refused in words.

use std::ops::ControlFlow;

use quasirigid::elements::{Assembly, WheelSpeed};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::prelude::Carrier;
use quasirigid::submanifold::{MAX_DEGREE, SpinManifold, SpinManifoldPlan};
use quasirigid_math::expression::Expression;

use crate::inside::bodies::wheel;

use super::{bodies, body_of, plan};

fn refusal(body: &FlexibleBody, plan: &SpinManifoldPlan) -> String {
    SpinManifold::derive(body, plan, &mut |_| ControlFlow::Continue(())).unwrap_err().to_string()
}

#[test]
fn a_degree_out_of_range() {
    let body = body_of(&bodies::two_masses());
    for degree in [0, MAX_DEGREE + 1] {
        assert!(refusal(&body, &plan(&body, 1.0, degree)).contains("choose 1 to 11"));
    }
}

#[test]
fn a_material_without_equations() {
    let mut assembly = bodies::two_masses();
    assembly.springs[1].rheology = Rheology::QualityFactor { factor: 80.0 };
    let body = body_of(&assembly);
    let words = refusal(&body, &plan(&body, 1.0, 3));
    assert!(words.contains("no equations of motion of its own"), "{words}");
}

#[test]
fn a_wheel_of_prescribed_speed() {
    let speed = WheelSpeed::Prescribed { inertia: 0.1, speed: Expression::parse("3 + t", &["t"]).unwrap() };
    let body = body_of(&Assembly { wheels: vec![wheel([0.0, 0.0, 1.0], speed)], ..bodies::two_masses() });
    assert!(refusal(&body, &plan(&body, 1.0, 3)).contains("prescribed speed"));
}

#[test]
fn a_body_that_has_no_nutation() {
    let body = body_of(&Assembly::default().with(Carrier::principal(40.0, [9.0, 9.0, 9.0])));
    assert!(refusal(&body, &plan(&body, 1.0, 3)).contains("does the angular momentum circle in the body"));
}

#[test]
fn an_end_that_is_asked_for() {
    let body = body_of(&bodies::two_masses());
    let found = SpinManifold::derive(&body, &plan(&body, 1.0, 5), &mut |_| ControlFlow::Break(()));
    assert!(found.unwrap_err().to_string().contains("interrupted"));
}
