//! Beams, and keys that parts of every kind share.

use insta::assert_snapshot;
use quasirigid::elements::{
    Frame, FrameNode, Material, Member, Part, PartKind, PartReduction, SectionShape, TipMass,
};
use quasirigid::model::Rheology;

use super::{ALUMINIUM, BOOM, CARRIER, TUBE, read, refusal};

/// A file with a material, a section and these lines, which start in line 13.
fn model(lines: &str) -> String {
    format!("{CARRIER}{ALUMINIUM}{TUBE}{lines}")
}

/// Refusal of a boom with these further lines, which start in line 19.
fn refused(lines: &str) -> String {
    refusal(&model(&format!("{BOOM}{lines}")))
}

fn node(name: &str, position: [f64; 3]) -> FrameNode {
    FrameNode { name: name.to_owned(), position }
}

const ALUMINIUM_IS: Material =
    Material { density: 2700.0, young: 70e9, poisson: 0.3, rheology: Rheology::Elastic };
const TUBE_IS: SectionShape = SectionShape::Tube { radius: 0.03, thickness: 0.002 };

/// Names in an order that is not that of the alphabet, so that sorted nodes are seen.
#[test]
fn a_beam_is_read_with_its_nodes_in_the_order_of_the_file() {
    let text = model(
        "[[beam]]\nname = \"mast\"\nnodes = { tip = [\"3 m\", 0, 0.5], root = [\"10 in\", 0, 0], elbow = [1, 0.25, 0] }\n\
         lines = [[\"root\", \"elbow\"], [\"elbow\", \"tip\"]]\nsection = \"tube\"\nmaterial = \"aluminium\"\n\
         up = [0, 0, 2]\nelements = 5\nattach = \"root\"\n\
         masses = [{ node = \"tip\", mass = \"2 lb\", inertia = [0.01, 0.02, 0.03] }, { node = \"elbow\", mass = 0.5 }]\n\
         rayleigh = { mass = \"0.02 1/s\", stiffness = \"3 ms\" }\n",
    );
    let model = read(&text);
    let member = |ends| Member {
        name: String::new(),
        ends,
        section: TUBE_IS,
        up: Some([0.0, 0.0, 2.0]),
        material: ALUMINIUM_IS,
        elements: 5,
    };
    let tip = [[0.01, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]];
    let frame = Frame {
        nodes: vec![
            node("tip", [3.0, 0.0, 0.5]),
            node("root", [0.254, 0.0, 0.0]),
            node("elbow", [1.0, 0.25, 0.0]),
        ],
        members: vec![member([1, 2]), member([2, 0])],
    };
    let masses = vec![
        TipMass { node: 0, mass: 2.0 * 0.453_592_37, inertia: tip },
        TipMass { node: 2, mass: 0.5, inertia: [[0.0; 3]; 3] },
    ];
    let expected = Part {
        name: "mast".to_owned(),
        kind: PartKind::Frame(frame),
        masses,
        attached: vec![1],
        rayleigh: [0.02, 3e-3],
    };
    assert_eq!(model.assembly.parts, [expected]);
    assert_eq!(model.assembly.check(), []);
}

/// 2 m of tube: `ρ π (R² − r²) L`.
#[test]
fn a_beam_has_the_mass_of_its_tube() {
    let body = read(&model(&format!("{BOOM}attach = \"root\"\n"))).assembly.body().expect("a body");
    let tube = 2700.0 * std::f64::consts::PI * (0.03_f64.powi(2) - 0.028_f64.powi(2)) * 2.0;
    assert!((body.invariants().mass / (40.0 + tube) - 1.0).abs() < 1e-12, "{}", body.invariants().mass);
}

#[test]
fn what_a_beam_does_not_say_has_defaults() {
    let nameless = BOOM.replace("name = \"boom\"\n", "");
    let panel = "[[panel]]\nrectangle = { sides = [[1, 0, 0], [0, 1, 0]], cells = [1, 1] }\nattach = \"left\"\n\
                 layers = [{ material = \"aluminium\", thickness = 0.001 }]\n";
    let assembly = read(&model(&format!("{panel}{nameless}{nameless}"))).assembly;
    let names: Vec<&str> = assembly.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["beam 1", "beam 2", "panel 1"]);
    let PartKind::Frame(frame) = &assembly.parts[0].kind else { panic!("a frame") };
    let Member { up, elements, .. } = frame.members[0];
    assert_eq!((up, elements, assembly.parts[0].masses.len()), (None, 8, 0));
    assert_eq!((assembly.parts[0].attached.len(), assembly.parts[0].rayleigh), (0, [0.0; 2]));
    assert_eq!(assembly.reduction, PartReduction { order: 3, modes: 0 });
}

#[test]
fn the_reduction_keeps_as_many_modes_as_the_file_says() {
    let reduced = |lines: &str| read(&model(&format!("[reduction]\n{lines}"))).assembly.reduction;
    assert_eq!(reduced("modes = 12\n"), PartReduction { order: 3, modes: 12 });
    assert_eq!(reduced(""), PartReduction { order: 3, modes: 0 });
    assert_snapshot!(refusal(&model("[reduction]\nmode = 3\n")), @r#"
    model.toml:14:1: unknown key "mode" in [reduction]
      did you mean `modes`? the keys are modes
    "#);
    assert_snapshot!(refusal(&model("[reduction]\nmodes = 501\n")), @"
    model.toml:14:9: `modes` is 501, but must be an integer from 0 to 500
      write an integer from 0 to 500
    ");
    assert_snapshot!(refusal(&model("[[reduction]]\nmodes = 3\n")), @"
    model.toml:13:1: there is one [reduction], not a list of them
      write [reduction] once, with single brackets
    ");
}

/// Each part at the ends of the range of its own material, and a spring at those of its own.
#[test]
fn ranges_of_rheologies_go_to_their_parts() {
    let viscoelastic = |name: &str, time: &str| {
        format!(
            "[material.{name}]\ndensity = 1\nyoung = 1\npoisson = 0\nrheology = {{ kind = \"kelvin-voigt\", {time} }}\n"
        )
    };
    let boom = BOOM.replace("aluminium", "slow") + "attach = \"root\"\n";
    let bent = "[[beam]]\nname = \"bent\"\nnodes = { root = [1, 0, 0], tip = [3, 0, 0], far = [3, 1, 0] }\n\
                lines = [[\"root\", \"tip\"], [\"tip\", \"far\"]]\nsection = \"tube\"\nmaterial = \"fast\"\n\
                attach = \"root\"\n";
    let spring = "[[spring]]\nfrom = { part = \"boom\", node = \"tip\" }\nto = { part = \"bent\", node = \"tip\" }\n\
                  stiffness = 3\nrheology = { kind = \"kelvin-voigt\", time = 7, range = [6, 8] }\n";
    let text = format!(
        "{CARRIER}{TUBE}{}{}{boom}{bent}{spring}",
        viscoelastic("slow", "time = 2, range = [1, 3]"),
        viscoelastic("fast", "time = \"20 ms\", range = [\"10 ms\", 0.03]"),
    );
    let model = read(&text);
    let times = |assembly: &quasirigid::elements::Assembly| -> Vec<f64> {
        let of = |rheology: &Rheology| match rheology {
            Rheology::KelvinVoigt { time } => *time,
            other => panic!("{other:?}"),
        };
        let frames = assembly.parts.iter().map(|part| match &part.kind {
            PartKind::Frame(frame) => frame,
            other => panic!("{other:?}"),
        });
        let members = frames.flat_map(|frame| &frame.members).map(|member| of(&member.material.rheology));
        members.chain(assembly.springs.iter().map(|spring| of(&spring.rheology))).collect()
    };
    assert_eq!(times(&model.assembly), [2.0, 0.02, 0.02, 7.0]);
    let [least, greatest] = &**model.extremes.as_ref().expect("ranges");
    assert_eq!(times(least), [1.0, 0.01, 0.01, 6.0]);
    assert_eq!(times(greatest), [3.0, 0.03, 0.03, 8.0]);
}

#[test]
fn a_beam_with_a_key_wrong_or_missing_is_refused() {
    assert_snapshot!(refused("element = 3\n"), @r#"
    model.toml:19:1: unknown key "element" in [[beam]]
      did you mean `elements`? the keys are name, nodes, lines, section, material, up, elements, masses, attach, rayleigh
    "#);
    assert_snapshot!(refused("elements = 0\nup = [0, 1]\n"), @"
    model.toml:19:12: `elements` is 0, but must be an integer from 1 to 10000
      write an integer from 1 to 10000
    model.toml:20:6: `up`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    ");
    assert_snapshot!(refused("rayleigh = 0.1\n"), @"
    model.toml:19:12: `rayleigh`: found a decimal number, expected a table
      write for example { mass = 0.01, stiffness = 1e-4 }
    ");
    assert_snapshot!(refused("rayleigh = { mass = \"1 s\", stiffness = -1 }\n"), @r#"
    model.toml:19:21: `mass`: "1 s" is a time, but a rate is needed
      write for example "0.2 1/s", or a plain number in 1/s
    model.toml:19:40: `stiffness` is -1 s, but must be zero or positive
      write zero or a positive value
    "#);
    assert_snapshot!(refusal(&model("[[beam]]\nlines = []\n")), @r#"
    model.toml:13:1: [[beam]] has no `nodes`
      add a line such as: nodes = { root = [0, 0, 0], tip = [2, 0, 0] }
    model.toml:13:1: [[beam]] has no `section`
      add a line such as: section = "tube", with [section.tube]
    model.toml:13:1: [[beam]] has no `material`
      add a line such as: material = "aluminium"
    "#);
    let other = BOOM.replace("\"aluminium\"", "\"aluminum\"").replace("\"tube\"", "\"pipe\"");
    assert_snapshot!(refusal(&model(&other)), @r#"
    model.toml:17:11: there is no section "pipe"
      there are tube
    model.toml:18:12: there is no material "aluminum"
      did you mean "aluminium"? there are aluminium
    "#);
}

#[test]
fn a_node_that_is_not_there_is_refused() {
    assert_snapshot!(refused("attach = \"rot\"\n"), @r#"
    model.toml:19:10: this part has no node or set "rot"
      did you mean "root"? there are root, tip
    "#);
    assert_snapshot!(refused("attach = 3\n"), @"
    model.toml:19:10: there is no node 3 in this part
      its nodes are root, tip
    ");
    assert_snapshot!(refused("masses = [{ node = \"top\", mass = 1 }]\n"), @r#"
    model.toml:19:20: this part has no node or set "top"
      did you mean "tip"? there are root, tip
    "#);
    assert_snapshot!(refused("masses = [{ node = [\"root\", \"tip\"], mass = 0, inerta = 1 }]\n"), @r#"
    model.toml:19:20: `node` names 2 nodes, but one is needed
      name one node, by its name or its number
    model.toml:19:44: `mass` is 0 kg, but must be positive
      write a number in kg, or a text with its unit such as "12 lb"
    model.toml:19:47: unknown key "inerta" in the mass
      did you mean `inertia`? the keys are node, mass, inertia
    "#);
    assert_snapshot!(refused("masses = [3]\n"), @r#"
    model.toml:19:11: `masses`: found an integer, expected a table
      write { node = "tip", mass = 1.2 }
    "#);
    let lines = |lines: &str| refusal(&model(&BOOM.replace("[[\"root\", \"tip\"]]", lines)));
    assert_snapshot!(lines("[[\"root\", \"end\"], [\"tip\", \"tip\"], [\"tip\"]]"), @r#"
    model.toml:16:19: this part has no node or set "end"
      there are root, tip
    model.toml:16:27: both ends of the line are the same
      a line joins two different nodes
    model.toml:16:43: `lines`: found an array of 1 value, expected an array of 2 nodes
      write 2 nodes in brackets, with commas between them
    "#);
    assert_snapshot!(lines("[]"), @r#"
    model.toml:16:9: a beam has one line or more
      write lines = [["root", "tip"]]
    "#);
    let list = BOOM.replace("{ root = [1, 0, 0], tip = [3, 0, 0] }", "[[1, 0, 0], [3, 0, 0]]");
    assert_snapshot!(refusal(&model(&list)), @"
    model.toml:15:9: `nodes`: found an array of 2 values, expected a table of nodes
      write { root = [0, 0, 0], tip = [2, 0, 0] }
    ");
    assert_snapshot!(refusal(&model(&BOOM.replace("[1, 0, 0]", "[1, 0]"))), @"
    model.toml:15:18: `root`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    ");
}
