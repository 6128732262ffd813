//! One body from several programs: meshes of gmsh as both its files have them, and matrices of CalculiX.

use std::path::Path;

use insta::assert_snapshot;
use quasirigid_io::model::Model;

use super::located;
use super::same::{assert_same, differences};

/// Files that gmsh and CalculiX wrote, see the page beside them.
const BODIES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/bodies/model.toml");
/// A carrier lighter than the parts on it, and off their centre.
const HUB: &str = "[carrier]\nmass = \"9 g\"\ncenter_of_mass = [\"31 mm\", \"-8 mm\", \"12 mm\"]\n\
                   inertia = [[8e-7, 1e-7, -2e-7], [1e-7, 1.1e-6, 3e-7], [-2e-7, 3e-7, 1.3e-6]]\n";
/// Two materials of equal elasticity; the numbers are those of `write.py`.
const PLASTIC: &str = "[material.nylon]\ndensity = \"1.15 g/cm^3\"\nyoung = \"2.7 GPa\"\npoisson = 0.39\n\
                       rheology = { kind = \"kelvin-voigt\", time = \"2 ms\" }\n";
const METAL: &str = "[material.titanium]\ndensity = \"4.43 g/cm^3\"\nyoung = \"113.8 GPa\"\npoisson = 0.342\n\
                     rheology = { kind = \"kelvin-voigt\", time = \"2 ms\" }\n";

fn on_hub(parts: &str) -> Model {
    Model::parse(Path::new(BODIES), &format!("{HUB}{parts}")).unwrap_or_else(|error| panic!("{error}"))
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
    assert_same(&on_hub(&hook("hook.inp")), &on_hub(&hook("hook.msh")), 1e-8);
}

const SPUR: &str = "unit = \"mm\"\nmaterials = { STEM = \"nylon\", TIP = \"titanium\" }\nattach = \"ROOT\"\n";

/// The spur as matrices, with the rows that CalculiX lists; N, mm and s make t the unit of mass.
fn spur(mass: &str) -> String {
    format!(
        "[[matrices]]\nname = \"part\"\nnodes = \"spur.inp\"\ndofs = \"spur.dof\"\nstiffness = \"spur.sti\"\n\
         mass = \"{mass}\"\nlength_unit = \"mm\"\nmass_unit = \"t\"\n\
         rheology = {{ kind = \"kelvin-voigt\", time = \"2 ms\" }}\nattach = [1, 2, 3, 4, 5, 6, 7, 8, 9]\n"
    )
}

/// The mass is integrated by `write.py`. Stiffnesses of the spur span six decades, and CalculiX writes 14 digits.
#[test]
fn stiffness_of_calculix_with_the_exact_mass_is_our_solid() {
    assert_same(&on_hub(&spur("spur-mass.npz")), &on_hub(&solid("spur.msh", SPUR)), 1e-8);
}

/// The matrices have no constrained node, so the body can float.
#[test]
fn a_body_that_floats_is_the_same_from_matrices_and_cells() {
    let floating = |text: String| {
        let text = text.lines().filter(|line| !line.starts_with("attach")).collect::<Vec<_>>().join("\n");
        Model::parse(Path::new(BODIES), &text).unwrap_or_else(|error| panic!("{error}"))
    };
    let cells = floating(solid("spur.inp", SPUR));
    assert_same(&floating(spur("spur-mass.npz")), &cells, 1e-8);
}

/// Hexahedra with incompatible modes, whose mass CalculiX has and we have not; in inches and pounds of force.
#[test]
fn stiffness_and_mass_of_calculix_are_our_hexahedra() {
    let aluminium =
        "[material.aluminium]\ndensity = \"2.588e-4 lbf s^2/in^4\"\nyoung = \"10.3e6 psi\"\npoisson = 0.33\n";
    let rayleigh = "rayleigh = { mass = 40, stiffness = \"0.1 ms\" }\n";
    let solid = format!(
        "{aluminium}[[solid]]\nfile = \"brick.inp\"\nunit = \"in\"\nmaterial = \"aluminium\"\nattach = \"ROOT\"\n{rayleigh}"
    );
    let matrices = format!(
        "[[matrices]]\nnodes = \"brick-nodes.csv\"\ndofs = \"brick.dof\"\nstiffness = \"brick.sti\"\n\
         mass = \"brick.mas\"\nlength_unit = \"in\"\nmass_unit = \"lbf s^2/in\"\n\
         attach = [11, 13, 15, 17, 19, 21]\n{rayleigh}"
    );
    assert_same(&on_hub(&matrices), &on_hub(&solid), 1e-8);
}

/// CalculiX integrates the mass of quadratic tetrahedra with four points, which is exact to the second degree: where
/// edges are straight, mass, centre and inertia are right, and loads in proportion to the place are not. On the twelve
/// cells of the spur that is a thousandth; the page beside the files says how it falls on finer meshes.
#[test]
fn mass_of_calculix_is_short_of_points() {
    for (name, difference) in differences(&on_hub(&spur("spur.mas")), &on_hub(&solid("spur.msh", SPUR))) {
        let frozen = name.ends_with("mass") || name == "inertia" || name.ends_with("momentum of degree 1");
        let expected = match name.as_str() {
            "power of degree 6" | "spin rate of degree 4" | "spin rate of degree 5" => 8e-4..1.2e-3,
            _ if frozen => 0.0..1e-14,
            _ => continue,
        };
        assert!(expected.contains(&difference), "{name}: {difference:e}");
    }
}

/// The degrees of freedom that CalculiX gives the cells of type C3D8I are at no node of the mesh.
#[test]
fn dofs_of_no_node_are_refused() {
    let keys = "dofs = \"brick.dof\"\nstiffness = \"brick.sti\"\nmass = \"brick.mas\"\n";
    let text = format!("{HUB}[[matrices]]\nnodes = \"brick.inp\"\n{keys}");
    let error = Model::parse(Path::new(BODIES), &text).expect_err("a refusal");
    assert_snapshot!(located(&error), @"
    model.toml:8:13: there is no degree of freedom 58.1 of a node in the table `nodes`
      every row is about a displacement (1 to 3) or rotation (4 to 6) of a node in the table
    ");
}
