//! Exodus and MED: pyramids, what is left out, and files that are neither. The shapes are in the zoo.

use insta::assert_snapshot;
use quasirigid_io::mesh::volume_of;
use quasirigid_mesh::{Mesh, Shape};

use super::{bytes, says};

/// Name, dimensions, `elem_type`, type and bytes.
type Variable = (String, Vec<u32>, Option<&'static str>, u32, Vec<u8>);

/// A classic netCDF file, by the guide to its format.
#[derive(Default)]
struct Classic {
    dimensions: Vec<u32>,
    variables: Vec<Variable>,
}

impl Classic {
    fn add(
        &mut self,
        name: &str,
        lengths: &[usize],
        element: Option<&'static str>,
        kind: u32,
        bytes: Vec<u8>,
    ) {
        let first = self.dimensions.len() as u32;
        self.dimensions.extend(lengths.iter().map(|length| *length as u32));
        let dimensions = (first..first + lengths.len() as u32).collect();
        self.variables.push((name.into(), dimensions, element, kind, bytes));
    }

    fn reals(&mut self, name: &str, values: &[f64]) {
        self.add(
            name,
            &[values.len()],
            None,
            6,
            values.iter().flat_map(|value| value.to_be_bytes()).collect(),
        );
    }

    fn integers(&mut self, name: &str, lengths: &[usize], element: Option<&'static str>, values: &[i32]) {
        self.add(name, lengths, element, 4, values.iter().flat_map(|value| value.to_be_bytes()).collect());
    }

    fn file(&self) -> Vec<u8> {
        let long = |value: u32| value.to_be_bytes().to_vec();
        let name = |name: &str| {
            let fill = vec![0; name.len().next_multiple_of(4) - name.len()];
            [long(name.len() as u32), name.as_bytes().to_vec(), fill].concat()
        };
        let header = |starts: &[u32]| {
            let mut bytes =
                [b"CDF\x01".to_vec(), long(0), long(10), long(self.dimensions.len() as u32)].concat();
            for (index, length) in self.dimensions.iter().enumerate() {
                bytes.extend([name(&format!("d{index}")), long(*length)].concat());
            }
            bytes.extend([long(12), long(1), name("title"), long(2), name("ab")].concat());
            bytes.extend([long(11), long(self.variables.len() as u32)].concat());
            for ((label, dimensions, element, kind, data), start) in self.variables.iter().zip(starts) {
                bytes.extend([name(label), long(dimensions.len() as u32)].concat());
                dimensions.iter().for_each(|dimension| bytes.extend(long(*dimension)));
                match element {
                    Some(element) => {
                        bytes.extend([long(12), long(1), name("elem_type"), long(2), name(element)].concat());
                    }
                    None => bytes.extend([long(0), long(0)].concat()),
                }
                bytes.extend([long(*kind), long(data.len() as u32), long(*start)].concat());
            }
            bytes
        };
        let zeros = vec![0; self.variables.len()];
        let mut at = header(&zeros).len() as u32;
        let starts: Vec<u32> = self
            .variables
            .iter()
            .map(|(.., data)| {
                let start = at;
                at += data.len() as u32;
                start
            })
            .collect();
        let mut bytes = header(&starts);
        self.variables.iter().for_each(|(.., data)| bytes.extend(data));
        bytes
    }
}

/// Two pyramids on the sides of one square, which is no plane, and a body of one node; of 13 nodes with the middles of their edges.
fn pyramids(quadratic: bool) -> Vec<u8> {
    let corners = [
        [3.0, 1.0, -2.0],
        [5.0, 1.25, -2.5],
        [5.5, 3.0, -1.75],
        [3.25, 2.75, -2.25],
        [4.0, 2.0, 1.0],
        [4.25, 1.75, -5.0],
    ];
    let mut nodes = corners.to_vec();
    let mut cells = vec![vec![2, 3, 4, 1, 5], vec![3, 2, 1, 4, 6]];
    if quadratic {
        let edges = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];
        let mut known: Vec<([i32; 2], i32)> = Vec::new();
        for cell in &mut cells {
            for [a, b] in edges {
                let edge = [cell[a].min(cell[b]), cell[a].max(cell[b])];
                let middle = known.iter().find(|(other, _)| *other == edge).map(|(_, middle)| *middle);
                cell.push(middle.unwrap_or_else(|| {
                    let [a, b] = edge.map(|node: i32| corners[node as usize - 1]);
                    nodes.push([0, 1, 2].map(|axis| 0.5 * a[axis] + 0.5 * b[axis]));
                    known.push((edge, nodes.len() as i32));
                    nodes.len() as i32
                }));
            }
        }
    }
    let mut file = Classic::default();
    for (axis, name) in ["coordx", "coordy", "coordz"].iter().enumerate() {
        file.reals(name, &nodes.iter().map(|node| node[axis]).collect::<Vec<_>>());
    }
    let per_cell = cells[0].len();
    file.integers("eb_prop1", &[2], None, &[30, 40]);
    file.integers("connect1", &[2, per_cell], Some("PYRAMID"), &cells.concat());
    file.integers("connect2", &[1, 1], Some("SPHERE"), &[3]);
    file.integers("ss_prop1", &[1], None, &[9]);
    file.file()
}

/// Six times the volume over the triangles of a surface.
fn six_volumes(mesh: &Mesh, triangles: &[[usize; 3]]) -> f64 {
    let volume = |[a, b, c]: &[usize; 3]| {
        let [a, b, c] = [a, b, c].map(|node| mesh.nodes[*node]);
        (0..3)
            .map(|k| a[k] * (b[(k + 1) % 3] * c[(k + 2) % 3] - b[(k + 2) % 3] * c[(k + 1) % 3]))
            .sum::<f64>()
    };
    triangles.iter().map(volume).sum()
}

/// Both pyramids divide their common base along one diagonal, so that nothing is between them.
#[test]
fn pyramids_are_tetrahedra_that_fill_them() {
    for quadratic in [false, true] {
        let read = volume_of(std::path::Path::new("a.exo"), &pyramids(quadratic)).unwrap();
        let (mesh, shape) = (&read.mesh, if quadratic { Shape::Tet10 } else { Shape::Tet4 });
        assert!(mesh.cells.len() == 4 && mesh.cells.iter().all(|cell| cell.shape == shape));
        assert_eq!(mesh.cells.iter().map(|cell| cell.label).collect::<Vec<_>>(), [1, 1, 2, 2]);
        let total: f64 = (0..4).map(|cell| mesh.volume(&[cell])).sum();
        // the eight triangles from the square to both tops
        let square = [0, 1, 2, 3].map(|corner| [corner, (corner + 1) % 4]);
        let sides = square.iter().flat_map(|[a, b]| [[*a, *b, 4], [*b, *a, 5]]);
        let expected = six_volumes(mesh, &sides.collect::<Vec<_>>()) / 6.0;
        assert!((total / expected - 1.0).abs() < 1e-14, "{total} and not {expected}");
        assert_eq!(mesh.nodes.len(), if quadratic { 6 + 12 + 1 } else { 6 });
        assert_eq!(
            read.notes,
            [
                "left out: 1 SPHERE of 1 nodes",
                "sets of sides are left out (1); sets of nodes are read",
                "pyramids are two tetrahedra each (2)",
            ]
        );
    }
}

#[test]
fn containers_of_other_things_are_refused() {
    let mut other = Classic::default();
    other.reals("temperature", &[1.0, 2.0]);
    assert_snapshot!(says("a.nc", other.file()), @"a.nc: the netCDF file has neither the variables of Exodus nor the mesh of MED; save the mesh as one of them");
    let mut short = Classic::default();
    short.reals("coordx", &[0.0, 1.0]);
    short.reals("coordy", &[0.0]);
    short.integers("eb_prop1", &[1], None, &[1]);
    assert_snapshot!(says("a.exo", short.file()), @r#"a.exo: the array "coordy" has 1 values instead of 2; is the file damaged?"#);
    let file = pyramids(false);
    assert!(says("a.exo", &file[..file.len() - 20]).contains("was it cut off"));
    let med = bytes("zoo.med");
    assert!(!says("a.med", &med[..med.len() / 2]).is_empty());
    let mut builder = hdf5_pure::FileBuilder::new();
    builder.create_dataset("x").with_f64_data(&[1.0]).with_shape(&[1]);
    assert_snapshot!(says("a.h5", builder.finish().unwrap()), @"a.h5: the HDF5 file has neither the variables of Exodus nor the mesh of MED; save the mesh as one of them");
}
