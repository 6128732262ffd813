//! Isosurface stuffing: fills a closed surface with tetrahedra of a body-centred cubic lattice.
//! The lattice bounds the angles for any surface; what it cannot resolve (thin necks, torn rings, lost volume) is refused, not meshed.
//! Method of `[@labelle2007]`.

use super::MeshingError;
use super::fineness::allowed;
use super::fit::Fit;
use super::lattice::Lattice;
use super::quadratic::Quadratic;
use super::slivers::without_slivers;
use super::stencils::cells;
use super::topology::same_topology;
use super::wall::curved;
use crate::Mesh;
use crate::surface::{ClosedSurface, Proximity};

/// Tetrahedra of the lattice in a cube of it.
pub(super) const IN_CUBE: f64 = 12.0;
/// Share of the volume by which a mesh may be off.
pub(super) const OFF: f64 = 0.03;
/// Parts of a cube by which a side may be longer than whole cubes without another cube.
const WHOLE: f64 = 1e-9;

/// Mesh of the body inside a surface, with about `resolution` cubes of a body-centred cubic lattice along the longest side of the box
/// around it, by isosurface stuffing `[@labelle2007]`.
///
/// Points of the lattice near the surface are drawn to it, tetrahedra that it cuts are cut off there, so that all corners
/// on the wall are on the surface; so are middles of edges on the wall unless a cell would bend too much. No dihedral
/// angle between straight edges is below 10.7° or above 165°. Edges and corners of the surface are cut off where they do
/// not lie in the lattice, which is aligned with the axes and with the middle of the box.
///
/// # Errors
/// [`MeshingError::Resolution`] for no cells, [`MeshingError::TooMany`], [`MeshingError::Volume`],
/// [`MeshingError::Severed`] and [`MeshingError::Torn`] if cells are too wide for the surface.
pub fn inside(surface: &ClosedSurface, resolution: usize) -> Result<Mesh, MeshingError> {
    if resolution == 0 {
        return Err(MeshingError::Resolution);
    }
    let frame = Frame::new(surface.bounds(), resolution);
    allowed(frame.cubes.into_iter().product(), resolution)?;
    let proximity = Proximity::new(surface, |point| frame.in_lattice(point));
    let volume = proximity.volume();
    allowed(IN_CUBE * volume, resolution)?;
    let lattice = Lattice::new(frame.cubes.map(|cubes| cubes as usize));
    let filling = cells(&lattice, &Fit::new(&lattice, &proximity));
    let filling = without_slivers(filling, surface.bodies(), resolution)?;
    let quadratic = Quadratic::new(&filling.cells, filling.points.len());
    let nodes = curved(filling.points, &quadratic, &proximity);
    let mut mesh = quadratic.mesh(nodes);
    // An empty sum is −0.
    let found = (0.0 + mesh.volume(&(0..mesh.cells.len()).collect::<Vec<_>>())) / volume;
    if !((found - 1.0).abs() <= OFF) {
        return Err(MeshingError::Volume { found, allowed: OFF, resolution: resolution.saturating_mul(2) });
    }
    same_topology(surface, &filling.cells, resolution)?;
    mesh.nodes.iter_mut().for_each(|node| *node = frame.in_space(*node));
    Ok(mesh)
}

/// Frame of the lattice: its origin, the side of its cubes, and their numbers, with one to spare on each side.
pub(super) struct Frame {
    origin: [f64; 3],
    pub side: f64,
    pub cubes: [f64; 3],
}

impl Frame {
    pub fn new([low, high]: [[f64; 3]; 2], resolution: usize) -> Self {
        // Halves do not overflow.
        let half: [f64; 3] = std::array::from_fn(|axis| 0.5 * high[axis] - 0.5 * low[axis]);
        let middle: [f64; 3] = std::array::from_fn(|axis| 0.5 * high[axis] + 0.5 * low[axis]);
        let side = half.into_iter().fold(0.0, f64::max) / (0.5 * resolution as f64);
        let cubes = half.map(|half| (2.0 * (half / side) - WHOLE).ceil().max(1.0) + 2.0);
        let origin = std::array::from_fn(|axis| middle[axis] - 0.5 * cubes[axis] * side);
        Self { origin, side, cubes }
    }

    pub fn in_lattice(&self, point: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| (point[axis] - self.origin[axis]) / self.side)
    }

    pub fn in_space(&self, point: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| self.origin[axis] + self.side * point[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{angles_deg, assert_valid};
    use super::*;
    use crate::surface::testing::{ball, ball_triangles, block, cube, prism, turned};

    /// A ball of radius 1 without a ball of radius ½ off its middle.
    fn hollow(place: impl Fn([f64; 3]) -> [f64; 3]) -> ClosedSurface {
        let (mut vertices, mut triangles) = ball_triangles(5);
        let (inner, inward) = ball_triangles(4);
        let first = vertices.len();
        vertices.extend(inner.into_iter().map(|[x, y, z]| [0.5 * x + 0.1, 0.5 * y, 0.5 * z]));
        triangles.extend(inward.into_iter().map(|[a, b, c]| [a + first, c + first, b + first]));
        ClosedSurface::new(vertices.into_iter().map(place).collect(), triangles).unwrap()
    }

    /// Relative error of the volume of a mesh, after checks that the mesh is valid, that angles are within their bounds, and
    /// that nodes of the wall are on the surface: all corners, and all middles of edges but a few.
    fn error(surface: &ClosedSurface, mesh: &Mesh, euler: i64) -> f64 {
        let wall = assert_valid(mesh, euler);
        let [least, most] = angles_deg(mesh);
        assert!(least > 10.7 && most < 165.0, "{least} {most}");
        let proximity = Proximity::new(surface, |at| at);
        let size = surface.bounds()[1].into_iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        let on = |node: &usize| proximity.nearest(mesh.nodes[*node]).distance.abs() < 1e-14 * size;
        assert!(wall.iter().all(|face| face[..3].iter().all(on)));
        let straight = wall.iter().flat_map(|face| &face[3..]).filter(|node| !on(node)).count();
        assert!(10 * straight < 3 * wall.len(), "{straight} of {}", 3 * wall.len());
        mesh.volume(&(0..mesh.cells.len()).collect::<Vec<_>>()) / surface.volume() - 1.0
    }

    #[test]
    fn balls_have_their_volume_in_any_unit() {
        for unit in [1e-3, 1.0, 1e3] {
            let surface = ball(6, turned(unit));
            let mesh = inside(&surface, 10).unwrap();
            assert_eq!(mesh.cells.len(), inside(&ball(6, turned(1.0)), 10).unwrap().cells.len());
            let error = error(&surface, &mesh, 2);
            assert!(error.abs() < 1e-3, "{error:e}");
        }
    }

    #[test]
    fn a_cube_along_the_axes_is_exact() {
        for resolution in 1..5 {
            let surface = cube(|at| at.map(|x| 3.0 * x + 0.1));
            let mesh = inside(&surface, resolution).unwrap();
            assert!(error(&surface, &mesh, 2).abs() < 1e-13);
            assert_eq!(mesh.cells.len(), 12 * resolution.pow(3) + 12 * resolution.pow(2));
        }
    }

    #[test]
    fn sharp_edges_cost_volume_by_the_second_power_of_the_width() {
        let errors =
            |surface: &ClosedSurface| [12, 24].map(|n| error(surface, &inside(surface, n).unwrap(), 2));
        for [coarse, fine] in [errors(&cube(turned(1e3))), errors(&block(turned(1.0)))] {
            assert!(coarse < 0.0 && coarse > -0.03 && fine > coarse / 3.0, "{coarse:e} {fine:e}");
        }
    }

    #[test]
    fn a_body_within_a_cavity_is_left_out() {
        for unit in [1e-3, 1.0, 1e3] {
            let surface = hollow(turned(unit));
            assert_eq!(surface.bodies(), 1);
            let error = error(&surface, &inside(&surface, 10).unwrap(), 4);
            assert!(error.abs() < 2e-3, "{error:e}");
        }
    }

    #[test]
    fn too_few_and_too_many_cells_are_refused_with_what_to_try() {
        let surface = cube(|[x, y, z]| turned(1.0)([x, y, 0.1 * z]));
        let refusal = inside(&surface, 6).unwrap_err();
        assert!(
            matches!(refusal, MeshingError::Volume { found, resolution: 12, .. } if found < 0.97),
            "{refusal}"
        );
        assert_eq!(inside(&surface, 0), Err(MeshingError::Resolution));
        for resolution in [100_000, usize::MAX] {
            assert!(matches!(inside(&surface, resolution), Err(MeshingError::TooMany { .. })));
        }
        // 12 × 75³ is just above five million.
        let refusal = inside(&cube(|at| at), 75);
        assert!(matches!(refusal, Err(MeshingError::TooMany { resolution: 74, .. })));
        let message = MeshingError::Volume { found: 0.5, allowed: OFF, resolution: 12 }.to_string();
        assert!(
            message.starts_with(
                "the mesh has 50.0 % of the volume that the surface encloses, more than 3 % off"
            )
        );
    }

    #[test]
    fn a_neck_that_is_too_thin_is_refused() {
        // Two squares of side 4, joined by a neck 2 long and 0.2 wide.
        let [thin, wide] = [0.1, 2.0];
        let outline = [
            [-5.0, -wide],
            [-1.0, -wide],
            [-1.0, -thin],
            [1.0, -thin],
            [1.0, -wide],
            [5.0, -wide],
            [5.0, wide],
            [1.0, wide],
            [1.0, thin],
            [-1.0, thin],
            [-1.0, wide],
            [-5.0, wide],
        ];
        let filling = [
            [0, 1, 2],
            [0, 2, 9],
            [0, 9, 11],
            [9, 10, 11],
            [2, 3, 8],
            [2, 8, 9],
            [3, 4, 5],
            [3, 5, 6],
            [3, 6, 8],
            [6, 7, 8],
        ];
        let surface = prism(&outline, &filling, |[x, y, z]| [x, y, 4.0 * z + 0.05]);
        let refusal = inside(&surface, 10).unwrap_err();
        assert_eq!(refusal, MeshingError::Severed { parts: 2, bodies: 1, resolution: 20 });
    }
}
