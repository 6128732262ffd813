//! Parts that move as one are one; parts locked by friction are frozen.

use nalgebra::{Matrix3, Vector3};
use quasirigid::elements::{
    Assembly, CavityShape, Coefficient, End, RotorKind, Spring, SpringLaw, WheelSpeed,
};
use quasirigid::model::ReducedBody;
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::to_inertial;

use super::bodies::{everything, wheel};
use super::description::SAME;
use crate::support::parts;

const ORDER: usize = 3;
/// Rounding of some hundred operations, grown by the condition of the chains of liquids.
const ROUNDING: f64 = 1e-12;

fn reduced(assembly: &Assembly) -> ReducedBody {
    reduce(&assembly.body().unwrap(), ORDER).unwrap()
}

/// Cuts a rotor in two of the same relaxation time, each with its share of inertia and friction; a flywheel may rotate the other way.
fn cut_rotor(assembly: &mut Assembly, index: usize, share: f64) {
    let mut part = assembly.rotors[index].clone();
    part.name.push_str(" cut");
    if let RotorKind::Flywheel { axis } = &mut part.kind {
        *axis = axis.map(|entry| -2.0 * entry);
    }
    let whole = &mut assembly.rotors[index];
    for (rotor, share) in [(whole, 1.0 - share), (&mut part, share)] {
        rotor.inertia *= share;
        rotor.friction *= share;
    }
    assembly.rotors.push(part);
}

/// Cuts a wheel in two, whose angular momenta sum up.
fn cut_wheel(assembly: &mut Assembly) {
    let whole = &assembly.wheels[0];
    let WheelSpeed::Constant { angular_momentum } = whole.speed else { panic!("{whole:?}") };
    let vector = angular_momentum * Vector3::from(whole.axis).normalize();
    let part = Vector3::new(-1.5, 3.0, 0.7);
    assembly.wheels = [part, vector - part]
        .iter()
        .enumerate()
        .map(|(i, vector)| {
            let mut wheel = wheel((*vector).into(), WheelSpeed::Constant { angular_momentum: vector.norm() });
            wheel.name = format!("wheel {i}");
            wheel
        })
        .collect();
}

/// Cuts a liquid in two of the same viscosity in one cavity, each with its share of the density.
fn cut_liquid(assembly: &mut Assembly, index: usize, share: f64) {
    let mut part = assembly.cavities[index].clone();
    part.name.push_str(" cut");
    part.density *= share;
    assembly.cavities[index].density *= 1.0 - share;
    assembly.cavities.push(part);
}

/// Cuts a mass in two at one place, each with its share of every spring.
fn cut_mass(assembly: &mut Assembly, index: usize, share: f64) {
    let new = End::Point(assembly.points.len());
    let mut part = assembly.points[index].clone();
    part.name.push_str(" cut");
    part.mass *= share;
    assembly.points[index].mass *= 1.0 - share;
    assembly.points.push(part);
    let old = End::Point(index);
    let mut parts = Vec::new();
    for spring in assembly.springs.iter_mut().filter(|spring| spring.from == old || spring.to == old) {
        let moved = |end: End| if end == old { new } else { end };
        let part = Spring {
            name: String::new(),
            from: moved(spring.from),
            to: moved(spring.to),
            law: times(spring.law, share),
            ..spring.clone()
        };
        parts.push(part);
        spring.law = times(spring.law, 1.0 - share);
    }
    assembly.springs.extend(parts);
}

fn times(law: SpringLaw, factor: f64) -> SpringLaw {
    let scaled = |coefficient| match coefficient {
        Coefficient::Isotropic(value) => Coefficient::Isotropic(factor * value),
        Coefficient::Diagonal(values) => Coefficient::Diagonal(values.map(|value| factor * value)),
        Coefficient::Full(rows) => Coefficient::Full(rows.map(|row| row.map(|value| factor * value))),
    };
    match law {
        SpringLaw::Spatial { stiffness, damping } => {
            SpringLaw::Spatial { stiffness: scaled(stiffness), damping: scaled(damping) }
        }
        SpringLaw::Axial { .. } => panic!("{law:?}"),
    }
}

#[test]
fn parts_that_move_as_one_are_one() {
    type Cut = fn(&mut Assembly);
    let cuts: [(&str, Cut); 6] = [
        ("flywheel", |assembly| cut_rotor(assembly, 0, 0.3)),
        ("ball", |assembly| cut_rotor(assembly, 1, 0.6)),
        ("wheel", cut_wheel),
        ("ellipsoid of liquid", |assembly| cut_liquid(assembly, 0, 0.7)),
        ("ball of liquid", |assembly| cut_liquid(assembly, 1, 0.2)),
        ("sprung mass", |assembly| cut_mass(assembly, 0, 0.4)),
    ];
    let whole = reduced(&everything());
    let mut all = everything();
    let check = |name: &str, assembly: &Assembly| {
        let gaps = SAME.gaps(&reduced(assembly), &whole);
        println!("{name}: {gaps:?}");
        assert!(gaps.iter().all(|(_, gap)| *gap < ROUNDING), "{name}: {gaps:?}");
    };
    for (name, cut) in cuts {
        let mut assembly = everything();
        cut(&mut assembly);
        check(name, &assembly);
        cut(&mut all);
    }
    check("all", &all);
}

/// The body whose rotors and liquids are part of its carrier.
fn frozen() -> Assembly {
    let mut assembly = everything();
    assembly.rotors.clear();
    let carrier = assembly.carrier.take().unwrap();
    let mut rigid =
        vec![(carrier.mass, Vector3::from(carrier.center_of_mass), Matrix3::from(carrier.inertia))];
    for cavity in assembly.cavities.drain(..) {
        let CavityShape::Ellipsoid { semi_axes } = cavity.shape else { panic!() };
        let [a, b, c] = semi_axes;
        let mass = cavity.density * 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
        let own = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 5.0);
        let axis =
            |i: usize| Vector3::from(to_inertial(cavity.attitude, Matrix3::identity().column(i).into()));
        let inertia = (0..3).map(|i| own[i] * axis(i) * axis(i).transpose()).sum();
        rigid.push((mass, cavity.center.into(), inertia));
    }
    let mass: f64 = rigid.iter().map(|(mass, ..)| mass).sum();
    let center = rigid.iter().map(|(mass, center, _)| *mass * center).sum::<Vector3<f64>>() / mass;
    let inertia: Matrix3<f64> = rigid
        .iter()
        .map(|(mass, place, inertia)| {
            let d = place - center;
            inertia + *mass * (d.norm_squared() * Matrix3::identity() - d * d.transpose())
        })
        .sum();
    let inertia = (0.5 * (inertia + inertia.transpose())).into();
    assembly.carrier = Some(parts::carrier(mass, center.into(), inertia));
    assembly
}

/// As friction grows, torque, angular momentum, energy and power approach those of the frozen body, as one over the friction.
#[test]
fn what_friction_holds_is_frozen() {
    let frozen = reduced(&frozen());
    let omega = [0.3, -0.2, 0.4];
    let K = frozen.angular_momentum(omega);
    let gap = |found: &[f64], expected: &[f64]| {
        let apart = found.iter().zip(expected).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        apart / expected.iter().map(|b| b * b).sum::<f64>().sqrt()
    };
    let gaps = [1e3, 1e4].map(|factor| {
        let mut assembly = everything();
        assembly.rotors.iter_mut().for_each(|rotor| rotor.friction *= factor);
        assembly.cavities.iter_mut().for_each(|cavity| cavity.viscosity *= factor);
        let body = reduced(&assembly);
        assert!(body.J.iter().zip(frozen.J).all(|(a, b)| (a - b).abs() < 1e-14 * frozen.J[0]));
        [
            gap(&body.torque(omega), &frozen.torque(omega)),
            gap(&body.angular_momentum(omega), &K),
            gap(&body.Omega.vector(K), &frozen.Omega.vector(K)),
            gap(&[body.energy(omega)], &[frozen.energy(omega)]),
            gap(&[body.dissipated_power(omega)], &[frozen.dissipated_power(omega)]),
        ]
    });
    println!("{gaps:?}");
    for (coarse, fine) in gaps[0].iter().zip(gaps[1]) {
        assert!(fine > 1e-9 && ((coarse / fine).log10() - 1.0).abs() < 0.01, "{gaps:?}");
    }
}
