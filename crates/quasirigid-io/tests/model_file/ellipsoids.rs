//! A body without a carrier, and elements that cannot stand beside it.

use std::path::Path;

use insta::assert_snapshot;
use quasirigid_elements::ObservedShape;
use quasirigid_io::model::{Displacements, Model};

use super::{CARRIER, HINGED, POINT, ROCK, made_of, read, refusal};

/// A file with an ellipsoid of rock in lines 1 to 7 and these lines after it, from line 8.
fn with(rest: &str) -> String {
    made_of(&format!("{ROCK}{rest}"))
}

/// Diagnostics of the laws of mechanics for such a file.
fn verdict(rest: &str) -> String {
    let model = read(&with(rest));
    let errors = model.assembly.check();
    let errors = if errors.is_empty() { model.assembly.forces().err().into_iter().collect() } else { errors };
    model.diagnose_all(&errors).to_string()
}

#[test]
fn a_file_without_a_body_is_refused() {
    assert_snapshot!(refusal(&format!("[material.rock]\n{ROCK}")), @"
    model.toml:1:1: the file has no [carrier] and no part that is elastic throughout
      add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]
    ");
    assert_snapshot!(refusal("ellipsoid = []\n"), @"
    model.toml:1:1: the file has no [carrier] and no part that is elastic throughout
      add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]
    ");
    assert_snapshot!(refusal("[ellipsoid]\nsemi_axes = [1, 2, 3]\n"), @"
    model.toml:1:1: `ellipsoid` is a list of tables, but a table stands here
      write [[ellipsoid]], with double brackets, once for each
    ");
}

#[test]
fn an_ellipsoid_has_semi_axes_and_a_material() {
    assert_snapshot!(refusal("[[ellipsoid]]\n"), @r#"
    model.toml:1:1: [[ellipsoid]] has no `semi_axes`
      add a line such as: semi_axes = ["2.3 km", "1.2 km", "950 m"]
    model.toml:1:1: [[ellipsoid]] has no `material`
      add a line such as: material = "rock"
    "#);
    let axes = |axes: &str| refusal(&with("").replace("[2300, 1200, 950]", axes));
    assert_snapshot!(axes("[2300, 1200]"), @"
    model.toml:2:13: `semi_axes`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    ");
    assert_snapshot!(axes("[\"2.3 km\", 0, -950]"), @r#"
    model.toml:2:24: `semi_axes` is 0 m, but must be positive
      write a number in m, or a text with its unit such as "22 in"
    model.toml:2:27: `semi_axes` is -950 m, but must be positive
      write a number in m, or a text with its unit such as "22 in"
    "#);
    assert_snapshot!(axes("[nan, \"1 s\", inf]"), @r#"
    model.toml:2:14: `semi_axes` is nan, which is not a finite number
      write a number in m, or a text with its unit such as "22 in"
    model.toml:2:19: `semi_axes`: "1 s" is a time, but a length is needed
      write for example "22 in", or a plain number in m
    model.toml:2:26: `semi_axes` is inf, which is not a finite number
      write a number in m, or a text with its unit such as "22 in"
    "#);
    assert_snapshot!(refusal(&with("").replace("semi_axes", "semiaxes")), @r#"
    model.toml:2:1: unknown key "semiaxes" in [[ellipsoid]]
      did you mean `semi_axes`? the keys are name, semi_axes, diameter, axis_ratios, moment_ratios, shape, center, material
    "#);
    assert_snapshot!(refusal(&with("").replace("material = \"rock\"", "material = \"rock\"\ncentre = [0, 0, 1]")), @r#"
    model.toml:4:1: unknown key "centre" in [[ellipsoid]]
      did you mean `center`? the keys are name, semi_axes, diameter, axis_ratios, moment_ratios, shape, center, material
    "#);
}

#[test]
fn names_are_unique_across_all_parts() {
    let named =
        |name: &str| with("").replacen("[[ellipsoid]]", &format!("[[ellipsoid]]\nname = \"{name}\""), 1);
    assert_eq!(read(&named("Toutatis")).assembly.ellipsoids[0].name, "Toutatis");
    assert_snapshot!(refusal(&format!("{}{POINT}", named("tip"))), @r#"
    model.toml:10:8: the name "tip" is used twice; it stands first in line 2
      give each element its own name
    "#);
    assert_snapshot!(refusal(&named("carrier")), @r#"
    model.toml:2:8: the name "carrier" is that of the carrier
      choose another name
    "#);
}

#[test]
fn nothing_is_fixed_to_an_ellipsoid() {
    let spring = "[[spring]]\nfrom = \"ellipsoid 1\"\nto = \"tip\"\nstiffness = 1\n";
    assert_snapshot!(refusal(&with(&format!("{POINT}{spring}"))), @r#"
    model.toml:13:8: "ellipsoid 1" is elastic throughout, but a spring joins points, nodes of parts, places on appendages and the carrier
      it is a whole body; nothing is fixed to it
    "#);
    let force = "[[force]]\nkind = \"thrust\"\non = \"ellipsoid 1\"\nforce = [0, 0, 1]\n";
    assert_snapshot!(refusal(&with(force)), @r#"
    model.toml:10:6: "ellipsoid 1" is elastic throughout, but a force acts on a point, on a node of a part, on a place of an appendage or on the carrier
      it is a whole body; nothing is fixed to it
    "#);
}

#[test]
fn what_stands_beside_an_ellipsoid_is_refused() {
    assert_snapshot!(verdict(CARRIER), @"
    model.toml:8:1: the carrier: an ellipsoid or a surface is the whole body; this is not allowed beside it
      leave it out, or make the body of a [carrier] and what hangs on it
    ");
    assert_snapshot!(verdict(POINT), @r#"
    model.toml:9:8: point "tip": an ellipsoid or a surface is the whole body; this is not allowed beside it
      leave it out, or make the body of a [carrier] and what hangs on it
    "#);
    assert_snapshot!(verdict(&format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n")), @r#"
    model.toml:9:8: appendage "boom": an ellipsoid or a surface is the whole body; this is not allowed beside it
      leave it out, or make the body of a [carrier] and what hangs on it
    "#);
    assert_snapshot!(verdict("[[ellipsoid]]\nsemi_axes = [1, 2, 3]\nmaterial = \"rock\"\n"), @r#"
    model.toml:8:1: ellipsoid "ellipsoid 2": an ellipsoid or a surface is the whole body; this is not allowed beside it
      leave it out, or make the body of a [carrier] and what hangs on it
    "#);
    assert_snapshot!(verdict("[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n"), @"
    model.toml:10:9: `point` of the support: a body that is elastic throughout moves freely; no point of it can be held
      leave [support] out
    ");
    assert_snapshot!(verdict("[[force]]\nkind = \"thrust\"\non = \"carrier\"\nat = [0, 0, 1]\nforce = [0, 0, 1]\n"), @r#"
    model.toml:10:6: `on` of force "force 1": this body has no carrier
      on a body that is elastic throughout act gravity and torques, which need no place
    "#);
    let torque = read(&with("[[force]]\nkind = \"torque\"\ntorque = [0, 0, 1]\n"));
    assert_eq!(
        (torque.assembly.check(), torque.assembly.forces().map(|forces| forces.len())),
        (vec![], Ok(1))
    );
}

/// Elements that no file can describe, as a program can build them.
#[test]
fn what_mechanics_says_of_an_ellipsoid_is_located() {
    let mut model = read(&with(""));
    model.assembly.ellipsoids[0].material.young = f64::INFINITY;
    assert_snapshot!(model.diagnose_all(&model.assembly.check()), @r#"
    model.toml:6:9: `young` of ellipsoid "ellipsoid 1": inf is not a finite number
      write a finite number
    "#);
    model.assembly.ellipsoids[0].material.young = 1.0;
    model.assembly.ellipsoids[0].material.poisson = 0.5;
    assert_snapshot!(model.diagnose_all(&model.assembly.check()), @r#"
    model.toml:7:11: `poisson` of ellipsoid "ellipsoid 1": no elastic material that can be compressed has the Poisson's ratio 0.5; it lies between -1 and 0.5
      most rocks and metals have 0.2 to 0.35
    "#);
    let mut sheared = read(&with("").replace("young", "shear"));
    sheared.assembly.ellipsoids[0].material.young = -1.0;
    assert_snapshot!(sheared.diagnose_all(&sheared.assembly.check()), @r#"
    model.toml:6:9: `young` of ellipsoid "ellipsoid 1": -1 is not positive
      write a positive number
    "#);
    model.assembly.ellipsoids.clear();
    assert_snapshot!(model.diagnose(&model.assembly.body().expect_err("no body")), @"
    model.toml:1:1: the body has no carrier and no part that is elastic throughout
      add a [carrier], or parts that are elastic throughout, such as an [[ellipsoid]]
    ");
}

#[test]
fn an_ellipsoid_starts_on_the_slow_manifold_or_at_rest() {
    assert_eq!(read(&with("[initial]\n")).initial.displacements, Displacements::SlowManifold);
    let rest = read(&with("[initial]\ndisplacements = \"rest\"\n"));
    assert_eq!(rest.initial.displacements, Displacements::Given { q: Vec::new(), rate: Vec::new() });
    assert_snapshot!(refusal(&with("[initial]\ndisplacements = { \"ellipsoid 1\" = [0, 0, 1] }\n")), @r#"
    model.toml:9:19: "ellipsoid 1" is elastic throughout, and its displacements have no names
      write displacements = "slow-manifold" or "rest"
    "#);
}

/// Numbers so large or small that mechanics cannot compute with them are read or refused.
#[test]
fn no_size_makes_it_panic() {
    for size in ["1e-300", "1e-100", "1e-30", "1e30", "1e100", "1e300"] {
        let text = with("[initial]\ndisplacements = \"rest\"\n")
            .replace("[2300, 1200, 950]", &format!("[1, {size}, 3]"));
        let _ = Model::parse(Path::new("model.toml"), &text);
    }
}

/// A shape observed in rotation is noted in the assembly, at the ends of ranges too; a start that has none is refused.
#[test]
fn a_shape_as_observed_needs_a_rotation() {
    let observed = |lines: &str, rest: &str| {
        let text = with(rest).replacen("semi_axes = [2300, 1200, 950]", lines, 1);
        text.replacen("material = \"rock\"", "material = \"rock\"\nshape = \"as-observed\"", 1)
    };
    let spin = "[initial]\nangular_velocity = [0, 0, 1e-3]\n";
    let axes = "semi_axes = [2300, 1200, 950]";
    assert_eq!(read(&observed(axes, spin)).assembly.as_observed, Some(ObservedShape::Surface));
    let moments = "diameter = 300\nmoment_ratios = [1, 1.1, 1.2]";
    assert_eq!(read(&observed(moments, spin)).assembly.as_observed, Some(ObservedShape::Moments));
    assert_eq!(read(&with(spin)).assembly.as_observed, None);
    let none = refusal(&observed(axes, ""));
    assert!(none.contains("`shape`: the shape observed is that of the body in rotation"), "{none}");
    let rest = refusal(&observed(axes, "[initial]\nangular_velocity = [0, 0, 0]\n"));
    assert!(rest.contains("this body is at rest"), "{rest}");
    let built = read(&observed(axes, spin));
    let error = built.diagnose(&built.assembly.body().unwrap_err()).to_string();
    assert!(error.contains("a body is built of its relaxed shape"), "{error}");
}
