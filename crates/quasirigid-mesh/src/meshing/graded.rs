//! Cells of a lattice that is finer around a neck.

use super::fineness::allowed;
use super::fit::Fit;
use super::inside::{Frame, IN_CUBE, OFF};
use super::jacobian::six_volumes;
use super::lattice::Lattice;
use super::quadratic::Quadratic;
use super::slivers::without_slivers;
use super::stencils::cells;
use super::topology::same_topology;
use super::wall::curved;
use super::{MeshingError, Neck};
use crate::Mesh;
use crate::surface::{ClosedSurface, Proximity};
use quasirigid_math::vec3::{add, norm, scale};

/// A mesh with the width of its cells.
#[derive(Clone, Debug)]
pub struct GradedMesh {
    /// Curved tetrahedra.
    pub mesh: Mesh,
    /// Side of the cubes of its lattice, at the neck around which they are finest.
    pub side: f64,
    grading: Option<Grading>,
}

impl GradedMesh {
    /// Side of the cubes of the lattice at a place.
    #[must_use]
    pub fn width(&self, place: [f64; 3]) -> f64 {
        self.side * self.grading.as_ref().map_or(1.0, |grading| grading.growth(place))
    }
}

/// A map of space, radial about a point, `ρ → s asinh(ρ/s)`: cubes of the lattice there are cells here that grow with the
/// distance. (G11)
#[derive(Clone, Copy, Debug)]
struct Grading {
    center: [f64; 3],
    scale: f64,
}

/// Radius, in those of a neck, within which cells are about equal.
const EVEN: f64 = 1.5;
/// Distance to the surface, in sides of a cube, below which corners are on it.
const ON: f64 = 1e-9;
/// Sag of a triangle in the map, as a share of a neck's radius, that is allowed, and the number of triangles up to which they are divided
/// for it.
const SAG: f64 = 0.02;
const MOST_TRIANGLES: usize = 60_000;

/// Mesh of the body inside a surface, with about so many cells; they are finest around a neck, if one is given, and grow with the distance
/// from it.
///
/// # Errors
/// As [`inside`](super::inside); [`MeshingError::Folded`] if cells are too wide for the map.
pub fn graded(
    surface: &ClosedSurface,
    neck: Option<&Neck>,
    cells: usize,
) -> Result<GradedMesh, MeshingError> {
    let grading = neck.map(|neck| Grading { center: neck.center, scale: EVEN * neck.radius });
    let Some(map) = grading else { return fill(surface, surface, None, cells) };
    let mut triangles = (surface.vertices().to_vec(), surface.triangles().to_vec());
    let least = SAG * map.scale / EVEN;
    while triangles.1.len() < MOST_TRIANGLES / 4 && map.sag(&triangles) > least {
        triangles = divided(triangles);
    }
    let vertices = triangles.0.into_iter().map(|place| map.there(place)).collect();
    // A surface that the map folds is filled evenly.
    match ClosedSurface::new(vertices, triangles.1) {
        Ok(mapped) => fill(surface, &mapped, grading, cells),
        Err(_) => fill(surface, surface, None, cells),
    }
}

/// Fills a surface with the cells of a lattice that fit its image.
fn fill(
    surface: &ClosedSurface,
    image: &ClosedSurface,
    grading: Option<Grading>,
    count: usize,
) -> Result<GradedMesh, MeshingError> {
    let resolution = resolution(image, count);
    let frame = Frame::new(image.bounds(), resolution);
    allowed(frame.cubes.into_iter().product(), resolution)?;
    let proximity = Proximity::new(image, |point| frame.in_lattice(point));
    allowed(IN_CUBE * proximity.volume(), resolution)?;
    let lattice = Lattice::new(frame.cubes.map(|cubes| cubes as usize));
    let filling = cells(&lattice, &Fit::new(&lattice, &proximity));
    let mut filling = without_slivers(filling, surface.bodies(), resolution)?;
    // Places of the body, in sides of a cube.
    let [low, high] = surface.bounds();
    let middle: [f64; 3] = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
    let here = |place: [f64; 3]| scale(frame.side.recip(), add(place, scale(-1.0, middle)));
    let real = Proximity::new(surface, here);
    if let Some(map) = &grading {
        for point in &mut filling.points {
            let on = proximity.nearest(*point).distance.abs() < ON;
            let place = here(map.back(frame.in_space(*point)));
            *point = if on { real.nearest(place).at } else { place };
        }
        let folded = |cell: &&[usize; 4]| !(six_volumes(cell.map(|corner| filling.points[corner])) > 0.0);
        let count = filling.cells.iter().filter(folded).count();
        if count > 0 {
            return Err(MeshingError::Folded { count, cells: filling.cells.len() });
        }
    } else {
        filling.points.iter_mut().for_each(|point| *point = here(frame.in_space(*point)));
    }
    let quadratic = Quadratic::new(&filling.cells, filling.points.len());
    let nodes = curved(filling.points, &quadratic, &real);
    let mut mesh = quadratic.mesh(nodes);
    let found = mesh.volume(&(0..mesh.cells.len()).collect::<Vec<_>>()) / real.volume();
    if !((found - 1.0).abs() <= OFF) {
        return Err(MeshingError::Volume { found, allowed: OFF, resolution: resolution.saturating_mul(2) });
    }
    same_topology(surface, &filling.cells, resolution)?;
    mesh.nodes.iter_mut().for_each(|node| *node = add(scale(frame.side, *node), middle));
    Ok(GradedMesh { mesh, side: frame.side, grading })
}

/// Cubes along the longest side for about so many cells.
fn resolution(image: &ClosedSurface, cells: usize) -> usize {
    let [low, high] = image.bounds();
    let longest = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let share = image.volume() / longest.powi(3);
    ((cells as f64 / (IN_CUBE * share)).cbrt().round() as usize).max(4)
}

impl Grading {
    fn radial(&self, place: [f64; 3], map: impl Fn(f64) -> f64) -> [f64; 3] {
        let arm = add(place, scale(-1.0, self.center));
        let share = norm(arm) / self.scale;
        // The map is odd and has slope one.
        let stretch = if share > 0.0 { map(share) / share } else { 1.0 };
        add(self.center, scale(stretch, arm))
    }

    fn there(&self, place: [f64; 3]) -> [f64; 3] {
        self.radial(place, f64::asinh)
    }

    fn back(&self, place: [f64; 3]) -> [f64; 3] {
        self.radial(place, f64::sinh)
    }

    /// Growth of cells along the radius.
    fn growth(&self, place: [f64; 3]) -> f64 {
        1.0_f64.hypot(norm(add(place, scale(-1.0, self.center))) / self.scale)
    }

    /// Largest sag of an edge in the map, in its lengths.
    fn sag(&self, (vertices, triangles): &(Vec<[f64; 3]>, Vec<[usize; 3]>)) -> f64 {
        let bend = |[a, b]: [[f64; 3]; 2]| {
            let middle = self.there(scale(0.5, add(a, b)));
            norm(add(middle, scale(-0.5, add(self.there(a), self.there(b)))))
        };
        let edges = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        edges.map(|ends| bend(ends.map(|end| vertices[end]))).fold(0.0, f64::max)
    }
}

/// Each triangle cut in four.
fn divided((mut vertices, triangles): (Vec<[f64; 3]>, Vec<[usize; 3]>)) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let mut middles = std::collections::HashMap::new();
    let mut finer = Vec::with_capacity(4 * triangles.len());
    for [a, b, c] in triangles {
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[i, j]| {
            *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                vertices.push(scale(0.5, add(vertices[i], vertices[j])));
                vertices.len() - 1
            })
        });
        finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    (vertices, finer)
}

#[cfg(test)]
mod tests {
    use super::super::testing::assert_valid;
    use super::super::{inside, necks};
    use super::*;
    use crate::surface::testing::{ball, turned};

    fn waisted(unit: f64) -> ClosedSurface {
        ball(24, |[x, y, z]| {
            let share = 0.15 + 0.85 * (2.0 * x * x).min(1.0);
            turned(unit)([2.0 * x, share * y, share * z])
        })
    }

    #[test]
    fn cells_are_finest_in_the_neck_and_fill_the_body_in_any_unit() {
        let even = inside(&waisted(1.0), 16).unwrap();
        for unit in [1e-4, 1.0, 1e4] {
            let surface = waisted(unit);
            let neck = necks(&surface).unwrap()[0];
            let found = graded(&surface, Some(&neck), 3000).unwrap();
            assert_valid(&found.mesh, 2);
            let count = found.mesh.cells.len();
            assert!((1500..6000).contains(&count) && count < even.cells.len(), "{count}");
            assert!(neck.radius / found.width(neck.center) > 1.5, "{} {}", neck.radius, found.side);
            let volume = found.mesh.volume(&(0..count).collect::<Vec<_>>()) / surface.volume();
            assert!((volume - 1.0).abs() < 0.01, "{volume}");
        }
    }

    #[test]
    fn the_map_is_undone() {
        let map = Grading { center: [3.0, -1.0, 2.0], scale: 0.2 };
        for place in [[3.0, -1.0, 2.0], [3.1, -1.0, 2.3], [-8.0, 4.0, 9.0]] {
            let error = norm(add(map.back(map.there(place)), scale(-1.0, place)));
            assert!(error < 1e-13 * norm(place), "{error:e}");
        }
    }
}
