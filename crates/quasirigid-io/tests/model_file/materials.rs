//! Materials, and ellipsoids made of them.

use insta::assert_snapshot;
use quasirigid::elements::{Ellipsoid, Material};
use quasirigid::model::Rheology;

use super::{CARRIER, ELLIPSOID, ROCK, made_of, read, refusal};

/// The ellipsoid that is made of a material with these lines.
fn ellipsoid(lines: &str) -> Ellipsoid {
    let [ellipsoid] = read(&made_of(lines)).assembly.ellipsoids.try_into().expect("one ellipsoid");
    ellipsoid
}

/// Refusal of a material with these lines, which start in line 5.
fn refused(lines: &str) -> String {
    refusal(&made_of(lines))
}

#[test]
fn an_ellipsoid_is_read_with_its_material() {
    let body = read(&format!("{}center = [1, \"2 m\", 3]\n[material.rock]\n{ROCK}", ELLIPSOID)).assembly;
    let expected = Ellipsoid {
        name: "ellipsoid 1".to_owned(),
        semi_axes: [2300.0, 1200.0, 950.0],
        center: [1.0, 2.0, 3.0],
        material: Material { density: 2500.0, young: 1e9, poisson: 0.25, rheology: Rheology::Elastic },
    };
    assert_eq!(body.ellipsoids, [expected]);
    assert_eq!(body.carrier, None);
    assert_eq!(body.check(), []);
}

/// `E = 2 μ (1 + ν)`: the moduli of steel in textbooks, 79.3 and 206 GPa with Poisson's ratio 0.3.
#[test]
fn a_shear_modulus_gives_that_of_young() {
    let steel = ellipsoid("density = 7850\nshear = \"79.3 GPa\"\npoisson = 0.3\n");
    assert!((steel.material.young / 206.18e9 - 1.0).abs() < 1e-14, "{}", steel.material.young); // two products, each rounded
    assert_eq!((steel.material.poisson, steel.center), (0.3, [0.0; 3]));
}

#[test]
fn an_impossible_material_is_refused() {
    assert_snapshot!(refused("density = -1\nyoung = nan\npoisson = 0.5\n"), @r#"
    model.toml:5:11: `density` is -1 kg/m^3, but must be positive
      write a number in kg/m^3, or a text with its unit such as "2.5 g/cm^3"
    model.toml:6:9: `young` is nan, which is not a finite number
      write a number in Pa, or a text with its unit such as "70 GPa"
    model.toml:7:11: `poisson` is 0.5, but must be between -1 and 0.5
      write a number
    "#);
    assert_snapshot!(refused("density = \"2 kg\"\nshear = 0\npoisson = -1\n"), @r#"
    model.toml:5:11: `density`: "2 kg" is a mass, but a density is needed
      write for example "2.5 g/cm^3", or a plain number in kg/m^3
    model.toml:6:9: `shear` is 0 Pa, but must be positive
      write a number in Pa, or a text with its unit such as "70 GPa"
    model.toml:7:11: `poisson` is -1, but must be between -1 and 0.5
      write a number
    "#);
    assert_snapshot!(refused("density = \"2.5 g/cm^3\"\nshear = \"1 GPa\"\npoisson = nan\n"), @"
    model.toml:7:11: `poisson` is nan, which is not a finite number
      write a number
    ");
    assert_snapshot!(refused("density = inf\nyoung = \"70 kN\"\npoisson = \"0.3\"\n"), @r#"
    model.toml:5:11: `density` is inf, which is not a finite number
      write a number in kg/m^3, or a text with its unit such as "2.5 g/cm^3"
    model.toml:6:9: `young`: "70 kN" is a force, but a pressure is needed
      write for example "70 GPa", or a plain number in Pa
    model.toml:7:11: `poisson`: "0.3" is a text without a unit
      write 0.3 without the quotes
    "#);
    let inside = ellipsoid("density = 1\nyoung = 1\npoisson = 0.499\n");
    assert_eq!(inside.material.poisson, 0.499);
}

#[test]
fn a_material_has_one_modulus() {
    assert_snapshot!(refused(&format!("{ROCK}shear = \"1 GPa\"\n")), @"
    model.toml:8:9: `shear` follows from `young` and `poisson`
      leave out one of the two moduli
    ");
    assert_snapshot!(refused("density = 2500\npoisson = 0.25\n"), @r#"
    model.toml:4:1: the material has no `young`
      add a line such as: young = "70 GPa", or shear = "26 GPa"
    "#);
    assert_snapshot!(refused("density = 2500\npoisson = 0.25\nyuong = 1\n"), @r#"
    model.toml:7:1: unknown key "yuong" in the material
      did you mean `young`? the keys are density, young, shear, mu_Q, poisson, rheology
    "#);
    assert_snapshot!(refused(""), @r#"
    model.toml:4:1: the material has no `density`
      add a line such as: density = "2.5 g/cm^3"
    model.toml:4:1: the material has no `poisson`
      add a line such as: poisson = 0.25
    model.toml:4:1: the material has no `young`
      add a line such as: young = "70 GPa", or shear = "26 GPa"
    "#);
}

#[test]
fn an_unknown_material_is_refused_with_the_nearest_known_one() {
    let ice = format!("[material.ice]\n{ROCK}");
    assert_snapshot!(refusal(&format!("{}[material.rocks]\n{ROCK}{ice}", ELLIPSOID)), @r#"
    model.toml:3:12: there is no material "rock"
      did you mean "rocks"? there are ice, rocks
    "#);
    assert_snapshot!(refusal(&format!("{}{ice}", ELLIPSOID)), @r#"
    model.toml:3:12: there is no material "rock"
      there are ice
    "#);
    assert_snapshot!(refusal(ELLIPSOID), @r#"
    model.toml:3:12: there is no material "rock"
      the file has no materials; add [material.rock] with density, young and poisson
    "#);
    assert_snapshot!(refusal(&format!("{}[material.3]\n{ROCK}", ELLIPSOID.replace("\"rock\"", "3"))), @"
    model.toml:3:12: `material`: found an integer, expected a text
      write the material in quotes
    ");
}

#[test]
fn materials_have_names() {
    assert_snapshot!(refusal(&format!("{CARRIER}[material]\ndensity = 2500\n")), @"
    model.toml:6:11: `density`: found an integer, expected a table with the name of a material
      write [material.rock], and its name in place of rock, with its keys below
    ");
    assert_snapshot!(refusal(&format!("{CARRIER}[[material]]\nname = \"rock\"\n")), @"
    model.toml:5:1: `material`: found an array of 1 value, expected a table for each material
      write [material.rock], and its name in place of rock, with its keys below
    ");
    assert_snapshot!(refusal(&format!("{CARRIER}[material.rock]\ndensty = 2500\nyoung = 1\npoisson = 0\n")), @r#"
    model.toml:6:1: unknown key "densty" in the material
      did you mean `density`? the keys are density, young, shear, mu_Q, poisson, rheology
    "#);
}

/// A range of an unused material is no range of the body.
#[test]
fn materials_that_nothing_is_made_of_are_noted() {
    let ice =
        format!("[material.ice]\n{ROCK}rheology = {{ kind = \"maxwell\", time = 1, range = [1, 2] }}\n");
    let model = read(&format!("{}{ice}", made_of(ROCK)));
    assert_snapshot!(model.notes.join("\n"), @r#"nothing is made of the material "ice""#);
    assert_eq!(model.extremes, None);
    assert_snapshot!(read(&format!("{CARRIER}[material.rock]\n{ROCK}")).notes.join("\n"), @r#"nothing is made of the material "rock""#);
    assert_eq!(read(&made_of(ROCK)).notes, [""; 0]);
}
