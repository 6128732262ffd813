//! Materials with three planes of symmetry, in solids and in the layers of panels.

use insta::assert_snapshot;
use quasirigid::elements::{ElasticMaterial, Orthotropic, PartKind};
use quasirigid::model::{Measured, Rheology};

use super::{BOOM, CARRIER, TUBE, only_part, read, refusal, verdict};

/// Constants of a ply; the moduli along 2 and 3 differ, so that an exchange is seen.
const PLY: &str = "density = \"1.6 g/cm^3\"\nyoung = [\"140 GPa\", \"9 GPa\", 8e9]\npoisson = [0.3, 0.28, 0.45]\n\
                   shear = [\"5 GPa\", \"4.5 GPa\", \"3 GPa\"]\n";
const PANEL: &str =
    "[[panel]]\nrectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [2, 1] }\nattach = \"left\"\n";

/// A panel of one layer of a material with these lines, which start in line 6.
fn model(lines: &str) -> String {
    format!(
        "{CARRIER}[material.ply]\n{lines}{PANEL}layers = [{{ material = \"ply\", thickness = \"1 mm\" }}]\n"
    )
}

#[test]
fn an_orthotropic_material_is_read_in_the_order_of_its_axes() {
    let rheology = "rheology = { kind = \"kelvin-voigt\", time = \"2 ms\" }\n";
    let model = read(&model(&format!("{PLY}{rheology}")));
    assert_eq!(model.assembly.check(), []);
    let PartKind::Panel(panel) = &only_part(&model.assembly).kind else { panic!("a panel") };
    let expected = Orthotropic {
        density: 1600.0,
        young: [140e9, 9e9, 8e9],
        poisson: [0.3, 0.28, 0.45],
        shear: [5e9, 4.5e9, 3e9],
        rheology: Rheology::KelvinVoigt { time: 2e-3 },
    };
    assert_eq!(panel.layers[0].material, ElasticMaterial::Orthotropic(expected));
}

/// A measured modulus is relative to the first of Young's moduli.
#[test]
fn a_table_of_an_orthotropic_material_is_relative_to_its_first_modulus() {
    let rows = "rheology = { kind = \"table\", rows = [[1, \"70 GPa\", 0.02], [2, \"140 GPa\", 0.01]] }\n";
    let model = read(&model(&format!("{PLY}{rows}")));
    let PartKind::Panel(panel) = &only_part(&model.assembly).kind else { panic!("a panel") };
    let measured = Measured::new(vec![[1.0, 0.5, 0.02], [2.0, 1.0, 0.01]]).expect("a table");
    assert_eq!(panel.layers[0].material.rheology(), &Rheology::Table(measured));
}

#[test]
fn an_orthotropic_material_with_a_constant_too_few_is_refused() {
    assert_snapshot!(refusal(&model("density = 1600\nyoung = [1e9, 2e9]\npoisson = 0.3\n")), @r#"
    model.toml:5:1: the material has no `shear`
      add a line such as: shear = ["5 GPa", "5 GPa", "3 GPa"], for 12, 13, 23
    model.toml:7:9: `young`: found an array of 2 values, expected an array of 3 moduli
      write 3 moduli in brackets, with commas between them
    model.toml:8:11: `poisson`: found a decimal number, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
    assert_snapshot!(refusal(&model(&PLY.replace("0.28, ", "").replace("\"4.5 GPa\"", "\"4.5 kg\""))), @r#"
    model.toml:8:11: `poisson`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:9:19: `shear`: "4.5 kg" is a mass, but a pressure is needed
      write for example "70 GPa", or a plain number in Pa
    "#);
    assert_snapshot!(refusal(&model(&PLY.replace("8e9]", "-8e9]"))), @r#"
    model.toml:7:30: `young` is -8000000000 Pa, but must be positive
      write a number in Pa, or a text with its unit such as "70 GPa"
    "#);
}

#[test]
fn a_beam_is_not_orthotropic() {
    let text = format!("{CARRIER}[material.aluminium]\n{PLY}{TUBE}{BOOM}");
    assert_snapshot!(refusal(&text), @"
    model.toml:19:12: this needs a material that is the same in every direction
      solids and the layers of panels may be orthotropic
    ");
}

/// `ν₁₂² < E₁/E₂` (Lempriere): 4² > 140/9.
#[test]
fn constants_of_no_material_are_refused_at_the_layers() {
    assert_snapshot!(verdict(&model(&PLY.replace("[0.3,", "[4,"))), @r#"model.toml:13:10: `layers` of panel "panel 1": ply 1: Poisson's ratio nu12 = 4; its square must be below E1/E2 = 15.555555555555555"#);
    let inside = read(&model(&PLY.replace("[0.3,", "[3.9,")));
    assert_eq!(inside.assembly.check(), []);
}
