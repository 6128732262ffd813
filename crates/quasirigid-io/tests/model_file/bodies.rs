//! One body from several programs: meshes of gmsh as both its files have them, and matrices of CalculiX.

use std::path::Path;

use quasirigid::math::polynomial::{Homogeneous, Series};
use quasirigid::model::{FlexibleBody, ReducedBody};
use quasirigid::reduction::{frequencies, reduce};
use quasirigid_io::model::Model;

/// Files that gmsh and CalculiX wrote, see the page beside them.
const BODIES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/bodies/model.toml");
/// Lighter than what it carries, and off its centre.
const HUB: &str = "[carrier]\nmass = \"9 g\"\ncenter_of_mass = [\"31 mm\", \"-8 mm\", \"12 mm\"]\n\
                   inertia = [[8e-7, 1e-7, -2e-7], [1e-7, 1.1e-6, 3e-7], [-2e-7, 3e-7, 1.3e-6]]\n";
/// Two materials that answer alike; the numbers are those of `write.py`.
const PLASTIC: &str = "[material.nylon]\ndensity = \"1.15 g/cm^3\"\nyoung = \"2.7 GPa\"\npoisson = 0.39\n\
                       rheology = { kind = \"kelvin-voigt\", time = \"2 ms\" }\n";
const METAL: &str = "[material.titanium]\ndensity = \"4.43 g/cm^3\"\nyoung = \"113.8 GPa\"\npoisson = 0.342\n\
                     rheology = { kind = \"kelvin-voigt\", time = \"2 ms\" }\n";

/// A body on the hub, and its reduced equations.
fn bodies(parts: &str) -> (FlexibleBody, ReducedBody) {
    let model = Model::parse(Path::new(BODIES), &format!("{HUB}{parts}"));
    let model = model.unwrap_or_else(|error| panic!("{error}"));
    let body =
        model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let reduced = reduce(&body, 3).expect("a reduced body");
    (body, reduced)
}

/// Largest difference of two lists over the largest entry of the second.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let off = found.iter().zip(expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    if size > 0.0 { off / size } else { off }
}

fn all(part: &Homogeneous) -> Vec<f64> {
    part.terms().flat_map(|(_, coefficients)| coefficients).collect()
}

/// What of two bodies does not depend on their coordinates, with the relative difference of each.
fn differences(found: &str, expected: &str) -> Vec<(String, f64)> {
    let [(body, reduced), (other_body, other)] = [found, expected].map(bodies);
    let mut differences = vec![
        ("mass".to_owned(), difference(&[reduced.mass], &[other.mass])),
        ("centre of mass".to_owned(), difference(&body.center_of_mass(), &other_body.center_of_mass())),
        ("inertia".to_owned(), difference(&reduced.J, &other.J)),
    ];
    let lowest = |body| frequencies(body).expect("frequencies")[..6].to_vec();
    differences.push(("frequencies".to_owned(), difference(&lowest(&body), &lowest(&other_body))));
    let mut add = |name: &str, found: &Series, expected: &Series, from: usize| {
        for degree in from..=expected.degree() {
            let error = difference(&all(found.part(degree)), &all(expected.part(degree)));
            differences.push((format!("{name} of degree {degree}"), error));
        }
    };
    add("spin rate", &reduced.f, &other.f, 2);
    add("momentum", &reduced.K, &other.K, 1);
    add("energy", &reduced.energy, &other.energy, 2);
    add("power", &reduced.power, &other.power, 6);
    differences
}

fn assert_same(found: &str, expected: &str, tolerance: f64) {
    let differences = differences(found, expected);
    println!("{differences:#?}");
    for (name, difference) in differences {
        assert!(difference <= tolerance, "{name}: {difference:e}");
    }
}

fn solid(file: &str, rest: &str) -> String {
    format!("{METAL}{PLASTIC}[[solid]]\nname = \"part\"\nfile = \"{file}\"\n{rest}")
}

/// Curved tetrahedra of two materials.
#[test]
fn both_files_of_gmsh_are_one_body() {
    let hook = |file: &str| {
        let plastic = PLASTIC.replace("2 ms", "5 ms");
        let materials = "materials = { RING = \"nylon\", BLOCK = \"titanium\" }\n";
        solid(file, &format!("unit = \"mm\"\n{materials}attach = \"ROOT\"\n")).replace(PLASTIC, &plastic)
    };
    assert_same(&hook("hook.inp"), &hook("hook.msh"), 1e-8);
}

const SPUR: &str = "unit = \"mm\"\nmaterials = { STEM = \"nylon\", TIP = \"titanium\" }\nattach = \"ROOT\"\n";

/// The spur as matrices over what CalculiX says of its rows; N, mm and s make t the unit of mass.
fn spur(mass: &str) -> String {
    format!(
        "[[matrices]]\nname = \"part\"\nnodes = \"spur.inp\"\nfreedoms = \"spur.dof\"\nstiffness = \"spur.sti\"\n\
         mass = \"{mass}\"\nlength_unit = \"mm\"\nmass_unit = \"t\"\n\
         rheology = {{ kind = \"kelvin-voigt\", time = \"2 ms\" }}\nattach = [1, 2, 3, 4, 5, 6, 7, 8, 9]\n"
    )
}

/// The mass is integrated by `write.py`.
#[test]
fn stiffness_of_calculix_with_the_exact_mass_is_our_solid() {
    assert_same(&spur("spur-mass.npz"), &solid("spur.msh", SPUR), 1e-8);
}

/// Only its stiffness has the displacements that our cells have of their own; in inches and pounds of force.
#[test]
fn stiffness_and_mass_of_calculix_are_our_hexahedra() {
    let aluminium = "[material.aluminium]\ndensity = \"2.588e-4 lbf s^2/in^4\"\nyoung = \"10.3e6 psi\"\npoisson = 0.33\n";
    let rayleigh = "rayleigh = { mass = 40, stiffness = \"0.1 ms\" }\n";
    let solid = format!(
        "{aluminium}[[solid]]\nfile = \"brick.inp\"\nunit = \"in\"\nmaterial = \"aluminium\"\nattach = \"ROOT\"\n{rayleigh}"
    );
    let matrices = format!(
        "[[matrices]]\nnodes = \"brick-nodes.csv\"\nfreedoms = \"brick.dof\"\nstiffness = \"brick.sti\"\n\
         mass = \"brick.mas\"\nlength_unit = \"in\"\nmass_unit = \"lbf s^2/in\"\n\
         attach = [11, 13, 15, 17, 19, 21]\n{rayleigh}"
    );
    assert_same(&matrices, &solid, 1e-8);
}

/// CalculiX integrates the mass of quadratic tetrahedra with four points, which is exact to the second degree: mass,
/// centre and inertia are right, and loads in proportion to the place are not.
#[test]
fn mass_of_calculix_is_short_of_points() {
    let differences = differences(&spur("spur.mas"), &solid("spur.msh", SPUR));
    println!("{differences:#?}");
}
