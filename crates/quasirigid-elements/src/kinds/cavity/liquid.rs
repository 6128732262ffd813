//! Liquid in a cavity: Krylov basis of its flows, and relaxations as cyclic coordinates of the body.
//! The three slow flows alone give the reduced equations at low order; each step of a chain raises the order to which the angular
//! momentum is exact, and responses at given rates make fast motions right. Equations (L3) to (L6), (L11), docs/theory/13-inside.md.

use std::ops::Range;

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::advection::advection;
use crate::flow::Velocity;
use crate::math::eigen::{Dense, modes};
use crate::math::krylov::dot;
use crate::math::span::Span;

/// Velocity fields in a cavity, solenoidal and zero on its wall, as vectors over a basis. (L3)
pub(super) trait Liquid {
    /// `∫ψ·(e × r) dV` for the unit vector of an axis, `r` from the middle of the cavity.
    fn load(&self, axis: usize) -> Vec<f64>;

    /// Flows `u` with `∫∇ψ:∇u dV + rate ∫ψ·u dV = load` for every solenoidal `ψ`, with a rate of change over the kinematic
    /// viscosity (1/m²). (L4), (L11)
    ///
    /// None if they are not found.
    fn flows(&self, loads: &[Vec<f64>], rate: f64) -> Option<Vec<Vec<f64>>>;

    /// The three slow flows that a change of spin drives; none if they are not found.
    fn slow(&self) -> Option<Vec<Vec<f64>>> {
        self.flows(&[0, 1, 2].map(|axis| self.load(axis)), 0.0)
    }

    /// `∫∇ψ:∇u dV`.
    fn friction(&self, u: &[f64]) -> Vec<f64>;

    /// `∫ψ·u dV`.
    fn mass(&self, u: &[f64]) -> Vec<f64>;

    /// `∫ψ·(e × u) dV` for the unit vector of an axis.
    fn turned(&self, axis: usize, u: &[f64]) -> Vec<f64>;

    /// Visits quadrature points, with the share of the volume (m³) and the velocity of each flow; none where the flows have no advection.
    fn sample(&self, flows: &[Vec<f64>], visit: &mut dyn FnMut(f64, &[Velocity])) {
        let _ = (flows, visit);
    }
}

/// Relaxations of a liquid, `∇²u − ∇p = −u/τ`, within a space that holds its responses to the spin, per unit of density and of kinematic
/// viscosity; each has the same `∫u² dV`. (L6)
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Relaxations {
    /// `∫u² dV` of each.
    pub mass: f64,
    /// `∫|∇u|² dV` of each, ascending.
    pub friction: Vec<f64>,
    /// `∫r × u dV`.
    pub momentum: Vec<Vector3<f64>>,
    /// `∫u_j × u_k dV` by row and column.
    pub turning: Vec<(usize, usize, Vector3<f64>)>,
    /// Share of each slow flow in each relaxation, a row for each flow, and `∫u_a·(u_b·∇)u_c dV` of the slow flows. (L21)
    pub shares: Vec<Vec<f64>>,
    pub advection: Vec<([usize; 3], f64)>,
}

/// Size of the space of flows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Memory {
    /// Length of the chains of slow responses: the degree to which the angular momentum is exact is one more than twice as high.
    pub depth: usize,
    /// Number of the rates of change whose responses are in the space: the more, the faster the motions that are still right.
    pub modes: usize,
}

/// Ratio of the first rate of change to the slowest rate of relaxation. (L11)
const FIRST: f64 = 5.0;
/// Ratio of each rate of change to the one before. (L11)
const STEP: f64 = 8.0;

/// Share of the largest entry of the coupling below which entries are rounding.
const COUPLING_ROUNDING: f64 = 1e-12;

impl Relaxations {
    /// Relaxations of a liquid, scaled to a value of `∫u² dV`; none if flows or eigenvalues are not found.
    ///
    /// The chains begin with the three slow flows that a change of spin drives. Each step is the response to the inertia of the flow before
    /// it, and to its rotation with the body about each axis. Responses to faster changes of the spin join them.
    pub fn of(liquid: &dyn Liquid, memory: Memory, mass: f64) -> Option<Self> {
        let (span, slow) = krylov_basis(liquid, memory)?;
        let inertia = span.projected(|u| liquid.mass(u));
        let size = inertia.size();
        let mut unit = Dense::zero(size);
        (0..size).for_each(|i| unit.add(i, i, 1.0));
        let found = modes(&inertia, &unit).ok()?;
        let share = |row: usize, mode: usize| found.shapes.at(row, mode) * mass.sqrt();
        let field = |mode: usize| span.combined(&(0..size).map(|row| share(row, mode)).collect::<Vec<_>>());
        let fields: Vec<Vec<f64>> = (0..size).map(field).collect();
        let loads: [Vec<f64>; 3] = std::array::from_fn(|axis| liquid.load(axis));
        let momentum = |u: &Vec<f64>| Vector3::from_fn(|axis, _| dot(&loads[axis], u));
        Some(Self {
            mass,
            friction: found.frequencies.iter().map(|frequency| mass * frequency * frequency).collect(),
            momentum: fields.iter().map(momentum).collect(),
            turning: turning(liquid, &fields),
            shares: (0..slow).map(|row| (0..size).map(|mode| share(row, mode)).collect()).collect(),
            advection: advection(liquid, &span.into_vectors()[..slow]),
        })
    }

    /// Tensor of the slow response, `P = Σ h hᵀ/b`; every choice of [`Memory`] holds the whole of it. (L5)
    pub fn slow_tensor(&self) -> Matrix3<f64> {
        let terms = self.momentum.iter().zip(&self.friction);
        terms.map(|(h, friction)| h * h.transpose() / *friction).sum()
    }
}

/// Vectors that span the chains, orthonormal in `∫∇u:∇u dV`, and the number of slow flows among the first.
fn krylov_basis(liquid: &dyn Liquid, Memory { depth, modes }: Memory) -> Option<(Span, usize)> {
    let mut kept = Vec::new();
    let slow = grown(liquid, &mut kept, liquid.slow()?);
    let mut last = slow.clone();
    for _ in 1..depth {
        let after = |u: &Vec<f64>| {
            std::iter::once(liquid.mass(u))
                .chain((0..3).map(|axis| liquid.turned(axis, u)))
                .collect::<Vec<_>>()
        };
        let loads: Vec<Vec<f64>> = kept[last].iter().flat_map(after).collect();
        last = grown(liquid, &mut kept, liquid.flows(&loads, 0.0)?);
    }
    let slowest =
        kept[slow.clone()].iter().map(|u| 1.0 / dot(u, &liquid.mass(u))).fold(f64::INFINITY, f64::min);
    let loads = [0, 1, 2].map(|axis| liquid.load(axis));
    let mut rate = FIRST * slowest;
    for _ in 0..modes {
        grown(liquid, &mut kept, liquid.flows(&loads, rate)?);
        rate *= STEP;
    }
    Some((Span::orthonormal(kept, |u| liquid.friction(u)), slow.len()))
}

/// Adds flows to orthonormal ones, without linearly dependent ones, and returns the places of the new ones.
fn grown(liquid: &dyn Liquid, kept: &mut Vec<Vec<f64>>, flows: Vec<Vec<f64>>) -> Range<usize> {
    let start = kept.len();
    let unit = |mut u: Vec<f64>| {
        let length = dot(&u, &liquid.friction(&u)).sqrt();
        u.iter_mut().for_each(|entry| *entry /= length);
        u
    };
    let flows = flows.into_iter().filter(|u| u.iter().any(|entry| *entry != 0.0)).map(unit);
    let all = std::mem::take(kept).into_iter().chain(flows).collect();
    *kept = Span::orthonormal(all, |u| liquid.friction(u)).into_vectors();
    start..kept.len()
}

fn turning(liquid: &dyn Liquid, fields: &[Vec<f64>]) -> Vec<(usize, usize, Vector3<f64>)> {
    let size = fields.len();
    // ∫u_j × u_k · e = −∫u_j · (e × u_k)
    let along: [DMatrix<f64>; 3] = std::array::from_fn(|axis| {
        let turned: Vec<Vec<f64>> = fields.iter().map(|u| liquid.turned(axis, u)).collect();
        DMatrix::from_fn(size, size, |j, k| 0.5 * (dot(&fields[k], &turned[j]) - dot(&fields[j], &turned[k])))
    });
    let largest = along.iter().map(|matrix| matrix.amax()).fold(0.0, f64::max);
    let entry = |j: usize, k: usize| Vector3::from_fn(|axis, _| along[axis][(j, k)]);
    (0..size)
        .flat_map(|j| (0..size).map(move |k| (j, k)))
        .map(|(j, k)| (j, k, entry(j, k)))
        .filter(|(_, _, entry)| entry.amax() > COUPLING_ROUNDING * largest)
        .collect()
}
