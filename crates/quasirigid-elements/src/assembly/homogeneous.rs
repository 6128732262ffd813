use super::Assembly;
use crate::element::Role;
use crate::material::Material;

impl Assembly {
    /// Material of a body that is a single ellipsoid, closed surface or solid of one material; none of any other.
    #[must_use]
    pub fn homogeneous(&self) -> Option<&Material> {
        let mut elements = self.each().filter(|(id, _)| id.kind.role() != Role::External);
        let (_, alone) = elements.next()?;
        if self.carrier.is_some() || elements.next().is_some() { None } else { alone.homogeneous() }
    }
}
