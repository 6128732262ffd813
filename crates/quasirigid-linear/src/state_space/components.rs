//! States that depend on each other, so that eigenvalues of one group keep their digits whatever the others are: angles that nothing
//! depends on have exact zeros.

use super::Real;

/// Groups of states that depend on each other, in an order that makes a matrix block upper triangular.
pub(super) fn dependent(A: &Real) -> Vec<Vec<usize>> {
    let reached = reached(A);
    let reaches = |from: usize, to: usize| reached[from][to / 64] >> (to % 64) & 1 == 1;
    let count = |state: usize| reached[state].iter().map(|word| word.count_ones()).sum::<u32>();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for state in 0..A.nrows() {
        let own = |group: &&mut Vec<usize>| reaches(group[0], state) && reaches(state, group[0]);
        match groups.iter_mut().find(own) {
            Some(group) => group.push(state),
            None => groups.push(vec![state]),
        }
    }
    // a state that depends on another reaches more than that
    groups.sort_by_key(|group| std::cmp::Reverse(count(group[0])));
    groups
}

/// For each state the states that it depends on, directly or not, and itself; bits by words.
fn reached(A: &Real) -> Vec<Vec<u64>> {
    let size = A.nrows();
    let mut reached = vec![vec![0_u64; size.div_ceil(64)]; size];
    for (row, bits) in reached.iter_mut().enumerate() {
        let on = (0..size).filter(|column| *column == row || A[(row, *column)] != 0.0);
        on.for_each(|column| bits[column / 64] |= 1 << (column % 64));
    }
    for through in 0..size {
        let beyond = reached[through].clone();
        for bits in reached.iter_mut().filter(|bits| bits[through / 64] >> (through % 64) & 1 == 1) {
            bits.iter_mut().zip(&beyond).for_each(|(word, other)| *word |= other);
        }
    }
    reached
}
