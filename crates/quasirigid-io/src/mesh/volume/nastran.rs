use std::path::Path;

use quasirigid_mesh::Mesh;

use super::VolumeProblem;
use crate::mesh::error::MeshError;
use crate::nastran::model;
use crate::text_file::FileError;

/// The solids, plates and lines of a deck, with what else it has.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<(Mesh, Vec<String>), MeshError> {
    let refused = |error: FileError<crate::matrix::MatrixProblem>| MeshError {
        file: error.file,
        place: error.place,
        problem: VolumeProblem::Card(error.problem).into(),
    };
    let model = model::read(file, bytes).map_err(refused)?;
    let cells = model.cells().map_err(|fault| refused(model.located(fault)))?;
    let mut notes = model.notes();
    notes.extend(cells.notes());
    let beside = [
        (model.tips.len(), "CONM2"),
        (model.springs.len() + model.bushes.len(), "springs and bushings"),
        (model.stiff.len() + model.means.len(), "rigid elements"),
        (model.materials.len(), "materials"),
    ];
    let beside: Vec<String> = beside
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if !beside.is_empty() {
        notes.push(format!("read as a mesh alone, without its {}; a [[deck]] takes them", beside.join(", ")));
    }
    Ok((cells.mesh, notes))
}
