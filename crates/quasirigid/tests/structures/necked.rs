//! A family of necked bodies: cross-sections along a line, joined by straight tetrahedra that end on the same triangles however
//! many they are.

use std::f64::consts::TAU;

use nalgebra::{Rotation3, Vector3};
use quasirigid_mesh::{Cell, Mesh, Shape};

/// A body whose cross-sections are polygons about a line, with a tip at both ends.
pub struct Necked {
    pub name: &'static str,
    /// Whether an edge runs around its neck, where stresses have no bound.
    pub creased: bool,
    /// Places along the line and radii there; tips have none.
    stations: Vec<[f64; 2]>,
    /// Corners of a polygon.
    around: usize,
    /// Map from the straight body to the body.
    place: fn(Vector3<f64>) -> Vector3<f64>,
}

impl Necked {
    /// Straight tetrahedra, with so many layers from the line to the surface.
    pub fn mesh(&self, layers: usize) -> Mesh {
        let inner = &self.stations[1..self.stations.len() - 1];
        let size = 1 + layers * self.around;
        // Within a section the middle is last, so that the order of two nodes on the surface does not depend on the layers.
        let number = |station: usize, layer: usize, step: usize| {
            let own = if layer == 0 { size - 1 } else { (layers - layer) * self.around + step % self.around };
            station * size + own
        };
        let mut places = Vec::new();
        for [x, r] in inner {
            for layer in (1..=layers).rev() {
                for step in 0..self.around {
                    let angle = TAU * step as f64 / self.around as f64;
                    let r = r * layer as f64 / layers as f64;
                    places.push(Vector3::new(*x, r * angle.cos(), r * angle.sin()));
                }
            }
            places.push(Vector3::new(*x, 0.0, 0.0));
        }
        let tips = [places.len(), places.len() + 1];
        places.extend([0, self.stations.len() - 1].map(|end| Vector3::new(self.stations[end][0], 0.0, 0.0)));
        let section =
            |station: usize| disc([self.around, layers], |layer, step| number(station, layer, step));
        let mut cells: Vec<[usize; 4]> = Vec::new();
        for station in 0..inner.len() - 1 {
            for mut triangle in section(station) {
                triangle.sort_unstable();
                let [p, q, r] = triangle;
                let [u, v, w] = triangle.map(|node| node + size);
                cells.extend([[p, q, r, w], [p, q, v, w], [p, u, v, w]]);
            }
        }
        for (station, tip) in [(0, tips[0]), (inner.len() - 1, tips[1])] {
            cells.extend(section(station).into_iter().map(|[a, b, c]| [a, b, c, tip]));
        }
        let nodes: Vec<Vector3<f64>> = places.into_iter().map(self.place).collect();
        straight(&nodes, cells)
    }
}

/// Triangles of a disc of so many steps around and layers from its middle.
pub fn disc([around, layers]: [usize; 2], at: impl Fn(usize, usize) -> usize) -> Vec<[usize; 3]> {
    let mut triangles = Vec::new();
    for step in 0..around {
        triangles.push([at(0, 0), at(1, step), at(1, step + 1)]);
        for layer in 1..layers {
            triangles.push([at(layer, step), at(layer + 1, step), at(layer + 1, step + 1)]);
            triangles.push([at(layer, step), at(layer + 1, step + 1), at(layer, step + 1)]);
        }
    }
    triangles
}

/// Straight tetrahedra, turned so that their volumes are positive.
pub fn straight(nodes: &[Vector3<f64>], cells: Vec<[usize; 4]>) -> Mesh {
    let upright = |mut cell: [usize; 4]| {
        let [a, b, c, d] = cell.map(|node| nodes[node]);
        if (b - a).cross(&(c - a)).dot(&(d - a)) < 0.0 {
            cell.swap(0, 1);
        }
        cell
    };
    let cell = |(index, cell): (usize, [usize; 4])| Cell {
        label: index as u64 + 1,
        shape: Shape::Tet4,
        nodes: Box::new(upright(cell)),
    };
    Mesh {
        node_labels: (1..=nodes.len() as u64).collect(),
        cells: cells.into_iter().enumerate().map(cell).collect(),
        nodes: nodes.iter().map(|node| (*node).into()).collect(),
        sets: Vec::new(),
    }
}

/// A ball's part of an outline, from the tip to an angle from the line, in steps that shrink towards the neck.
fn arc(radius: f64, to: f64, steps: usize) -> Vec<[f64; 2]> {
    (0..=steps)
        .map(|step| {
            let left = 1.0 - step as f64 / steps as f64;
            let angle = to.to_radians() * (1.0 - left.powf(1.6));
            [-radius * angle.cos(), radius * angle.sin()]
        })
        .collect()
}

/// Balls of two radii that meet in a circle of a radius, or have a rod of it and a length between them.
fn balls([one, other]: [f64; 2], neck: f64, rod: f64, steps: usize) -> Vec<[f64; 2]> {
    let [first, second] = [one, other].map(|radius| (neck / radius).asin().to_degrees());
    let depth = |radius: f64, angle: f64| radius * angle.to_radians().cos();
    let mut stations = arc(one, 180.0 - first, steps);
    let start = depth(one, first);
    let pieces = (rod / (2.0 * neck)).ceil() as usize;
    stations.extend((1..pieces).map(|piece| [start + rod * piece as f64 / pieces as f64, neck]));
    let middle = start + rod + depth(other, second);
    let mut last: Vec<[f64; 2]> =
        arc(other, 180.0 - second, steps).into_iter().map(|[x, r]| [middle - x, r]).collect();
    last.reverse();
    stations.extend(&last[usize::from(rod == 0.0)..]);
    stations
}

/// An oval of Cassini, with its neck over its greatest width along the line of foci.
fn oval(neck: f64, steps: usize) -> Vec<[f64; 2]> {
    // a² − c² and a² + c² of the curve, with half its length 1.
    let least = neck * neck;
    let (square, focus) = (0.5 * (1.0 + least), 0.5 * (1.0 - least));
    (0..=steps)
        .map(|step| {
            let x = -(std::f64::consts::PI * step as f64 / steps as f64).cos();
            let r = (square * square + 4.0 * focus * x * x).sqrt() - x * x - focus;
            [x, r.max(0.0).sqrt()]
        })
        .collect()
}

/// Tips of radius zero, whatever rounding says.
fn tipped(mut stations: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let last = stations.len() - 1;
    stations[0][1] = 0.0;
    stations[last][1] = 0.0;
    stations
}

fn turned(place: Vector3<f64>) -> Vector3<f64> {
    Rotation3::from_euler_angles(0.7, -0.4, 1.9) * place
}

/// Twelve bodies: smooth and creased, equal and unequal, straight, bent and flat, off-centre, rotated, in odd units.
pub fn family() -> Vec<Necked> {
    let necked = |name: &'static str, stations, around, place| {
        let creased = !name.contains("oval") && !name.contains("peanut");
        Necked { name, creased, stations: tipped(stations), around, place }
    };
    let straight: fn(Vector3<f64>) -> Vector3<f64> = |place| place;
    vec![
        necked("oval, neck 0.5", oval(0.5, 18), 12, straight),
        necked("oval, neck 0.3, far off", oval(0.3, 20), 12, |x| {
            700.0 * turned(x) + Vector3::new(3e3, -900.0, 40.0)
        }),
        necked("oval, neck 0.15", oval(0.15, 24), 12, |x| 1e-3 * turned(x)),
        necked("contact binary, neck 0.9", balls([1.0, 1.0], 0.9, 0.0, 8), 12, turned),
        necked("contact binary, neck 0.6", balls([1.0, 1.0], 0.6, 0.0, 8), 12, straight),
        necked("contact binary, neck 0.3", balls([1.0, 1.0], 0.3, 0.0, 8), 12, |x| 1e3 * turned(x)),
        necked("contact binary, neck 0.2", balls([1.0, 1.0], 0.2, 0.0, 10), 12, turned),
        necked("comet of unequal lobes", balls([1.2, 0.8], 0.45, 0.0, 8), 12, |x| {
            1e3 * turned(Vector3::new(x.x + 0.4, 0.9 * x.y, 0.7 * x.z + 0.2 * x.x * x.x))
        }),
        necked("dumbbell, rod 0.25", balls([1.0, 1.0], 0.25, 1.5, 8), 12, turned),
        necked("dumbbell, thin rod, unequal", balls([1.0, 0.6], 0.12, 1.0, 9), 10, straight),
        necked("bent peanut", oval(0.45, 20), 12, |x| {
            40.0 * turned(Vector3::new(x.x, x.y + 0.4 * x.x * x.x, 0.8 * x.z))
        }),
        necked("flat bilobe", balls([1.0, 1.0], 0.5, 0.0, 8), 14, |x| {
            1e2 * turned(Vector3::new(x.x, x.y, 0.4 * x.z))
        }),
    ]
}
