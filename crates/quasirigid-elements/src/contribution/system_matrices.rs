//! System matrices: the sums of stiffness and damping over the coordinates of a body, and its dissipators.

use crate::ElementError;
use crate::math::sparse::SparseRows;
use crate::model::{Dissipator, Rheology, Viscoelastic};
use crate::structure::{Block, Entries};

/// Stiffness and damping of all coordinates, the viscoelastic parts of the stiffness, and the dissipators. (I9), (G1), (D1)
pub(crate) struct Matrices {
    pub stiffness: SparseRows<f64>,
    pub damping: SparseRows<f64>,
    pub viscoelastic: Vec<Viscoelastic>,
    pub dissipators: Vec<Dissipator>,
}

/// A dissipator while its entries are collected.
struct Draft {
    name: String,
    damping: Entries,
    loss: Option<(Rheology, Entries)>,
    kelvin_voigt: Option<f64>,
}

impl Matrices {
    /// Sums the blocks of a body of this many coordinates, and the friction of internal rotors and liquids, by name.
    pub fn sum(
        size: usize,
        blocks: impl Iterator<Item = Result<Block, ElementError>>,
        friction: &[(String, Entries)],
    ) -> Result<Self, ElementError> {
        let (mut stiffness, mut damping): (Entries, Entries) = (Vec::new(), Vec::new());
        let mut materials: Vec<(Rheology, Entries)> = Vec::new();
        let mut drafts: Vec<Draft> = Vec::new();
        for block in blocks {
            let block = block?;
            let elastic = block.entries(&block.stiffness);
            let (viscous, loss) = block.losses(&elastic);
            if let Some((rheology, entries)) = &loss {
                match materials.iter_mut().find(|(known, _)| known == rheology) {
                    Some((_, sum)) => sum.extend_from_slice(entries),
                    None => materials.push((rheology.clone(), entries.clone())),
                }
            }
            damping.extend_from_slice(&viscous);
            stiffness.extend(elastic);
            let time = if let Rheology::KelvinVoigt { time } = block.rheology { Some(time) } else { None };
            Draft::add(&mut drafts, &block.name, &viscous, loss, time);
        }
        for (name, entries) in friction {
            damping.extend_from_slice(entries);
            Draft::add(&mut drafts, name, entries, None, None);
        }
        let viscoelastic =
            |(rheology, entries)| Viscoelastic { rheology, stiffness: SparseRows::sum(size, entries) };
        Ok(Self {
            stiffness: SparseRows::sum(size, stiffness),
            damping: SparseRows::sum(size, damping),
            viscoelastic: materials.into_iter().map(viscoelastic).collect(),
            dissipators: drafts.into_iter().map(|draft| draft.finished(size)).collect(),
        })
    }
}

impl Draft {
    /// Adds damping and loss to the dissipator of a name; an entry with neither adds none.
    fn add(
        drafts: &mut Vec<Self>,
        name: &str,
        damping: &Entries,
        loss: Option<(Rheology, Entries)>,
        kelvin_voigt: Option<f64>,
    ) {
        let damping = damping.iter().copied().filter(|(_, _, entry)| *entry != 0.0);
        let mut damping = damping.peekable();
        if damping.peek().is_none() && loss.is_none() {
            return;
        }
        let joins = |draft: &&mut Self| {
            let same = match (&draft.loss, &loss) {
                (Some((known, _)), Some((rheology, _))) => known == rheology,
                _ => true,
            };
            same && draft.name == name
        };
        let Some(draft) = drafts.iter_mut().find(joins) else {
            drafts.push(Self { name: name.to_owned(), damping: damping.collect(), loss, kelvin_voigt });
            return;
        };
        draft.damping.extend(damping);
        draft.kelvin_voigt = [draft.kelvin_voigt, kelvin_voigt].into_iter().flatten().reduce(f64::max);
        match (&mut draft.loss, loss) {
            (Some((_, entries)), Some((_, more))) => entries.extend(more),
            (known @ None, more) => *known = more,
            (Some(_), None) => {}
        }
    }

    fn finished(self, size: usize) -> Dissipator {
        let viscoelastic =
            |(rheology, entries)| Viscoelastic { rheology, stiffness: SparseRows::sum(size, entries) };
        Dissipator {
            name: self.name,
            damping: SparseRows::sum(size, self.damping),
            loss: self.loss.map(viscoelastic),
            kelvin_voigt: self.kelvin_voigt,
        }
    }
}
