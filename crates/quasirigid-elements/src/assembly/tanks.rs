//! Liquids of the tanks of a body, settled together: the centre of mass that a spin passes through depends on where each of them lies.

use nalgebra::{Matrix3, Matrix3x2, Vector3};

use crate::Assembly;
use crate::error::{ElementError, ElementId, ElementKind, Field, at};
use crate::kinds::tank::{Settled, Sloshing, TankError};
use crate::model::Invariants;
use crate::{SettledTank, Settling};

/// Settlements of all liquids, each with the centre of mass of the one before.
const ROUNDS: usize = 60;
/// Movement of the centre of mass in a settlement, as a share of its distance from the tanks, at which it is found.
const STILL: f64 = 1e-13;

/// Greatest share of the differences of the moments of inertia of a body by which that of its liquids may be uncertain.
const MOST_UNCERTAIN: f64 = 0.2;

impl Assembly {
    /// Number of coordinates of the liquids of tanks.
    pub(super) fn slosh_coordinates(&self) -> usize {
        self.tanks.iter().map(|tank| tank.coordinates()).sum()
    }

    /// Liquids of the tanks, in a body whose other parts have this mass (kg) and centre (m), spinning about that of the whole, or about a
    /// point that is held.
    pub(super) fn sloshing(
        &self,
        rest: (f64, Vector3<f64>),
        held: Option<Vector3<f64>>,
    ) -> Result<Vec<(ElementId, Sloshing)>, ElementError> {
        let id = |index: usize| ElementKind::Tank.at(index);
        let settled = self.settled(rest, held)?;
        let each = self.tanks.iter().zip(&settled).enumerate();
        each.map(|(index, (tank, settled))| Ok((id(index), tank.sloshing(id(index), settled)?))).collect()
    }

    /// Settled liquids with the share by which the inertia of those that a spin settled is uncertain: they turn with the body, and an ideal
    /// liquid that oscillates does not. (U9)
    pub(super) fn carried_along(
        &self,
        tanks: Vec<SettledTank>,
        invariants: &Invariants,
    ) -> Result<Vec<SettledTank>, ElementError> {
        let [xx, yy, zz, yz, zx, xy] = invariants.J;
        let J = Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
        let known = |(index, tank): (usize, SettledTank)| {
            let Settling::Spin(spin) = tank.settled_by else { return Ok(tank) };
            let axis = Vector3::from(spin).normalize();
            let polar = axis.dot(&(J * axis));
            let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
            let across = Matrix3x2::from_columns(&[first, axis.cross(&first)]);
            let moments = (across.transpose() * J * across).symmetric_eigenvalues();
            let gap = moments.iter().map(|moment| (polar - moment).abs()).fold(f64::INFINITY, f64::min);
            let share = tank.drag[0].max(tank.drag[1]) / gap;
            if share <= MOST_UNCERTAIN {
                return Ok(SettledTank { inertia_share: share, ..tank });
            }
            let error = TankError::Uncertain { share, most: MOST_UNCERTAIN };
            Err(at(ElementKind::Tank.at(index), Field::new("settled_by"))(error.into()))
        };
        tanks.into_iter().enumerate().map(known).collect()
    }

    fn settled(
        &self,
        (mass, center): (f64, Vector3<f64>),
        held: Option<Vector3<f64>>,
    ) -> Result<Vec<Settled>, ElementError> {
        let mut about = held.unwrap_or(center);
        for _ in 0..ROUNDS {
            let settle =
                |(index, tank): (usize, &crate::Tank)| tank.settle(ElementKind::Tank.at(index), about);
            let settled = self.tanks.iter().enumerate().map(settle).collect::<Result<Vec<_>, _>>()?;
            let liquid: f64 = settled.iter().map(|liquid| liquid.mass).sum();
            let first: Vector3<f64> =
                settled.iter().map(|liquid| liquid.mass * liquid.center_of_mass()).sum();
            let next = held.unwrap_or((mass * center + first) / (mass + liquid));
            let size =
                settled.iter().map(|liquid| (liquid.center_of_mass() - next).norm()).fold(0.0, f64::max);
            let still = (next - about).norm() <= STILL * (size + next.norm());
            if still {
                return Ok(settled);
            }
            about = next;
        }
        let error = TankError::Weightless { cause: "the liquids find no rest in this spin".into() };
        Err(at(ElementKind::Tank.at(0), Field::new("settled_by"))(error.into()))
    }
}
