use super::Assembly;
use crate::ElementId;
use crate::model::Rheology;

impl Assembly {
    /// Every rheology with the element that has it; those of a part in the order of its regions, members or layers.
    pub fn rheologies_mut(&mut self) -> impl Iterator<Item = (ElementId, &mut Rheology)> {
        self.each_mut().flat_map(|(id, element)| {
            element.rheologies_mut().into_iter().map(move |rheology| (id, rheology))
        })
    }
}
