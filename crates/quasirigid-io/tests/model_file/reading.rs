//! Reading of a full model: every value in its place, defaults of absent ones, and every way to write TOML.
//! Values are compared one by one, since a round trip would pass a key that is read into the wrong field.

use std::fmt::Write as _;

use insta::assert_snapshot;
use quasirigid::dynamics::Form;
use quasirigid::elements::{Coefficient, End, HingeCoefficient, PointMotion, SpringLaw};
use quasirigid::model::Support;
use quasirigid_io::model::{PartialRun, Rotation};

use super::{CARRIER, carrier, read};

#[test]
fn a_full_model_is_read() {
    let model = read(
        r#"
[body]
name = "boom satellite"
[carrier]
mass = "88.184904873951 lb"
center_of_mass = [0, "10 cm", 0.0]
inertia = [[9.0, 0.5, 0], [0.5, 13.0, 0], [0, 0, 16.0]]
[[point]]
mass = 1
position = [0.8, 0.3, 0.5]
[[point]]
name = "slider"
mass = "500 g"
position = ["1 m", 0, "22 in"]
motion = { line = [1, 0, 0] }
[[spring]]
from = "point 1"
to = "carrier"
stiffness = "6 N/cm"
damping = 30
[[spring]]
from = "slider"
to = "point 1"
stiffness = [1, 2, 3]
damping = [[1, 0, 0], [0, 2, 0.5], [0, 0.5, 3]]
[[spring]]
from = "slider"
to = "carrier"
axial = true
anchor = [0.5, 0, 0]
stiffness = 7
[[hinged]]
name = "boom"
mass = 2.0
center_of_mass = [1.5, 0, 0]
inertia = [0, 0.3, 0.3]
hinge = [1, 0, 0]
axes = [[0, 1, 0], [0, 0, 1]]
stiffness = "0.565 N m/rad"
damping = ["0.01 N m s/rad", 0.02]
[support]
kind = "fixed-point"
point = [0, 0, -1]
[initial]
angular_velocity = ["750 rpm", 0.35, "3 deg/s"]
attitude = [0.6, 0, 0.8, 0]
displacements = "slow-manifold"
[run]
order = 5
duration = "2 h"
tolerance = 1e-10
samples = 1000
form = "angular-momentum"
"#,
    );
    assert_eq!(model.name, "boom satellite");
    let body = &model.assembly;
    assert!((carrier(body).mass - 40.0).abs() < 1e-12); // 14 digits written
    assert_eq!(carrier(body).center_of_mass, [0.0, 0.1, 0.0]);
    assert_eq!(carrier(body).inertia, [[9.0, 0.5, 0.0], [0.5, 13.0, 0.0], [0.0, 0.0, 16.0]]);
    assert_eq!(body.points[0].name, "point 1");
    assert_eq!(body.points[0].motion, PointMotion::Free);
    assert_eq!(body.points[1].mass, 0.5);
    assert_eq!(body.points[1].position, [1.0, 0.0, 0.5588]);
    assert_eq!(body.points[1].motion, PointMotion::Line([1.0, 0.0, 0.0]));
    assert_eq!((body.springs[0].from, body.springs[0].to), (End::Point(0), End::Carrier));
    assert_eq!((body.springs[1].from, body.springs[1].to), (End::Point(1), End::Point(0)));
    let [isotropic, full, axial] = [0, 1, 2].map(|index| body.springs[index].law);
    let (stiffness, damping) = (Coefficient::Isotropic(600.0), Coefficient::Isotropic(30.0));
    assert_eq!(isotropic, SpringLaw::Spatial { stiffness, damping });
    let stiffness = Coefficient::Diagonal([1.0, 2.0, 3.0]);
    let damping = Coefficient::Full([[1.0, 0.0, 0.0], [0.0, 2.0, 0.5], [0.0, 0.5, 3.0]]);
    assert_eq!(full, SpringLaw::Spatial { stiffness, damping });
    assert_eq!(
        axial,
        SpringLaw::Axial {
            stiffness: 7.0,
            damping: 0.0,
            anchor: Some([0.5, 0.0, 0.0]),
            prestress: quasirigid::elements::Prestress::Relaxed
        }
    );
    let boom = &body.hinged[0];
    assert_eq!(boom.axes, [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(boom.inertia, [[0.0, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]]);
    assert_eq!(boom.stiffness, HingeCoefficient::PerAxis(vec![0.565, 0.565]));
    assert_eq!(boom.damping, HingeCoefficient::PerAxis(vec![0.01, 0.02]));
    assert_eq!(body.support, Support::FixedPoint { point: [0.0, 0.0, -1.0] });
    assert!(matches!(model.initial.rotation, Some(Rotation::Spin([_, 0.35, _]))));
    assert_eq!(model.initial.attitude, [0.6, 0.0, 0.8, 0.0]);
    let histories = &model.run.histories;
    assert_eq!((model.run.order, histories.duration, histories.samples), (5, Some(7200.0), Some(1000)));
    assert_eq!((histories.tolerance, histories.form), (Some(1e-10), Some(Form::AngularMomentum)));
    assert_eq!(model.notes, [""; 0]);
    assert_eq!(model.extremes, None);
}

#[test]
fn what_the_file_leaves_out_has_its_default() {
    let model = read(CARRIER);
    assert_eq!(model.name, "model");
    assert_eq!(model.assembly.support, Support::Free);
    assert_eq!(model.initial.rotation, None);
    assert_eq!(model.initial.attitude, [1.0, 0.0, 0.0, 0.0]);
    assert_eq!((model.run.order, model.run.histories), (3, PartialRun::default()));
    // of CARRIER, by sha256sum
    assert_eq!(model.source.sha256, "0f1303cac9ec4982d910513c3b13aaebed50ec6616aa0ade1315747430b9b288");
}

#[test]
fn every_way_to_write_toml_is_understood() {
    let model = read(
        "carrier.mass = 0x28\ncarrier.center_of_mass = [0, +0.1, -0]\ncarrier.inertia = [9.0, 1_3, 16.0]\npoint = [{ mass = 1.0, position = [0, 0, 1] }]\r\n",
    );
    assert_eq!(carrier(&model.assembly).mass, 40.0);
    assert_eq!(carrier(&model.assembly).inertia[1][1], 13.0);
    assert_eq!(model.assembly.points.len(), 1);
    assert_eq!(carrier(&read(&format!("\u{feff}{CARRIER}")).assembly).mass, 40.0);
}

#[test]
fn an_attitude_rounded_by_hand_is_normalised_with_a_note() {
    let model = read(&format!("{CARRIER}[initial]\nattitude = [0.7071, 0, 0.7071, 0]\n"));
    let norm: f64 = model.initial.attitude.iter().map(|component| component * component).sum();
    assert!((norm - 1.0).abs() < 1e-15);
    assert_snapshot!(model.notes.join("\n"), @"the initial attitude has the norm 0.9999904099540154; it was divided by it");
}

#[test]
fn a_large_model_is_read_without_delay() {
    const COUNT: usize = 100_000;
    let mut text = CARRIER.to_owned();
    for index in 0..COUNT {
        write!(text, "[[point]]\nname = \"p{index}\"\nmass = 1.0\nposition = [{index}.5, 0.25, \"3 mm\"]\n")
            .expect("memory");
        write!(text, "[[spring]]\nfrom = \"p{index}\"\nto = \"carrier\"\nstiffness = 600.0\n")
            .expect("memory");
    }
    let start = std::time::Instant::now();
    let model = read(&text);
    assert_eq!(model.assembly.springs[COUNT - 1].from, End::Point(COUNT - 1));
    // ten times what an unoptimised build on a busy machine needs; quadratic work takes minutes
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}
