use quasirigid_elements::PartReduction;

use super::super::key::{Keys, integer, key};
use super::super::table::Table;

pub(in crate::model) const REDUCTION: Keys = Keys {
    known: &[key(
        "modes",
        integer(0, MOST_MODES as u64).or("0"),
        "vibrations retained beside the slow motion",
    )],
};

const MOST_MODES: usize = 500;

/// Reads `[reduction]`: number of coordinates of the parts beside those that the order asks for.
pub(in crate::model) fn reduction(file: &Table<'_>) -> Option<PartReduction> {
    let default = PartReduction::default();
    let Some(table) = file.table("reduction", "[reduction]", &REDUCTION) else {
        return file.get("reduction").is_none().then_some(default);
    };
    let modes = table.read_or("modes", default.modes, |value| value.integer(0..=MOST_MODES));
    Some(PartReduction { modes: modes?, ..default })
}
