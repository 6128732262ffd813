//! Relaxed surface: every vertex less its displacement in the rotation, to first order in it.

use std::collections::HashMap;

use super::{displaced, small};
use crate::contribution::{BuildOptions, WholeBody};
use crate::element::Element;
use crate::error::{ElementError, ElementKind, Field, Problem, at};
use crate::math::sym3::{self, Sym, times};
use crate::math::vec3::{add, dot, norm, scale};
use crate::visual::Visual;
use crate::{Assembly, Surface};
use quasirigid_mesh::surface::{ClosedSurface, nearest_weights};

/// Steps in which the bulge and the rotation that makes it are found from each other: periods are those of a rotation by the share of the
/// bulge in the difference of the moments.
const STEPS: usize = 4;

/// The surface without its spin, and the inertia tensor of that in rotation. (G18)
pub(super) fn relaxed<E: From<ElementError>>(
    given: &Surface,
    assembly: &Assembly,
    products: &impl Fn([Sym; 2]) -> Result<Sym, E>,
) -> Result<(Surface, Sym), E> {
    let id = ElementKind::Surface.at(0);
    let asked = BuildOptions { errors: false, visuals: true };
    let Some(WholeBody { body, visuals, .. }) = given.whole(id, assembly.reduction, asked)? else {
        return Err(at(id, Field::SHAPE)(Problem::NoObservedShape).into());
    };
    let Some(field) = visuals.first() else {
        return Err(at(id, Field::SHAPE)(Problem::NoObservedShape).into());
    };
    let still = body.invariants().J;
    let mut relaxed = still;
    let mut q = Vec::new();
    for _ in 0..STEPS {
        q = displaced(&body, products([relaxed, still])?, id)?;
        let spun = body.full_inertia_at(&q);
        relaxed = std::array::from_fn(|i| 2.0 * still[i] - spun[i]);
    }
    let field = Displacements::new(field, &q);
    let center = given.surface.centroid();
    let [low, high] = given.surface.bounds();
    let size = norm([0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis])));
    let mut vertices = given.surface.vertices().to_vec();
    let mut most = 0.0_f64;
    for vertex in &mut vertices {
        let moved = field.at(add(*vertex, scale(-1.0, center)));
        most = most.max(norm(moved));
        *vertex = add(*vertex, scale(-1.0, moved));
    }
    small(most / size, id)?;
    let surface = ClosedSurface::new(vertices, given.surface.triangles().to_vec())
        .map_err(|_| at(id, Field::SHAPE)(Problem::TooSoft { strain: most / size }))?;
    let mut found = Surface { surface, ..given.clone() };
    found.material.density *= given.surface.volume() / found.surface.volume();
    let (spun, own) = (body.full_inertia_at(&q), found.inertia());
    let inertia = std::array::from_fn(|i| own[i] + (spun[i] - still[i]));
    Ok((found, inertia))
}

/// Displacements (m) of the drawn surface of a body.
struct Displacements<'a> {
    visual: &'a Visual,
    moved: Vec<[f64; 3]>,
    /// Vertices by the bits of their places.
    exact: HashMap<[u64; 3], usize>,
    /// Gradient of the homogeneous deformation nearest to them, by rows.
    gradient: [[f64; 3]; 3],
}

impl<'a> Displacements<'a> {
    fn new(visual: &'a Visual, q: &[f64]) -> Self {
        let mut moved = vec![[0.0; 3]; visual.vertices.len()];
        for (coordinate, shape) in &visual.shapes {
            let all = moved.iter_mut().zip(shape);
            all.for_each(|(sum, shape)| *sum = add(*sum, scale(q[*coordinate], *shape)));
        }
        let exact = visual.vertices.iter().enumerate();
        let exact = exact.map(|(index, place)| (place.map(f64::to_bits), index)).collect();
        let gradient = homogeneous(&visual.vertices, &moved);
        Self { visual, moved, exact, gradient }
    }

    /// Displacement at a place (m, from the pole): of the vertex there, or between those of the nearest triangle, from where it grows as in
    /// the mean, since the faces of coarse cells lie below the surface.
    fn at(&self, place: [f64; 3]) -> [f64; 3] {
        if let Some(vertex) = self.exact.get(&place.map(f64::to_bits)) {
            return self.moved[*vertex];
        }
        let mut nearest = (f64::INFINITY, [0.0; 3], [0.0; 3]);
        for triangle in &self.visual.triangles {
            let corners = triangle.map(|corner| self.visual.vertices[corner]);
            let weights = nearest_weights(corners, place);
            let sum = |of: &dyn Fn(usize) -> [f64; 3]| {
                (0..3).fold([0.0; 3], |sum, i| add(sum, scale(weights[i], of(i))))
            };
            let beyond = add(place, scale(-1.0, sum(&|i| corners[i])));
            if norm(beyond) < nearest.0 {
                nearest = (norm(beyond), beyond, sum(&|i| self.moved[triangle[i]]));
            }
        }
        let (_, beyond, moved) = nearest;
        add(moved, self.gradient.map(|row| dot(row, beyond)))
    }
}

/// Gradient of the homogeneous deformation with the least sum of squared differences from displacements (m) at places (m), by rows.
fn homogeneous(places: &[[f64; 3]], moved: &[[f64; 3]]) -> [[f64; 3]; 3] {
    let mut square = [0.0; 6];
    let mut mixed = [[0.0; 3]; 3];
    for (place, moved) in places.iter().zip(moved) {
        let products = sym3::products(*place);
        square = std::array::from_fn(|i| square[i] + products[i]);
        mixed = std::array::from_fn(|i| add(mixed[i], scale(moved[i], *place)));
    }
    let inverse = sym3::inverse(square);
    mixed.map(|row| times(inverse, row))
}
