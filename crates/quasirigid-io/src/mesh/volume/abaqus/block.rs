//! Data lines of an Abaqus file, read as the keyword before them demands: nodes, cells, sets or nothing.
//! A cell may continue over several lines, so a half-read cell is kept here and refused where the block ends.

use super::kinds::Kind;
use super::sets::Filling;
use super::{Draft, MeshProblem, Other, Row, VolumeProblem};
use crate::text_file::{number, whole};
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

/// Meaning of data lines.
pub(super) enum Block {
    /// Data that are not part of the mesh.
    Skipped,
    Nodes {
        set: Option<Filling>,
    },
    Cells(Cells),
    Set(Filling),
    /// The place of an instance: a translation, then a rotation about the line between two points.
    Instance(Placing),
    /// Elements that are no cells, of a type, in a set.
    Others {
        kind: u16,
        set: Option<Filling>,
    },
    /// Cells that are counted and left out; whether the last one goes on.
    Counted {
        name: String,
        goes_on: bool,
    },
    /// Lines of a card that is kept, by its index.
    Card(usize),
}

/// Translation of an instance, and its rotation afterwards: two points of the axis and an angle (degrees).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Placing {
    translation: [f64; 3],
    rotation: Option<[f64; 7]>,
    lines: usize,
}

impl Placing {
    fn read(&mut self, line: &str) -> Result<(), MeshProblem> {
        let words = line.trim_end_matches([',', ' ']).split(',').map(str::trim);
        let numbers: Vec<f64> = words
            .map(|word| if word.is_empty() { Ok(0.0) } else { number(word, Row::InpPlace) })
            .collect::<Result<_, _>>()?;
        self.lines += 1;
        match (self.lines, numbers[..].as_ref()) {
            (1, [x, y, z]) => self.translation = [*x, *y, *z],
            (1, [x, y]) => self.translation = [*x, *y, 0.0],
            (1, [x]) => self.translation = [*x, 0.0, 0.0],
            (2, [ax, ay, az, bx, by, bz, angle]) => {
                self.rotation = Some([*ax, *ay, *az, *bx, *by, *bz, *angle]);
            }
            (_, found) => return Err(MeshProblem::Values { found: found.len(), row: Row::InpPlace }),
        }
        Ok(())
    }

    /// Whether the instance is where its part is.
    pub(super) fn is_still(&self) -> bool {
        self.translation == [0.0; 3] && self.rotation.is_none()
    }

    /// A direction of the part, as the instance turns it.
    pub(crate) fn turned(&self, direction: [f64; 3]) -> [f64; 3] {
        add(self.place(direction), scale(-1.0, self.place([0.0; 3])))
    }

    /// The place of a node of the part.
    pub(crate) fn place(&self, node: [f64; 3]) -> [f64; 3] {
        let moved = add(node, self.translation);
        let Some([ax, ay, az, bx, by, bz, angle]) = self.rotation else { return moved };
        let (start, along) = ([ax, ay, az], [bx - ax, by - ay, bz - az]);
        let length = norm(along);
        if length == 0.0 {
            return moved;
        }
        let (axis, from) = (scale(length.recip(), along), add(moved, scale(-1.0, start)));
        let (sin, cos) = angle.to_radians().sin_cos();
        let across = scale((1.0 - cos) * dot(axis, from), axis);
        add(start, add(add(scale(cos, from), scale(sin, cross(axis, from))), across))
    }
}

/// Cells of a kind, with the label and nodes read so far of the next.
pub(super) struct Cells {
    kind: Kind,
    /// Index of the type among those of the file.
    number: u16,
    set: Option<Filling>,
    label: Option<u64>,
    nodes: Vec<u64>,
}

impl Block {
    /// Reads a data line.
    pub(super) fn read(&mut self, line: &str, draft: &mut Draft) -> Result<(), MeshProblem> {
        match self {
            Self::Skipped => Ok(()),
            Self::Nodes { set } => {
                let (label, place) = node(line)?;
                let node = draft.add_node(label, place)?;
                set.map_or(Ok(()), |set| set.add(draft, &[node]))
            }
            Self::Cells(cells) => cells.read(line, draft),
            Self::Set(set) => set.read(draft, line),
            Self::Instance(placing) => placing.read(line),
            Self::Others { kind, set } => {
                let mut fields = line.trim_end_matches([',', ' ']).split(',').map(str::trim);
                let label = whole(fields.next().unwrap_or_default(), Row::InpCell)?;
                let node = |field: &str| if field.is_empty() { Ok(0) } else { whole(field, Row::InpCell) };
                let nodes = fields.map(node).collect::<Result<_, _>>()?;
                let index = draft.others.add(Other { label, kind: *kind, nodes })?;
                if let Some(set) = set {
                    set.add_others(draft, &[index]);
                }
                Ok(())
            }
            Self::Counted { .. } | Self::Card(_) => Ok(()),
        }
    }

    /// Refuses to end within a cell.
    pub(super) fn finish(&self) -> Result<(), MeshProblem> {
        match self {
            Self::Cells(cells) if cells.label.is_some() => Err(cells.wrong_count(cells.nodes.len())),
            _ => Ok(()),
        }
    }
}

/// Number and place of a node: coordinates left out are zero, and a normal may follow.
fn node(line: &str) -> Result<(u64, [f64; 3]), MeshProblem> {
    let mut fields = line.trim_end_matches([',', ' ']).split(',').map(str::trim);
    let label = whole(fields.next().unwrap_or_default(), Row::InpNode)?;
    let (mut place, mut found) = ([0.0; 3], 1);
    for field in fields {
        let value = if field.is_empty() { 0.0 } else { number(field, Row::InpNode)? };
        if let Some(x) = place.get_mut(found - 1) {
            *x = value;
        }
        found += 1;
    }
    if (2..=7).contains(&found) {
        Ok((label, place))
    } else {
        Err(MeshProblem::Values { found, row: Row::InpNode })
    }
}

impl Cells {
    pub(super) fn new(kind: Kind, number: u16, set: Option<Filling>) -> Self {
        Self { kind, number, set, label: None, nodes: Vec::new() }
    }

    fn wrong_count(&self, found: usize) -> MeshProblem {
        VolumeProblem::NodeCount { found: found as u64, shape: self.kind.shape.to_string() }.into()
    }

    /// Reads a line of a cell, which continues on the next one if a comma ends it before all nodes are there.
    fn read(&mut self, line: &str, draft: &mut Draft) -> Result<(), MeshProblem> {
        let line = line.trim_end();
        let (line, continues) = line.strip_suffix(',').map_or((line, false), |line| (line, true));
        for field in line.split(',') {
            let value = whole(field.trim(), Row::InpCell)?;
            if self.label.is_none() { self.label = Some(value) } else { self.nodes.push(value) }
        }
        let expected = self.kind.nodes();
        // A line may name a node towards which its section is turned.
        let towards = (self.kind.shape.dimension() == 1 && self.nodes.len() == expected + 1)
            .then(|| self.nodes.pop())
            .flatten();
        let found = self.nodes.len();
        if found < expected && continues {
            return Ok(());
        }
        let label = self.label.take().filter(|_| found == expected).ok_or_else(|| self.wrong_count(found))?;
        let nodes: Vec<u64> = (0..expected).map(|node| self.nodes[self.kind.place(node)]).collect();
        self.nodes.clear();
        let cell = if self.kind.pyramid {
            draft.add_pyramid(label, &nodes)?
        } else {
            draft.add_cell(label, self.kind.shape, &nodes)?
        };
        draft.types.resize(draft.cells().len(), self.number);
        draft.towards.extend(towards.map(|node| (cell, node)));
        self.set.map_or(Ok(()), |set| set.add(draft, &[cell]))
    }
}
