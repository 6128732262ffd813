//! Laws of mechanics in a model file: each refusal points to the value that breaks the law, or to its table.
//! The library knows nothing of files, so these tests hold the way from an element and a field back to a line and a column.

use insta::assert_snapshot;
use quasirigid::elements::{ElementError, ElementId, ElementKind, Field, Problem};
use quasirigid::model::InertiaError;
use quasirigid_io::model::{Model, ModelError};

use super::{CARRIER, HINGED, POINT, read};

fn diagnosis(model: &Model, element: ElementId, field: Field, problem: Problem) -> String {
    model.diagnose(&ElementError { element, field, problem }).to_string()
}

fn model() -> Model {
    let spring = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600.0\n";
    read(&format!("{CARRIER}{POINT}{spring}{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n"))
}

/// Diagnostics of the laws of mechanics for a good carrier with the rest of a file, which starts in line 5.
fn verdict(rest: &str) -> String {
    super::verdict(&format!("{CARRIER}{rest}"))
}

/// Diagnostics of a point with a spring to the carrier and these further lines, which start in line 12.
fn verdict_on_spring(lines: &str) -> String {
    verdict(&format!("{POINT}[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\n{lines}"))
}

#[test]
fn a_good_model_has_nothing_against_it() {
    let model = model();
    assert_eq!(model.assembly.check(), []);
    assert!(model.assembly.body().is_ok());
}

#[test]
fn an_impossible_inertia_is_refused() {
    let inertia = |inertia: &str| {
        let hinged = HINGED.replace("[0, 1, 1]", inertia);
        verdict(&format!("{hinged}axes = [[0, 0, 1]]\nstiffness = 3\n"))
    };
    assert_snapshot!(inertia("[1, 1, 2.5]"), @r#"
    model.toml:9:11: `inertia` of appendage "boom": no body has the principal moments of inertia [1.0, 1.0, 2.5] kg m^2: none may be negative, or exceed the sum of the other two
      check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass
    "#);
    assert_snapshot!(inertia("[-1, 1, 1]"), @r#"
    model.toml:9:11: `inertia` of appendage "boom": no body has the principal moments of inertia [-1.0, 1.0, 1.0] kg m^2: none may be negative, or exceed the sum of the other two
      check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass
    "#);
    assert_snapshot!(inertia("[[1, 0.1, 0], [0.2, 1, 0], [0, 0, 1]]"), @r#"
    model.toml:9:11: `inertia` of appendage "boom": the inertia tensor is not symmetric: two entries that should be equal differ by 1e-1 kg m^2
      write the same value at [i][j] and [j][i], or only the three values of the axes
    "#);
}

#[test]
fn a_stiffness_that_is_asymmetric_or_indefinite_is_refused() {
    assert_snapshot!(verdict_on_spring("stiffness = [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]\n"), @r#"
    model.toml:12:13: `stiffness` of spring 1: the matrix is not symmetric: entries [0][1] = 0.5 and [1][0] = 0 differ
      write the same value at [i][j] and [j][i], or only the three values of the axes
    "#);
    assert_snapshot!(verdict_on_spring("stiffness = 1\ndamping = [[1, 2, 0], [2, 1, 0], [0, 0, 1]]\n"), @r#"
    model.toml:13:11: `damping` of spring 1: the smallest eigenvalue is -1e0; a spring or dashpot must not give energy
      check the signs; the eigenvalues of the matrix must be zero or positive
    "#);
}

#[test]
fn an_axial_spring_without_a_line_is_refused() {
    assert_snapshot!(verdict_on_spring("stiffness = 1\naxial = true\n"), @r#"
    model.toml:11:6: `to` of spring 1: an axial spring to the carrier needs the place of its end on the carrier
      add anchor = [x, y, z], the place of the spring's end on the carrier
    "#);
    assert_snapshot!(verdict_on_spring("stiffness = 1\naxial = true\nanchor = [0.8, 0.3, 0.5]\n"), @r#"
    model.toml:11:6: `to` of spring 1: the ends of the axial spring are at the same place, so no line joins them
      move one end, or leave out axial = true
    "#);
}

#[test]
fn a_mechanism_is_refused_at_the_element_that_moves() {
    assert_snapshot!(verdict(POINT), @r#"
    model.toml:5:1: a mechanism: no spring resists some motion of "tip" x, "tip" y, "tip" z
      add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
    "#);
    assert_snapshot!(verdict_on_spring("stiffness = 1\naxial = true\nanchor = [0, 0, 0]\n"), @r#"
    model.toml:5:1: a mechanism: no spring resists some motion of "tip" x, "tip" y, "tip" z
      add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
    "#);
}

#[test]
fn impossible_hinges_and_motions_are_refused() {
    assert_snapshot!(verdict(&format!("{POINT}motion = {{ plane = [0, 0, 0] }}\n")), @r#"
    model.toml:9:10: `motion` of point "tip": a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
    assert_snapshot!(verdict(&format!("{HINGED}axes = [[0, 0, 1], [0, 0, 2]]\nstiffness = [1, 2, 3]\n")), @r#"
    model.toml:11:8: `axes` of appendage "boom": the axes are not independent, so two of them would be the same motion
      no axis may be a combination of the others
    model.toml:12:13: `stiffness` of appendage "boom": 2 axes, but 3 values
      write one number for all axes, one per axis, or a square matrix with a row per axis
    "#);
    let hinge = |stiffness: &str| verdict(&format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = {stiffness}\n"));
    assert_snapshot!(hinge("[]"), @r#"
    model.toml:12:13: `stiffness` of appendage "boom": 1 axis, but 0 values
      write one number for all axes, one per axis, or a square matrix with a row per axis
    "#);
    assert_snapshot!(hinge("[[]]"), @r#"
    model.toml:12:13: `stiffness` of appendage "boom": 1 axis, but 0 values
      write one number for all axes, one per axis, or a square matrix with a row per axis
    "#);
    assert_snapshot!(hinge("[[1, 2], [2, 1]]"), @r#"
    model.toml:12:13: `stiffness` of appendage "boom": 1 axis, but 2 values
      write one number for all axes, one per axis, or a square matrix with a row per axis
    "#);
}

/// Diagnostics of a force with these lines, which start in line 10, on a body with a point.
fn verdict_on_force(lines: &str) -> String {
    verdict(&format!("{POINT}[[force]]\n{lines}"))
}

#[test]
fn impossible_forces_are_refused() {
    assert_snapshot!(verdict_on_force("kind = \"drag\"\non = \"carrier\"\ncoefficient = 1\n"), @r#"
    model.toml:9:1: `at` of force "force 1": a force on the carrier needs the place where it acts
      add at = [x, y, z], the place on the carrier, in the file's frame
    "#);
    assert_snapshot!(verdict_on_force("kind = \"thrust\"\non = \"tip\"\nat = [0, 0, 1]\nforce = [0, 0, 1]\n"), @r#"
    model.toml:12:6: `at` of force "force 1": a force on a point acts at the point itself
      leave it out, or write on = "carrier"
    "#);
    let orbit = |keys: &str| {
        let orbit = format!("orbit = {{ body = \"Earth\", semi_major_axis = 7e6, {keys} }}");
        verdict_on_force(&format!("name = \"pull\"\nkind = \"central-gravity\"\n{orbit}\n"))
    };
    assert_snapshot!(orbit("eccentricity = 1"), @r#"
    model.toml:12:65: `eccentricity` of force "pull": no ellipse has the eccentricity 1; it is at least 0 and below 1
      write 0 for a circle; a flyby has a `periapsis_distance`, under central gravity
    "#);
    assert_snapshot!(orbit("node = 0, eccentricity = -0.1"), @r#"
    model.toml:12:75: `eccentricity` of force "pull": no ellipse has the eccentricity -0.1; it is at least 0 and below 1
      write 0 for a circle; a flyby has a `periapsis_distance`, under central gravity
    "#);
    assert_snapshot!(verdict_on_force("kind = \"torque\"\ntorque = [0, 0, 1]\nperiod = 1e-309\n"), @r#"
    model.toml:12:10: `frequency` of force "force 1": inf is not a finite number
      write a finite number
    "#);
}

#[test]
fn what_mechanics_says_of_forces_and_driven_points_is_located() {
    let pull = "[[force]]\nkind = \"central-gravity\"\norbit = { gravitational_parameter = 1, semi_major_axis = 2 }\n";
    let push = "[[force]]\nkind = \"spin-drag\"\ncoefficient = 2\n";
    let support = "[support]\nkind = \"prescribed\"\npoint = [0, 0, 0]\nacceleration = [0, 0, 0]\nvelocity = [0, 0, 1]\n";
    let model = read(&format!("{CARRIER}{pull}{push}{support}"));
    let not_positive = || Problem::NotPositive { value: -1.0 };
    assert_snapshot!(diagnosis(&model, ElementKind::Force.at(0), Field::SEMI_MAJOR_AXIS, not_positive()), @r#"
    model.toml:7:58: `semi_major_axis` of force "force 1": -1 is not positive
      write a positive number
    "#);
    assert_snapshot!(diagnosis(&model, ElementKind::Force.at(0), Field::NODE, not_positive()), @r#"
    model.toml:5:1: `node` of force "force 1": -1 is not positive
      write a positive number
    "#);
    assert_snapshot!(diagnosis(&model, ElementKind::Force.at(1), Field::COEFFICIENT, Problem::Driving { value: -1.0 }), @r#"
    model.toml:10:15: `coefficient` of force "force 2": the coefficient -1 is negative; a drag must not give energy
      write a positive coefficient; the force is opposite to the velocity
    "#);
    let infinite = || Problem::NotFinite { value: f64::INFINITY };
    assert_snapshot!(diagnosis(&model, ElementId::SUPPORT, Field::VELOCITY, infinite()), @"
    model.toml:15:12: `velocity` of the support: inf is not a finite number
      write a finite number
    ");
    assert_snapshot!(diagnosis(&model, ElementId::SUPPORT, Field::POSITION, infinite()), @"
    model.toml:11:1: `position` of the support: inf is not a finite number
      write a finite number
    ");
}

#[test]
fn a_law_of_mechanics_is_cited_at_the_value_that_breaks_it() {
    let model = model();
    let impossible = Problem::Inertia(InertiaError::Impossible { moments: [1.0, 2.0, 4.0] });
    assert_snapshot!(diagnosis(&model, ElementId::CARRIER, Field::INERTIA, impossible), @r#"
    model.toml:4:11: `inertia` of the carrier: no body has the principal moments of inertia [1.0, 2.0, 4.0] kg m^2: none may be negative, or exceed the sum of the other two
      check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass
    "#);
    let indefinite = Problem::Indefinite { eigenvalue: -2.5 };
    assert_snapshot!(diagnosis(&model, ElementKind::Spring.at(0), Field::STIFFNESS, indefinite), @r#"
    model.toml:12:13: `stiffness` of spring 1: the smallest eigenvalue is -2.5e0; a spring or dashpot must not give energy
      check the signs; the eigenvalues of the matrix must be zero or positive
    "#);
    let mechanism = Problem::Mechanism { coordinates: "tip.x, tip.y".to_owned() };
    assert_snapshot!(diagnosis(&model, ElementKind::Point.at(0), Field::POSITION, mechanism), @r#"
    model.toml:8:12: a mechanism: no spring resists some motion of tip.x, tip.y
      add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
    "#);
    let massless = Problem::MasslessAxis { axis: 1 };
    assert_snapshot!(diagnosis(&model, ElementKind::Hinged.at(0), Field::AXES, massless), @r#"
    model.toml:19:8: `axes` of appendage "boom": turning about axis 1 moves no mass; leave that axis out
      or give the appendage an inertia about it
    "#);
}

#[test]
fn a_value_the_file_leaves_out_is_diagnosed_at_its_table() {
    let model = model();
    assert_snapshot!(diagnosis(&model, ElementKind::Point.at(0), Field::MOTION, Problem::ZeroDirection), @r#"
    model.toml:5:1: `motion` of point "tip": a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
    let moments = [0.0, 0.0, 1.0];
    let no_inertia = Problem::NoInertia { moments, held: false };
    assert_snapshot!(diagnosis(&model, ElementId::SUPPORT, Field::FIXED_POINT, no_inertia), @r#"
    model.toml:1:1: the whole body has no inertia about some axis (principal moments [0.0, 0.0, 1.0] kg m^2)
      check the masses and the inertia of the carrier
    "#);
}

#[test]
fn several_errors_stand_in_the_order_of_the_file() {
    let error =
        |element, field| ElementError { element, field, problem: Problem::NotFinite { value: f64::NAN } };
    let errors = [error(ElementKind::Hinged.at(0), Field::MASS), error(ElementId::CARRIER, Field::MASS)];
    let ModelError::Invalid { diagnostics, model } = model().diagnose_all(&errors) else {
        panic!("a listing");
    };
    assert_eq!(
        diagnostics.iter().map(|diagnostic| diagnostic.position(&model.text)).collect::<Vec<_>>(),
        [(2, 8), (15, 8)]
    );
    assert_eq!(&model.text[diagnostics[0].span.clone()], "40.0");
}
