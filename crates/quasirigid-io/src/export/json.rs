use quasirigid_body::Support;
use quasirigid_math::polynomial::Homogeneous;
use serde::Serialize;

use super::{Derived, Forces, parts};

/// The object that `derive --format json` prints.
#[derive(Serialize)]
struct Object<'a> {
    name: &'a str,
    units: &'static str,
    support: &'static str,
    order: usize,
    mass: f64,
    center_of_mass: [f64; 3],
    pole: [f64; 3],
    inertia: [[f64; 3]; 3],
    wheels: [f64; 3],
    frequencies: &'a [f64],
    coordinates: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    forces: Option<&'a Forces>,
    mu: Vec<Term>,
    momentum: Vec<Term>,
    spin_of_momentum: Vec<Term>,
    energy_of_momentum: Vec<Term>,
    c: Vec<Term>,
    T: Vec<Term>,
    force: Vec<Term>,
    energy: Vec<Term>,
    power: Vec<Term>,
    displacements: Vec<Term>,
    rates: Vec<Term>,
}

/// One monomial `ωx^i ωy^j ωz^k` with its coefficients.
#[derive(Serialize)]
struct Term {
    exponents: [usize; 3],
    value: Vec<f64>,
}

impl Derived<'_> {
    /// The derived body as one JSON object: every monomial of every degree, all digits.
    #[must_use]
    pub fn json(&self) -> String {
        let Derived { name, body, reduced, frequencies, forces, .. } = *self;
        let object = Object {
            name,
            units: "SI",
            support: match body.support() {
                Support::Free => "free",
                Support::FixedPoint { .. } => "fixed-point",
                Support::Prescribed { .. } => "prescribed",
            },
            order: reduced.order,
            mass: reduced.mass,
            center_of_mass: body.center_of_mass(),
            pole: body.pole(),
            inertia: body.inertia(),
            wheels: body.wheels().angular_momentum(0.0),
            frequencies,
            coordinates: body.coordinates().iter().map(|coordinate| coordinate.name.as_str()).collect(),
            forces,
            mu: terms(&self.mu().iter().collect::<Vec<_>>()),
            momentum: terms(&self.angular_momentum()),
            spin_of_momentum: terms(&parts(&reduced.Omega, 1)),
            energy_of_momentum: terms(&parts(&reduced.energy_of_momentum, 2)),
            c: terms(&parts(&reduced.c, 0)),
            T: terms(&parts(&reduced.T, 0)),
            force: terms(&parts(&reduced.phi, 4)),
            energy: terms(&parts(&reduced.energy, 2)),
            power: terms(&self.power()),
            displacements: terms(&self.displacements().iter().collect::<Vec<_>>()),
            rates: terms(&self.rates().iter().collect::<Vec<_>>()),
        };
        serde_json::to_string_pretty(&object).expect("numbers and strings always have a JSON text")
    }
}

fn terms(parts: &[&Homogeneous]) -> Vec<Term> {
    let terms = parts.iter().flat_map(|part| part.terms());
    terms.map(|(exponents, value)| Term { exponents, value }).collect()
}
