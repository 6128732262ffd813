//! Modes of bodies under moments and on supports against closed forms: tops, pendulums, librations on an orbit. (M6)–(M8)

use nalgebra::{Complex, Matrix3, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use quasirigid::elements::{ApplicationPoint, Assembly, Carrier, Wheel, WheelSpeed};
use quasirigid::model::Support;
use quasirigid::model::force::{Axes, Force, ForceLaw, MagneticField, Orbit, Wave};
use quasirigid::modes::{SteadyError, SteadyModes, SteadyState, SteadyStateGuess};
use quasirigid_math::expression::Expression;

use super::forced::formula;
use crate::support::parts;
use crate::support::transform::rescaled;
use crate::support::{cases, rotation, sprung_body, units};

type V = Vector3<f64>;
type C = Complex<f64>;

/// A rigid body whose principal axes are rotated in its file's axes, with its centre away from the origin.
struct Rigid {
    mass: f64,
    moments: [f64; 3],
    /// Columns: principal axes in the axes of the file.
    axes: Matrix3<f64>,
    center: V,
}

impl Rigid {
    fn carrier(&self) -> Carrier {
        let J = self.axes * Matrix3::from_diagonal(&V::from(self.moments)) * self.axes.transpose();
        parts::carrier(self.mass, self.center.into(), (0.5 * (J + J.transpose())).into())
    }

    fn free(&self) -> Assembly {
        Assembly { carrier: Some(self.carrier()), ..Assembly::default() }
    }

    /// Body fixed at a distance below the centre of mass along the third principal axis.
    fn held(&self, below: f64) -> Assembly {
        let point = (self.center - below * self.axes.column(2)).into();
        Assembly { support: Support::FixedPoint { point }, ..self.free() }
    }
}

pub fn quaternion(R: &Matrix3<f64>) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*R));
    [q.w, q.i, q.j, q.k]
}

fn gravity(g: V) -> Force<ApplicationPoint> {
    Force { name: "weight".into(), law: ForceLaw::UniformGravity { acceleration: g.into() } }
}

fn found(assembly: &Assembly, near: SteadyStateGuess) -> Result<SteadyModes, SteadyError> {
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let state = SteadyState::near(&body, &forces, near)?;
    SteadyModes::about(&body, &forces, state)
}

fn near(omega: V, attitude: &Matrix3<f64>) -> SteadyStateGuess {
    SteadyStateGuess {
        omega: omega.into(),
        attitude: quaternion(attitude),
        place: [0.0; 3],
        velocity: [0.0; 3],
        asked: false,
    }
}

/// Eigenvalues with positive or no imaginary part, as found.
fn eigenvalues(modes: &SteadyModes) -> Vec<C> {
    modes.modes.iter().map(|mode| C::new(-mode.decay_rate, mode.frequency)).collect()
}

/// Largest distance between two lists as sets, relative to the largest of them.
fn apart(found: &[C], expected: &[C]) -> f64 {
    if found.len() != expected.len() {
        return f64::INFINITY;
    }
    let size = expected.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let from = |a: &[C], b: &[C]| {
        a.iter().map(|x| b.iter().map(|y| (x - y).norm()).fold(f64::INFINITY, f64::min)).fold(0.0, f64::max)
    };
    from(found, expected).max(from(expected, found)) / size
}

/// Roots of `a λ² + b λ + c = 0`.
fn roots(a: f64, b: f64, c: f64) -> [C; 2] {
    let root = C::from(b * b - 4.0 * a * c).sqrt();
    [(-b + root) / (2.0 * a), (-b - root) / (2.0 * a)]
}

/// Eigenvalues of `λ⁴ + bλ² + c` of which one of each pair counts.
fn quartic(a: f64, b: f64, c: f64) -> Vec<C> {
    roots(a, b, c).iter().flat_map(|square| [square.sqrt(), -square.sqrt()]).filter(upper).collect()
}

fn upper(lambda: &C) -> bool {
    lambda.im > -1e-12 * lambda.norm()
}

/// Rotated axes with the third along a direction.
fn frame(R: &Matrix3<f64>, tilt: f64) -> Matrix3<f64> {
    *Rotation3::from_axis_angle(&V::x_axis(), tilt).matrix() * R
}

proptest! {
    #![proptest_config(cases(48))]

    /// A symmetric top upright at the spin `Ω`: in axes that do not rotate with its own spin the axis obeys `A ẍ − iCΩ ẋ − m g l x = 0`; in
    /// the body everything rotates backwards at `Ω`. Critical: `C²Ω² = 4 A m g l`.
    #[test]
    fn a_sleeping_top_has_the_motions_of_its_closed_form(
        R in rotation(), S in rotation(), mass in 0.5..5.0f64, A in 0.5..2.0f64, share in 0.3..1.9f64,
        l in 0.1..1.0f64, spin in 0.1..3.0f64, side in any::<bool>(), tilt in -0.2..0.2f64, units in units()
    ) {
        let C3 = share * A;
        let body = Rigid { mass, moments: [A, A, C3], axes: R, center: V::new(0.4, -0.3, 0.8) };
        let (g, m) = (9.81, mass);
        let about = A + m * l * l;
        let critical = (4.0 * about * m * g * l).sqrt() / C3;
        let rate = if side { spin * critical } else { -spin * critical };
        let up = S.column(2).into_owned();
        let mut assembly = body.held(l);
        assembly.forces.push(gravity(-g * up));
        let axis = R.column(2).into_owned();
        // The third axis up, then leaned.
        let attitude = S * frame(&R.transpose(), tilt);
        let modes = found(&assembly, near(rate * axis, &attitude)).unwrap();
        let rate = rate * tilt.cos();
        prop_assert!((V::from(modes.state.omega) - rate * axis).norm() < 1e-9 * rate.abs(), "{:?}", modes.state);
        // In the axes at rest transverse motions e^{st}: A s² − iCΩ s − mgl = 0; in the body s − iΩ.
        let b = C3 * rate;
        let root = C::from(b * b - 4.0 * about * m * g * l).sqrt();
        let seen = [1.0, -1.0].map(|sign| C::i() * (b + sign * root) / (2.0 * about));
        let expected: Vec<C> = seen
            .iter()
            .map(|s| s - C::i() * rate)
            .map(|s| if s.im >= 0.0 { s } else { s.conj() })
            .collect();
        let gap = apart(&eigenvalues(&modes), &expected);
        prop_assert!(gap < 1e-9, "{gap:e} {:?} {expected:?}", eigenvalues(&modes));
        prop_assert_eq!(modes.stable(), spin * tilt.cos() > 1.0);
        prop_assert_eq!(modes.neutral, 0);
        // Units.
        let scaled = rescaled(&assembly, units);
        let mut scaled = Assembly { forces: vec![gravity(-g * up * units.factor([1, 0, -2]))], ..scaled };
        scaled.support = match assembly.support {
            Support::FixedPoint { point } => Support::FixedPoint { point: point.map(|x| x * units.length) },
            _ => unreachable!(),
        };
        let other = found(&scaled, near(rate / tilt.cos() * axis / units.time, &attitude)).unwrap();
        let back: Vec<C> = eigenvalues(&other).iter().map(|x| x * units.time).collect();
        let gap = apart(&back, &eigenvalues(&modes));
        prop_assert!(gap < 1e-9, "{gap:e} {back:?}");
    }

    /// A symmetric top with its own spin in a wheel, leaning and precessing at `Ω`: with `K₃` about its axis
    /// `AΩ² cos θ − K₃Ω + mgl = 0`, and it nods at `ν² = (K₃/A − 2Ω cos θ)² + Ω² sin² θ`.
    #[test]
    fn a_conical_top_nods_as_its_closed_form(
        R in rotation(), S in rotation(), mass in 0.5..5.0f64, A in 0.5..2.0f64, share in 0.3..1.9f64,
        l in 0.1..1.0f64, lean in 0.2..2.9f64, rate in -8.0..8.0f64, off in -0.05..0.05f64
    ) {
        prop_assume!(rate.abs() > 0.5);
        let body = Rigid { mass, moments: [A, A, share * A], axes: R, center: V::new(-0.4, 0.3, 0.8) };
        let about = A + mass * l * l;
        let pull = mass * 9.81 * l;
        let K3 = (about * rate * rate * lean.cos() + pull) / rate;
        let own = K3 - share * A * rate * lean.cos();
        let up = S.column(2).into_owned();
        let mut assembly = body.held(l);
        assembly.forces.push(gravity(-9.81 * up));
        let axis: [f64; 3] = R.column(2).into_owned().into();
        assembly.wheels.push(Wheel { name: "own spin".into(), axis, speed: WheelSpeed::Constant { angular_momentum: own } });
        let attitude = S * frame(&R.transpose(), lean + off);
        let omega = rate * (attitude.transpose() * up);
        let modes = found(&assembly, near(omega, &attitude)).unwrap();
        let leaning = (attitude_of(&modes) * V::from(axis)).dot(&up);
        prop_assert!((leaning - lean.cos()).abs() < 1e-9, "{leaning} {}", lean.cos());
        let nods = ((K3 / about - 2.0 * rate * lean.cos()).powi(2) + (rate * lean.sin()).powi(2)).sqrt();
        let gap = apart(&eigenvalues(&modes), &[C::new(0.0, nods)]);
        prop_assert!(gap < 1e-9, "{gap:e} {:?} {nods}", eigenvalues(&modes));
        prop_assert!(modes.stable());
        // Rotation about its own axis and the spin about it.
        prop_assert_eq!(modes.neutral, 2);
    }

    /// Hanging at rest: `ν² = mgl/I` about each horizontal axis. Upside down: the same rates, real. Weight or an accelerated support.
    #[test]
    fn a_pendulum_swings_as_its_closed_form(
        R in rotation(), S in rotation(), mass in 0.5..5.0f64, A in 0.5..1.0f64, B in 0.5..1.0f64, l in 0.1..1.0f64,
        tilt in -0.6..0.6f64, over in any::<bool>(), driven in any::<bool>()
    ) {
        let body = Rigid { mass, moments: [A, B, 0.7], axes: R, center: V::new(-0.4, 0.3, 0.8) };
        let up = S.column(2).into_owned();
        let assembly = body.held(l);
        let Support::FixedPoint { point } = assembly.support else { unreachable!() };
        let pull = if over { -9.81 } else { 9.81 };
        let assembly = if driven {
            let acceleration = (-pull * up).map(constant).into();
            let support = Support::Prescribed { point, acceleration, velocity: [0.0; 3], position: [0.0; 3] };
            Assembly { support, ..assembly }
        } else {
            Assembly { forces: vec![gravity(pull * up)], ..assembly }
        };
        let attitude = S * frame(&R.transpose(), tilt);
        let modes = found(&assembly, near(V::zeros(), &attitude)).unwrap();
        let squares = [A, B].map(|I| pull.abs() * mass * l / (I + mass * l * l));
        let expected: Vec<C> = squares
            .iter()
            .flat_map(|square| {
                let rate = square.sqrt();
                if over { vec![C::new(rate, 0.0), C::new(-rate, 0.0)] } else { vec![C::new(0.0, rate)] }
            })
            .collect();
        let gap = apart(&eigenvalues(&modes), &expected);
        prop_assert!(gap < 1e-12, "{gap:e} {:?} {expected:?}", eigenvalues(&modes));
        prop_assert!(modes.stable() != over && modes.neutral == 0 && modes.state.axis.is_none());
    }

    /// On a circular orbit: pitch `3(I₁ − I₃)/I₂ n²`, roll and yaw `s⁴ + (1 + 3k₁ + k₁k₃)n²s² + 4k₁k₃n⁴`, with the first axis ahead, the
    /// second across, the third outward. [DeBra and Delp 1961]
    #[test]
    fn a_satellite_librates_as_its_closed_form(
        R in rotation(), S in rotation(), raw in proptest::array::uniform3(0.3..1.0f64), period in 0.1..100.0f64,
        phase in 0.0..6.0f64, turn in proptest::array::uniform3(-0.08..0.08f64), units in units()
    ) {
        let [a, b, c] = raw;
        let moments = [b + c, c + a, a + b];
        let [I1, I2, I3] = moments;
        prop_assume!((I1 - I3).abs() > 0.05 && (I2 - I3).abs() > 0.05 && (I1 - I2).abs() > 0.05);
        let body = Rigid { mass: 3.0, moments, axes: R, center: V::new(5.0, 1.0, -2.0) };
        let n = 6.0 / period;
        let orbit = turned_orbit(&S, n, phase);
        let place = V::from(orbit.at(0.0).place).normalize();
        let ahead = V::from(orbit.at(0.0).velocity).normalize();
        let mut assembly = body.free();
        assembly.forces.push(Force { name: "Earth".into(), law: ForceLaw::CentralGravity { orbit: orbit.into() } });
        let axes = Matrix3::from_columns(&[ahead, place.cross(&ahead), place]);
        let attitude = axes * R.transpose() * Rotation3::new(V::from(turn)).matrix();
        let modes = found(&assembly, near(V::new(0.3, 0.1, 0.2) * n, &attitude)).unwrap();
        let [k1, k3] = [(I2 - I3) / I1, (I2 - I1) / I3];
        let square = 3.0 * (I1 - I3) / I2;
        let pitch = if square > 0.0 { vec![C::new(0.0, square.sqrt())] } else { [1.0, -1.0].map(|s| C::new(s * (-square).sqrt(), 0.0)).into() };
        let expected: Vec<C> = pitch
            .into_iter()
            .chain(quartic(1.0, 1.0 + 3.0 * k1 + k1 * k3, 4.0 * k1 * k3))
            .map(|s| s * n)
            .collect();
        let gap = apart(&eigenvalues(&modes), &expected);
        prop_assert!(gap < 1e-8, "{gap:e} {:?} {expected:?}", eigenvalues(&modes));
        let stable = expected.iter().all(|s| s.re < 1e-9 * n);
        prop_assert_eq!(modes.stable(), stable);
        if stable {
            let of = |name: &str| modes.modes.iter().filter(|mode| mode.name.starts_with(name)).count();
            prop_assert_eq!((of("pitch"), of("roll-yaw")), (1, 2));
        }
        // Units.
        let mut scaled = rescaled(&assembly, units);
        let orbit = Orbit {
            mu: orbit.mu * units.factor([3, 0, -2]),
            semi_major_axis: orbit.semi_major_axis * units.length,
            ..orbit
        };
        scaled.forces = vec![Force { name: "Earth".into(), law: ForceLaw::CentralGravity { orbit: orbit.into() } }];
        let other = found(&scaled, near(V::new(0.3, 0.1, 0.2) * n / units.time, &attitude)).unwrap();
        let back: Vec<C> = eigenvalues(&other).iter().map(|x| x * units.time).collect();
        let gap = apart(&back, &eigenvalues(&modes));
        prop_assert!(gap < 1e-8, "{gap:e} {back:?}");
    }

    /// A pivot moved round a circle: the body points outward, rotates with it, and swings: in the plane `I₃ν² = mlRΩ²`; across it with
    /// twist, `(I₁s² + (I₃−I₂)Ω²)(I₂s² + (I₃−I₁)Ω² + mlRΩ²) + (I₁+I₂−I₃)²Ω²s² = 0`.
    #[test]
    fn a_centrifuge_pendulum_swings_as_its_closed_form(
        R in rotation(), S in rotation(), mass in 0.5..5.0f64, A in 0.5..1.0f64, B in 0.5..1.0f64, l in 0.1..1.0f64,
        radius in 0.2..5.0f64, rate in 0.3..9.0f64, turn in proptest::array::uniform3(-0.05..0.05f64)
    ) {
        prop_assume!((A - B).abs() > 0.05);
        // The centre of mass lies ahead on the body's third axis: its moments about the pivot.
        let body = Rigid { mass, moments: [A, B, 0.7], axes: R, center: V::new(-0.4, 0.3, 0.8) };
        let assembly = body.held(l);
        let Support::FixedPoint { point } = assembly.support else { unreachable!() };
        let (out, ahead, normal) = (S.column(0).into_owned(), S.column(1).into_owned(), S.column(2).into_owned());
        let pull = radius * rate * rate;
        let component = |i: usize| formula_of_t(&format!("{:e}*cos({rate:e}*t) + {:e}*sin({rate:e}*t)", -pull * out[i], -pull * ahead[i]));
        let acceleration = [component(0), component(1), component(2)];
        let velocity = (radius * rate * ahead).into();
        let support = Support::Prescribed { point, acceleration, velocity, position: (radius * out).into() };
        let assembly = Assembly { support, ..assembly };
        let axes = Matrix3::from_columns(&[ahead, normal, out]);
        let attitude = axes * R.transpose() * Rotation3::new(V::from(turn)).matrix();
        let modes = found(&assembly, near(attitude.transpose() * normal * rate, &attitude)).unwrap();
        let (I1, I2, I3) = (0.7, A + mass * l * l, B + mass * l * l);
        let (w, held) = (rate * rate, mass * l * pull);
        let inertia = [I1 * I2, I1 * ((I3 - I1) * w + held) + I2 * (I3 - I2) * w + (I1 + I2 - I3).powi(2) * w];
        let expected: Vec<C> = quartic(inertia[0], inertia[1], (I3 - I2) * w * ((I3 - I1) * w + held))
            .into_iter()
            .chain([C::new(0.0, (held / I3).sqrt())])
            .collect();
        let gap = apart(&eigenvalues(&modes), &expected);
        prop_assert!(gap < 1e-9, "{gap:e} {:?} {expected:?}", eigenvalues(&modes));
    }

    /// A torque fixed in the body against a drag of its rotation: `ω = M/κ`, which falls back at `κ/C`, and
    /// `(As + κ)(Bs + κ) + (C−A)(C−B)Ω² = 0`.
    #[test]
    fn a_driven_spin_settles_as_its_closed_form(
        R in rotation(), S in rotation(), raw in proptest::array::uniform3(0.3..1.0f64), drag in 0.01..1.0f64, rate in 0.3..3.0f64
    ) {
        let [a, b, c] = raw;
        let [A, B, C3] = [b + c, c + a, a + b];
        let body = Rigid { mass: 2.0, moments: [A, B, C3], axes: R, center: V::new(5.0, 1.0, -2.0) };
        let axis = R.column(2).into_owned();
        let mut assembly = body.free();
        let law = ForceLaw::Torque { torque: (drag * rate * axis).into(), axes: Axes::Body, wave: Wave::default() };
        assembly.forces.push(Force { name: "motor".into(), law });
        assembly.forces.push(Force { name: "air".into(), law: ForceLaw::SpinDrag { coefficient: drag } });
        let start = axis * (0.9 * rate) + R.column(0) * (0.05 * rate);
        let modes = found(&assembly, near(start, &S)).unwrap();
        prop_assert!((V::from(modes.state.omega) - rate * axis).norm() < 1e-10 * rate, "{:?}", modes.state);
        let both = roots(A * B, drag * (A + B), drag * drag + (C3 - A) * (C3 - B) * rate * rate);
        let expected: Vec<C> = both.into_iter().filter(upper).chain([C::from(-drag / C3)]).collect();
        let gap = apart(&eigenvalues(&modes), &expected);
        prop_assert!(gap < 1e-9, "{gap:e} {:?} {expected:?}", eigenvalues(&modes));
        let lost: f64 = modes.modes.iter().map(|mode| mode.dissipation.iter().map(|(_, share)| share).sum::<f64>()).sum();
        prop_assert!((lost - modes.modes.len() as f64).abs() < 1e-9 && modes.modes[0].dissipation[0].0 == "drag \"air\"");
    }
}

/// A body of revolution that falls upright at the terminal speed of a drag above its centre of mass: down `m s + k`, and to each side
/// `(ms + k)(As² + kd²s + mgd) − k²d²s = 0`.
#[test]
fn a_body_under_a_parachute_swings_as_its_closed_form() {
    let R = *Rotation3::new(V::new(0.3, -0.2, 0.5)).matrix();
    let S = *Rotation3::new(V::new(-1.3, 0.4, 0.9)).matrix();
    let (m, A, k, d, g) = (2.0, 0.5, 3.0, 0.8, 9.81);
    let body = Rigid { mass: m, moments: [A, A, 0.3], axes: R, center: V::new(0.4, -0.3, 0.8) };
    let mut assembly = body.free();
    let place = (body.center + d * R.column(2)).into();
    let at = ApplicationPoint { on: quasirigid::elements::End::Carrier, at: Some(place) };
    let up = S.column(2).into_owned();
    assembly.forces =
        vec![gravity(-g * up), Force { name: "canopy".into(), law: ForceLaw::Drag { at, coefficient: k } }];
    let attitude = S * frame(&R.transpose(), 0.3);
    let modes = found(&assembly, near(V::zeros(), &attitude)).unwrap();
    let falling = attitude_of(&modes) * V::from(modes.state.velocity);
    assert!((falling + m * g / k * up).norm() < 1e-10, "{falling}");
    let cubic = |s: C| (s * m + k) * (s * s * A + s * (k * d * d) + m * g * d) - s * (k * d).powi(2);
    let size = m * A * 10f64.powi(3);
    let side: Vec<C> = eigenvalues(&modes).into_iter().filter(|s| cubic(*s).norm() < 1e-9 * size).collect();
    let down = eigenvalues(&modes).into_iter().filter(|s| (s + k / m).norm() < 1e-9).count();
    // A real root and a pair to each side, and down.
    assert_eq!((side.len(), down, modes.modes.len()), (4, 1, 5), "{:?}", eigenvalues(&modes));
    assert!(modes.stable());
}

/// With no more than drag of a place a free body comes to rest.
#[test]
fn drag_of_a_place_leaves_a_free_body_at_rest() {
    let R = *Rotation3::new(V::new(0.3, -0.2, 0.5)).matrix();
    let body = Rigid { mass: 2.0, moments: [0.5, 0.8, 1.0], axes: R, center: V::new(0.4, -0.3, 0.8) };
    let at = ApplicationPoint { on: quasirigid::elements::End::Carrier, at: Some([0.5, 0.1, -0.3]) };
    let mut assembly = body.free();
    assembly.forces = vec![
        Force { name: "canopy".into(), law: ForceLaw::Drag { at, coefficient: 0.3 } },
        Force { name: "air".into(), law: ForceLaw::SpinDrag { coefficient: 0.1 } },
    ];
    let modes = found(&assembly, near(V::new(0.1, 0.2, 1.0), &R)).unwrap();
    assert!(
        V::from(modes.state.omega).norm() < 1e-9 && modes.stable() && modes.modes.len() == 6,
        "{modes:?}"
    );
}

fn attitude_of(modes: &SteadyModes) -> Matrix3<f64> {
    let [w, i, j, k] = modes.state.attitude;
    *UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, i, j, k)).to_rotation_matrix().matrix()
}

fn formula_of_t(text: &str) -> Expression {
    Expression::parse(text, &["t"]).unwrap()
}

fn constant(value: f64) -> Expression {
    formula_of_t(&format!("{value:e}"))
}

/// A circular orbit of mean motion `n` whose plane is rotated.
pub fn turned_orbit(S: &Matrix3<f64>, n: f64, phase: f64) -> Orbit {
    let (P, Q, W) = (S.column(0), S.column(1), S.column(2));
    let semi_major_axis = 7.0e6;
    Orbit {
        mu: n * n * f64::powi(semi_major_axis, 3),
        semi_major_axis,
        eccentricity: 0.0,
        inclination: W[0].hypot(W[1]).atan2(W[2]),
        raan: W[0].atan2(-W[1]),
        argument_of_periapsis: P[2].atan2(Q[2]),
        mean_anomaly: phase,
        node_rate: 0.0,
        periapsis_rate: 0.0,
    }
}

/// Reason for which there is no steady state, of a fixed and of a free body with forces of these laws.
fn refused(law: &[ForceLaw<ApplicationPoint>], free: bool, omega: V) -> String {
    let R = *Rotation3::new(V::new(0.3, -0.2, 0.5)).matrix();
    let body = Rigid { mass: 2.0, moments: [0.5, 0.8, 1.0], axes: R, center: V::new(0.4, -0.3, 0.8) };
    let mut assembly = if free { body.free() } else { body.held(0.4) };
    let named = |(i, law): (usize, &ForceLaw<ApplicationPoint>)| Force {
        name: format!("force {i}"),
        law: law.clone(),
    };
    assembly.forces = law.iter().enumerate().map(named).collect();
    found(&assembly, near(omega, &Matrix3::identity())).unwrap_err().to_string()
}

/// `found/third/control/07`: a controller about a frame that turns at the rate `n`, of which a formula knows by the time alone. The frame
/// sets the rate of the state; pitch is `I₃ s² + d s + k`, roll and yaw are coupled by the rotation. A factor one, written with the time, changes nothing.
#[test]
fn formulas_of_the_time_that_turn_at_a_constant_rate_have_a_steady_state() {
    let (I, n, k, d) = (V::new(30.0, 36.0, 10.0), 1e-3, 4e-4, 0.02);
    let (c, s, one) = ("cos(0.0005*t)", "sin(0.0005*t)", "(cos(0.3*t)^2+sin(0.3*t)^2)");
    let w = format!("({c}*qw+{s}*qz)");
    let off = [format!("({c}*qx+{s}*qy)"), format!("({c}*qy-{s}*qx)"), format!("({c}*qz-{s}*qw)")];
    let rates = ["wx", "wy", "(wz-0.001)"];
    let torque = [0, 1, 2].map(|i| format!("-{one}*(2*{k}*{w}*{}+{d}*{})", off[i], rates[i]));
    let body = Rigid { mass: 2.0, moments: I.into(), axes: Matrix3::identity(), center: V::zeros() };
    let with = |torque: [&str; 3]| {
        let law = ForceLaw::TorqueExpression { torque: torque.map(formula), axes: Axes::Body };
        Assembly { forces: vec![Force { name: "PD".into(), law }], ..body.free() }
    };
    let close = near(V::new(0.0, 0.0, 0.9 * n), Rotation3::new(V::new(0.02, -0.03, 0.05)).matrix());
    let modes = found(&with(torque.each_ref().map(String::as_str)), close).unwrap();
    let omega = V::from(modes.state.omega);
    assert!((omega - V::new(0.0, 0.0, n)).norm() < 1e-9 * n, "{omega}");
    let (J, W) = (Matrix3::from_diagonal(&I), omega.cross_matrix());
    let characteristic = |lambda: C| {
        let complex = |M: Matrix3<f64>| M.map(C::from);
        let turned = complex(Matrix3::identity()) * lambda + complex(W);
        let moment =
            complex(J) * lambda + complex(W * J - (J * omega).cross_matrix() + d * Matrix3::identity());
        (moment * turned + complex(k * Matrix3::identity())).determinant()
    };
    assert_eq!(modes.modes.len(), 3, "three oscillating pairs");
    for mode in &modes.modes {
        let lambda = C::new(-mode.decay_rate, mode.frequency);
        let scale = characteristic(lambda + C::from(1e-2 * lambda.norm())).norm();
        assert!(characteristic(lambda).norm() < 1e-8 * scale, "{lambda}");
    }
    for refused in ["cos(0.1*t)*qx", "exp(-t)*qx", "qx+step(t-5)", "t*qx", "qx*cos(0.0005*t)"] {
        let told = found(&with([refused, "0", "-wz"]), close).unwrap_err().to_string();
        assert!(told.contains("the force \"PD\"") && told.contains("changes with time"), "{refused}: {told}");
    }
}

#[test]
fn what_has_no_steady_state_is_refused_in_words() {
    let carrier = ApplicationPoint { on: quasirigid::elements::End::Carrier, at: Some([0.5, 0.1, -0.3]) };
    let spin = V::new(0.1, 0.2, 1.0);
    let orbit = turned_orbit(&Matrix3::identity(), 0.1, 0.4);
    let weight = ForceLaw::UniformGravity { acceleration: [0.0, 0.0, -9.81] };
    let level = ForceLaw::UniformGravity { acceleration: [9.81, 0.0, 0.0] };
    let eccentric = ForceLaw::CentralGravity { orbit: Orbit { eccentricity: 0.01, ..orbit }.into() };
    let wave = Wave { frequency: 0.2, phase: 0.0 };
    let shaken = ForceLaw::Torque { torque: [0.1, 0.0, 0.0], axes: Axes::Body, wave };
    let driven = ForceLaw::Torque { torque: [0.0, 0.0, 0.1], axes: Axes::Inertial, wave: Wave::default() };
    let timed = ForceLaw::Expression { at: carrier, force: ["0", "0", "sin(t)"].map(formula) };
    let placed = ForceLaw::Expression { at: carrier, force: ["-x", "0", "0"].map(formula) };
    let field = ForceLaw::MagneticDipole {
        moment: [1.0, 0.0, 0.2],
        field: MagneticField::Dipole { strength: [1e20, 0.0, 3e20], rate: 0.0, orbit },
    };
    let told = [
        (refused(&[eccentric], true, spin), "\"force 0\" is eccentric (0.01)"),
        (refused(&[weight.clone(), shaken], false, spin), "the force \"force 1\" changes with time"),
        (refused(&[timed], false, spin), "the force \"force 0\" changes with time"),
        (refused(std::slice::from_ref(&placed), true, spin), "depends on where the free body is"),
        (refused(&[weight.clone(), placed], false, spin), "the force \"force 1\" changes with time"),
        (refused(&[weight.clone(), driven], false, spin), "N·m about the axis"),
        (
            refused(&[level, ForceLaw::CentralGravity { orbit: orbit.into() }], false, spin),
            "the acceleration of the support, changes with time",
        ),
        (refused(&[field], true, spin), "the force \"force 0\" changes with time"),
        (
            refused(
                &[
                    ForceLaw::CentralGravity { orbit: orbit.into() },
                    ForceLaw::CentralGravity { orbit: turned_orbit(&Matrix3::identity(), 0.2, 0.4).into() },
                ],
                true,
                spin,
            ),
            "turn differently",
        ),
    ];
    for (message, words) in told {
        assert!(message.contains(words), "{message}");
    }
    let spun_up = ForceLaw::Torque { torque: [0.0, 0.0, 0.1], axes: Axes::Body, wave: Wave::default() };
    assert!(refused(&[spun_up], true, spin).contains("spin it up or down"));
    let body = Rigid { mass: 2.0, moments: [0.5, 0.8, 1.0], axes: Matrix3::identity(), center: V::zeros() };
    let mut assembly = body.held(0.4);
    let Support::FixedPoint { point } = assembly.support else { unreachable!() };
    for acceleration in ["sin(t)", "t", "1 + 0.1*t^3", "0.3*cos(2*t) + 0.1*sin(t)"] {
        let acceleration = [formula_of_t(acceleration), formula_of_t("cos(2*t)"), formula_of_t("0")];
        assembly.support =
            Support::Prescribed { point, acceleration, velocity: [0.0; 3], position: [0.0; 3] };
        let message = found(&assembly, near(spin, &Matrix3::identity())).unwrap_err().to_string();
        assert!(message.contains("acceleration of the support changes"), "{message}");
    }
    let speed = WheelSpeed::Prescribed { inertia: 0.1, speed: formula_of_t("10*t") };
    let mut assembly = Assembly { forces: vec![gravity(V::z())], ..body.held(0.4) };
    assembly.wheels.push(Wheel { name: "wheel".into(), axis: [0.0, 0.0, 1.0], speed });
    let message = found(&assembly, near(spin, &Matrix3::identity())).unwrap_err().to_string();
    assert!(message.contains("wheel changes its speed"), "{message}");
}

/// Support at a radius (m) from a centre about which it is driven round at a rate (rad/s), in the plane across `z` from the `x` axis on.
fn driven_round(point: [f64; 3], radius: f64, rate: f64) -> Support {
    let pull = radius * rate * rate;
    let component = |wave: &str| formula_of_t(&format!("{:e}*{wave}({rate:e}*t)", -pull));
    let acceleration = [component("cos"), component("sin"), constant(0.0)];
    Support::Prescribed {
        point,
        acceleration,
        velocity: [0.0, radius * rate, 0.0],
        position: [radius, 0.0, 0.0],
    }
}

/// A body driven round by its pivot, with air drag `k` at the centre of mass `l` from the pivot: it lags by the angle `α` of
/// `mΩR sin α = k (R cos α + l)`, and is steady, because the air meets it alike all the way round.
#[test]
fn a_centrifuge_in_air_lags_as_its_closed_form() {
    let R = *Rotation3::new(V::new(0.3, -0.2, 0.5)).matrix();
    let (m, l, k, radius, rate) = (2.0, 0.4, 0.7, 1.5, 3.0);
    let body = Rigid { mass: m, moments: [0.5, 0.8, 0.7], axes: R, center: V::new(0.4, -0.3, 0.8) };
    let mut assembly = body.held(l);
    let Support::FixedPoint { point } = assembly.support else { unreachable!() };
    assembly.support = driven_round(point, radius, rate);
    let at = ApplicationPoint { on: quasirigid::elements::End::Carrier, at: Some(body.center.into()) };
    assembly.forces.push(Force { name: "air".into(), law: ForceLaw::Drag { at, coefficient: k } });
    // The third axis outwards, the second up.
    let axes = Matrix3::from_columns(&[V::y(), V::z(), V::x()]);
    let attitude = axes * R.transpose();
    let omega = attitude.transpose() * V::z() * rate;
    let driven = SteadyStateGuess {
        place: [radius, 0.0, 0.0],
        velocity: [0.0, radius * rate, 0.0],
        ..near(omega, &attitude)
    };
    let modes = found(&assembly, driven).unwrap();
    let lag = (k * l / (m * rate * radius).hypot(k * radius)).asin() + k.atan2(m * rate);
    let out = attitude_of(&modes) * R.column(2);
    assert!((out - V::new(lag.cos(), -lag.sin(), 0.0)).norm() < 1e-9, "{out} {lag}");
    assert!(modes.stable(), "{modes:?}");
}

/// A mass on the axis of a spin, whose velocity along the axis a drag resists that changes as the body turns: nothing pulls at the steady
/// state, but small motions of that one coordinate are damped by a coefficient that is not constant.
#[test]
fn a_damping_that_changes_with_time_is_refused() {
    let told = |law: &str| {
        let mass = parts::sprung(1.0, [0.0, 0.0, 0.6], [90.0; 3], [1.0; 3]);
        let mut assembly = sprung_body(Carrier::principal(40.0, [9.0, 13.0, 16.0]), &[mass]);
        assembly.support = Support::FixedPoint { point: [0.0; 3] };
        let at = ApplicationPoint { on: quasirigid::elements::End::Point(0), at: None };
        let force = ["0", "0", law].map(formula);
        assembly.forces.push(Force { name: "air".into(), law: ForceLaw::Expression { at, force } });
        found(&assembly, near(1.5 * V::z(), &Matrix3::identity()))
    };
    assert!(told("-vz").unwrap().stable());
    let message = told("-(1 + 0.5*qz)*vz").unwrap_err().to_string();
    assert!(message.contains("the force \"air\" changes with time"), "{message}");
}
