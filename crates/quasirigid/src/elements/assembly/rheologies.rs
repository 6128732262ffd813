use super::Assembly;
use crate::elements::{ElementId, ElementKind};
use crate::model::Rheology;

impl Assembly {
    /// Every rheology with the element that has it; those of a part in the order of its regions, members or layers.
    pub fn rheologies_mut(&mut self) -> impl Iterator<Item = (ElementId, &mut Rheology)> {
        let Self { ellipsoids, surfaces, parts, connections, springs, hinged, .. } = self;
        let parts = parts.iter_mut().enumerate().flat_map(|(index, part)| {
            part.kind
                .rheologies_mut()
                .into_iter()
                .map(move |rheology| (ElementKind::Part.at(index), rheology))
        });
        numbered(ElementKind::Ellipsoid, ellipsoids.iter_mut().map(|element| &mut element.material.rheology))
            .chain(numbered(
                ElementKind::Surface,
                surfaces.iter_mut().map(|element| &mut element.material.rheology),
            ))
            .chain(parts)
            .chain(numbered(
                ElementKind::Connection,
                connections.iter_mut().map(|element| &mut element.rheology),
            ))
            .chain(numbered(ElementKind::Spring, springs.iter_mut().map(|element| &mut element.rheology)))
            .chain(numbered(ElementKind::Hinged, hinged.iter_mut().map(|element| &mut element.rheology)))
    }
}

fn numbered<'a>(
    kind: ElementKind,
    list: impl Iterator<Item = &'a mut Rheology>,
) -> impl Iterator<Item = (ElementId, &'a mut Rheology)> {
    list.enumerate().map(move |(index, rheology)| (kind.at(index), rheology))
}
