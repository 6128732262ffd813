//! Rates of small wobbles of random bodies that count as valid: springs, hinges, rotors and liquids; those of the modes of the full
//! system, of the right sign. `PROPTEST_CASES` widens the search. (P5), (V12)

use quasirigid::dynamics::{Forced, Options, Sample, Start, propagate, propagate_full, steady_spin_near};
use quasirigid::elements::{
    Assembly, Cavity, CavityShape, HingeCoefficient, Hinged, Regime, Rotor, RotorKind,
};
use quasirigid::model::{FlexibleBody, Principal, ReducedBody, Rheology};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid::reduction::{Validity, Verdict, reduce};
use quasirigid::verification::wobble_difference;
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use crate::support::parts;
use crate::support::transform::rotated;
use crate::support::{Sprung, sprung_body};

/// Bodies that count as valid.
const BODIES: usize = 60;
/// Bodies of those whose loss of energy is compared with the full system.
const RUN: usize = 12;
/// Share of the eigenvalue below which a rate is none.
const NONE: f64 = 1e-13;

/// Generator of `splitmix64`.
struct Random(u64);

impl Random {
    /// Uniform between two numbers.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// A power of ten with a uniform exponent.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.between(low, high))
    }

    fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [0, 1, 2].map(|_| self.between(-size, size))
    }

    fn direction(&mut self) -> [f64; 3] {
        loop {
            let vector = self.vector(1.0);
            if (0.1..1.0).contains(&norm(vector)) {
                return scale(norm(vector).recip(), vector);
            }
        }
    }
}

/// A body of any size, mass and shape, off its axes, with the angular velocity at which it is judged.
fn drawn(random: &mut Random) -> (Assembly, [f64; 3]) {
    let (M, L, spin) = (random.decades(-1.0, 3.0), random.decades(-1.0, 1.0), random.decades(-2.0, 2.0));
    let mut second = [0, 1, 2].map(|_| random.between(0.05, 1.0));
    if random.chance(0.2) {
        second[1] = second[0] * (1.0 + random.decades(-3.0, -1.0));
    }
    let [a, b, c] = second.map(|share| 0.3 * share * M * L * L);
    let inertia = parts::diag([b + c, c + a, a + b]);
    let carrier = parts::carrier(M, random.vector(0.2 * L), inertia);
    let masses: Vec<Sprung> = (0..usize::from(random.chance(0.8)) + usize::from(random.chance(0.4)))
        .map(|_| {
            let (mass, frequency) = (M * random.decades(-3.0, -0.7), spin * random.decades(0.8, 2.2));
            let stiffness = mass * frequency * frequency * random.between(0.5, 2.0);
            let damping = 2.0 * random.decades(-3.0, 0.0) * mass * frequency;
            parts::sprung(mass, random.vector(L), [stiffness; 3], [damping; 3])
        })
        .collect();
    let mut assembly = sprung_body(carrier, &masses);
    if masses.is_empty() || random.chance(0.4) {
        assembly.hinged.push(boom(random, M, L, spin));
    }
    if random.chance(0.3) {
        let inertia = M * L * L * random.decades(-4.0, -1.5);
        let friction = inertia * spin * random.decades(0.8, 3.0);
        let kind = RotorKind::Flywheel { axis: random.direction() };
        assembly.rotors.push(Rotor { name: "flywheel".into(), kind, inertia, friction, speed: None });
    }
    if random.chance(0.3) {
        assembly.cavities.push(tank(random, M, L, spin));
    }
    let turn = nalgebra::Rotation3::new(nalgebra::Vector3::from(random.vector(3.0)));
    (rotated(&assembly, turn.matrix()), scale(spin, random.direction()))
}

fn boom(random: &mut Random, M: f64, L: f64, spin: f64) -> Hinged {
    let (mass, hinge, along) = (M * random.decades(-3.0, -1.0), random.vector(0.5 * L), random.direction());
    let length = L * random.between(0.3, 2.0);
    let first = cross(along, random.direction());
    let second = cross(along, first);
    let axes = if random.chance(0.5) { vec![first] } else { vec![first, second] };
    let slim = mass * length * length / 12.0;
    let inertia = std::array::from_fn(|i| {
        std::array::from_fn(|j| slim * (f64::from(u8::from(i == j)) * 1.01 - along[i] * along[j]))
    });
    let frequency = spin * random.decades(0.8, 2.2);
    let stiffness = 4.0 * slim * frequency * frequency;
    let damping = 2.0 * random.decades(-3.0, 0.0) * stiffness / frequency;
    Hinged {
        name: "boom".into(),
        mass,
        center_of_mass: add(hinge, scale(0.5 * length, along)),
        inertia,
        hinge,
        stiffness: HingeCoefficient::PerAxis(vec![stiffness; axes.len()]),
        damping: HingeCoefficient::PerAxis(vec![damping; axes.len()]),
        axes,
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    }
}

fn tank(random: &mut Random, M: f64, L: f64, spin: f64) -> Cavity {
    let radius = L * random.between(0.1, 0.4);
    let density = M * random.decades(-2.0, -0.3) / (4.0 * radius.powi(3));
    Cavity {
        name: "tank".into(),
        shape: CavityShape::Ellipsoid { semi_axes: [radius; 3] },
        center: random.vector(0.4 * L),
        attitude: ALIGNED,
        density,
        viscosity: density * radius * radius * spin * random.decades(-0.5, 1.5),
        resolution: 4,
        regime: Regime::default(),
        modes: 0,
    }
}

/// Largest relative difference of the rates about the three axes from those of the modes there, and whether a sign is wrong.
fn rates(reduced: &ReducedBody, about_axes: &[Option<SpinModes>; 3]) -> Option<(f64, bool)> {
    let determined = Principal::compute(reduced.J).determined();
    let (mut worst, mut wrong) = (0.0_f64, false);
    for (axis, modes) in about_axes.iter().enumerate().filter(|(axis, _)| determined[*axis]) {
        let modes = modes.as_ref()?;
        let found = steady_spin_near(reduced, modes.equilibrium.angular_momentum)?;
        let exact = if axis == 1 {
            let fastest = modes.modes.iter().map(|mode| mode.of_motion[0]).fold(f64::INFINITY, f64::min);
            [fastest, 0.0]
        } else {
            modes.nutation()?.of_motion
        };
        if exact[0].abs() > NONE * exact[0].hypot(exact[1]) {
            worst = worst.max((found.growth + exact[0]).abs() / exact[0].abs());
            wrong |= found.growth * exact[0] > 0.0;
        }
    }
    Some((worst, wrong))
}

/// Energy lost by both systems in fifty radians from the slow manifold, and its share in the energy.
fn lost(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> ([f64; 2], f64) {
    let options = Options { tolerance: 1e-11, ..Options::default() };
    let times = [50.0 / norm(omega)];
    let (mut own, mut full): (Vec<Sample>, Vec<Sample>) = (Vec::new(), Vec::new());
    propagate(reduced, Start::new(omega, ALIGNED), &times, &options, &mut own).unwrap();
    let settled = Start::new(omega, ALIGNED).settled(Forced::not(body), 5).unwrap();
    propagate_full(Forced::not(body), &settled, &times, &options, &mut full).unwrap();
    ([own[0].dissipated, full[0].dissipated], full[0].dissipated / full[0].energy)
}

/// Before the comparison with the modes counts, and after.
#[test]
fn bodies_that_count_as_valid_have_the_rates_of_the_modes() {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|count| count.parse().ok());
    let bodies = asked.unwrap_or(BODIES);
    let mut random = Random(4021);
    let (mut drawn_bodies, mut valid, mut compared) = (0, 0, 0);
    let (mut before, mut worst, mut run) = (0, 0.0_f64, 0);
    while valid < bodies {
        drawn_bodies += 1;
        assert!(drawn_bodies < 20 * bodies, "{valid} valid bodies of {drawn_bodies}");
        let (assembly, omega) = drawn(&mut random);
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, 3).unwrap();
        let validity = Validity::assess_reduced(&body, &reduced, omega).unwrap();
        if [validity.verdict(), validity.dissipation()] != [Verdict::Holds; 2] {
            continue;
        }
        let G = norm(reduced.angular_momentum(omega));
        let about_axes = RelativeEquilibrium::all(&body, SpinMagnitude::AngularMomentum(G))
            .map(|equilibrium| SpinModes::about(&body, equilibrium.ok()?).ok());
        let Some((gap, wrong)) = rates(&reduced, &about_axes) else { continue };
        before += usize::from(gap > 0.1);
        let extremes = [0, 2].map(|axis| wobble_difference(&reduced, about_axes[axis].as_ref()?));
        if extremes.iter().flatten().any(|difference| *difference >= 0.1) {
            continue;
        }
        valid += 1;
        worst = worst.max(gap);
        assert!(!wrong && gap < 0.1, "body {drawn_bodies}: {gap} {wrong} {assembly:?} {omega:?}");
        if run < RUN && dot(omega, omega) > 0.0 {
            run += 1;
            let ([own, full], share) = lost(&body, &reduced, omega);
            if share > 1e-9 {
                compared += 1;
                assert!((own / full - 1.0).abs() < 0.1, "body {drawn_bodies}: {own:e} {full:e} {assembly:?}");
            }
        }
    }
    println!(
        "{drawn_bodies} drawn, {before} off by 10 % before the comparison counts, worst {worst} after, {compared} runs"
    );
    assert!(compared > RUN / 2);
}
