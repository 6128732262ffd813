use insta::assert_snapshot;
use quasirigid::elements::{ElementError, Field, Place, Problem};
use quasirigid::model::{InertiaError, Support};
use quasirigid_io::model::{Model, ModelError};

use super::{CARRIER, HINGED, POINT, read};

fn diagnosis(model: &Model, place: Place, field: Field, problem: Problem) -> String {
    model
        .diagnose(&ElementError {
            place,
            field,
            problem,
        })
        .to_string()
}

fn model() -> Model {
    let spring = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600.0\n";
    read(&format!(
        "{CARRIER}{POINT}{spring}{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n"
    ))
}

#[test]
fn a_law_of_mechanics_is_cited_at_the_value_that_breaks_it() {
    let model = model();
    let impossible = Problem::Inertia(InertiaError::Impossible {
        moments: [1.0, 2.0, 4.0],
    });
    assert_snapshot!(diagnosis(&model, Place::Carrier, Field::Inertia, impossible), @r#"
    model.toml:4:11: `inertia` of the carrier: no body has the principal moments of inertia [1.0, 2.0, 4.0] kg m^2: none may be negative, or exceed the sum of the other two
      check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass
    "#);
    let indefinite = Problem::Indefinite { eigenvalue: -2.5 };
    assert_snapshot!(diagnosis(&model, Place::Spring(0), Field::Stiffness, indefinite), @r#"
    model.toml:12:13: `stiffness` of spring 1: the smallest eigenvalue is -2.5e0; a spring or dashpot must not give energy
      check the signs; the eigenvalues of the matrix must be zero or positive
    "#);
    let mechanism = Problem::Mechanism {
        coordinates: "tip.x, tip.y".to_owned(),
    };
    assert_snapshot!(diagnosis(&model, Place::Point(0), Field::Position, mechanism), @r#"
    model.toml:8:12: a mechanism: no spring resists the motion of tip.x, tip.y
      add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
    "#);
    let massless = Problem::MasslessAxis { axis: 1 };
    assert_snapshot!(diagnosis(&model, Place::Hinged(0), Field::Axes, massless), @r#"
    model.toml:19:8: `axes` of appendage "boom": turning about axis 1 moves no mass; leave that axis out
      or give the appendage an inertia about it
    "#);
}

#[test]
fn a_value_the_file_leaves_out_is_diagnosed_at_its_table() {
    let model = model();
    assert_snapshot!(diagnosis(&model, Place::Point(0), Field::Motion, Problem::ZeroDirection), @r#"
    model.toml:5:1: `motion` of point "tip": a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
    let moments = [0.0, 0.0, 1.0];
    let no_inertia = Problem::NoInertia {
        moments,
        support: Support::Free,
    };
    assert_snapshot!(diagnosis(&model, Place::Support, Field::FixedPoint, no_inertia), @r#"
    model.toml:1:1: the whole body has no inertia about some axis (principal moments [0.0, 0.0, 1.0] kg m^2)
      check the masses and the inertia of the carrier
    "#);
}

#[test]
fn several_errors_stand_in_the_order_of_the_file() {
    let error = |place, field| ElementError {
        place,
        field,
        problem: Problem::NotFinite { value: f64::NAN },
    };
    let errors = [
        error(Place::Hinged(0), Field::Mass),
        error(Place::Carrier, Field::Mass),
    ];
    let ModelError::Invalid { diagnostics, model } = model().diagnose_all(&errors) else {
        panic!("a listing");
    };
    assert_eq!(
        diagnostics
            .iter()
            .map(|diagnostic| diagnostic.position(&model.text))
            .collect::<Vec<_>>(),
        [(2, 8), (15, 8)]
    );
    assert_eq!(&model.text[diagnostics[0].span.clone()], "40.0");
}
