//! Inertia invariants by their definition: sums over point masses that move on exact paths. (I1)–(I8)
//!
//! Nothing of the program is used to place the masses. The appendages rotate by exact rotations through the gimbal angles, and the exact
//! sums are differentiated numerically.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use proptest::prelude::*;
use quasirigid::elements::PointMotion;
use quasirigid::model::{FlexibleBody, Support};
use quasirigid_math::sym3::{self, Sym};

use crate::support::{Mass, Massive, cases, inertia, massive, moments};

type V = Vector3<f64>;

/// Sixth-order differences with this step err by `h⁶/140` and round by 1e-16/h² at worst.
const STEP: f64 = 0.02;
/// Remaining error of both, for sums of some ten masses.
const DIFFERENCES: f64 = 2e-10;

/// Positions of every mass from the pole, as functions of the coordinates.
pub struct Cloud {
    carrier: Vec<Mass>,
    /// Mass, equilibrium position and directions of each point.
    points: Vec<(f64, V, Vec<V>)>,
    /// Masses, hinge and unit axes of each appendage.
    appendages: Vec<(Vec<Mass>, V, Vec<Unit<V>>)>,
}

impl Cloud {
    /// The masses of a body, seen from its pole. The basis of a plane is the body's own choice, taken from its markers.
    pub fn of(massive: &Massive, body: &FlexibleBody) -> Self {
        let pole = V::from(body.pole());
        let from_pole = |masses: &[Mass]| masses.iter().map(|(m, r)| (*m, r - pole)).collect();
        let assembly = &massive.assembly;
        let points = assembly.points.iter().zip(body.markers()).map(|(point, marker)| {
            let shapes = marker.shapes.iter().map(|(_, H)| V::from(*H)).collect();
            (point.mass, V::from(point.position) - pole, shapes)
        });
        let hinged = assembly.hinged.iter().zip(&massive.appendages).map(|(hinged, masses)| {
            let axes = hinged.axes.iter().map(|axis| Unit::new_normalize(V::from(*axis))).collect();
            (from_pole(masses), V::from(hinged.hinge) - pole, axes)
        });
        Self { carrier: from_pole(&massive.carrier), points: points.collect(), appendages: hinged.collect() }
    }

    /// Places of all masses at the coordinates `q`.
    pub fn at(&self, q: &[f64]) -> Vec<Mass> {
        let mut q = q.iter();
        let mut masses = self.carrier.clone();
        for (m, place, directions) in &self.points {
            let moved: V = directions.iter().map(|e| *q.next().unwrap() * e).sum();
            masses.push((*m, place + moved));
        }
        for (cloud, hinge, axes) in &self.appendages {
            // The first axis is the outermost, so its rotation is applied last.
            let turn = axes.iter().fold(Rotation3::identity(), |turn, axis| {
                turn * Rotation3::from_axis_angle(axis, *q.next().unwrap())
            });
            masses.extend(cloud.iter().map(|(m, r)| (*m, hinge + turn * (r - hinge))));
        }
        assert!(q.next().is_none(), "every coordinate moves something");
        masses
    }

    /// Velocity of every mass for unit rate of a coordinate.
    fn velocity(&self, q: &[f64], k: usize) -> Vec<V> {
        let place = |t: f64| -> Vec<V> {
            let mut q = q.to_vec();
            q[k] += t;
            self.at(&q).into_iter().map(|(_, r)| r).collect()
        };
        let ends = [1.0, 2.0, 3.0].map(|i| (place(i * STEP), place(-i * STEP)));
        (0..ends[0].0.len())
            .map(|mass| {
                let odd = |i: usize| ends[i].0[mass] - ends[i].1[mass];
                (45.0 * odd(0) - 9.0 * odd(1) + odd(2)) / (60.0 * STEP)
            })
            .collect()
    }

    /// Angular momentum per unit rate, `h_k(q) = Σ m u × ∂u/∂q_k`.
    fn h(&self, q: &[f64], k: usize) -> V {
        let velocity = self.velocity(q, k);
        self.at(q).iter().zip(velocity).map(|((m, u), v)| *m * u.cross(&v)).sum()
    }
}

/// First derivative of a function of the coordinates at equilibrium.
fn first<T>(n: usize, j: usize, f: impl Fn(&[f64]) -> T) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
{
    let at = |t: f64| f(&(0..n).map(|i| if i == j { t } else { 0.0 }).collect::<Vec<_>>());
    let odd = |i: f64| at(i * STEP) - at(-i * STEP);
    (odd(1.0) * 45.0 - odd(2.0) * 9.0 + odd(3.0)) * (1.0 / (60.0 * STEP))
}

/// Second derivative of a function of the coordinates at equilibrium.
fn second<T>(n: usize, j: usize, k: usize, f: impl Fn(&[f64]) -> T) -> T
where
    T: Clone + std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
{
    let along = |ends: &[usize]| {
        let at = |t: f64| f(&(0..n).map(|i| if ends.contains(&i) { t } else { 0.0 }).collect::<Vec<_>>());
        let even = |i: f64| at(i * STEP) + at(-i * STEP);
        let sum = even(1.0) * 270.0 - even(2.0) * 27.0 + even(3.0) * 2.0 - at(0.0) * 490.0;
        sum * (1.0 / (180.0 * STEP * STEP))
    };
    if j == k { along(&[j]) } else { (along(&[j, k]) - along(&[j]) - along(&[k])) * 0.5 }
}

fn matrix(J: Sym) -> Matrix3<f64> {
    Matrix3::from(sym3::rows(J))
}

/// Scales against which invariants are judged: mass, and mass times size squared, of the whole.
fn whole(cloud: &Cloud, n: usize) -> (f64, f64) {
    let masses = cloud.at(&vec![0.0; n]);
    (masses.iter().map(|(m, _)| m).sum(), inertia(&masses, V::zeros()).amax())
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn frozen_body_is_the_sum_of_its_masses(massive in massive()) {
        let body = massive.assembly.body().unwrap();
        let n = body.coordinates().len();
        let masses = Cloud::of(&massive, &body).at(&vec![0.0; n]);
        let (mass, center, _) = moments(&masses);
        let J = inertia(&masses, V::zeros());
        prop_assert!((body.invariants().mass / mass - 1.0).abs() < 1e-14);
        prop_assert!((matrix(body.invariants().J) - J).amax() < 1e-13 * J.amax());
        let from_pole = V::from(body.center_of_mass()) - V::from(body.pole());
        // Positions are of the order of one metre.
        prop_assert!((from_pole - center).norm() < 1e-14);
        if massive.assembly.support == Support::Free {
            prop_assert!(center.norm() < 1e-14);
        }
    }

    /// First-order invariants are derivatives of sums over the masses. (I2), (I3)
    #[test]
    fn first_order_invariants_are_derivatives_of_their_sums(massive in massive()) {
        let body = massive.assembly.body().unwrap();
        let n = body.coordinates().len();
        let cloud = Cloud::of(&massive, &body);
        let (mass, largest) = whole(&cloud, n);
        let origin = vec![0.0; n];
        let at_rest = cloud.at(&origin);
        for j in 0..n {
            let velocity = cloud.velocity(&origin, j);
            let S: V = at_rest.iter().zip(&velocity).map(|((m, _), v)| *m * v).sum();
            let h = cloud.h(&origin, j);
            let J1 = first(n, j, |q| inertia(&cloud.at(q), V::zeros()));
            let invariants = body.invariants();
            prop_assert!((V::from(invariants.S[j]) - S).norm() < DIFFERENCES * mass, "S_{j}");
            prop_assert!((V::from(invariants.h[j]) - h).norm() < DIFFERENCES * largest, "h_{j}");
            prop_assert!((matrix(invariants.J1[j]) - J1).amax() < DIFFERENCES * largest, "J_{j}");
        }
    }

    /// Second-order invariants are derivatives of sums over the masses, with skew gimbal axes and every pair of coordinates, coupled or
    /// not. (I4)–(I6), (I8)
    #[test]
    fn second_order_invariants_are_derivatives_of_their_sums(massive in massive()) {
        let body = massive.assembly.body().unwrap();
        let n = body.coordinates().len();
        let cloud = Cloud::of(&massive, &body);
        let (mass, largest) = whole(&cloud, n);
        let origin = vec![0.0; n];
        let velocities: Vec<_> = (0..n).map(|j| cloud.velocity(&origin, j)).collect();
        let at_rest = cloud.at(&origin);
        let center = |q: &[f64]| -> V { cloud.at(q).iter().map(|(m, u)| *m * u).sum() };
        for j in 0..n {
            for k in 0..n {
                let pair = body.invariants().pairs.row(j).find(|(column, _)| *column == k);
                let pair = pair.map(|(_, pair)| *pair).unwrap_or_default();
                let each = at_rest.iter().zip(velocities[j].iter().zip(&velocities[k]));
                let A: f64 = each.map(|((m, _), (v, w))| m * v.dot(w)).sum();
                prop_assert!((pair.A - A).abs() < DIFFERENCES * largest.max(mass), "A_{j}{k}");
                let J2 = second(n, j, k, |q| inertia(&cloud.at(q), V::zeros())) * 0.5;
                prop_assert!((matrix(pair.J2) - J2).amax() < DIFFERENCES * largest, "J_{j}{k}");
                let Z = first(n, j, |q| cloud.h(q, k));
                prop_assert!((V::from(pair.Z) - Z).norm() < DIFFERENCES * largest, "Z_{j}{k}");
                let curvature = second(n, j, k, center);
                prop_assert!((V::from(pair.S2) - curvature).norm() < DIFFERENCES * mass, "Γ_{j}{k}");
            }
        }
    }

    /// A point moves along its line, or in its plane, in orthonormal directions.
    #[test]
    fn constrained_points_move_as_their_constraints_allow(massive in massive()) {
        let body = massive.assembly.body().unwrap();
        for (point, marker) in massive.assembly.points.iter().zip(body.markers()) {
            let shapes: Vec<V> = marker.shapes.iter().map(|(_, H)| V::from(*H)).collect();
            for (i, a) in shapes.iter().enumerate() {
                for (k, b) in shapes.iter().enumerate() {
                    prop_assert!((a.dot(b) - f64::from(u8::from(i == k))).abs() < 1e-15 * 4.0);
                }
            }
            match point.motion {
                PointMotion::Free => prop_assert_eq!(shapes.len(), 3),
                PointMotion::Line(direction) => {
                    prop_assert_eq!(shapes.len(), 1);
                    prop_assert!(shapes[0].cross(&V::from(direction).normalize()).norm() < 4e-16);
                }
                PointMotion::Plane(normal) => {
                    prop_assert_eq!(shapes.len(), 2);
                    let normal = V::from(normal).normalize();
                    prop_assert!(shapes.iter().all(|e| e.dot(&normal).abs() < 4e-16));
                }
            }
        }
    }
}
