//! The graph of a sparse symmetric matrix, with unknowns that have the same neighbours taken as one.
//!
//! Its factor fills as that of the matrix does, and is found with a fraction of the work: a node of a mesh has three to six unknowns.

/// Vertices with their weights and neighbours, each list ascending.
pub(super) struct Graph {
    pub starts: Vec<i32>,
    pub neighbours: Vec<i32>,
    /// Unknowns of each vertex; vertices are numbered by their first unknown.
    pub members: Vec<Vec<u32>>,
}

impl Graph {
    /// The graph of a matrix whose lower triangle has these rows in each column, an edge for every entry.
    ///
    /// Unknowns are compared by a sum of hashes over their neighbours and themselves. Where two with other neighbours agree by chance,
    /// each unknown is a vertex.
    pub fn of(starts: &[usize], rows: &[u32]) -> Self {
        let members = groups(&hashes(starts, rows));
        let graph = Self::over(starts, rows, members);
        if graph.covers(starts, rows) {
            return graph;
        }
        Self::over(starts, rows, (0..starts.len() as u32 - 1).map(|unknown| vec![unknown]).collect())
    }

    /// The graph of the first unknowns of some groups.
    fn over(starts: &[usize], rows: &[u32], members: Vec<Vec<u32>>) -> Self {
        let size = starts.len() - 1;
        let vertices = vertices(size, &members);
        let mut first = vec![false; size];
        members.iter().for_each(|members| first[members[0] as usize] = true);
        let (first, numbers) = (&first, &vertices);
        let edges = || {
            members.iter().enumerate().flat_map(move |(vertex, members)| {
                let column = members[0] as usize;
                let rows = rows[starts[column]..starts[column + 1]].iter().map(|row| *row as usize);
                let others = rows.filter(|row| first[*row]).map(|row| numbers[row] as usize);
                others.filter(move |other| *other != vertex).map(move |other| (other, vertex))
            })
        };
        let mut next = vec![0_i32; members.len() + 1];
        for (one, other) in edges() {
            next[one + 1] += 1;
            next[other + 1] += 1;
        }
        (0..members.len()).for_each(|vertex| next[vertex + 1] += next[vertex]);
        let starts = next.clone();
        let mut neighbours = vec![0; starts[members.len()] as usize];
        for (one, other) in edges() {
            for (vertex, neighbour) in [(one, other), (other, one)] {
                let place = &mut next[vertex];
                neighbours[*place as usize] = neighbour as i32;
                *place += 1;
            }
        }
        Self { starts, neighbours, members }
    }

    /// Whether every entry of the matrix is within a vertex or on an edge.
    fn covers(&self, starts: &[usize], rows: &[u32]) -> bool {
        let vertices = vertices(starts.len() - 1, &self.members);
        let mut near = vec![u32::MAX; self.size()];
        (0..self.size()).all(|vertex| {
            near[vertex] = vertex as u32;
            self.neighbours(vertex).for_each(|other| near[other] = vertex as u32);
            let columns = self.members[vertex].iter().map(|column| *column as usize);
            let mut below = columns.flat_map(|column| &rows[starts[column]..starts[column + 1]]);
            below.all(|row| near[vertices[*row as usize] as usize] == vertex as u32)
        })
    }

    /// Number of vertices.
    pub fn size(&self) -> usize {
        self.members.len()
    }

    pub fn neighbours(&self, vertex: usize) -> impl Iterator<Item = usize> {
        let range = self.starts[vertex] as usize..self.starts[vertex + 1] as usize;
        self.neighbours[range].iter().map(|other| *other as usize)
    }
}

/// A number for each unknown that those with the same neighbours share.
fn hashes(starts: &[usize], rows: &[u32]) -> Vec<u64> {
    let mut hashes: Vec<u64> = (0..starts.len() - 1).map(hash).collect();
    for column in 0..hashes.len() {
        for row in rows[starts[column]..starts[column + 1]].iter().map(|row| *row as usize) {
            if row != column {
                hashes[row] = hashes[row].wrapping_add(hash(column));
                hashes[column] = hashes[column].wrapping_add(hash(row));
            }
        }
    }
    hashes
}

/// Unknowns with the same number, each list ascending, in the order of their first unknowns.
fn groups(hashes: &[u64]) -> Vec<Vec<u32>> {
    let mut order: Vec<u32> = (0..hashes.len() as u32).collect();
    order.sort_by_key(|unknown| hashes[*unknown as usize]);
    let mut groups: Vec<Vec<u32>> =
        order.chunk_by(|a, b| hashes[*a as usize] == hashes[*b as usize]).map(<[u32]>::to_vec).collect();
    groups.sort_unstable_by_key(|group| group[0]);
    groups
}

/// The vertex of each unknown.
fn vertices(size: usize, members: &[Vec<u32>]) -> Vec<u32> {
    let mut vertices = vec![0; size];
    for (vertex, group) in members.iter().enumerate() {
        group.iter().for_each(|unknown| vertices[*unknown as usize] = vertex as u32);
    }
    vertices
}

/// SplitMix64, whose sums over different sets differ.
fn hash(index: usize) -> u64 {
    let mut z = (index as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of four unknowns: no two have the same neighbours.
    #[test]
    fn unknowns_taken_as_one_by_chance_are_found() {
        let (starts, rows) = ([0, 2, 4, 6, 7], [0, 1, 1, 2, 2, 3, 3]);
        let covers = |members: &[&[u32]]| {
            let members = members.iter().map(|group| group.to_vec()).collect();
            Graph::over(&starts, &rows, members).covers(&starts, &rows)
        };
        assert!(covers(&[&[0], &[1], &[2], &[3]]));
        assert!(!covers(&[&[0, 3], &[1], &[2]]) && !covers(&[&[0], &[1, 2], &[3]]));
        let graph = Graph::of(&starts, &rows);
        assert_eq!(graph.members, [[0], [1], [2], [3]]);
        assert_eq!(graph.neighbours, [1, 0, 2, 1, 3, 2]);
    }
}
