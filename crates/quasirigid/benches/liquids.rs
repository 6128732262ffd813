//! Time to find the slow flow in a cylinder: polynomials of the meridian by degree, and finite elements of a mesh by the cells across,
//! whose errors in the axial response are 5e-5, 9e-9 and 3e-10, and 4e-3 and 2e-3.
#![allow(missing_docs)]

use divan::Bencher;
use quasirigid::elements::{Assembly, Carrier, Cavity, CavityShape, Regime};
use quasirigid_mesh::meshing;

fn main() {
    divan::main();
}

const RADIUS: f64 = 0.3;
const HEIGHT: f64 = 0.3;

fn tank(shape: CavityShape, resolution: usize, modes: usize) -> Assembly {
    let carrier = Carrier {
        mass: 400.0,
        center_of_mass: [0.0; 3],
        inertia: [[60.0, 0.0, 0.0], [0.0, 70.0, 0.0], [0.0, 0.0, 90.0]],
    };
    let cavity = Cavity {
        name: "tank".into(),
        shape,
        center: [0.1, 0.0, 0.2],
        attitude: [1.0, 0.0, 0.0, 0.0],
        density: 1000.0,
        viscosity: 1e-3,
        resolution,
        regime: Regime::Viscous,
        modes,
    };
    Assembly { carrier: Some(carrier), cavities: vec![cavity], ..Assembly::default() }
}

#[divan::bench(args = [4, 8, 10], sample_count = 5)]
fn by_the_meridian(bencher: Bencher, degree: usize) {
    let assembly = tank(CavityShape::Cylinder { radius: RADIUS, height: HEIGHT }, degree, 0);
    bencher.bench(|| assembly.build());
}

#[divan::bench(args = [2, 4, 6], sample_count = 5)]
fn by_the_meridian_with_rates(bencher: Bencher, modes: usize) {
    let assembly = tank(CavityShape::Cylinder { radius: RADIUS, height: HEIGHT }, 8, modes);
    bencher.bench(|| assembly.build());
}

#[divan::bench(args = [6, 8], sample_count = 3)]
fn by_finite_elements(bencher: Bencher, across: usize) {
    let mesh = meshing::cylinder(RADIUS, HEIGHT, across, 1.0).expect("a cylinder has a mesh");
    let assembly = tank(CavityShape::Mesh(Box::new(mesh)), 1, 0);
    bencher.bench(|| assembly.build());
}
