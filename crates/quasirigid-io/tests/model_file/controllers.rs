//! Controllers: laws and channels that are read, and refusals of mistakes in their place. (Y1) to (Y5)

use quasirigid::elements::NamedController;
use quasirigid::model::control::{Actuator, ControlLaw, Measurement, Sampling};
use quasirigid_io::model::Model;

use super::{CARRIER, POINT, read, refusal_of};

const SPRING: &str = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600\n";
const WHEEL: &str = "[[wheel]]\nname = \"rw\"\naxis = [0, 0, 2]\nmomentum = 3\n";

fn controller(kind: &str, lines: &str) -> NamedController {
    let text = format!("{CARRIER}{POINT}[[controller]]\nkind = \"{kind}\"\n{lines}");
    read(&text).assembly.controllers[0].clone()
}

/// The law of (Y5) for `ex` and its rate: matrices by hand.
#[test]
fn a_pid_controller_is_read_with_its_gains() {
    let found = controller(
        "pid",
        "proportional = [2, 3, 4]\nderivative = 5\nintegral = 0.5\nfilter = \"200 ms\"\nsaturation = \"30 mN m\"\n\
         deadband = 0.01\noutputs = [\"torque.y\", \"wheel.rw.torque\", \"torque.x\"]\ntarget = [0, 1, 0, 0]\n",
    );
    let ControlLaw::Linear(law) = &found.law else { panic!("{found:?}") };
    assert_eq!(law.D[1], [0.0, 3.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(law.D[2], [0.0, 0.0, -4.0, 0.0, 0.0, 0.0]);
    assert_eq!(law.C[0], [-0.5, 0.0, 0.0, -5.0, 0.0, 0.0]);
    assert_eq!(law.A[3], [0.0, 0.0, 0.0, -5.0, 0.0, 0.0]);
    assert_eq!(law.B[3], [0.0, 0.0, 0.0, 5.0, 0.0, 0.0]);
    assert_eq!(found.inputs[1].of, Measurement::Attitude { target: [0.0, 1.0, 0.0, 0.0], axis: 1 });
    assert_eq!(found.inputs[4].of, Measurement::Rate { axis: 1 });
    assert_eq!(
        found.inputs.iter().map(|input| input.deadband).collect::<Vec<_>>(),
        [0.01, 0.01, 0.01, 0.0, 0.0, 0.0]
    );
    assert_eq!(found.outputs[1].to, Actuator::Wheel { wheel: "rw".into() });
    assert_eq!(found.outputs[2].limit, Some(0.03));
    assert_eq!((found.problem(), found.sampling), (None, None));
    let rate = controller("pid", "on = \"rate\"\nproportional = 1\ntarget = [0, \"60 rpm\", 0]\n");
    assert!((rate.inputs[1].reference - 2.0 * std::f64::consts::PI).abs() < 1e-14);
}

#[test]
fn a_sampled_state_space_is_read_with_its_channels() {
    let found = controller(
        "state-space",
        "inputs = [\"velocity.tip.y\", \"wheel.rw.momentum\", \"speed.tip x\"]\noutputs = [\"torque.z\"]\nA = [[0.9]]\nB = [[1, 2, 3]]\nC = [[4]]\n\
         period = \"50 ms\"\ndelay = \"20 ms\"\nseed = 7\nnoise = { \"velocity.tip.y\" = 1e-3 }\nquantum = { \"wheel.rw.momentum\" = 0.5 }\n",
    );
    assert_eq!(found.sampling, Some(Sampling { period: 0.05, delay: 0.02, seed: 7 }));
    assert_eq!(found.inputs[0].of, Measurement::Velocity { at: "tip".into(), axis: 1 });
    assert_eq!(found.inputs[2].of, Measurement::Speed { coordinate: "tip x".into() });
    assert_eq!([found.inputs[0].noise, found.inputs[1].noise, found.inputs[1].quantum], [1e-3, 0.0, 0.5]);
    let ControlLaw::Linear(law) = &found.law else { panic!("{found:?}") };
    assert_eq!((&law.D, found.problem()), (&vec![vec![0.0; 3]], None));
}

#[test]
fn formulas_are_read_in_channels_and_states() {
    let found = controller(
        "formula",
        "inputs = { tip = \"displacement.tip.x\" }\nstates = { z = \"ex - z\", y = \"tip\" }\nstart = { y = 0.25 }\n\
         torque = [\"-2*ex - 3*wx\", \"-z*y\", 0]\nmotors = { rw = \"0.1*wz\" }\n",
    );
    let ControlLaw::Formulas(law) = &found.law else { panic!("{found:?}") };
    let at: Vec<f64> = (1..=14).map(f64::from).collect();
    // t wx wy wz qw qx qy qz ex ey ez tip z y
    assert_eq!(
        law.outputs.iter().map(|formula| formula.value(&at)).collect::<Vec<_>>(),
        [-24.0, -182.0, 0.0, 0.4]
    );
    assert_eq!(law.states.iter().map(|formula| formula.value(&at)).collect::<Vec<_>>(), [-4.0, 12.0]);
    assert_eq!((found.start.clone(), found.problem()), (vec![0.0, 0.25], None));
}

#[test]
fn thrusters_are_read_with_their_switches() {
    let found = controller(
        "bang-bang",
        "level = [1, 2, \"3 N m\"]\nlead = 4\ndeadband = 0.5\nhysteresis = [0.1, 0.2, 0.5]\nminimum_on = \"0.25 s\"\nperiod = 0.1\n",
    );
    let ControlLaw::Relay(law) = &found.law else { panic!("{found:?}") };
    assert_eq!((&law.levels[..], law.lead, law.least), (&[1.0, 2.0, 3.0][..], 4.0, 3));
    assert_eq!((&law.on[..], &law.off[..]), (&[0.5; 3][..], &[0.4, 0.3, 0.0][..]));
    assert_eq!((found.inputs.len(), found.start.len(), found.problem()), (6, 6, None));
}

#[test]
fn mistakes_are_refused_in_their_place() {
    let refused = |lines: &str| refusal_of(&format!("[[controller]]\n{lines}"));
    for (lines, told) in [
        ("kind = \"pid\"\nproportional = [1, 2]\n", "`proportional` has 2 entries for 3 of the controller"),
        ("kind = \"pid\"\non = \"rate\"\nderivative = 1\n", "a derivative without a filter has no bounds"),
        ("kind = \"pid\"\non = \"velocity.tip.y\"\nproportional = 1\n", "outputs = [\"torque.y\"]"),
        ("kind = \"pid\"\ndelay = 1\n", "`delay` needs samples, and this controller is continuous"),
        ("kind = \"pid\"\nperiod = 1\nnoise = { rate = 1 }\n", "the controller does not measure \"rate\""),
        ("kind = \"pid\"\nperiod = 0\n", "period"),
        ("kind = \"bang-bang\"\nlevel = 1\n", "period = \"0.1 s\""),
        ("kind = \"bang-bang\"\nperiod = 1\nlevel = 1\nhysteresis = 1\n", "never switches off"),
        (
            "kind = \"bang-bang\"\nperiod = 1\nlevel = 1\non = \"rate\"\nlead = 1\n",
            "the rate of this error is not measured",
        ),
        ("kind = \"pid\"\nstates = { z = \"ex\" }\n", "states"),
        ("kind = \"formula\"\nstates = { z = \"ex\" }\n", "torque"),
        ("kind = \"formula\"\ntorque = [\"z\", 0, 0]\n", "z"),
        (
            "kind = \"formula\"\nperiod = 1\nstates = { z = \"ex\" }\ntorque = [0, 0, 0]\n",
            "their next values",
        ),
        (
            "kind = \"state-space\"\ninputs = [\"rate.w\"]\n",
            "\"rate.w\" is nothing that a controller measures",
        ),
        (
            "kind = \"state-space\"\ninputs = [\"rate.x\"]\noutputs = [\"force.x\"]\n",
            "nothing that a controller commands",
        ),
    ] {
        let found = refused(lines);
        assert!(found.contains(told) && found.contains("model.toml:"), "{lines}: {found}");
    }
}

/// Mistakes that the law and the body show: sizes of matrices, sensors of continuous controllers, names of nothing.
#[test]
fn controllers_that_cannot_be_are_refused_in_their_place() {
    let refused = |lines: &str| {
        let text = format!("{CARRIER}{POINT}{SPRING}{WHEEL}[[controller]]\nname = \"acs\"\n{lines}");
        let model: Model = read(&text);
        match model.assembly.check().as_slice() {
            [] => model.diagnose(&model.assembly.build().expect_err("a refusal")).to_string(),
            errors => model.diagnose_all(errors).to_string(),
        }
    };
    for (lines, told) in [
        ("kind = \"state-space\"\ninputs = [\"rate.x\"]\nB = [[1]]\n", "`B` must have 0 rows of 1 numbers"),
        (
            "kind = \"state-space\"\ninputs = [\"rate.x\"]\noutputs = [\"torque.x\"]\nA = [[1, 2]]\n",
            "`A` must have 1 rows of 1 numbers",
        ),
        ("kind = \"pid\"\nproportional = 1\nnoise = { attitude = 1 }\n", "`noise` needs samples"),
        ("kind = \"pid\"\nproportional = 1\ntarget = [1, 1, 0, 0]\n", "is not a unit quaternion"),
        (
            "kind = \"pid\"\non = \"velocity.top.y\"\nproportional = 1\noutputs = [\"torque.y\"]\n",
            "there is no node of this name alone, \"top\"; there are tip",
        ),
        (
            "kind = \"formula\"\nmotors = { wheel = 1 }\n",
            "`motors` of controller \"acs\": there is no wheel of constant speed \"wheel\"; there are rw",
        ),
        (
            "kind = \"pid\"\non = \"rate.x\"\nproportional = 1\noutputs = [\"wheel.wheel.torque\"]\n",
            "`outputs` of controller \"acs\": there is no wheel of constant speed \"wheel\"; there are rw",
        ),
        (
            "kind = \"pid\"\nproportional = 1\noutputs = [\"torque.x\", \"torque.z\", \"torque.x\"]\n",
            "`outputs` of controller \"acs\": the outputs command the same twice, and would add up",
        ),
        (
            "kind = \"formula\"\ninputs = { a = \"coordinate.arm\" }\ntorque = [\"a\", 0, 0]\n",
            "there is no coordinate \"arm\"; there are \"tip\" x, \"tip\" y, \"tip\" z",
        ),
    ] {
        let found = refused(lines);
        assert!(found.contains(told) && found.contains("model.toml:"), "{lines}: {found}");
    }
}
