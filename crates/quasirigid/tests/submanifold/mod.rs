//! Reduced equations about a steady spin.

mod between_poles;
pub mod bodies;
mod explorer_1;
mod laws;
mod orders;
mod refused;
mod resonance;
mod stiff_limit;
mod tuned_damper;

use std::ops::ControlFlow;

use quasirigid::elements::Assembly;
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::submanifold::{Masters, SpinManifold, SpinManifoldPlan, Style};
use quasirigid_math::vec3::{add, dot, scale};

/// Angular momentum (N·m·s), with that of the wheels, of a spin (rad/s) about the axis of greatest inertia.
fn angular_momentum(body: &FlexibleBody, spin: f64) -> [f64; 3] {
    let Principal { moments, axes } = Principal::compute(body.invariants().J);
    let wheels = body.wheels().constant;
    let along = if dot(axes[2], wheels) < 0.0 { -spin } else { spin };
    add(scale(along * moments[2], axes[2]), wheels)
}

/// Plan about the axis of greatest inertia, in normal form, the nutation alone.
fn plan(body: &FlexibleBody, spin: f64, degree: usize) -> SpinManifoldPlan {
    let angular_momentum = angular_momentum(body, spin);
    let (mode, masters, style) = (Mode::ShortAxis, Masters::Nutation, Style::NormalForm);
    SpinManifoldPlan { mode, angular_momentum, masters, degree, style }
}

fn derived<'a>(body: &'a FlexibleBody, plan: &SpinManifoldPlan) -> SpinManifold<'a> {
    SpinManifold::derive(body, plan, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn body_of(assembly: &Assembly) -> FlexibleBody {
    assembly.body().unwrap()
}

/// Coefficient of `z₁²z̄₁` in the motion of the nutation: the change of its rates with the square of the amplitude.
fn cubic(manifold: &SpinManifold) -> [f64; 2] {
    let expansion = manifold.expansion();
    let mut exponents = vec![0; expansion.masters.len()];
    (exponents[0], exponents[1]) = (2, 1);
    expansion.rates[0].coefficient(expansion.ring.index(&exponents).unwrap())
}
