//! Carrier with everything inside locked: what remains of a body when every part on it is taken away.

use nalgebra::{Matrix3, Vector3};

use crate::error::ElementError;
use crate::{Assembly, Carrier};

impl Assembly {
    /// Carrier with the liquids inside it, of tanks what does not slosh, as one rigid body; none of a body without a carrier.
    ///
    /// # Errors
    /// [`ElementError`] for a carrier, a rotor or a liquid that cannot be.
    pub fn locked_carrier(&self) -> Result<Option<Carrier>, ElementError> {
        let Some(carrier) = &self.carrier else { return Ok(None) };
        let mut rigid = vec![(carrier.piece()?, carrier.position())];
        for (id, element) in self.each() {
            rigid.extend(element.inner(id, 0)?.into_iter().flat_map(|inner| inner.rigid));
        }
        if !self.tanks.is_empty() {
            let about = self.held_point()?.map_or_else(|| Ok(self.body()?.center_of_mass().into()), Ok)?;
            let tanks = self.sloshing((0.0, about), Some(about))?;
            rigid.extend(tanks.into_iter().map(|(_, sloshing)| sloshing.rest));
        }
        let mass = rigid.iter().map(|(piece, _)| piece.mass).sum::<f64>();
        let first = rigid.iter().map(|(piece, base)| piece.first + piece.mass * base);
        let center = first.sum::<Vector3<f64>>() / mass;
        let second = rigid.iter().fold(Matrix3::zeros(), |sum, (piece, base)| {
            let (arm, first) = (base - center, piece.first);
            let across: Matrix3<f64> = arm * first.transpose();
            sum + piece.second + across + across.transpose() + piece.mass * arm * arm.transpose()
        });
        let inertia = second.trace() * Matrix3::identity() - second;
        Ok(Some(Carrier { mass, center_of_mass: center.into(), inertia: inertia.into() }))
    }
}
