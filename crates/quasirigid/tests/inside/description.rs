//! One body described in two ways.

use nalgebra::{Matrix3, Rotation3, Vector3};
use quasirigid::elements::{
    Assembly, CavityShape, Coefficient, Rotor, RotorKind, SlowLiquid, SpringLaw, Wheel, WheelSpeed,
};
use quasirigid::model::ReducedBody;
use quasirigid_math::polynomial::Series;
use quasirigid_math::{rotation, sym3};

/// Rotated axes of the file, and the sizes of the old units in the new ones.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// Rotation vector `v → Rv` of the vectors in the file (rad).
    pub turn: [f64; 3],
    pub length: f64,
    pub mass: f64,
    pub time: f64,
}

/// The description that changes nothing.
pub const SAME: Description = Description { turn: [0.0; 3], length: 1.0, mass: 1.0, time: 1.0 };

/// Spins and angular momenta at which polynomials are compared: there the angular momenta of the wheels and of the body are alike.
const SPIN: f64 = 0.5;
const MOMENTUM: f64 = 6.0;
const DIRECTIONS: u32 = 61;

impl Description {
    fn R(&self) -> Matrix3<f64> {
        *Rotation3::from_scaled_axis(self.turn.into()).matrix()
    }

    /// The factor of a quantity with these exponents of length, mass and time.
    pub fn factor(&self, [length, mass, time]: [i32; 3]) -> f64 {
        self.length.powi(length) * self.mass.powi(mass) * self.time.powi(time)
    }

    /// A vector with these exponents.
    pub fn vector(&self, v: [f64; 3], exponents: [i32; 3]) -> [f64; 3] {
        (self.factor(exponents) * (self.R() * Vector3::from(v))).into()
    }

    fn tensor(&self, T: [[f64; 3]; 3], exponents: [i32; 3]) -> [[f64; 3]; 3] {
        let image = self.factor(exponents) * (self.R() * Matrix3::from(T) * self.R().transpose());
        (0.5 * (image + image.transpose())).into()
    }

    fn coefficient(&self, coefficient: Coefficient, exponents: [i32; 3]) -> Coefficient {
        let rows = match coefficient {
            Coefficient::Isotropic(value) => Matrix3::from_diagonal_element(value).into(),
            Coefficient::Diagonal(values) => Matrix3::from_diagonal(&Vector3::from(values)).into(),
            Coefficient::Full(rows) => rows,
        };
        Coefficient::Full(self.tensor(rows, exponents))
    }

    /// The body of such parts in this description.
    pub fn of(&self, assembly: &Assembly) -> Assembly {
        let mut other = assembly.clone();
        if let Some(carrier) = &mut other.carrier {
            carrier.mass *= self.mass;
            carrier.center_of_mass = self.vector(carrier.center_of_mass, [1, 0, 0]);
            carrier.inertia = self.tensor(carrier.inertia, [2, 1, 0]);
        }
        for point in &mut other.points {
            point.mass *= self.mass;
            point.position = self.vector(point.position, [1, 0, 0]);
        }
        for spring in &mut other.springs {
            let SpringLaw::Spatial { stiffness, damping } = spring.law else { panic!("{:?}", spring.law) };
            let (stiffness, damping) =
                (self.coefficient(stiffness, [0, 1, -2]), self.coefficient(damping, [0, 1, -1]));
            spring.law = SpringLaw::Spatial { stiffness, damping };
        }
        for Rotor { kind, inertia, friction, .. } in &mut other.rotors {
            *inertia *= self.factor([2, 1, 0]);
            *friction *= self.factor([2, 1, -1]);
            if let RotorKind::Flywheel { axis } = kind {
                *axis = self.vector(*axis, [0; 3]);
            }
        }
        for Wheel { axis, speed, .. } in &mut other.wheels {
            *axis = self.vector(*axis, [0; 3]);
            let WheelSpeed::Constant { angular_momentum } = speed else { panic!("{speed:?}") };
            *angular_momentum *= self.factor([2, 1, -1]);
        }
        for cavity in &mut other.cavities {
            let CavityShape::Ellipsoid { semi_axes } = &mut cavity.shape else {
                panic!("{:?}", cavity.shape)
            };
            *semi_axes = semi_axes.map(|a| self.length * a);
            cavity.center = self.vector(cavity.center, [1, 0, 0]);
            cavity.attitude = rotation::turned(cavity.attitude, self.turn);
            cavity.density *= self.factor([-3, 1, 0]);
            cavity.viscosity *= self.factor([2, 0, -1]);
        }
        other
    }

    /// Differences of a reduced body from the image of another, by name: the largest difference of each degree, relative to the largest
    /// value of that degree.
    pub fn gaps(&self, found: &ReducedBody, before: &ReducedBody) -> Vec<(&'static str, f64)> {
        let (spin, angular_momentum) = ((SPIN, [0, 0, -1]), (MOMENTUM, [2, 1, -1]));
        let tensor = self.tensor(sym3::rows(before.J), [2, 1, 0]);
        let mut gaps = vec![("J", matrix_gap(sym3::rows(found.J), tensor))];
        // At a given angular momentum whole degrees of the energy cancel: its sizes are those at a given spin.
        let energies = sizes(&before.energy, SPIN);
        for (name, found, before, argument, value) in [
            ("f", &found.f, &before.f, spin, [0, 0, -2]),
            ("mu", &torque(found), &torque(before), spin, [2, 1, -2]),
            ("K", &found.K, &before.K, spin, [2, 1, -1]),
            ("Omega", &found.Omega, &before.Omega, angular_momentum, [0, 0, -1]),
            ("E of omega", &found.energy, &before.energy, spin, [2, 1, -2]),
            ("E of K", &found.energy_of_momentum, &before.energy_of_momentum, angular_momentum, [2, 1, -2]),
            ("power", &found.power, &before.power, spin, [2, 1, -3]),
            ("phi", &found.phi, &before.phi, spin, [1, 1, -2]),
        ] {
            let own = sizes(before, argument.0);
            let sizes = if name == "E of K" { &energies } else { &own };
            gaps.push((name, self.series_gap(found, before, argument, value, sizes)));
        }
        gaps
    }

    fn series_gap(
        &self,
        found: &Series,
        before: &Series,
        (length, argument): (f64, [i32; 3]),
        value: [i32; 3],
        sizes: &[f64],
    ) -> f64 {
        assert_eq!((found.degree(), found.rows()), (before.degree(), before.rows()));
        let image = |old: Vec<f64>| match *old {
            [x, y, z] => self.vector([x, y, z], value).to_vec(),
            _ => old.iter().map(|entry| self.factor(value) * entry).collect(),
        };
        let gap = |degree: usize| {
            let apart = directions(length).flat_map(|u| {
                let new = value_of(found, degree, self.vector(u, argument));
                let old = image(value_of(before, degree, u));
                new.into_iter().zip(old).map(|(new, old)| (new - old).abs())
            });
            let largest = largest(apart);
            if largest == 0.0 { 0.0 } else { largest / (self.factor(value) * sizes[degree]) }
        };
        largest((0..=before.degree()).map(gap))
    }

    /// Difference of the slow tensor of a liquid from the image of another.
    pub fn liquid_gap(&self, found: &SlowLiquid, before: &SlowLiquid) -> f64 {
        matrix_gap(found.tensor, self.tensor(before.tensor, [7, 0, 0]))
    }
}

/// Torque `μ` of all degrees. (R7)
fn torque(body: &ReducedBody) -> Series {
    let mut torque = Series::zero(body.f.degree(), 3);
    (3..=body.f.degree()).for_each(|degree| torque.set(body.mu(degree)));
    torque
}

fn matrix_gap(found: [[f64; 3]; 3], expected: [[f64; 3]; 3]) -> f64 {
    let (found, expected) = (Matrix3::from(found), Matrix3::from(expected));
    (found - expected).amax() / expected.amax()
}

/// Largest value of each degree on the sphere of a radius.
fn sizes(series: &Series, radius: f64) -> Vec<f64> {
    let size = |degree| directions(radius).flat_map(move |u| value_of(series, degree, u)).map(f64::abs);
    (0..=series.degree()).map(|degree| largest(size(degree))).collect()
}

fn value_of(series: &Series, degree: usize, x: [f64; 3]) -> Vec<f64> {
    let mut value = vec![0.0; series.rows()];
    series.part(degree).add_value(x, &mut value);
    value
}

/// Largest of numbers that are not negative; infinite if one is no number.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| {
        if value <= most {
            most
        } else if value.is_nan() {
            f64::INFINITY
        } else {
            value
        }
    })
}

/// Vectors of a length, spread over the sphere.
fn directions(size: f64) -> impl Iterator<Item = [f64; 3]> {
    (0..DIRECTIONS).map(move |i| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(DIRECTIONS);
        let (sin, cos) = (2.4 * f64::from(i) + 0.3).sin_cos();
        let across = size * (1.0 - z * z).sqrt();
        [across * cos, across * sin, size * z]
    })
}
