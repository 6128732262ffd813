//! The magnetic field of a model, and controllers in it: what is read, and refusals of mistakes in their place. (Y8), (Y9)

use quasirigid::elements::NamedController;
use quasirigid::model::control::{Actuator, ControlLaw, HysteresisLoop, HysteresisRod, Measurement};
use quasirigid::model::force::{ForceLaw, MagneticField};

use super::{CARRIER, read, refusal_of, verdict};

const FIELD: &str = "[magnetic_field]\nfield = [0, \"20 uT\", \"30 uT\"]\n";
const ORBIT: &str = "orbit = { body = \"Earth\", semi_major_axis = \"6878 km\" }\n";
const UNIFORM: MagneticField = MagneticField::Uniform([0.0, 2e-5, 3e-5]);

fn b_dot(lines: &str) -> NamedController {
    let text = format!("{CARRIER}{FIELD}[[controller]]\nkind = \"b-dot\"\n{lines}");
    read(&text).assembly.controllers[0].clone()
}

fn refused_b_dot(lines: &str) -> String {
    refusal_of(&format!("{FIELD}[[controller]]\nkind = \"b-dot\"\n{lines}"))
}

#[test]
fn forces_without_a_field_of_their_own_take_that_of_the_model() {
    let magnet = "[[force]]\nkind = \"magnetic-dipole\"\nmoment = [1, 0, 0]\n";
    let currents = "[[force]]\nkind = \"eddy-current\"\ntensor = 2\n";
    let own = format!("{magnet}dipole = [0, 0, 7.8e15]\n{ORBIT}");
    let text = format!("{CARRIER}{magnet}{currents}{own}{FIELD}");
    let model = read(&text);
    assert_eq!(model.assembly.magnetic_field, Some(UNIFORM));
    let fields: Vec<MagneticField> = model
        .assembly
        .forces
        .iter()
        .map(|force| match force.law {
            ForceLaw::MagneticDipole { field, .. } | ForceLaw::EddyCurrent { field, .. } => field,
            _ => panic!("a force in a field"),
        })
        .collect();
    assert_eq!(fields[..2], [UNIFORM; 2]);
    assert!(matches!(fields[2], MagneticField::Dipole { .. }), "{fields:?}");
    assert!(model.notes.is_empty(), "{:?}", model.notes);
    let earth = format!("[magnetic_field]\nigrf = {{ epoch = \"2024-03-01\", degree = 3 }}\n{ORBIT}");
    let model = read(&format!("{CARRIER}{currents}{earth}"));
    assert!(matches!(model.assembly.magnetic_field, Some(MagneticField::Earth { .. })));
}

#[test]
fn a_field_that_nothing_uses_is_noted() {
    for (used, lines) in [
        (false, "[[force]]\nkind = \"magnetic-dipole\"\nmoment = [1, 0, 0]\nfield = [0, 0, 1]\n"),
        (false, "[[controller]]\nkind = \"pid\"\nproportional = 1\n"),
        (true, "[[controller]]\nkind = \"b-dot\"\ngain = 1\n"),
        (true, "[[controller]]\nkind = \"formula\"\ninputs = { b = \"field.x\" }\ntorque = [\"b\", 0, 0]\n"),
        (true, "[[force]]\nkind = \"magnetic-dipole\"\nmoment = [1, 0, 0]\nduring = [[1, 2]]\n"),
    ] {
        let notes = read(&format!("{CARRIER}{FIELD}{lines}")).notes.join("\n");
        assert_eq!(!notes.contains("[magnetic_field] acts on nothing"), used, "{lines}: {notes}");
    }
}

#[test]
fn fields_that_cannot_be_are_refused_once() {
    let magnet = "[[force]]\nkind = \"magnetic-dipole\"\nmoment = [1, 0, 0]\n";
    for (lines, told) in [
        ("[magnetic_field]\n", "[magnetic_field] has no `field`"),
        ("[magnetic_field]\nfeld = [0, 0, 1]\n", "did you mean `field`?"),
        ("[magnetic_field]\nfield = [0, 0, \"1 m\"]\n", "a magnetic field is needed"),
        ("[magnetic_field]\nfield = [0, 0, 1]\ndipole = [0, 0, 1]\n", "given by `field` already"),
        ("[magnetic_field]\ndipole = [0, 0, 1]\n", "[magnetic_field] has no `orbit`"),
        ("[[magnetic_field]]\nfield = [0, 0, 1]\n", "there is one [magnetic_field]"),
    ] {
        let found = refusal_of(&format!("{lines}{magnet}"));
        assert!(found.contains(told), "{lines}: {found}");
        assert_eq!(found.matches("model.toml:").count(), 1, "{found}");
    }
    let half = refusal_of(&format!("{FIELD}{magnet}{ORBIT}"));
    assert!(half.contains("has no `field`"), "{half}");
    let open = "[magnetic_field]\ndipole = [0, 0, 1]\norbit = { body = \"Earth\", semi_major_axis = 7e6, eccentricity = 1.5 }\n";
    let found = verdict(&format!("{CARRIER}{magnet}{open}"));
    assert!(found.contains("`eccentricity` of the magnetic field"), "{found}");
    assert_eq!(found.matches("model.toml:10:65").count(), 1, "{found}");
    assert_eq!(found.matches("model.toml:").count(), 1, "{found}");
}

#[test]
fn b_dot_is_read_with_its_gain_and_its_limit() {
    let found = b_dot("gain = \"20 kA m^2 s/T\"\nsaturation = \"200 mA m^2\"\n");
    let ControlLaw::Linear(law) = &found.law else { panic!("{found:?}") };
    assert_eq!(law.D, [[-2e4, 0.0, 0.0], [0.0, -2e4, 0.0], [0.0, 0.0, -2e4]]);
    for axis in 0..3 {
        assert_eq!(found.inputs[axis].of, Measurement::FieldRate { axis });
        assert_eq!(found.outputs[axis].to, Actuator::Moment { axis });
        assert_eq!(found.outputs[axis].limit, Some(0.2));
    }
    assert_eq!((found.problem(), found.sampling), (None, None));
    let each = b_dot("gain = [1, 0, 2]\nsaturation = [0.1, 0.2, \"30 mA m^2\"]\n");
    let ControlLaw::Linear(law) = &each.law else { panic!("{each:?}") };
    assert_eq!([law.D[0][0], law.D[1][1], law.D[2][2]], [-1.0, 0.0, -2.0]);
    assert_eq!(each.outputs[2].limit, Some(0.03));
    let sampled = b_dot(
        "gain = 1\nperiod = 2\ndelay = 0.5\nnoise = { field_rate = 1e-9 }\nquantum = { field_rate = 1e-8 }\n",
    );
    assert!(sampled.inputs.iter().all(|input| (input.noise, input.quantum) == (1e-9, 1e-8)), "{sampled:?}");
    let switched = b_dot("bang_bang = true\nperiod = \"1 s\"\nsaturation = [0.1, 0.2, 0.3]\n");
    let ControlLaw::Relay(law) = &switched.law else { panic!("{switched:?}") };
    assert_eq!(
        (&law.levels[..], &law.on[..], &law.off[..]),
        (&[0.1, 0.2, 0.3][..], &[0.0; 3][..], &[0.0; 3][..])
    );
    assert_eq!((switched.inputs.len(), switched.start.len(), switched.problem()), (6, 6, None));
}

#[test]
fn channels_of_fields_and_moments_are_read() {
    let text = format!(
        "{CARRIER}{FIELD}[[controller]]\nkind = \"state-space\"\ninputs = [\"field.x\", \"field_rate.z\"]\noutputs = [\"moment.y\", \"torque.x\"]\n\
         D = [[1, 2], [3, 4]]\nsaturation = [\"100 mA m^2\", \"2 mN m\"]\n\
         [[controller]]\nkind = \"formula\"\ninputs = {{ by = \"field.y\" }}\nmoment = [\"-by*wz\", 0, 0.5]\n"
    );
    let controllers = read(&text).assembly.controllers;
    assert_eq!(controllers[0].inputs[0].of, Measurement::Field { axis: 0 });
    assert_eq!(controllers[0].inputs[1].of, Measurement::FieldRate { axis: 2 });
    assert_eq!(controllers[0].outputs[0].to, Actuator::Moment { axis: 1 });
    assert_eq!([0, 1].map(|i| controllers[0].outputs[i].limit), [Some(0.1), Some(0.002)]);
    let ControlLaw::Formulas(law) = &controllers[1].law else { panic!("{:?}", controllers[1]) };
    let at: Vec<f64> = (1..=12).map(f64::from).collect();
    let values: Vec<f64> = law.outputs.iter().map(|formula| formula.value(&at)).collect();
    assert_eq!(values, [-48.0, 0.0, 0.5]);
    assert_eq!(
        controllers[1].outputs.iter().filter(|output| matches!(output.to, Actuator::Moment { .. })).count(),
        3
    );
}

#[test]
fn mistakes_are_refused_in_their_place() {
    for (lines, told) in [
        ("", "has no `gain`"),
        ("gain = \"2 N m\"\n", "a gain on the rate of a field is needed"),
        ("gain = -1\n", "a gain of this law is positive"),
        ("gain = [0, 0, 0]\n", "a gain of this law is positive"),
        ("gain = [1, 2]\n", "`gain` has 2 entries for 3 of the controller"),
        ("gain = 1\nsaturation = \"0.2 N m\"\n", "a magnetic moment is needed"),
        ("gain = 1\nsaturation = 0\n", "`saturation` is 0"),
        (
            "gain = 1\nnoise = { field_rate = 1 }\nperiod = 1\nsaturation = [1, 2]\n",
            "`saturation` has 2 entries",
        ),
        ("gain = 1\nperiod = 1\nnoise = { field = 1 }\n", "does not measure \"field\""),
        (
            "gain = 1\noutputs = [\"torque.x\"]\n",
            "`outputs` is not a key of [[controller]] of kind \"b-dot\"",
        ),
        ("bang_bang = true\ngain = 1\n", "a bang-bang law has no gain"),
        ("bang_bang = true\nsaturation = 1\n", "a bang-bang law needs samples"),
        ("bang_bang = true\nperiod = 1\n", "saturation = \"0.2 A m^2\""),
        ("bang_bang = true\nperiod = 1\nsaturation = -1\n", "`saturation` is -1"),
    ] {
        let found = refused_b_dot(lines);
        assert!(found.contains(told) && found.contains("model.toml:"), "{lines}: {found}");
    }
    let mixed = refusal_of(&format!(
        "{FIELD}[[controller]]\nkind = \"state-space\"\ninputs = [\"rate.x\"]\noutputs = [\"moment.x\", \"torque.x\"]\nsaturation = 1\n"
    ));
    assert!(mixed.contains("the outputs are torques and moments, and one limit is given"), "{mixed}");
    let channel = refusal_of("[[controller]]\nkind = \"state-space\"\ninputs = [\"field.w\"]\n");
    assert!(channel.contains("field.x, field_rate.x, orbit.x, orbit_rate.x, nadir.x or sun.x"), "{channel}");
    let coil = refusal_of(
        "[[controller]]\nkind = \"state-space\"\ninputs = [\"rate.x\"]\noutputs = [\"moment.w\"]\n",
    );
    assert!(coil.contains("moment.z"), "{coil}");
}

/// Each way to need a field, where the model has none.
#[test]
fn controllers_without_a_field_are_refused_in_their_place() {
    for lines in [
        "kind = \"b-dot\"\ngain = 1\n",
        "kind = \"pid\"\non = \"field.x\"\nproportional = 1\noutputs = [\"torque.x\"]\n",
        "kind = \"formula\"\nmoment = [1, 0, 0]\n",
        "kind = \"state-space\"\ninputs = [\"rate.x\"]\noutputs = [\"moment.x\"]\nD = [[1]]\n",
    ] {
        let found = verdict(&format!("{CARRIER}[[controller]]\nname = \"acs\"\n{lines}"));
        for told in ["model.toml:", "controller \"acs\": it needs a magnetic field", "add [magnetic_field]"] {
            assert!(found.contains(told), "{lines}: {found}");
        }
    }
}

fn rod_of(lines: &str) -> String {
    format!(
        "{FIELD}[[rod]]\nname = \"rod x\"\naxis = [1, 0, 0]\nsaturation = \"0.74 T\"\nremanence = 0.35\ncoercivity = \"1.59 A/m\"\n{lines}"
    )
}

#[test]
fn rods_are_read_with_their_size_and_their_material() {
    let rods = |lines: &str| read(&format!("{CARRIER}{}", rod_of(lines))).assembly.rods;
    let sized = rods("length = \"95 mm\"\ndiameter = \"1 mm\"\n");
    let HysteresisRod { name, axis, volume, demagnetization, material } = &sized[0];
    assert_eq!((&**name, *axis), ("rod x", [1.0, 0.0, 0.0]));
    assert_eq!(*material, HysteresisLoop { saturation: 0.74, remanence: 0.35, coercivity: 1.59 });
    assert!((volume / (std::f64::consts::PI * 0.25e-6 * 0.095) - 1.0).abs() < 1e-14, "{volume}");
    // (ln 2m − 1)/m² of a long spheroid
    assert!((demagnetization * 95.0 * 95.0 / (190f64.ln() - 1.0) - 1.0).abs() < 1e-3, "{demagnetization}");
    let given = rods("volume = \"75 mm^3\"\ndemagnetization = 1e-3\n");
    assert_eq!((given[0].volume, given[0].demagnetization), (75e-9, 1e-3));
    let both = rods("length = 0.1\ndiameter = 0.001\ndemagnetization = 0\n");
    assert_eq!(both[0].demagnetization, 0.0);
}

#[test]
fn mistakes_in_rods_are_refused_in_their_place() {
    for (lines, told) in [
        ("", "[[rod]] has no `length`"),
        ("volume = 1e-7\n", "[[rod]] has no `demagnetization`"),
        ("volume = 1e-7\ndemagnetization = 0\nlength = 1\n", "the rod has its size twice"),
        ("length = 0.001\ndiameter = 0.01\n", "no longer than its diameter"),
        ("length = \"1 T\"\ndiameter = 0.01\n", "a length is needed"),
        ("volume = 1e-7\ndemagnetization = -0.1\n", "`demagnetization` is -0.1"),
        ("length = 1\ndiameter = 0.01\nmagnetization = 1\n", "did you mean `demagnetization`"),
    ] {
        let found = refusal_of(&rod_of(lines));
        assert!(found.contains(told) && found.contains("model.toml:"), "{lines}: {found}");
    }
    let size = "length = 0.1\ndiameter = 0.001\n";
    let remanent =
        verdict(&format!("{CARRIER}{}", rod_of(size).replace("remanence = 0.35", "remanence = 0.9")));
    assert!(
        remanent.contains("`remanence` of rod \"rod x\": a remanence of 0.9 T is not less"),
        "{remanent}"
    );
    let nowhere = verdict(&format!("{CARRIER}{}", rod_of(size).replace(FIELD, "")));
    assert!(
        nowhere.contains("rod \"rod x\": it needs a magnetic field")
            && nowhere.contains("add [magnetic_field]"),
        "{nowhere}"
    );
}
