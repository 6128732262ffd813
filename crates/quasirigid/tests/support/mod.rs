//! Random bodies.
//!
//! In base units a body has a size of about one metre, a mass of a few kilograms and vibrations of 8 to 60 rad/s with
//! damping ratios from 0.1 to 1, so that damping and stiffness both appear in every degree. [`bodies`] then changes the
//! units, because no law depends on them.

pub mod linearised;
pub mod matrices;
pub mod parts;
pub mod rotors;
pub mod transform;

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use proptest::array::{uniform3, uniform4};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use quasirigid::elements::{
    Assembly, Carrier, Coefficient, End, HingeCoefficient, Hinged, Point, PointMotion, SpringLaw,
};
use quasirigid::model::{Rheology, Support};

use transform::{Units, rescaled, times};

/// A mass that is free to move (kg, m), on a spring to the carrier: stiffness (N/m) and damping (N·s/m) along the axes.
pub struct Sprung {
    pub mass: f64,
    pub position: [f64; 3],
    pub stiffness: [f64; 3],
    pub damping: [f64; 3],
}

/// Free body of a carrier and sprung masses, named by their numbers.
pub fn sprung_body(carrier: Carrier, masses: &[Sprung]) -> Assembly {
    let point = |(number, sprung): (usize, &Sprung)| Point {
        name: number.to_string(),
        mass: sprung.mass,
        position: sprung.position,
        motion: PointMotion::Free,
    };
    let spring = |(number, sprung): (usize, &Sprung)| {
        parts::spring(End::Point(number), End::Carrier, parts::diagonal(sprung.stiffness, sprung.damping))
    };
    Assembly {
        carrier: Some(carrier),
        points: masses.iter().enumerate().map(point).collect(),
        springs: masses.iter().enumerate().map(spring).collect(),
        ..Assembly::default()
    }
}

/// A point mass: mass (kg) and position (m).
pub type Mass = (f64, Vector3<f64>);

/// A body with the point masses its rigid pieces are made of.
#[derive(Clone, Debug)]
pub struct Massive {
    pub assembly: Assembly,
    pub carrier: Vec<Mass>,
    pub appendages: Vec<Vec<Mass>>,
}

/// Number of bodies on which a law is tried; the same ones in every run unless the environment says otherwise.
pub fn cases(count: u32) -> ProptestConfig {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    ProptestConfig {
        cases: number("PROPTEST_CASES").map_or(count, |cases| cases as u32),
        rng_seed: RngSeed::Fixed(number("PROPTEST_RNG_SEED").unwrap_or(1978)),
        // The failing body is printed in full and becomes a test of its own.
        failure_persistence: None,
        // Shrinking leads to bodies without inertia, where everything fails: it is off unless asked for.
        max_shrink_iters: number("PROPTEST_MAX_SHRINK_ITERS").unwrap_or(0) as u32,
        ..ProptestConfig::default()
    }
}

/// A body of every kind, in units of its own.
pub fn bodies() -> impl Strategy<Value = Assembly> {
    (assemblies(), units()).prop_map(|(assembly, units)| rescaled(&assembly, units))
}

/// A body of every kind in base units.
pub fn assemblies() -> impl Strategy<Value = Assembly> {
    massive().prop_map(|massive| massive.assembly)
}

/// Units of length, mass and time between 1e-9 and 1e9, not powers of ten.
pub fn units() -> impl Strategy<Value = Units> {
    uniform3(-9.0..9.0).prop_map(|[l, m, t]: [f64; 3]| Units {
        length: 10f64.powf(l),
        mass: 10f64.powf(m),
        time: 10f64.powf(t),
    })
}

/// A rotation of any angle.
pub fn rotation() -> impl Strategy<Value = Matrix3<f64>> {
    uniform4(-1.0..1.0)
        .prop_filter("a quaternion", |q: &[f64; 4]| q.iter().map(|x| x * x).sum::<f64>() > 0.01)
        .prop_map(|[w, i, j, k]| {
            let q = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, i, j, k));
            *q.to_rotation_matrix().matrix()
        })
}

/// A vector in the cube of side two.
pub fn vector() -> impl Strategy<Value = [f64; 3]> {
    uniform3(-1.0..1.0)
}

/// A vector that is not short.
pub fn direction() -> impl Strategy<Value = [f64; 3]> {
    vector().prop_filter("a direction", |v| Vector3::from(*v).norm() > 0.3)
}

/// Bodies with their point masses, in base units.
pub fn massive() -> impl Strategy<Value = Massive> {
    let support = (any::<bool>(), vector());
    (cloud(0.3, 1.0), vec(sprung_point(), 1..4), vec(extra_spring(), 0..3), vec(hinged(), 0..3), support)
        .prop_map(|(carrier, sprung, extra, hinged, support)| join(carrier, sprung, &extra, hinged, support))
}

/// Bodies whose coordinates all move on straight lines, in base units.
pub fn massive_points() -> impl Strategy<Value = Massive> {
    (cloud(0.3, 1.0), vec(sprung_point(), 1..4), vec(extra_spring(), 0..3))
        .prop_map(|(carrier, sprung, extra)| join(carrier, sprung, &extra, Vec::new(), (true, [0.0; 3])))
}

/// Mass, centre of mass and inertia tensor about it, by definition.
pub fn moments(masses: &[Mass]) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let mass: f64 = masses.iter().map(|(m, _)| m).sum();
    let center = masses.iter().map(|(m, r)| *m * r).sum::<Vector3<f64>>() / mass;
    (mass, center, inertia(masses, center))
}

/// `Σ m (|r|² 1 − r rᵀ)` about a point. (I1)
pub fn inertia(masses: &[Mass], about: Vector3<f64>) -> Matrix3<f64> {
    let one = |(m, r): &Mass| {
        let d = r - about;
        *m * (d.norm_squared() * Matrix3::identity() - d * d.transpose())
    };
    masses.iter().map(one).sum()
}

fn join(
    carrier: Vec<Mass>,
    sprung: Vec<(Point, SpringLaw)>,
    extra: &[(usize, usize, SpringLaw, [f64; 3])],
    hinged: Vec<(Hinged, Vec<Mass>)>,
    (free, fixed): (bool, [f64; 3]),
) -> Massive {
    let (mass, center, inertia) = moments(&carrier);
    let count = sprung.len();
    let to_carrier =
        sprung.iter().enumerate().map(|(i, (_, law))| parts::spring(End::Point(i), End::Carrier, *law));
    let between = extra.iter().map(|(i, j, law, place)| {
        let (i, j) = (i % count, j % (count + 1));
        let to = if j == count || j == i { End::Carrier } else { End::Point(j) };
        let law = match *law {
            SpringLaw::Axial { stiffness, damping, .. } => {
                parts::axial(stiffness, damping, (to == End::Carrier).then_some(place.map(|x| 2.0 * x)))
            }
            spatial @ SpringLaw::Spatial { .. } => spatial,
        };
        parts::spring(End::Point(i), to, law)
    });
    let springs = to_carrier.chain(between).collect();
    let named = |(i, (mut point, _)): (usize, (Point, SpringLaw))| {
        point.name = format!("point {i}");
        point
    };
    let points = sprung.into_iter().enumerate().map(named).collect();
    let (mut hinges, appendages): (Vec<Hinged>, Vec<Vec<Mass>>) = hinged.into_iter().unzip();
    for (i, hinge) in hinges.iter_mut().enumerate() {
        hinge.name = format!("hinge {i}");
    }
    let carrier_piece = parts::carrier(mass, center.into(), inertia.into());
    let support = if free { Support::Free } else { Support::FixedPoint { point: fixed } };
    Massive {
        assembly: Assembly {
            carrier: Some(carrier_piece),
            points,
            springs,
            hinged: hinges,
            support,
            ..Assembly::default()
        },
        carrier,
        appendages,
    }
}

fn cloud(mass: f64, size: f64) -> impl Strategy<Value = Vec<Mass>> {
    vec((0.2..1.0, vector()), 5..8).prop_map(move |masses| {
        masses.into_iter().map(|(m, r)| (mass * m, size * Vector3::from(r))).collect()
    })
}

/// A point on a spring of every kind to the carrier.
fn sprung_point() -> impl Strategy<Value = (Point, SpringLaw)> {
    (0.05..0.5, vector(), motion(), coefficient(), coefficient(), 8.0..30.0, 0.1..0.5).prop_map(
        |(mass, position, motion, stiffness, damping, frequency, ratio)| {
            let stiffness = times(stiffness, mass * frequency * frequency);
            let damping = times(damping, 2.0 * ratio * mass * frequency);
            (Point { name: String::new(), mass, position, motion }, SpringLaw::Spatial { stiffness, damping })
        },
    )
}

fn motion() -> impl Strategy<Value = PointMotion> {
    (0..3, direction()).prop_map(|(kind, direction)| match kind {
        0 => PointMotion::Free,
        1 => PointMotion::Line(direction),
        _ => PointMotion::Plane(direction),
    })
}

fn extra_spring() -> impl Strategy<Value = (usize, usize, SpringLaw, [f64; 3])> {
    (0..9usize, 0..9usize, any::<bool>(), coefficient(), coefficient(), 20.0..60.0, direction()).prop_map(
        |(i, j, axial, stiffness, damping, strength, place)| {
            let law = if axial {
                parts::axial(strength, 0.03 * strength, None)
            } else {
                SpringLaw::Spatial {
                    stiffness: times(stiffness, strength),
                    damping: times(damping, 0.03 * strength),
                }
            };
            (i, j, law, place)
        },
    )
}

/// An isotropic, diagonal or full coefficient with eigenvalues from 0.5 to 2.
fn coefficient() -> impl Strategy<Value = Coefficient> {
    (0..3, uniform3(0.5..2.0), rotation()).prop_map(|(kind, values, R)| match kind {
        0 => Coefficient::Isotropic(values[0]),
        1 => Coefficient::Diagonal(values),
        _ => {
            let turned = R * Matrix3::from_diagonal(&Vector3::from(values)) * R.transpose();
            Coefficient::Full((0.5 * (turned + turned.transpose())).into())
        }
    })
}

/// An appendage of point masses on one to three skew axes.
fn hinged() -> impl Strategy<Value = (Hinged, Vec<Mass>)> {
    let axes = (1..4usize, uniform3(-0.5..0.5_f64), rotation(), uniform3(0.3..3.0_f64));
    let laws = (8.0..30.0, 0.1..0.5, hinge_form(), hinge_form());
    (cloud(0.05, 0.5), vector(), direction(), axes, laws).prop_map(
        |(cloud, hinge, offset, (count, skew, R, lengths), (frequency, ratio, stiffness, damping))| {
            let base = Vector3::from(hinge);
            let masses: Vec<Mass> =
                cloud.iter().map(|(m, r)| (*m, base + 0.6 * Vector3::from(offset) + r)).collect();
            let (mass, center, inertia) = moments(&masses);
            let about: f64 = masses.iter().map(|(m, r)| m * (r - base).norm_squared()).sum();
            let skewed: [Vector3<f64>; 3] =
                [[1.0, 0.0, 0.0], [skew[0], 1.0, 0.0], [skew[1], skew[2], 1.0]].map(Vector3::from);
            let axis = |i: usize| -> [f64; 3] { (lengths[i] * (R * skewed[i])).into() };
            let hinge = Hinged {
                name: String::new(),
                mass,
                center_of_mass: center.into(),
                inertia: inertia.into(),
                hinge,
                axes: (0..count).map(axis).collect(),
                stiffness: hinge_matrix(stiffness, count, about * frequency * frequency),
                damping: hinge_matrix(damping, count, 2.0 * ratio * about * frequency),
                rheology: Rheology::Elastic,
                places: Vec::new(),
                angle: None,
            };
            (hinge, masses)
        },
    )
}

type HingeForm = (bool, [f64; 3], [f64; 3]);

fn hinge_form() -> impl Strategy<Value = HingeForm> {
    (any::<bool>(), uniform3(0.5..2.0), uniform3(-0.3..0.3))
}

fn hinge_matrix((full, values, mixed): HingeForm, count: usize, scale: f64) -> HingeCoefficient {
    if !full {
        return HingeCoefficient::PerAxis(values[..count].iter().map(|value| scale * value).collect());
    }
    let entry = |i: usize, j: usize| {
        let share = if i == j { 1.0 } else { mixed[i + j - 1] };
        scale * share * (values[i] * values[j]).sqrt()
    };
    HingeCoefficient::Full((0..count).map(|i| (0..count).map(|j| entry(i, j)).collect()).collect())
}
