//! Sections of beams.

use insta::assert_snapshot;
use quasirigid::elements::{PartKind, SectionShape};

use super::{ALUMINIUM, BOOM, CARRIER, only_part, read, refusal};

/// A boom with a section of these lines, which start in line 10.
fn model(lines: &str) -> String {
    format!("{CARRIER}{ALUMINIUM}[section.tube]\n{lines}{BOOM}attach = \"root\"\n")
}

fn section(lines: &str) -> SectionShape {
    let model = read(&model(lines));
    assert_eq!(model.assembly.check(), []);
    let PartKind::Frame(frame) = &only_part(&model.assembly).kind else { panic!("a frame") };
    frame.members[0].section
}

#[test]
fn every_shape_is_read_with_its_units() {
    let (height, width, thickness) = (0.08, 0.0508, 0.002);
    let outer = "height = \"80 mm\"\nwidth = \"2 in\"\n";
    assert_eq!(
        section(&format!("shape = \"rectangle\"\n{outer}")),
        SectionShape::Rectangle { height, width }
    );
    assert_eq!(section("shape = \"circle\"\nradius = 0.03\n"), SectionShape::Circle { radius: 0.03 });
    assert_eq!(
        section("shape = \"tube\"\nradius = \"3 cm\"\nthickness = \"2 mm\"\n"),
        SectionShape::Tube { radius: 0.03, thickness }
    );
    assert_eq!(
        section(&format!("shape = \"box\"\n{outer}thickness = 0.002\n")),
        SectionShape::Box { height, width, thickness }
    );
    assert_eq!(
        section(&format!("shape = \"I\"\n{outer}web = \"2 mm\"\nflange = 0.003\n")),
        SectionShape::IBeam { height, width, web: 0.002, flange: 0.003 }
    );
}

/// 4 cm² = 4e-4 m² and 12 cm⁴ = 1.2e-7 m⁴; the powers of the unit are rounded once each.
#[test]
fn a_general_section_is_read_from_its_constants() {
    let constants = "area = \"4 cm^2\"\nsecond_y = \"12 cm^4\"\nsecond_z = 3e-7\ntorsion = \"50000 mm^4\"\n";
    let read = |more: &str| match section(&format!("shape = \"general\"\n{constants}{more}")) {
        SectionShape::General { area, second_y, second_z, torsion, shear } => {
            ([area, second_y, second_z, torsion], shear)
        }
        other => panic!("{other:?}"),
    };
    let (found, shear) = read("");
    for (found, expected) in found.iter().zip([4e-4, 1.2e-7, 3e-7, 5e-8]) {
        assert!((found / expected - 1.0).abs() < 1e-15 * 4.0, "{found} {expected}");
    }
    assert_eq!(shear, None);
    let [y, z] = read("shear_areas = [2e-4, \"3 cm^2\"]\n").1.expect("shear areas");
    assert!(y == 2e-4 && (z / 3e-4 - 1.0).abs() < 1e-15, "{y} {z}");
}

#[test]
fn a_wrong_section_is_refused() {
    let refused = |lines: &str| refusal(&model(lines));
    assert_snapshot!(refused("radius = 0.03\n"), @r#"
    model.toml:9:1: the section has no `shape`
      add a line such as: shape = "rectangle", "circle", "tube", "box", "I" or "general"
    "#);
    assert_snapshot!(refused("shape = \"channel\"\nradius = 0.03\n"), @r#"
    model.toml:10:9: `shape` cannot be "channel"
      write "rectangle", "circle", "tube", "box", "I" or "general"
    "#);
    assert_snapshot!(refused("shape = \"i\"\n"), @r#"
    model.toml:10:9: `shape` cannot be "i"
      did you mean "I"? write "rectangle", "circle", "tube", "box", "I" or "general"
    "#);
    assert_snapshot!(refused("shape = \"tube\"\nradius = \"3 kg\"\nwall = 0.002\n"), @r#"
    model.toml:9:1: a section of shape "tube" has no `thickness`
      add a line such as: thickness = "20 mm"
    model.toml:11:10: `radius`: "3 kg" is a mass, but a length is needed
      write for example "22 in", or a plain number in m
    model.toml:12:1: unknown key "wall" in a section of shape "tube"
      the keys are shape, radius, thickness
    "#);
    assert_snapshot!(refused("shape = \"box\"\nheight = 0\nwidth = -1\n"), @r#"
    model.toml:9:1: a section of shape "box" has no `thickness`
      add a line such as: thickness = "20 mm"
    model.toml:11:10: `height` is 0 m, but must be positive
      write a number in m, or a text with its unit such as "22 in"
    model.toml:12:9: `width` is -1 m, but must be positive
      write a number in m, or a text with its unit such as "22 in"
    "#);
    assert_snapshot!(refused("shape = \"general\"\narea = 0.1\nsecond_y = 1\nsecond_z = 1\ntorsion = 1\nshear_areas = [1]\n"), @"
    model.toml:15:15: `shear_areas`: found an array of 1 value, expected an array of 2 areas
      write 2 areas in brackets, with commas between them
    ");
}

#[test]
fn sections_have_names() {
    assert_snapshot!(refusal(&format!("{CARRIER}[section]\nshape = \"tube\"\n")), @"
    model.toml:6:9: `shape`: found a text, expected a table with the name of a section
      write [section.tube], and its name in place of tube, with its keys below
    ");
    assert_snapshot!(refusal(&format!("{CARRIER}[[section]]\nshape = \"tube\"\n")), @"
    model.toml:5:1: `section`: found an array of 1 value, expected a table for each section
      write [section.tube], and its name in place of tube, with its keys below
    ");
    let tubes = model("shape = \"circle\"\nradius = 0.1\n").replace("[section.tube]", "[section.tubes]");
    assert_snapshot!(refusal(&tubes), @r#"
    model.toml:16:11: there is no section "tube"
      did you mean "tubes"? there are tubes
    "#);
    assert_snapshot!(refusal(&format!("{CARRIER}{ALUMINIUM}{BOOM}")), @r#"
    model.toml:13:11: there is no section "tube"
      the file has no sections; add [section.tube] with shape = "tube", radius and thickness
    "#);
}

/// Sections that only the library can refuse: walls that meet, a web out of proportion.
#[test]
fn a_section_that_cannot_be_is_refused_at_its_beam() {
    let verdict = |lines: &str| super::verdict(&model(lines));
    assert_snapshot!(verdict("shape = \"tube\"\nradius = 0.03\nthickness = 0.031\n"), @r#"model.toml:17:11: `section` of beam "boom": the thickness of a section is 0.031, but there is room for less than 0.03"#);
    assert_snapshot!(verdict("shape = \"I\"\nheight = 0.1\nwidth = 0.1\nweb = 0.02\nflange = 0.001\n"), @r#"model.toml:19:11: `section` of beam "boom": the web of an I-beam is 0.02 m thick and its flanges are 0.001 m; its torsion constant is known for a web of 0.25 to 1.5 times the flanges: give the constants of this section themselves"#);
}
