//! Public data go through JSON and come back unchanged; values that the constructors refuse are refused there too.

use std::fmt::Debug;

use quasirigid::elements::{ApplicationPoint, Assembly, Bushing, PlaceRef};
use quasirigid::model::force::{Axes, Force, ForceLaw};
use quasirigid::model::{Measured, Rheology};
use quasirigid::prelude::*;
use quasirigid::problems::ring_of_points;
use quasirigid_math::expression::Expression;
use serde::Serialize;
use serde::de::DeserializeOwned;

fn same<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let text = serde_json::to_string(value).unwrap();
    let back: T = serde_json::from_str(&text).unwrap();
    assert_eq!(&back, value, "{text}");
}

#[test]
fn assemblies_come_back() {
    let mut assembly: Assembly = ring_of_points(3);
    let inertia = [[0.2, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 0.2]];
    let boom = Hinged::new("boom", 2.0, [0.0, -1.5, 0.2], inertia).on([0.0, -1.0, 0.2]);
    assembly.add(boom.about([1.0, 0.1, 0.0], 200.0, 0.5).place("tip", [0.0, -2.0, 0.2]));
    assembly.bushings.push(Bushing {
        name: "mount".into(),
        from: End::Carrier,
        to: End::Hinged(PlaceRef { hinged: 0, place: 0 }),
        center: Some([0.0, -1.9, 0.3]),
        axes: [[1.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        stiffness: [400.0, 500.0, 1e4 / 3.0],
        rotational_stiffness: [3.0; 3],
        damping: [0.1; 3],
        rotational_damping: [0.0; 3],
        rheology: Rheology::Elastic,
    });
    let table = Measured::new(vec![[1.0, 0.9, 0.01], [10.0, 1.1, 0.02]]).unwrap();
    assembly.springs[0].rheology = Rheology::Table(table);
    let force = ["t", "2*x", "1/3"].map(|text| Expression::parse(text, &["t", "x"]).unwrap());
    let law = ForceLaw::TorqueExpression { torque: force, axes: Axes::Body };
    assembly.forces.push(Force { name: "coil".into(), law });
    let _: &Vec<Force<ApplicationPoint>> = &assembly.forces;
    same(&assembly);
}

#[test]
fn runs_come_back() {
    let reduced = reduce(&ring_of_points(2).body().unwrap(), 3).unwrap();
    let events = vec![Event::Nutation { axis: [0.1, 0.2, 0.3], angle: 0.4 }, Event::Energy(-1.0)];
    let options = Options { events, tolerance: 1e-7, form: Form::AngularVelocity, ..Options::default() };
    same(&options);
    let start = Start::new([0.1, 0.2, 1.0 / 3.0], ALIGNED);
    same(&start);
    let mut samples: Vec<Sample> = Vec::new();
    let run = propagate(&reduced, start, &[0.1, 0.2], &options, &mut samples).unwrap();
    same(&run);
    same(&samples);
}

#[test]
fn what_no_constructor_takes_is_refused() {
    let rows = |text: &str| serde_json::from_str::<Measured>(text).is_ok();
    assert!(rows("[[1.0, 0.9, 0.01]]") && !rows("[]") && !rows("[[2.0, 1.0, 0.1], [1.0, 1.0, 0.1]]"));
    let formula = |text: &str| serde_json::from_str::<Expression>(text).is_ok();
    assert!(formula(r#"{"text": "2*t", "variables": ["t"]}"#));
    assert!(!formula(r#"{"text": "2*t", "variables": []}"#));
}
