//! What a study says beside its numbers: orders beyond the kinematics, materials that are no solids, losses by material, spins beyond gravity.

use quasirigid_io::model::{BodyKind, System};
use quasirigid_study::evolution;
use quasirigid_study::settings::PartialRun;

use crate::support::{
    MODEL, carrier, column, ellipsoid, evolve, evolved, follow, of_order, one_line, study, table,
    told_history, wobbling,
};

/// Notes on a model at an order.
fn note(model: &str, order: usize) -> String {
    of_order(model, order).model.notes.join(" ")
}

#[test]
fn orders_beyond_the_kinematics_are_said() {
    let rubble = ellipsoid(
        "[1.5, 1.2, 0.9]",
        [2000.0, 0.25],
        "shear = \"2 kPa\"",
        "kind = \"kelvin-voigt\", time = 0.05",
    ) + "[initial]\nangular_velocity = [0.06, 0.05, 0.09]\n";
    let axial =
        MODEL.replace("to = \"carrier\"", "to = \"carrier\"\naxial = true\nanchor = [0, 0, 0]").replace(
            "position = [0.8, 0.3, 0.5]",
            "position = [0.8, 0.3, 0.5]\nmotion = { line = [0.8, 0.3, 0.5] }",
        );
    let hinged = format!(
        "{MODEL}[[hinged]]\nmass = 1\ncenter_of_mass = [0, 1, 0]\ninertia = [0.1, 0.1, 0.1]\nhinge = [0, 0.5, 0]\naxes = [[1, 0, 0]]\nstiffness = 90\n"
    );
    for (model, complete, words) in [
        (&rubble, 3, "the strain of ellipsoids is linear"),
        (&axial, 3, "the force of axial springs is linear"),
        (&hinged, 5, "paths on hinges"),
    ] {
        assert_eq!(note(model, complete), "", "{words}");
        let said = note(model, complete + 1);
        assert!(said.contains(words) && said.contains(&format!("complete to order {complete}")), "{said}");
        assert_eq!(said.contains("The full system has the terms that are missing."), complete == 5, "{said}");
    }
    assert_eq!(note(MODEL, 9), "", "points on springs are exact");
}

#[test]
fn liquids_are_complete_to_the_order_of_the_paper() {
    let note = |shape: &str, order: usize| {
        note(&format!("{MODEL}[[cavity]]\n{shape}\ndensity = 1000\nkinematic_viscosity = 0.1\n"), order)
    };
    for shape in ["shape = \"sphere\"\nradius = 0.2", "shape = \"ellipsoid\"\nsemi_axes = [0.25, 0.2, 0.15]"]
    {
        assert_eq!(note(shape, 3), "");
        assert!(note(shape, 4).contains("the square of the velocity"), "{}", note(shape, 4));
    }
    assert_eq!(note("shape = \"ring\"\nradius = 0.3\ntube_radius = 0.02", 5), "");
}

/// Ellipsoid of 1 km in a rotation of 5 h, of a material with this rheology.
fn rock(rheology: &str) -> String {
    ellipsoid("[\"1 km\", \"1 km\", \"0.6 km\"]", [2000.0, 0.25], "shear = \"1 GPa\"", rheology)
        + &wobbling("45 deg", "0.35 mrad/s", "short-axis")
        + "[run]\nevolve = { until = \"5 deg\" }\n"
}

/// A Kelvin–Voigt body of 1 d is more dashpot than spring in a rotation of 5 h.
#[test]
fn a_dashpot_is_no_solid_at_its_own_harmonics() {
    let study = study(&rock("kind = \"kelvin-voigt\", time = \"1 d\""));
    let evolved = evolved(&study, |_| {});
    let (history, said) = told_history(&study, &table(System::Reduced, &[0.0, 1.0]), PartialRun::default());
    let checked = study.check().unwrap();
    assert!(!evolved.holds() && !history.holds() && !checked.holds());
    for told in [evolved.record.message, said, checked.text()] {
        let told = one_line(&told);
        assert!(
            told.contains(
                "the material of rock resists this motion as a dashpot, not as a spring: at 2.33e-4 rad/s"
            ) && told.contains("above 45"),
            "{told}"
        );
    }
}

/// Laws without a modulus at rest flow under the mean load: how long their answers hold stands first, in every answer and in what went in.
#[test]
fn how_long_a_flowing_material_holds_is_said_first() {
    for (rheology, flows) in
        [("kind = \"maxwell\", time = \"30 d\"", true), ("kind = \"kelvin-voigt\", time = \"1 s\"", false)]
    {
        let study = study(&rock(rheology));
        let first = study.model.notes.first().cloned().unwrap_or_default();
        let told =
            first.starts_with("MAY NOT HOLD beyond") && first.contains("the material of rock without end");
        assert_eq!(told, flows, "{first}");
        assert_eq!(study.inputs().notes, study.model.notes);
    }
}

/// The same law where the motion is fast beside the time is a solid, and `Q = 1` is the limit.
#[test]
fn a_solid_at_its_own_harmonics_is_followed() {
    for (rheology, checked) in [
        ("kind = \"maxwell\", time = \"1 Myr\"", true),
        ("kind = \"quality-factor\", Q = 1", true),
        ("kind = \"kelvin-voigt\", time = \"1 min\"", false),
    ] {
        let study = study(&rock(rheology));
        let evolved = evolved(&study, |_| {});
        let text = evolution::text("rock", BodyKind::Spacecraft, &evolved.record) + &evolved.notes.join(" ");
        assert!(evolved.holds() && !text.contains("SOLID"), "{rheology}: {text}");
        if checked {
            let found = study.check().unwrap();
            assert!(found.holds() && !found.text().contains("SOLID"), "{rheology}: {}", found.text());
        }
    }
}

/// Two bricks side by side, each a set of its own, in the format of Gmsh 2.2.
fn bricks() -> String {
    let mut nodes = String::new();
    for (number, [x, y, z]) in (0..12).map(|i| [i % 3, i / 3 % 2, i / 6]).enumerate() {
        nodes.push_str(&format!("{} {x} {} {}\n", number + 1, 0.8 * f64::from(y), 0.5 * f64::from(z)));
    }
    let brick = |first: i32| [0, 1, 4, 3, 6, 7, 10, 9].map(|step| (first + step).to_string()).join(" ");
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"CORE\"\n3 2 \"MANTLE\"\n$EndPhysicalNames\n\
         $Nodes\n12\n{nodes}$EndNodes\n$Elements\n2\n1 5 2 1 1 {}\n2 5 2 2 2 {}\n$EndElements\n",
        brick(1),
        brick(2)
    )
}

/// Two materials of one rheology have a share each, by their names, in solids and in the layers of panels.
#[test]
fn shares_have_the_names_of_the_materials() {
    let sail = "[[panel]]\nname = \"whole\"\nrectangle = { sides = [[4, 0, 0], [0, 2, 0]], cells = [3, 2] }\n\
                layers = [{ material = \"core\", thickness = 0.02 }, { material = \"mantle\", thickness = 0.01 }]\n";
    let solid = "[[solid]]\nname = \"whole\"\nfile = \"bricks.msh\"\nmaterials = { CORE = \"core\", MANTLE = \"mantle\" }\n";
    let material = |name: &str, shear: &str| {
        format!(
            "[material.{name}]\ndensity = 2000\nshear = \"{shear}\"\npoisson = 0.25\nrheology = {{ kind = \"quality-factor\", Q = 50 }}\n"
        )
    };
    let layered = material("core", "1 GPa") + &material("mantle", "3 GPa");
    let start = wobbling("20 deg", "0.01 rad/s", "short-axis");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bricks.msh"), bricks()).unwrap();
    for parts in [sail, solid] {
        let model = format!("{layered}{parts}{start}");
        let file = folder.path().join("model.toml");
        let study = quasirigid_study::Study::read_from(&file, model.as_bytes(), None).unwrap();
        let shares = evolved(&study, |_| {}).record.dissipation;
        let [core, mantle] =
            ["whole core", "whole mantle"].map(|name| shares.get(name).copied().unwrap_or(0.0));
        assert!((core + mantle - 1.0).abs() < 1e-9 && core > 0.1 && mantle > 0.02, "{shares:?}");
    }
}

/// Density, modulus and Q as they were read stand in the answer and the record; a body of 2 m where 2 km were meant is seen.
#[test]
fn a_homogeneous_body_is_echoed() {
    let record = evolve(&rock("kind = \"quality-factor\", Q = 250").replace(" km\"", " m\""));
    let text = one_line(&evolution::text("rock", BodyKind::Spacecraft, &record));
    assert!(
        text.contains(
            "body 5027 kg, as a ball 0.8434 m in radius, 2000 kg/m^3, shear modulus 1.000e9 Pa, Q = 250"
        ),
        "{text}"
    );
    let found = record.homogeneous.unwrap();
    let mass = 2000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.6;
    for (value, expected) in [
        (found.mass, mass),
        (found.radius, 0.6_f64.cbrt()),
        (found.density, 2000.0),
        (found.shear, 1e9),
        (found.quality.unwrap(), 250.0),
    ] {
        crate::support::close(value, expected, 1e-12);
    }
}

/// Beyond `√(4πGρ/3)`, 2.3 h at 2 g/cm³, a kilometre of loose rock breaks up, which is noted; a body of 2 m does not.
#[test]
fn a_spin_beyond_gravity_is_said() {
    let notes = |model: &str| evolved(&study(model), |_| {}).notes.join(" ");
    let said = |model: &str| notes(model).contains("no longer holds loose material");
    let fast = |period: f64| {
        let rate = format!("{:e} rad/s", std::f64::consts::TAU / (3600.0 * period));
        rock("kind = \"quality-factor\", Q = 100").replace("0.35 mrad/s", &rate)
    };
    assert!(said(&fast(2.0)) && !said(&fast(2.6)));
    assert!(!said(&fast(2.0).replace(" km\"", " m\"")));
    let torque = "[[force]]\nkind = \"torque\"\ntorque = [0.0, 0.0, 1e4]\n";
    let driven = notes(&(fast(2.6).replace("until = \"5 deg\"", "duration = \"1 kyr\"") + torque));
    assert!(driven.contains("At the end the body turns once in"), "{driven}");
}

/// A ball of liquid, Reynolds number 9000 over the viscosity in units of 10⁻⁵ m²/s.
fn ball(viscosity: &str) -> String {
    carrier(260.0, [4.0, 4.0, 6.0])
        + &format!(
            "[[cavity]]\nname = \"tank\"\nshape = \"sphere\"\nradius = 0.3\ndensity = 1000.0\n\
             kinematic_viscosity = \"{viscosity}\"\nmodes = 2\n"
        )
        + &wobbling("5 deg", "1 rad/s", "short-axis")
        + "[run]\nduration = \"20 s\"\nsystems = [\"full\"]\n"
}

/// The slow flow and two relaxations give a wobble on oil at a Reynolds number of 9000 less than half its decay; honey at rest in the body they know.
#[test]
fn liquids_that_the_equations_of_motion_do_not_hold_are_told() {
    let off = "with them the rate of a small nutation at this spin is off by 57 %";
    for (viscosity, holds) in [("1e-5 m^2/s", false), ("1 m^2/s", true)] {
        let study = study(&ball(viscosity));
        let (checked, history) = (study.check().unwrap(), follow(&study, System::Full, &[0.0, 20.0]));
        let run = study.run(&PartialRun::default(), &mut ()).unwrap();
        assert_eq!([checked.holds(), history.holds(), run.holds], [holds; 3], "{viscosity}");
        for said in [checked.left_out.notes(), history.wrong.into_iter().collect(), run.record.notes] {
            assert_eq!(said.join(" ").contains(off), !holds, "{viscosity}: {said:?}");
        }
        let rigid = follow(&study, System::Rigid, &[0.0, 20.0]);
        assert!(rigid.holds() && column(&rigid.columns, "dissipated")[1] == 0.0);
    }
}
