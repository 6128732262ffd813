//! Bodies of points and springs alone, as those of N-body simulations `[@quillen2019]`: a random network that floats.

use nalgebra::{DMatrix, Matrix3, Matrix6, MatrixXx6, Rotation3, Vector3, Vector6};
use quasirigid::elements::{Assembly, End, Point, PointMotion, Spring};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::reduction::reduce;

use super::common::{Numbers, compliance, error, loads, turned_axes};
use crate::support::parts;

const SEMI_AXES: [f64; 3] = [1300.0, 1050.0, 800.0];
const CENTER: [f64; 3] = [4100.0, -900.0, 2300.0];
/// Least distance of two points, and the longest spring (m).
const APART: f64 = 380.0;
const REACH: f64 = 2.3 * APART;
const MASS: f64 = 7.2e11;
const STIFFNESS: f64 = 3.1e5;
/// Kelvin–Voigt time of a spring (s).
const TIME: f64 = 40.0;
const OMEGA: [f64; 3] = [1.1e-4, -0.7e-4, 0.9e-4];

/// Points in an ellipsoid with rotated axes, no two of them close.
fn points() -> Vec<Vector3<f64>> {
    let mut numbers = Numbers(1901);
    let mut kept: Vec<Vector3<f64>> = Vec::new();
    for _ in 0..20_000 {
        let x = Vector3::from_fn(|_, _| numbers.next());
        let place = turned_axes() * x.component_mul(&Vector3::from(SEMI_AXES)) + Vector3::from(CENTER);
        if x.norm() <= 1.0 && kept.iter().all(|other| (place - other).norm() > APART) {
            kept.push(place);
        }
    }
    kept
}

/// Masses of the points: all equal, as in the simulations, or all different.
fn masses(count: usize, alike: bool) -> Vec<f64> {
    let mut numbers = Numbers(1839);
    (0..count).map(|_| if alike { MASS } else { MASS * (1.0 + 0.6 * numbers.next()) }).collect()
}

fn pairs(points: &[Vector3<f64>]) -> Vec<(usize, usize)> {
    let all = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    all.filter(|(i, j)| (points[*i] - points[*j]).norm() < REACH).collect()
}

fn network(masses: &[f64], damping: f64, rheology: &Rheology) -> FlexibleBody {
    let places = points();
    let point = |(i, place): (usize, &Vector3<f64>)| Point {
        name: format!("{i}"),
        mass: masses[i],
        position: (*place).into(),
        motion: PointMotion::Free,
    };
    let spring = |(i, j): (usize, usize)| Spring {
        name: String::new(),
        from: End::Point(i),
        to: End::Point(j),
        law: parts::axial(STIFFNESS, damping, None),
        rheology: rheology.clone(),
    };
    let springs = pairs(&places).into_iter().map(spring).collect();
    Assembly { points: places.iter().enumerate().map(point).collect(), springs, ..Assembly::default() }
        .body()
        .unwrap()
}

/// Places from the centre of mass, and the inertia about it.
fn moments(masses: &[f64]) -> (Vec<Vector3<f64>>, Matrix3<f64>) {
    let places = points();
    let first: Vector3<f64> = places.iter().zip(masses).map(|(place, mass)| *mass * place).sum();
    let center = first / masses.iter().sum::<f64>();
    let arms: Vec<Vector3<f64>> = places.iter().map(|place| place - center).collect();
    let part = |(s, mass): (&Vector3<f64>, &f64)| {
        *mass * (s.norm_squared() * Matrix3::identity() - s * s.transpose())
    };
    let inertia = arms.iter().zip(masses).map(part).sum();
    (arms, inertia)
}

/// Compliance by another method: every coordinate of every point, loads less the inertia that they cause, and the pseudo-inverse of the
/// stiffness.
fn exact_compliance(masses: &[f64]) -> Matrix6<f64> {
    let (arms, _) = moments(masses);
    let size = 3 * arms.len();
    let mut stiffness = DMatrix::zeros(size, size);
    for (i, j) in pairs(&arms) {
        let n = (arms[i] - arms[j]).normalize();
        let k = STIFFNESS * n * n.transpose();
        for (a, b, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
            let mut block = stiffness.fixed_view_mut::<3, 3>(3 * a, 3 * b);
            block += sign * k;
        }
    }
    let slope = |dof: usize| {
        let (s, e) = (arms[dof / 3], Vector3::ith(dof % 3, 1.0));
        masses[dof / 3] * (2.0 * s.dot(&e) * Matrix3::identity() - s * e.transpose() - e * s.transpose())
    };
    let J1: Vec<Matrix3<f64>> = (0..size).map(slope).collect();
    let rigid = MatrixXx6::from_fn(size, |dof, motion| {
        let e = Vector3::ith(motion % 3, 1.0);
        if motion < 3 { e[dof % 3] } else { e.cross(&arms[dof / 3])[dof % 3] }
    });
    let inertia = MatrixXx6::from_fn(size, |dof, motion| masses[dof / 3] * rigid[(dof, motion)]);
    let loads = loads(&J1, Rotation3::identity());
    let balanced = &loads - &inertia * rigid.tr_mul(&inertia).try_inverse().unwrap() * rigid.tr_mul(&loads);
    let eigen = stiffness.symmetric_eigen();
    let largest = eigen.eigenvalues.amax();
    let soft = eigen.eigenvalues.iter().filter(|value| **value < 1e-9 * largest).count();
    assert_eq!(soft, 6, "the network holds its shape");
    let shares = eigen.eigenvectors.tr_mul(&balanced);
    let mut sum = Matrix6::zeros();
    for (value, row) in
        eigen.eigenvalues.iter().zip(shares.row_iter()).filter(|(value, _)| **value > 1e-9 * largest)
    {
        let row = row.transpose();
        sum += row * row.transpose() / *value;
    }
    sum
}

#[test]
fn a_network_has_the_compliance_of_its_pseudo_inverse() {
    for alike in [true, false] {
        let masses = masses(points().len(), alike);
        let body = network(&masses, 0.0, &Rheology::Elastic);
        let (_, inertia) = moments(&masses);
        let axes = Rotation3::identity();
        let gap = error(&compliance(&body, axes), &exact_compliance(&masses));
        let turn = error(&Matrix3::from(body.inertia()), &inertia);
        let counts = [masses.len(), pairs(&points()).len(), body.coordinates().len()];
        println!("{counts:?} points, springs and coordinates: compliance {gap:.1e}, inertia {turn:.1e}");
        assert!(gap < 1e-11 && turn < 1e-13, "{gap} {turn}");
    }
}

/// In the Tisserand frame no coordinate has linear or angular momentum, though the origin is far away.
#[test]
fn a_network_floats_in_its_tisserand_frame() {
    let masses = masses(points().len(), false);
    let body = network(&masses, 0.0, &Rheology::Elastic);
    let invariants = body.invariants();
    let total: f64 = masses.iter().sum();
    for (S, h) in invariants.S.iter().zip(&invariants.h) {
        // Coordinates are scaled to an rms displacement of one: |S| would be the mass, |h| that times the size.
        assert!(Vector3::from(*S).amax() < 1e-11 * total, "{S:?}");
        assert!(Vector3::from(*h).amax() < 1e-11 * total * SEMI_AXES[0], "{h:?}");
    }
    assert!((invariants.mass / total - 1.0).abs() < 1e-14);
}

/// Dashpots in proportion to the springs, a rheology of the springs, and `τ q̇ᵀKq̇` with the compliance of the
/// pseudo-inverse and the rate of the products by Euler's equations.
#[test]
fn a_network_dissipates_in_proportion_to_its_time() {
    let masses = masses(points().len(), true);
    let power = |damping: f64, rheology: &Rheology| {
        let mut value = [0.0];
        reduce(&network(&masses, damping, rheology), 3).unwrap().power.part(6).add_value(OMEGA, &mut value);
        value[0]
    };
    let (_, inertia) = moments(&masses);
    let omega = Vector3::from(OMEGA);
    let rate = -inertia.try_inverse().unwrap() * omega.cross(&(inertia * omega));
    let pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];
    let products: Vector6<f64> = pairs.map(|(a, b)| omega[a] * rate[b] + rate[a] * omega[b]).into();
    let exact = TIME * products.dot(&(exact_compliance(&masses) * products));
    let dashpots = power(TIME * STIFFNESS, &Rheology::Elastic);
    let material = power(0.0, &Rheology::KelvinVoigt { time: TIME });
    println!("power {dashpots:.6e} W of dashpots, {material:.6e} of a rheology, {exact:.6e} by τ q̇ᵀKq̇");
    for found in [dashpots, material] {
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
    }
    for factor in [0.01, 30.0] {
        let ratio = power(factor * TIME * STIFFNESS, &Rheology::Elastic) / dashpots;
        assert!((ratio / factor - 1.0).abs() < 1e-12, "{ratio} {factor}");
    }
}
