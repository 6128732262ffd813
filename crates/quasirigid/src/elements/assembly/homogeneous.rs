use super::{Alone, Assembly};
use crate::elements::material::Material;
use crate::elements::part::{Kind, Substance};

impl Assembly {
    /// Material of a body that is one ellipsoid, one closed surface or one solid throughout, with nothing beside it; none of any other.
    #[must_use]
    pub fn homogeneous(&self) -> Option<&Material> {
        if !self.rotors.is_empty() || !self.wheels.is_empty() || !self.cavities.is_empty() {
            return None;
        }
        match self.alone().ok()? {
            Some(Alone::Ellipsoid(ellipsoid)) => Some(&ellipsoid.material),
            Some(Alone::Surface(surface)) => Some(&surface.material),
            None => self.one_solid(),
        }
    }

    fn one_solid(&self) -> Option<&Material> {
        let beside = self.carrier.is_some()
            || !self.points.is_empty()
            || !self.springs.is_empty()
            || !self.hinged.is_empty();
        let [part] = &self.parts[..] else { return None };
        let Kind::Solid(solid) = &part.kind else { return None };
        let [region] = &solid.regions[..] else { return None };
        match &region.substance {
            Substance::Isotropic(material) if !beside && part.masses.is_empty() => Some(material),
            _ => None,
        }
    }
}
