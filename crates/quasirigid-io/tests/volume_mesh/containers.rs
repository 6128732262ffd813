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
    file.integers("elem_ss1", &[3], None, &[2, 3, 1]);
    file.integers("side_ss1", &[3], None, &[5, 1, 6]);
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
        let base = mesh.sets.iter().find(|set| set.name == "ss9").map(|set| set.nodes.len());
        assert_eq!(base, Some(if quadratic { 8 } else { 4 }));
        assert_eq!(
            read.notes,
            [
                "left out: 1 SPHERE of 1 nodes",
                "sides of cells that are left out, or that have no such side, are left out (2)",
                "pyramids are two tetrahedra each (2)",
            ]
        );
    }
}

/// A plane: a normal and a distance.
type Plane = ([f64; 3], f64);

const fn across(normal: [f64; 3], distance: f64) -> Plane {
    (normal, distance)
}

const X0: Plane = across([1.0, 0.0, 0.0], 0.0);
const X1: Plane = across([1.0, 0.0, 0.0], 1.0);
const Y0: Plane = across([0.0, 1.0, 0.0], 0.0);
const Y1: Plane = across([0.0, 1.0, 0.0], 1.0);
const Z0: Plane = across([0.0, 0.0, 1.0], 0.0);
const Z1: Plane = across([0.0, 0.0, 1.0], 1.0);

/// The nodes of each side, as Exodus numbers sides, are those of the cell on its plane.
#[test]
fn sets_of_sides_are_the_nodes_on_their_planes() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let cube = [square, square.map(|[x, y, _]| [x, y, 1.0])].concat();
    let tet = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let wedge: Vec<[f64; 3]> =
        tet[..3].iter().copied().chain(tet[..3].iter().map(|[x, y, _]| [*x, *y, 1.0])).collect();
    let pyramid = [square.to_vec(), vec![[0.5, 0.5, 1.0]]].concat();
    let ring = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let hex = [ring.to_vec(), vec![[0, 4], [1, 5], [2, 6], [3, 7], [4, 5], [5, 6], [6, 7], [7, 4]]].concat();
    let prism = vec![[0, 1], [1, 2], [2, 0], [0, 3], [1, 4], [2, 5], [3, 4], [4, 5], [5, 3]];
    let four = vec![[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
    let five = [ring.to_vec(), vec![[0, 4], [1, 4], [2, 4], [3, 4]]].concat();
    let slant = across([1.0, 1.0, 1.0], 1.0);
    let upright = across([1.0, 1.0, 0.0], 1.0);
    let sides = [
        across([0.0, 2.0, -1.0], 0.0),
        across([2.0, 0.0, 1.0], 2.0),
        across([0.0, 2.0, 1.0], 2.0),
        across([2.0, 0.0, -1.0], 0.0),
        Z0,
    ];
    let flat = vec![Y0, X1, Y1, X0];
    let cells = [
        ("HEX", cube, hex, vec![Y0, X1, Y1, X0, Z0, Z1]),
        ("TETRA", tet, four, vec![Y0, slant, X0, Z0]),
        ("WEDGE", wedge, prism, vec![Y0, upright, X0, Z0, Z1]),
        ("PYRAMID", pyramid, five, sides.to_vec()),
        ("QUAD", square.to_vec(), ring.to_vec(), flat.clone()),
        ("SHELL", square.to_vec(), ring.to_vec(), [vec![Z0, Z0], flat].concat()),
    ];
    for (name, corners, edges, planes) in cells {
        for curved in [false, true] {
            let mut nodes = corners.clone();
            if curved {
                let middle = |[a, b]: &[usize; 2]| [0, 1, 2].map(|k| 0.5 * (corners[*a][k] + corners[*b][k]));
                nodes.extend(edges.iter().map(middle));
            }
            let mut file = Classic::default();
            for (axis, name) in ["coordx", "coordy", "coordz"].iter().enumerate() {
                file.reals(name, &nodes.iter().map(|node| node[axis]).collect::<Vec<_>>());
            }
            let all: Vec<i32> = (1..=nodes.len() as i32).collect();
            file.integers("eb_prop1", &[1], None, &[30]);
            file.integers("connect1", &[1, nodes.len()], Some(name), &all);
            let numbers: Vec<i32> = (1..=planes.len() as i32).collect();
            file.integers("ss_prop1", &[planes.len()], None, &numbers);
            for side in &numbers {
                file.integers(&format!("elem_ss{side}"), &[1], None, &[1]);
                file.integers(&format!("side_ss{side}"), &[1], None, &[*side]);
            }
            let mesh = volume_of(std::path::Path::new("a.exo"), &file.file()).unwrap().mesh;
            for (side, (normal, distance)) in (1..).zip(&planes) {
                let on = |place: &[f64; 3]| {
                    (place.iter().zip(normal).map(|(x, n)| x * n).sum::<f64>() - distance).abs() < 1e-12
                };
                let expected: Vec<usize> = (0..nodes.len()).filter(|node| on(&nodes[*node])).collect();
                let found = mesh.sets.iter().find(|set| set.name == format!("ss{side}")).unwrap();
                assert_eq!(found.nodes, expected, "{name} {side}");
            }
        }
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
