//! Connections, and springs and forces at nodes of parts.

use quasirigid::elements::{Anchor, Assembly, Connection, End, NodeRef};
use quasirigid::model::Rheology;
use quasirigid::model::force::ForceLaw;

use super::{ALUMINIUM, BOOM, CARRIER, POINT, TUBE, read};

/// A panel of 2 × 1 cells, its left edge at x = 3.
const ARRAY: &str = "[[panel]]\nname = \"array\"\nrectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [2, 1] }\n\
                     position = [3, 0, 0]\nlayers = [{ material = \"aluminium\", thickness = \"2 mm\" }]\n";

/// A boom on the carrier and a panel, with these lines.
fn model(lines: &str) -> String {
    format!("{CARRIER}{POINT}{ALUMINIUM}{TUBE}{BOOM}attach = \"root\"\n{ARRAY}{lines}")
}

fn connection(lines: &str) -> Connection {
    let [connection] =
        read(&model(&format!("[[connection]]\n{lines}"))).assembly.connections.try_into().expect("one");
    connection
}

const SIDES: &str = "from = { part = \"boom\", node = \"tip\" }\nto = { part = \"array\", set = \"left\" }\n";

#[test]
fn a_weld_has_no_axes() {
    let weld = connection(SIDES);
    let expected = Connection {
        from: Anchor::Nodes { part: 0, nodes: vec![1] },
        to: Anchor::Nodes { part: 1, nodes: vec![0, 3] },
        axes: Vec::new(),
        stiffness: Vec::new(),
        damping: Vec::new(),
        rheology: Rheology::Elastic,
    };
    assert_eq!(weld, expected);
    let carried = connection("from = { part = \"array\", node = 6 }\nto = \"carrier\"\n");
    assert_eq!((carried.from, carried.to), (Anchor::Nodes { part: 1, nodes: vec![5] }, Anchor::Carrier));
}

#[test]
fn a_hinge_has_the_values_of_its_axes() {
    let hinge =
        connection(&format!("{SIDES}hinge = [0, 2, 0]\nstiffness = \"300 N cm/rad\"\ndamping = 0.2\n"));
    assert_eq!((hinge.axes, hinge.stiffness, hinge.damping), (vec![[0.0, 2.0, 0.0]], vec![3.0], vec![0.2]));
    let cross =
        connection(&format!("{SIDES}hinge = [[0, 1, 0], [1, 0, 0]]\nstiffness = [3, 4]\ndamping = 0.1\n"));
    assert_eq!(cross.axes, [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    assert_eq!((cross.stiffness, cross.damping), (vec![3.0, 4.0], vec![0.1, 0.1]));
    let ball = connection(&format!(
        "{SIDES}ball = true\nstiffness = 5\nrheology = {{ kind = \"maxwell\", time = 2 }}\n"
    ));
    assert_eq!(ball.axes, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!((ball.stiffness, ball.damping), (vec![5.0; 3], vec![0.0; 3]));
    assert_eq!(ball.rheology, Rheology::Maxwell { time: 2.0 });
}

#[test]
fn the_range_of_a_connection_is_its_own() {
    let range = "rheology = { kind = \"kelvin-voigt\", time = 2, range = [1, 3] }\n";
    let model = read(&model(&format!("[[connection]]\n{SIDES}hinge = [0, 1, 0]\nstiffness = 3\n{range}")));
    let of = |assembly: &Assembly| assembly.connections[0].rheology.clone();
    let [least, greatest] = &**model.extremes.as_ref().expect("a range");
    assert_eq!(of(least), Rheology::KelvinVoigt { time: 1.0 });
    assert_eq!(of(greatest), Rheology::KelvinVoigt { time: 3.0 });
}

#[test]
fn springs_and_forces_act_at_nodes() {
    let spring = "[[spring]]\nfrom = { part = \"boom\", node = \"tip\" }\nto = \"tip\"\nstiffness = 600\n";
    let brace =
        "[[spring]]\nfrom = \"carrier\"\nto = { part = \"array\", set = \"right top\" }\nstiffness = 600\n";
    let force = "[[force]]\nkind = \"thrust\"\non = { part = \"array\", node = 2 }\nforce = [0, 0, 1]\n";
    let weld = format!("[[connection]]\n{SIDES}");
    // a set of one node is that node
    let brace = brace.replace("set =", "node =");
    let model = read(&model(&format!("{spring}{brace}{force}{weld}")));
    let [first, second] = &model.assembly.springs[..] else { panic!("two springs") };
    assert_eq!((first.from, first.to), (End::Node(NodeRef { part: 0, node: 1 }), End::Point(0)));
    assert_eq!((second.from, second.to), (End::Carrier, End::Node(NodeRef { part: 1, node: 5 })));
    let ForceLaw::Thrust { at, .. } = &model.assembly.forces[0].law else { panic!("a thrust") };
    assert_eq!((at.on, at.at), (End::Node(NodeRef { part: 1, node: 1 }), None));
    assert_eq!(model.assembly.check(), []);
    assert!(model.assembly.body().is_ok());
}

/// The panel on a hinge along its edge, which the boom carries: 1 N at an arm of 2 m turns it by 2/3 rad at 3 N m/rad,
/// so the far edge rises by 4/3 m. Bending adds a share that goes as 1/E, which two moduli take away.
#[test]
fn a_hinge_between_a_node_and_an_edge_turns_the_panel() {
    let hinge = format!("[[connection]]\n{SIDES}hinge = [0, 1, 0]\nstiffness = 3\n");
    let force = "[[force]]\nkind = \"thrust\"\non = { part = \"array\", node = \"right bottom\" }\nforce = [0, 0, 1]\n";
    let rise = |young: &str| {
        let text = model(&format!("{hinge}{force}")).replace(POINT, "").replace("70 GPa", young);
        let built = read(&text).assembly.build().expect("a body");
        let ForceLaw::Thrust { at, .. } = &built.forces[0].law else { panic!("a thrust") };
        let pole = built.body.pole();
        assert!((0..3).all(|axis| (at.position[axis] + pole[axis] - [5.0, 0.0, 0.0][axis]).abs() < 1e-12));
        let mut answer = vec![0.0; built.body.coordinates().len()];
        at.shapes.iter().for_each(|(coordinate, shape)| answer[*coordinate] = shape[2]);
        built.body.solve_stiffness(&mut answer, 1);
        at.shapes.iter().map(|(coordinate, shape)| shape[2] * answer[*coordinate]).sum::<f64>()
    };
    let (soft, stiff) = (rise("700 GPa"), rise("1400 GPa"));
    let rigid = 2.0 * stiff - soft;
    // the membrane of the panel is 1e9 times as stiff as the hinge, which costs as many digits
    assert!((rigid / (4.0 / 3.0) - 1.0).abs() < 1e-6, "{soft} {stiff} {rigid}");
    assert!(soft > stiff && stiff > 4.0 / 3.0, "{soft} {stiff}");
}

/// Two panels hinged edge to edge and a point on springs, without a carrier: joints of sets have nodes of their own,
/// and the point is none of them.
#[test]
fn a_point_beside_a_hinge_of_sets_is_where_it_is() {
    let other = ARRAY.replace("array", "other").replace("position = [3, 0, 0]", "position = [1, 0, 0]");
    let edge = |part: &str, set: &str| format!("{{ part = \"{part}\", set = \"{set}\" }}");
    let hinge = format!(
        "[[connection]]\nfrom = {}\nto = {}\nhinge = [0, 1, 0]\nstiffness = 3\n",
        edge("other", "right"),
        edge("array", "left")
    );
    let spring = |corner: &str| {
        format!(
            "[[spring]]\nfrom = \"tip\"\nto = {{ part = \"other\", node = \"{corner}\" }}\nstiffness = 9\n"
        )
    };
    let force = "[[force]]\nkind = \"thrust\"\non = \"tip\"\nforce = [0, 0, 1]\n";
    let text = format!(
        "{POINT}{ALUMINIUM}{ARRAY}{other}{hinge}{}{}{force}",
        spring("left top"),
        spring("left bottom")
    );
    let model = read(&text);
    assert_eq!(model.assembly.check(), []);
    let built = model.assembly.build().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let tip =
        built.body.markers().iter().find(|marker| marker.name == "\"tip\"").expect("the point is watched");
    let pole = built.body.pole();
    for axis in 0..3 {
        assert!((tip.position[axis] + pole[axis] - [0.8, 0.3, 0.5][axis]).abs() < 1e-12, "{tip:?}");
    }
    let ForceLaw::Thrust { at, .. } = &built.forces[0].law else { panic!("a thrust") };
    assert_eq!((at.position, at.shapes.is_empty()), (tip.position, false));
}
