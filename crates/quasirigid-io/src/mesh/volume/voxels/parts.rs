//! Parts of voxels that faces join.

/// Part of each solid voxel, from the largest on, and the numbers of their voxels; the first axis runs fastest.
pub(super) fn parts([x, y, z]: [usize; 3], solid: &[bool]) -> (Vec<Option<usize>>, Vec<usize>) {
    let mut of_part: Vec<Option<usize>> = vec![None; solid.len()];
    let mut sizes = Vec::new();
    let mut open = Vec::new();
    for start in 0..solid.len() {
        if !solid[start] || of_part[start].is_some() {
            continue;
        }
        let part = sizes.len();
        sizes.push(0);
        of_part[start] = Some(part);
        open.push(start);
        while let Some(voxel) = open.pop() {
            sizes[part] += 1;
            let [i, j, k] = [voxel % x, voxel / x % y, voxel / (x * y)];
            let neighbours = [
                (i > 0).then(|| voxel - 1),
                (i + 1 < x).then(|| voxel + 1),
                (j > 0).then(|| voxel - x),
                (j + 1 < y).then(|| voxel + x),
                (k > 0).then(|| voxel - x * y),
                (k + 1 < z).then(|| voxel + x * y),
            ];
            for next in neighbours.into_iter().flatten() {
                if solid[next] && of_part[next].is_none() {
                    of_part[next] = Some(part);
                    open.push(next);
                }
            }
        }
    }
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|part| (std::cmp::Reverse(sizes[*part]), *part));
    let mut rank = vec![0; sizes.len()];
    order.iter().enumerate().for_each(|(at, part)| rank[*part] = at);
    of_part.iter_mut().flatten().for_each(|part| *part = rank[*part]);
    let sizes = order.into_iter().map(|part| sizes[part]).collect();
    (of_part, sizes)
}
