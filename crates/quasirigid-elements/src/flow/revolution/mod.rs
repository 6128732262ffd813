//! Slow viscous flow in a cavity of revolution: harmonics round the axis, polynomials of high degree in the meridian, the
//! pressure two degrees lower `[@bernardi1999]`.

mod grid;
mod harmonic;
mod lagrange;
mod layout;
mod matrices;
mod outline;
mod potential;
mod ring;
mod slosh;
#[cfg(test)]
mod tests;
mod turning;

use std::f64::consts::TAU;

pub(crate) use self::outline::Outline;
pub(crate) use self::potential::slip;
pub(crate) use self::slosh::{Moments, Slosh, SloshMode, Wall, WallPiece};

use self::grid::{Grid, Patch};
use self::harmonic::Harmonic;
use self::layout::Layout;
use self::matrices::{Dense, Scalar};
use self::turning::Nodal;
use super::stokes::StokesError;
use super::{Velocity, incompressible};
use crate::math::factor::{Factor, Method};
use crate::math::symmetric::Symmetric;

/// A part of a load by distance from the axis and height.
type Profile = fn([f64; 2]) -> f64;

/// Resolution of the flow in a cavity of revolution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fineness {
    /// Degree of the polynomials along each side of a patch, 4 at least.
    pub degree: usize,
    /// Layers of patches along walls, 1 at least.
    pub layers: usize,
    /// The highest harmonic round the axis, 1 at least.
    pub harmonics: usize,
}

/// A cavity of revolution about z, discretised. Velocities and loads are vectors in the order of a [`Layout`].
pub(crate) struct RevolvedFlow {
    grid: Grid,
    blocks: Vec<Dense>,
    /// Scalars of order zero round the axis, and of higher orders.
    scalars: [Scalar; 2],
    /// Laplacians of orders 0, 1, 2, ….
    stiffness: Vec<Symmetric>,
    /// Factors of these Laplacians.
    factors: Vec<Factor>,
    layout: Layout,
    /// Volume (m³).
    volume: f64,
}

impl RevolvedFlow {
    /// Cavity with a given fineness.
    ///
    /// # Errors
    /// [`StokesError::OutOfRange`] if floating point does not resolve its places.
    pub fn new(outline: &Outline, fineness: Fineness) -> Result<Self, StokesError> {
        let Fineness { degree, layers, harmonics: most } = fineness;
        let grid = Grid::new(outline, degree, layers);
        let blocks: Option<Vec<Dense>> = grid.patches.iter().map(Dense::new).collect();
        let volume = grid.patches.iter().map(Patch::volume).sum();
        let blocks = blocks.ok_or(StokesError::OutOfRange { volume })?;
        let scalars = [
            Scalar::new(&grid, &blocks, |node| !grid.walls[node]),
            Scalar::new(&grid, &blocks, |node| !grid.walls[node] && !grid.axis[node]),
        ];
        let layout = Layout { most, counts: scalars.each_ref().map(|scalar| scalar.nodes.len()) };
        let stiffness: Vec<Symmetric> =
            (0..=most + 1).map(|k| scalars[usize::from(k > 0)].stiffness(k)).collect();
        let factors = stiffness.iter().map(|matrix| factor(matrix, volume)).collect::<Result<_, _>>()?;
        Ok(Self { grid, blocks, scalars, stiffness, factors, layout, volume })
    }

    /// `∫ ψ·(e × r) dV` for the unit vector of an axis.
    pub fn load(&self, axis: usize) -> Vec<f64> {
        // e_z × r runs round the axis; e_x × r = −z e_y + y e_z and e_y × r = z e_x − x e_z are of the first harmonic.
        let (m, kind, parts): (_, _, [Profile; 3]) = match axis {
            0 => (1, 1, [|_| 0.0, |[_, z]| -2.0 * z, |[r, _]| r]),
            1 => (1, 0, [|_| 0.0, |[_, z]| 2.0 * z, |[r, _]| -r]),
            _ => (0, 0, [|[r, _]| r, |[r, _]| -r, |_| 0.0]),
        };
        let mut load = vec![0.0; self.layout.size()];
        let families = self.layout.parts(m, kind).into_iter().zip(Layout::orders(m)).zip(Layout::weights(m));
        for (((own, k), weight), value) in families.zip(parts) {
            let (scalar, load) = (self.scalar(k), &mut load[own]);
            for patch in &self.grid.patches {
                for point in &patch.points {
                    let force = weight * point.share * point.at[0] * value(point.at);
                    for (node, function) in patch.nodes.iter().zip(&point.functions) {
                        if let Some(unknown) = scalar.unknowns[*node] {
                            load[unknown as usize] += force * function[0];
                        }
                    }
                }
            }
        }
        load
    }

    /// Flows under loads, with a rate of inertia in 1/m². (L4)
    ///
    /// # Errors
    /// [`StokesError::NoConvergence`] if the pressure is not found, [`StokesError::OutOfRange`] if the range of numbers is left.
    pub fn solve(&self, loads: &[Vec<f64>], rate: f64) -> Result<Vec<Vec<f64>>, StokesError> {
        let inert;
        let factors = if rate == 0.0 {
            &self.factors
        } else {
            inert = self.inert(rate)?;
            &inert
        };
        let mut flows = loads.to_vec();
        for (m, kind) in self.layout.families() {
            let own = self.layout.family(m, kind);
            let acts = |load: &usize| loads[*load][own.clone()].iter().any(|force| *force != 0.0);
            let acting: Vec<usize> = (0..loads.len()).filter(acts).collect();
            if acting.is_empty() {
                continue;
            }
            let rows = own.clone().flat_map(|row| acting.iter().map(move |load| (row, *load)));
            let mut forces: Vec<f64> = rows.clone().map(|(row, load)| loads[load][row]).collect();
            let harmonic = Harmonic {
                m,
                grid: &self.grid,
                blocks: &self.blocks,
                scalars: &self.scalars,
                factors: Layout::orders(m).map(|k| &factors[k]),
            };
            incompressible::solve(&harmonic, &mut forces, acting.len())?;
            rows.zip(&forces).for_each(|((row, load), value)| flows[load][row] = *value);
        }
        Ok(flows)
    }

    /// Factors of the Laplacians of orders 0, 1, 2, …, with a rate of inertia.
    fn inert(&self, rate: f64) -> Result<Vec<Factor>, StokesError> {
        let sum = |(k, stiffness): (usize, &Symmetric)| {
            let sum = stiffness.plus(rate, &self.scalar(k).mass).expect("both stand on one pattern");
            factor(&sum, self.volume)
        };
        self.stiffness.iter().enumerate().map(sum).collect()
    }

    /// `∫ ∇ψ:∇u dV`.
    pub fn stiffness_times(&self, u: &[f64]) -> Vec<f64> {
        self.by_families(|m, kind| {
            let (orders, parts) = (Layout::orders(m), self.layout.parts(m, kind));
            [0, 1, 2].map(|place| self.stiffness[orders[place]].times(&u[parts[place].clone()]))
        })
    }

    /// `∫ ψ·u dV`.
    pub fn mass_times(&self, u: &[f64]) -> Vec<f64> {
        self.by_families(|m, kind| {
            let (orders, parts) = (Layout::orders(m), self.layout.parts(m, kind));
            [0, 1, 2].map(|place| self.scalar(orders[place]).mass.times(&u[parts[place].clone()]))
        })
    }

    /// `∫ ψ·(e × u) dV` for the unit vector of an axis, without parts beyond the highest harmonic.
    pub fn turned(&self, axis: usize, u: &[f64]) -> Vec<f64> {
        let turned = self.nodal(u).turned(axis);
        self.by_families(|m, kind| {
            let (orders, values) = (Layout::orders(m), turned.parts(m, kind));
            [0, 1, 2].map(|place| {
                let scalar = self.scalar(orders[place]);
                scalar.mass.times(&scalar.nodes.iter().map(|node| values[place][*node]).collect::<Vec<_>>())
            })
        })
    }

    /// Visits quadrature points, with the share of the volume and the velocity of each flow in space; the rule is exact for products of
    /// three flows.
    pub fn sample(&self, flows: &[Vec<f64>], visit: &mut dyn FnMut(f64, &[Velocity])) {
        let nodal: Vec<Nodal> = flows.iter().map(|u| self.nodal(u)).collect();
        let angles = 6 * self.layout.most + 8;
        for patch in &self.grid.patches {
            for point in &patch.points {
                let round: Vec<_> = nodal.iter().map(|u| u.at(&patch.nodes, &point.functions)).collect();
                let share = point.share * point.at[0] * TAU / angles as f64;
                for angle in (0..angles).map(|i| TAU * i as f64 / angles as f64) {
                    let velocities = round.iter().map(|u| u.velocity(point.at[0], angle));
                    visit(share, &velocities.collect::<Vec<_>>());
                }
            }
        }
    }

    /// A flow at all nodes.
    fn nodal(&self, u: &[f64]) -> Nodal {
        let spread = |m: usize, kind: usize, place: usize| {
            let mut values = vec![0.0; self.grid.places.len()];
            let nodes = &self.scalar(Layout::orders(m)[place]).nodes;
            let own = &u[self.layout.parts(m, kind)[place].clone()];
            nodes.iter().zip(own).for_each(|(node, value)| values[*node] = *value);
            values
        };
        Nodal::new(&self.layout, self.grid.places.len(), spread)
    }

    /// A vector from the parts of its families, by harmonic and kind, each times the factor of its squares.
    fn by_families(&self, parts: impl Fn(usize, usize) -> [Vec<f64>; 3]) -> Vec<f64> {
        let mut vector = Vec::with_capacity(self.layout.size());
        for (m, kind) in self.layout.families() {
            for (values, weight) in parts(m, kind).into_iter().zip(Layout::weights(m)) {
                vector.extend(values.into_iter().map(|value| weight * value));
            }
        }
        vector
    }

    fn scalar(&self, k: usize) -> &Scalar {
        &self.scalars[usize::from(k > 0)]
    }
}

fn factor(matrix: &Symmetric, volume: f64) -> Result<Factor, StokesError> {
    Factor::new(matrix, Method::default()).map_err(|_| StokesError::OutOfRange { volume })
}
