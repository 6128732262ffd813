//! Solids inside surfaces with necks against meshes of the same facets: the error told bounds the true one.

use nalgebra::Matrix6;
use quasirigid::elements::{Approximation, Assembly, Material, Problem, Surface};
use quasirigid::math::mesh::Mesh;
use quasirigid::math::surface::ClosedSurface;
use quasirigid::model::{FlexibleBody, Rheology};

use crate::common::compliance;
use crate::meshes::{refined, solid, surface, throughout, with_middles};
use crate::necked::{Necked, family};

fn rock() -> Material {
    Material { density: 2600.0, young: 4e6, poisson: 0.27, rheology: Rheology::Elastic }
}

fn by_cells(mesh: Mesh) -> Matrix6<f64> {
    let regions = throughout(&mesh, &rock());
    let assembly = Assembly { parts: vec![solid(mesh, &regions, Vec::new())], ..Assembly::default() };
    of(&assembly.body().unwrap())
}

fn of(body: &FlexibleBody) -> Matrix6<f64> {
    compliance(body, nalgebra::Rotation3::identity())
}

/// The surface of a mesh without the nodes inside.
fn outer(mesh: &Mesh) -> ClosedSurface {
    let triangles = surface(mesh);
    let mut used: Vec<usize> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |node: usize| used.binary_search(&node).unwrap();
    let triangles = triangles.iter().map(|triangle| triangle.map(number)).collect();
    ClosedSurface::new(used.iter().map(|node| mesh.nodes[*node]).collect(), triangles).unwrap()
}

fn element(surface: &ClosedSurface, degree: Option<usize>, cells: Option<usize>) -> Assembly {
    let element = Surface { name: "rock".into(), surface: surface.clone(), material: rock(), degree, cells };
    Assembly { surfaces: vec![element], ..Assembly::default() }
}

/// Largest difference of the energies at any products of the spin, over that of the first: written here, not imported. Products
/// with next to no compliance are left out.
fn apart(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let eigen = found.symmetric_eigen();
    let most = eigen.eigenvalues.max();
    let share = |x: f64| (x.max(1e-3 * most)).sqrt().recip();
    let half = eigen.eigenvectors * Matrix6::from_diagonal(&eigen.eigenvalues.map(share));
    (half.transpose() * (expected - found) * half).symmetric_eigenvalues().amax()
}
