//! Facets turned to agree with their neighbours, and shells turned outward.

use super::super::geometry::normalised;
use super::super::shells::Shell;
use super::super::topology::sides;
use super::Draft;
use quasirigid_math::connected_components::connected_components;

impl Draft {
    /// Turns facets to agree with their neighbours, of each shell the fewer ones.
    pub(super) fn orient(&mut self) {
        // Across each edge: the neighbour, and whether it runs the other way.
        let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); self.triangles.len()];
        for group in sides(&self.triangles).chunk_by(|a, b| a.edge == b.edge) {
            if let [a, b] = group {
                let turned = a.ascending == b.ascending;
                neighbours[a.triangle].push((b.triangle, turned));
                neighbours[b.triangle].push((a.triangle, turned));
            }
        }
        if !neighbours.iter().flatten().any(|(_, turned)| *turned) {
            return;
        }
        let mut turns: Vec<Option<bool>> = vec![None; self.triangles.len()];
        for start in 0..self.triangles.len() {
            if turns[start].is_some() {
                continue;
            }
            turns[start] = Some(false);
            let (mut shell, mut at) = (vec![start], 0);
            while let Some(triangle) = shell.get(at).copied() {
                at += 1;
                for (other, turned) in &neighbours[triangle] {
                    if turns[*other].is_none() {
                        turns[*other] = turns[triangle].map(|turn| turn != *turned);
                        shell.push(*other);
                    }
                }
            }
            let turned = shell.iter().filter(|triangle| turns[**triangle] == Some(true)).count();
            let fewer = 2 * turned <= shell.len();
            self.repairs.reversed += turned.min(shell.len() - turned);
            for triangle in shell.into_iter().filter(|triangle| turns[*triangle] == Some(fewer)) {
                self.triangles[triangle].swap(1, 2);
            }
        }
    }

    /// Turns shells that look inward and lie in no other, and with them the shells inside: a surface that is inside out as a whole.
    pub(super) fn turn_outward(&mut self) {
        let mut pairs = Vec::new();
        for group in sides(&self.triangles).chunk_by(|a, b| a.edge == b.edge) {
            let [a, b] = group else { return }; // not closed
            pairs.push([a.triangle, b.triangle]);
        }
        let corners = normalised(&self.vertices, &self.triangles);
        let parts = connected_components(self.triangles.len(), pairs);
        let shells: Vec<Shell> = parts.into_iter().map(|part| Shell::new(&corners, part)).collect();
        if !shells.iter().any(|shell| shell.volume < 0.0) {
            return;
        }
        let around = |number: usize| -> Vec<usize> {
            let surrounds =
                |other: &usize| *other != number && shells[*other].surrounds(&shells[number], &corners);
            (0..shells.len()).filter(surrounds).collect()
        };
        let around: Vec<Vec<usize>> = (0..shells.len()).map(around).collect();
        let inverted = |number: &usize| around[*number].is_empty() && shells[*number].volume < 0.0;
        let with_it = |number: &usize| inverted(number) || around[*number].iter().any(inverted);
        let turned: Vec<usize> = (0..shells.len()).filter(with_it).collect();
        self.repairs.inverted += turned.len();
        for triangle in turned.into_iter().flat_map(|number| &shells[number].triangles) {
            self.triangles[*triangle].swap(1, 2);
        }
    }
}
