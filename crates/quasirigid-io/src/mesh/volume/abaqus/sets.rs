//! Node and element sets of an Abaqus file: lists, ranges, and sets within sets.
//! A range has the members that exist, as in Abaqus; its labels are not counted out where they outnumber the nodes or cells.

use super::{Draft, Kinds as Part, MeshProblem, Row, VolumeProblem};
use crate::text_file::whole;

/// A set that is being filled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Filling {
    /// Index among the sets.
    place: usize,
    /// Whether the set takes cells instead of nodes.
    of_cells: bool,
    /// Whether lines are ranges.
    ranges: bool,
    /// Whether members that do not exist are passed over: they may have been left out.
    some: bool,
    /// Added to the numbers in the lines, which are those of an instance.
    shift: u64,
}

impl Filling {
    pub(super) fn new(draft: &mut Draft, name: &str, of_cells: bool, ranges: bool) -> Self {
        Self {
            place: draft.sets.place(&name.to_ascii_uppercase(), name),
            of_cells,
            ranges,
            some: false,
            shift: 0,
        }
    }

    /// The same where members may have been left out.
    pub(super) fn of_some(self) -> Self {
        Self { some: true, ..self }
    }

    /// The same for numbers of an instance.
    pub(super) fn shifted(self, shift: u64) -> Self {
        Self { shift, ..self }
    }

    fn part(self) -> Part {
        if self.of_cells { Part::Cells } else { Part::Nodes }
    }

    fn index(self, draft: &Draft, label: u64) -> Option<usize> {
        let label = label.saturating_add(self.shift);
        if self.of_cells { draft.cell(label) } else { draft.node(label) }
    }

    /// Adds nodes or cells by their indices.
    pub(super) fn add(self, draft: &mut Draft, members: &[usize]) -> Result<(), MeshProblem> {
        match self.of_cells {
            true => draft.sets.add_cells(self.place, members),
            false => draft.sets.add_nodes(self.place, members),
        }
    }

    /// Adds elements that are no cells.
    pub(super) fn add_others(self, draft: &mut Draft, members: &[usize]) {
        let name = draft.sets.name(self.place).to_owned();
        draft.others.put(&name, members);
    }

    /// A line of the set.
    pub(super) fn read(self, draft: &mut Draft, line: &str) -> Result<(), MeshProblem> {
        let fields = line.trim_end_matches([',', ' ']).split(',').map(str::trim);
        if self.ranges {
            return self.read_range(draft, &fields.collect::<Vec<_>>());
        }
        for field in fields {
            match field.parse() {
                Ok(label) => {
                    let index = self.index(draft, label);
                    let other = draft.others.of(label.saturating_add(self.shift));
                    if let Some(other) = other.filter(|_| self.of_cells && index.is_none()) {
                        self.add_others(draft, &[other]);
                        continue;
                    }
                    if index.is_none() && self.some {
                        continue;
                    }
                    self.add(draft, &[index.ok_or_else(|| self.no_such(draft, field))?])?;
                }
                Err(_) => self.add_set(draft, field)?,
            }
        }
        Ok(())
    }

    fn no_such(self, draft: &Draft, label: &str) -> VolumeProblem {
        let label = label.chars().take(80).collect();
        VolumeProblem::NoSuchMember { set: draft.sets.name(self.place).to_owned(), part: self.part(), label }
    }

    /// Members of another set, by its name.
    fn add_set(self, draft: &mut Draft, name: &str) -> Result<(), MeshProblem> {
        let set = draft.sets.of_key(&name.trim_matches('"').to_ascii_uppercase());
        let members = set.map(|set| if self.of_cells { set.cells.clone() } else { set.nodes.clone() });
        let others =
            if self.of_cells { draft.others.set(name.trim_matches('"')).to_vec() } else { Vec::new() };
        let members = members.unwrap_or_default();
        if members.is_empty() && others.is_empty() && !self.some {
            return Err(self.no_such(draft, name).into());
        }
        if !others.is_empty() {
            self.add_others(draft, &others);
        }
        self.add(draft, &members)
    }

    /// Nodes of the cells of another set.
    pub(super) fn add_nodes_of(self, draft: &mut Draft, cells: &str) -> Result<(), MeshProblem> {
        let set = draft.sets.of_key(&cells.to_ascii_uppercase()).filter(|set| !set.cells.is_empty());
        let no_such = || VolumeProblem::NoSuchMember {
            set: draft.sets.name(self.place).to_owned(),
            part: Part::Cells,
            label: cells.to_owned(),
        };
        let cells = &set.ok_or_else(no_such)?.cells;
        let second = cells.iter().filter_map(|cell| draft.pyramids.get(cell)).map(|pyramid| pyramid.second);
        let all = cells.iter().copied().chain(second);
        let mut nodes: Vec<usize> = all.flat_map(|cell| draft.cells()[cell].nodes.iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        self.add(draft, &nodes)
    }

    /// Adds the members of a range that exist; the fields are first, last and step, which is one where left out.
    fn read_range(self, draft: &mut Draft, fields: &[&str]) -> Result<(), MeshProblem> {
        let (first, last, step) = match *fields {
            [first, last] => (first, last, "1"),
            [first, last, step] => (first, last, step),
            _ => return Err(MeshProblem::Values { found: fields.len(), row: Row::InpRange }),
        };
        let [from, to, step] = [first, last, step].map(|word| whole(word, Row::InpRange));
        let (from, to, step) = (from?, to?, step?);
        if step == 0 {
            return Err(MeshProblem::NotANumber { found: "step 0".into(), row: Row::InpRange });
        }
        let inside = |label: &u64| {
            let label = label.wrapping_sub(self.shift);
            (from..=to).contains(&label) && (label - from).is_multiple_of(step)
        };
        let all = if self.of_cells { draft.cells().len() } else { draft.node_labels().len() };
        let members: Vec<usize> = if to.saturating_sub(from) / step < all as u64 {
            (from..=to).step_by(step as usize).filter_map(|label| self.index(draft, label)).collect()
        } else if self.of_cells {
            (0..all).filter(|cell| inside(&draft.cells()[*cell].label)).collect()
        } else {
            (0..all).filter(|node| inside(&draft.node_labels()[*node])).collect()
        };
        let shifted = [from.saturating_add(self.shift), to.saturating_add(self.shift), step];
        let others = if self.of_cells { draft.others.between(shifted) } else { Vec::new() };
        if !others.is_empty() {
            self.add_others(draft, &others);
            return self.add(draft, &members);
        }
        if members.is_empty() && !self.some {
            return Err(self.no_such(draft, &format!("{first} to {last}")).into());
        }
        self.add(draft, &members)
    }
}
