//! Polygons of VTK, from either kind of file.

use super::array::Array;
use super::{Fault, MeshProblem, VolumeProblem};
use crate::mesh::draft::Draft;

/// Surface while its file is read.
#[derive(Default)]
pub(in crate::mesh) struct Polygons {
    pub(in crate::mesh) draft: Draft,
}

impl Polygons {
    /// Adds the points of a piece; returns the index of the first.
    pub(super) fn points(&mut self, array: Array<'_>) -> Result<usize, Fault> {
        let first = self.draft.vertices.len();
        let origin = array.origin.clone();
        let values = array.values.into_reals();
        if let Some(place) = values.iter().position(|x| !x.is_finite()) {
            return Err((
                origin.place(place),
                MeshProblem::NotFinite { found: values[place].to_string().into() },
            ));
        }
        self.draft.vertices.extend(values.as_chunks::<3>().0);
        Ok(first)
    }

    /// Adds polygons, or strips of triangles, whose corners are points of the piece from `first` on.
    pub(super) fn cells(
        &mut self,
        corners: &Array<'_>,
        ends: &Array<'_>,
        first: usize,
        strips: bool,
    ) -> Result<(), Fault> {
        let (all, mut start, mut polygon) = (corners.whole()?, 0, Vec::new());
        let points = self.draft.vertices.len() - first;
        for (cell, end) in ends.whole()?.iter().enumerate() {
            let here = usize::try_from(*end).ok().and_then(|end| all.get(start..end));
            let here = here.ok_or_else(|| {
                let (end, total) = (end.unsigned_abs(), all.len() as u64);
                let problem = VolumeProblem::Offset { cell: cell as u64, start: start as u64, end, total };
                (ends.origin.place(cell), problem.into())
            })?;
            polygon.clear();
            for (place, corner) in here.iter().enumerate() {
                let index = usize::try_from(*corner).ok().filter(|index| *index < points);
                let index = index.and_then(|index| u32::try_from(first + index).ok());
                polygon.push(index.ok_or_else(|| {
                    let found = corner.to_string().into();
                    let problem = MeshProblem::NoSuchVertex { found, first: 0, vertices: points };
                    (corners.origin.place(start + place), problem)
                })?);
            }
            start += here.len();
            if strips {
                for (k, corners) in polygon.windows(3).enumerate() {
                    let [a, b] = if k % 2 == 0 { [0, 1] } else { [1, 0] };
                    self.draft.polygon(&[corners[a], corners[b], corners[2]], 0);
                }
            } else {
                self.draft.polygon(&polygon, 0);
            }
        }
        Ok(())
    }

    /// Tells what is no face.
    pub(super) fn left_out(&mut self, kind: &str, count: u64) {
        if count > 0 {
            self.draft.remarks.push(format!("{count} {kind} left out"));
        }
    }
}
