//! The graph of a sparse symmetric matrix, with unknowns that have the same neighbours taken as one.

/// Vertices with their weights and neighbours, each list ascending.
pub(super) struct Graph {
    pub starts: Vec<i32>,
    pub neighbours: Vec<i32>,
    /// Unknowns of each vertex; vertices are numbered by their first unknown.
    pub members: Vec<Vec<u32>>,
}

impl Graph {
    /// The graph of a matrix whose lower triangle has these rows in each column.
    ///
    /// Unknowns are compared by a sum of hashes over their neighbours and themselves. Two that are taken as one by
    /// chance cost a little fill; the order stays valid.
    pub fn of(starts: &[usize], rows: &[u32]) -> Self {
        let size = starts.len() - 1;
        let pairs = || {
            (0..size).flat_map(|column| {
                let below = rows[starts[column]..starts[column + 1]]
                    .iter()
                    .filter(move |row| **row as usize != column);
                below.map(move |row| (*row as usize, column))
            })
        };
        let mut hashes: Vec<u64> = (0..size).map(hash).collect();
        for (row, column) in pairs() {
            hashes[row] = hashes[row].wrapping_add(hash(column));
            hashes[column] = hashes[column].wrapping_add(hash(row));
        }
        let (vertices, members) = groups(&hashes);
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

    /// Number of vertices.
    pub fn size(&self) -> usize {
        self.members.len()
    }

    pub fn neighbours(&self, vertex: usize) -> impl Iterator<Item = usize> {
        let range = self.starts[vertex] as usize..self.starts[vertex + 1] as usize;
        self.neighbours[range].iter().map(|other| *other as usize)
    }
}

/// The vertex of each unknown, and the unknowns of each vertex.
fn groups(hashes: &[u64]) -> (Vec<u32>, Vec<Vec<u32>>) {
    let mut order: Vec<u32> = (0..hashes.len() as u32).collect();
    order.sort_by_key(|unknown| hashes[*unknown as usize]);
    let mut members: Vec<Vec<u32>> =
        order.chunk_by(|a, b| hashes[*a as usize] == hashes[*b as usize]).map(<[u32]>::to_vec).collect();
    members.sort_unstable_by_key(|group| group[0]);
    let mut vertices = vec![0; hashes.len()];
    for (vertex, group) in members.iter().enumerate() {
        group.iter().for_each(|unknown| vertices[*unknown as usize] = vertex as u32);
    }
    (vertices, members)
}

/// SplitMix64, whose sums over different sets differ.
fn hash(index: usize) -> u64 {
    let mut z = (index as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
