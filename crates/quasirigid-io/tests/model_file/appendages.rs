//! `[[appendage]]`: units of a vendor's sheet, the point of its inertia, and what it must not give.

use insta::assert_snapshot;
use quasirigid::elements::{Appendage, Extent, InertiaPoint};

use super::{CARRIER, POINT, read, refusal};

/// A sheet in millimetres and grams, to which a test adds lines.
const SHEET: &str = "[[appendage]]\nname = \"wing\"\nat = [\"600 mm\", 0, 0.2]\nmass = \"22 kg\"\ncenter_of_mass = [\"2.4 m\", 0, 0]\n";
const INERTIA: &str = "inertia = [9.0, 41.0, 50.0]\n";
const MODES: &str = "modes = [{ frequency = \"0.31 Hz\", damping_ratio = 0.005, translation = [0, 0, 3.6], rotation = [0, -12.2, 0] }]\n";

fn sheet(text: &str) -> Appendage {
    read(&format!("{CARRIER}{text}")).assembly.appendages[0].clone()
}

/// The least refusal of a sheet, by reading or by the laws of mechanics.
fn refused(text: &str) -> String {
    let text = format!("{CARRIER}{text}");
    match quasirigid_io::model::Model::parse(std::path::Path::new("model.toml"), &text) {
        Err(error) => error.to_string(),
        Ok(model) => model.diagnose_all(&model.assembly.check()).to_string(),
    }
}

#[test]
fn participation_factors_have_the_units_of_the_sheet() {
    let plain = sheet(&format!("{SHEET}{INERTIA}{MODES}"));
    assert_eq!(plain.interface, [0.6, 0.0, 0.2]);
    assert!((plain.modes[0].frequency - 0.31 * std::f64::consts::TAU).abs() < 1e-15);
    assert_eq!((plain.extent, plain.inertia_about), (Extent::Unknown, InertiaPoint::CenterOfMass));
    // 1 kg^1/2 is 1000^1/2 g^1/2, and 1 kg^1/2 m is 1000^3/2 g^1/2 mm
    let (root, mm) = (1000.0_f64.sqrt(), 1000.0_f64.powf(1.5));
    let modes = MODES.replace("3.6", &(3.6 * root).to_string()).replace("-12.2", &(-12.2 * mm).to_string());
    let small = sheet(&format!("{SHEET}{INERTIA}{modes}mass_unit = \"g\"\nlength_unit = \"mm\"\n"));
    for (found, expected) in [
        (small.modes[0].translation[2], plain.modes[0].translation[2]),
        (small.modes[0].rotation[1], plain.modes[0].rotation[1]),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
    }
}

#[test]
fn an_inertia_about_the_interface_says_so() {
    // 22 kg at 2.4 m
    let shifted = format!("interface_inertia = [9.0, {}, {}]\n", 41.0 + 22.0 * 5.76, 50.0 + 22.0 * 5.76);
    let about = sheet(&format!("{SHEET}{shifted}{MODES}normal = [0, 0, 1]\n"));
    assert_eq!(
        (about.inertia_about, about.extent),
        (InertiaPoint::Interface, Extent::Plane([0.0, 0.0, 1.0]))
    );
    let bodies = [&format!("{SHEET}{INERTIA}{MODES}"), &format!("{SHEET}{shifted}{MODES}")]
        .map(|text| read(&format!("{CARRIER}{text}")).assembly.body().unwrap());
    let [a, b] = bodies.map(|body| body.invariants().J);
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12 * a.abs().max(1.0)), "{a:?} {b:?}");
    assert_snapshot!(refused(&format!("{SHEET}{INERTIA}{shifted}{MODES}")), @"
    model.toml:11:21: `inertia` and `interface_inertia` are one tensor about two points
      leave one of them out
    ");
}

#[test]
fn effective_masses_and_modes_that_carry_too_much_are_refused() {
    let squares = "modes = [{ frequency = 2.0, effective_mass = [0, 0, 13.0], translation = [0, 0, 3.6] }]\n";
    assert_snapshot!(refused(&format!("{SHEET}{INERTIA}{squares}")), @"
    model.toml:11:46: an effective mass has lost the sign of its participation factor, and with it the coupling of its axes
      ask for the participation factors of unit modal mass, and write `translation` and `rotation`
    ");
    let heavy = MODES.replace("3.6", "4.784");
    assert_snapshot!(refused(&format!("{SHEET}{INERTIA}{heavy}")), @r#"
    model.toml:11:9: `modes` of modal appendage "wing": the modes carry 104.0303 % of the mass along z
      check the units of the participation factors, the point of `rotation`, the axes, and that modes are not given twice
    "#);
    assert_snapshot!(refused(&format!("{SHEET}{INERTIA}modes = []\nline = [1, 0, 0]\nnormal = [0, 0, 1]\n")), @"
    model.toml:13:10: the mass is on a `line` or in a plane with a `normal`
      leave one of them out
    ");
    assert_snapshot!(refused(&format!("{SHEET}{INERTIA}modes = [{{ frequency = 2.0 }}]\n")), @"
    model.toml:11:10: a mode has no `translation`
      add a line such as: translation = [0, 0, 1.2]
    model.toml:11:10: a mode has no `rotation`
      add a line such as: rotation = [0, -2.4, 0]
    ");
}

#[test]
fn nothing_acts_on_an_appendage_without_shapes() {
    let spring = "[[spring]]\nfrom = \"tip\"\nto = \"wing\"\nstiffness = 1\n";
    assert_snapshot!(refusal(&format!("{CARRIER}{POINT}{SHEET}{INERTIA}{MODES}{spring}")), @r#"
    model.toml:18:6: "wing" is known by its modes alone, but a spring joins points, nodes of parts, places on appendages and the carrier
      write "carrier", with the place of its interface
    "#);
    let initial = "[initial]\nangular_velocity = [0, 0, 0.1]\ndisplacements = { wing = [0, 0, 0.1] }\n";
    assert_snapshot!(refusal(&format!("{CARRIER}{SHEET}{INERTIA}{MODES}{initial}")), @r#"
    model.toml:14:19: "wing" is known by its modes alone, and its displacements have no names
      write displacements = "slow-manifold" or "rest"
    "#);
}
