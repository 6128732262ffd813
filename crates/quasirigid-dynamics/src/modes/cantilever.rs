//! Cantilever modes of what a held carrier bears, with participation factors in its motion: hybrid coordinates `[@likins1970]`.
//! Rotors and liquids are locked in the carrier: they have no frequency of their own at rest.
//! Equations (M18) to (M20), docs/theory/15-modes.md.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use thiserror::Error;

use crate::math::eigen::{Dense, Eigenmodes, NoConvergence, modes};
use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::model::FlexibleBody;

/// Cantilever modes of a body, with its mass properties and the modes that it has afloat. (M18)
///
/// Vectors have body axes; rotations, moments and inertia are about one point.
#[derive(Clone, Debug, PartialEq)]
pub struct CantileverModes {
    /// Point that rotations are about (m), from the pole.
    pub about: [f64; 3],
    /// Mass of the whole body (kg).
    pub mass: f64,
    /// Centre of mass of the whole body (m), from the point.
    pub center_of_mass: [f64; 3],
    /// Inertia tensor of the whole body about the point (kg·m²).
    pub inertia: [[f64; 3]; 3],
    /// Modes with the carrier held, by ascending frequency.
    pub modes: Vec<CantileverMode>,
    /// Modes of the body at rest, free or on its support, by ascending frequency.
    pub free: Vec<FreeMode>,
    /// Largest share of one mode that the dashpots bring into another: the damping ratios are those of each mode alone.
    pub damping_coupling: f64,
}

/// Cantilever mode of unit modal mass. (M18)
#[derive(Clone, Debug, PartialEq)]
pub struct CantileverMode {
    /// Part or coordinate that moves most.
    pub name: String,
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Damping ratio of the mode alone.
    pub damping_ratio: f64,
    /// Participation factors in translations of the carrier (kg^½).
    pub translation: [f64; 3],
    /// Participation factors in rotations about the point (kg^½·m).
    pub rotation: [f64; 3],
}

/// Mode of the free body at rest, of unit modal mass. (M20)
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMode {
    /// Part or coordinate that moves most.
    pub name: String,
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Damping ratio of the mode alone.
    pub damping_ratio: f64,
    /// Displacement of the carrier at the point (kg^-½).
    pub displacement: [f64; 3],
    /// Rotation of the carrier (kg^-½·m⁻¹).
    pub rotation: [f64; 3],
}

/// Error of cantilever modes.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CantileverError {
    /// No spring holds some coordinate.
    #[error("the spin alone restores some coordinates, which have no frequency on a carrier that is held")]
    Hung,
    /// A coordinate is driven.
    #[error("a part follows a law over time, and has no modes; give it a constant place")]
    Driven,
    /// The eigenvalue solver fails.
    #[error(transparent)]
    NoConvergence(#[from] NoConvergence),
}

/// Off-diagonal damping, relative to the diagonal, that is rounding.
const DAMPING_ROUNDING: f64 = 1e-9;

type V = Vector3<f64>;

impl CantileverModes {
    /// Cantilever modes, and modes of the free body, with rotations about a point (m, from the pole). (M18), (M20)
    ///
    /// # Errors
    /// [`CantileverError`] for a coordinate that no spring holds, and where the eigenvalue solver fails.
    pub fn about(body: &FlexibleBody, about: [f64; 3]) -> Result<Self, CantileverError> {
        if !body.drives().is_empty() {
            return Err(CantileverError::Driven);
        }
        if body.hung().is_some() {
            return Err(CantileverError::Hung);
        }
        let elastic = 0..body.elastic();
        let stiffness = Dense::of(&body.stiffness().block(elastic.clone()));
        let held = modes(&held_mass(body), &stiffness)?;
        let free = modes(&body.recoiling_mass_matrix().block(elastic), &stiffness)?;
        let sums = Sums::new(body, about);
        let own = |modes: &Eigenmodes| -> Vec<Shape> {
            modes.frequencies.iter().enumerate().map(|(r, rate)| Shape::new(body, modes, r, *rate)).collect()
        };
        let (clamped, afloat) = (own(&held), own(&free));
        Ok(Self {
            about,
            mass: body.invariants().mass,
            center_of_mass: sums.center.into(),
            inertia: sums.inertia.into(),
            damping_coupling: coupling(body, &clamped),
            modes: clamped.into_iter().map(|shape| sums.cantilever(shape)).collect(),
            free: afloat.into_iter().map(|shape| sums.free(body, shape)).collect(),
        })
    }

    /// Mass that the modes carry: `Σ d dᵀ` with the participation factors `d` in translations, then in rotations. (M19)
    #[must_use]
    pub fn carried(&self) -> [[f64; 6]; 6] {
        let mut sum = [[0.0; 6]; 6];
        for mode in &self.modes {
            let d = mode.factors();
            (0..6).for_each(|a| (0..6).for_each(|b| sum[a][b] += d[a] * d[b]));
        }
        sum
    }
}

impl CantileverMode {
    /// Participation factors in translations (kg^½), then in rotations (kg^½·m).
    #[must_use]
    pub fn factors(&self) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (self.translation, self.rotation);
        [x, y, z, a, b, c]
    }

    /// Effective masses (kg) along the axes.
    #[must_use]
    pub fn effective_mass(&self) -> [f64; 3] {
        self.translation.map(|factor| factor * factor)
    }

    /// Effective inertias (kg·m²) about the axes through the point.
    #[must_use]
    pub fn effective_inertia(&self) -> [f64; 3] {
        self.rotation.map(|factor| factor * factor)
    }
}

/// Mass matrix of the elastic coordinates with the carrier held.
pub(super) fn held_mass(body: &FlexibleBody) -> Dense {
    let elastic = body.elastic();
    let mut A = Dense::zero(elastic);
    let pairs = body.invariants().pairs.iter().filter(|(j, k, _)| *j < elastic && *k < elastic);
    pairs.for_each(|(j, k, pair)| A.add(j, k, pair.A));
    A
}

/// Sums over the mass of the body about a point.
struct Sums {
    about: V,
    center: V,
    inertia: Matrix3<f64>,
    /// `S_j` and `h_j` about the point.
    factors: Vec<[V; 2]>,
}

impl Sums {
    fn new(body: &FlexibleBody, about: [f64; 3]) -> Self {
        let (invariants, about) = (body.invariants(), V::from(about));
        let of_pole = V::from(body.center_of_mass()) - V::from(body.pole());
        let center = of_pole - about;
        let shift = |d: V| invariants.mass * (Matrix3::identity() * d.norm_squared() - d * d.transpose());
        let factor = |(S, h): (&[f64; 3], &[f64; 3])| [V::from(*S), V::from(*h) - about.cross(&V::from(*S))];
        Self {
            about,
            center,
            inertia: Matrix3::from(sym3::rows(invariants.J)) - shift(of_pole) + shift(center),
            factors: invariants.S.iter().zip(&invariants.h).map(factor).collect(),
        }
    }

    /// Participation factors of a shape in translations and rotations. (M18)
    fn of(&self, shape: &[f64]) -> [V; 2] {
        let zero = [V::zeros(); 2];
        shape.iter().zip(&self.factors).fold(zero, |[L, R], (x, [S, h])| [L + *x * S, R + *x * h])
    }

    fn cantilever(&self, Shape { name, frequency, damping_ratio, x }: Shape) -> CantileverMode {
        let [L, R] = self.of(&x);
        CantileverMode { name, frequency, damping_ratio, translation: L.into(), rotation: R.into() }
    }

    /// Mode of the free body with the recoil of the carrier. (M20)
    fn free(&self, body: &FlexibleBody, Shape { name, frequency, damping_ratio, x }: Shape) -> FreeMode {
        let [L, R] = self.of(&x);
        let of_pole = R + self.about.cross(&L);
        let turn = -V::from(sym3::times(sym3::inverse(body.invariants().J), of_pole.into()));
        let pole = body.translation().map_or(V::zeros(), |per_mass| -per_mass * L);
        let displacement = pole + turn.cross(&self.about);
        FreeMode { name, frequency, damping_ratio, displacement: displacement.into(), rotation: turn.into() }
    }
}

/// Shape of a mode over the elastic coordinates.
struct Shape {
    name: String,
    frequency: f64,
    damping_ratio: f64,
    x: Vec<f64>,
}

impl Shape {
    fn new(body: &FlexibleBody, modes: &Eigenmodes, column: usize, frequency: f64) -> Self {
        let x: Vec<f64> = (0..body.elastic()).map(|row| modes.shapes.at(row, column)).collect();
        let lost = |(loss, matrix): (f64, &SparseRows<f64>)| loss * form(matrix, &x, &x);
        let viscous = lost((frequency, body.damping()));
        let material = body.viscoelastic().iter();
        let material = material.map(|part| lost((part.rheology.modulus(frequency)[1], &part.stiffness)));
        let damping_ratio = (viscous + material.sum::<f64>()) / (2.0 * frequency * frequency);
        Self { name: leading(body, &x), frequency, damping_ratio, x }
    }
}

/// `xᵀ M y` over the coordinates that the shapes have.
fn form(matrix: &SparseRows<f64>, x: &[f64], y: &[f64]) -> f64 {
    let entries = matrix.iter().filter(|(j, k, _)| *j < x.len() && *k < y.len());
    entries.map(|(j, k, entry)| x[j] * entry * y[k]).sum()
}

/// Largest share of one mode in another by the damping between them, to first order.
fn coupling(body: &FlexibleBody, shapes: &[Shape]) -> f64 {
    let between = |a: &Shape, b: &Shape| form(body.damping(), &a.x, &b.x);
    let own: Vec<f64> = shapes.iter().map(|shape| between(shape, shape)).collect();
    let mut largest = 0.0_f64;
    for (s, b) in shapes.iter().enumerate() {
        for (r, a) in shapes[..s].iter().enumerate() {
            let damping = between(a, b).abs();
            if damping > DAMPING_ROUNDING * (own[r] * own[s]).sqrt() {
                largest = largest.max(a.frequency * damping / (b.frequency.powi(2) - a.frequency.powi(2)));
            }
        }
    }
    largest
}

/// Name of the coordinate with most of the kinetic energy of a shape; of a structure that of its part.
fn leading(body: &FlexibleBody, x: &[f64]) -> String {
    let mut energies: BTreeMap<&str, f64> = BTreeMap::new();
    let pairs = &body.invariants().pairs;
    for (j, coordinate) in body.coordinates().iter().enumerate().take(x.len()) {
        let momentum: f64 = pairs.row(j).filter(|(k, _)| *k < x.len()).map(|(k, pair)| pair.A * x[k]).sum();
        let known = !coordinate.is_shape() || body.part_masses().is_empty();
        *energies.entry(&coordinate.name).or_default() += if known { x[j] * momentum } else { 0.0 };
    }
    for part in body.part_masses() {
        *energies.entry(&part.name).or_default() += form(&part.mass, x, x);
    }
    let most = energies.iter().max_by(|a, b| a.1.total_cmp(b.1));
    most.map_or_else(String::new, |(name, _)| (*name).to_owned())
}
