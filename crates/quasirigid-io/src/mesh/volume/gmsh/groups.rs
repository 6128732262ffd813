use std::collections::HashMap;

use super::source::Source;
use super::{Draft, Fault, MeshProblem, Part, Row, VolumeProblem};

/// Physical groups: their names, and those that each entity belongs to.
#[derive(Default)]
pub(super) struct Groups {
    names: HashMap<(i64, i64), String>,
    /// Groups by dimension and number of the entity, once the file has listed its entities.
    pub(super) of_entity: Option<HashMap<(i64, i64), Vec<i64>>>,
}

impl Groups {
    /// `$PhysicalNames`: dimension, number and name of each group. Makes their sets, which may stay empty.
    pub(super) fn read_names(&mut self, source: &mut Source, draft: &mut Draft) -> Result<(), Fault> {
        source.announce(Part::Names, 1);
        source.start_text(Row::GmshCount)?;
        let count: u64 = source.parsed()?;
        source.finish_text()?;
        source.announce(Part::Names, count);
        for _ in 0..count {
            source.start_text(Row::GmshName)?;
            let group = (source.parsed()?, source.parsed()?);
            let quoted = source.remainder()?;
            let name = quoted.strip_prefix('"').and_then(|name| name.strip_suffix('"'));
            let wrong =
                || (source.place(), MeshProblem::Unexpected { found: quoted.into(), row: Row::GmshName });
            let name = name.ok_or_else(wrong)?;
            draft.sets.place(name, name);
            self.names.insert(group, name.to_owned());
            source.count();
        }
        source.close("PhysicalNames")
    }

    /// Place of the set of a group. Gmsh writes a group with a minus for entities that it takes reversed.
    pub(super) fn set(&self, draft: &mut Draft, dimension: i64, group: i64) -> usize {
        let number = i64::try_from(group.unsigned_abs()).unwrap_or(i64::MAX);
        match self.names.get(&(dimension, number)) {
            Some(name) => draft.sets.place(name, name),
            None => {
                let name = number.to_string();
                draft.sets.place(&name, &name)
            }
        }
    }

    /// Places of the sets of an entity; of none where the file lists no entities.
    pub(super) fn sets(
        &self,
        draft: &mut Draft,
        dimension: i64,
        tag: i64,
    ) -> Result<Vec<usize>, VolumeProblem> {
        let Some(of_entity) = &self.of_entity else { return Ok(Vec::new()) };
        let groups =
            of_entity.get(&(dimension, tag)).ok_or(VolumeProblem::NoSuchEntity { dimension, tag })?;
        Ok(groups.iter().map(|group| self.set(draft, dimension, *group)).collect())
    }
}
