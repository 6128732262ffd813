//! Orders above the one that the parts of a body support are named in a note.

use crate::support::{MODEL, ran_with};

const ELLIPSOID: &str = r#"
[material.rubble]
density = 2000
shear = "2 kPa"
poisson = 0.25
rheology = { kind = "kelvin-voigt", time = "0.05 s" }
[[ellipsoid]]
semi_axes = [1.5, 1.2, 0.9]
material = "rubble"
[initial]
angular_velocity = [0.06, 0.05, 0.09]
"#;

#[test]
fn orders_beyond_the_kinematics_are_said() {
    let axial =
        MODEL.replace("to = \"carrier\"", "to = \"carrier\"\naxial = true\nanchor = [0, 0, 0]").replace(
            "position = [0.8, 0.3, 0.5]",
            "position = [0.8, 0.3, 0.5]\nmotion = { line = [0.8, 0.3, 0.5] }",
        );
    let hinged = format!(
        "{MODEL}[[hinged]]\nmass = 1\ncenter_of_mass = [0, 1, 0]\ninertia = [0.1, 0.1, 0.1]\nhinge = [0, 0.5, 0]\naxes = [[1, 0, 0]]\nstiffness = 90\n"
    );
    for (model, complete, words) in [
        (ELLIPSOID, 3, "the strain of ellipsoids is linear"),
        (&axial, 3, "the force of axial springs is linear"),
        (&hinged, 5, "paths on hinges"),
    ] {
        let note = |order: usize| {
            ran_with(model, &format!("derive model.toml --order {order} --format latex"))
                .stderr
                .replace('\n', " ")
        };
        assert_eq!(note(complete), "", "{words}");
        let said = note(complete + 1);
        assert!(said.contains(words) && said.contains(&format!("complete to order {complete}")), "{said}");
        assert_eq!(said.contains("The full system has the terms that are missing."), complete == 5, "{said}");
    }
    assert_eq!(
        ran_with(MODEL, "derive model.toml --order 9 --format latex").stderr,
        "",
        "points on springs are exact"
    );
}

#[test]
fn a_verification_beyond_the_kinematics_does_not_end_with_every_order_reached() {
    let ran = ran_with(ELLIPSOID, "verify model.toml --orders 3,4 --revolutions 0.1 --halvings 1");
    let last = ran.stdout.trim_end().replace('\n', " ");
    assert!(last.contains("complete to order 3") && last.ends_with("in the full system, too."), "{last}");
    let ran = ran_with(ELLIPSOID, "verify model.toml --orders 3 --revolutions 0.1 --halvings 1");
    assert!(!ran.stdout.contains("complete to order"), "{}", ran.stdout);
    assert!(ran.stdout.contains("in the paper's form"), "{}", ran.stdout);
}

#[test]
fn liquids_are_complete_to_the_order_of_the_paper() {
    let cavity =
        |shape: &str| format!("{MODEL}[[cavity]]\n{shape}\ndensity = 1000\nkinematic_viscosity = 0.1\n");
    let note = |shape: &str, order: usize| {
        let ran = ran_with(&cavity(shape), &format!("derive model.toml --order {order} --format latex"));
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        ran.stderr
    };
    let [ball, ellipsoid] =
        ["shape = \"sphere\"\nradius = 0.2", "shape = \"ellipsoid\"\nsemi_axes = [0.25, 0.2, 0.15]"];
    for shape in [ball, ellipsoid] {
        assert_eq!(note(shape, 3), "");
        assert!(note(shape, 4).contains("the square of the velocity"), "{}", note(shape, 4));
    }
    assert_eq!(note("shape = \"ring\"\nradius = 0.3\ntube_radius = 0.02", 5), "");
}
