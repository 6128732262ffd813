//! Springs, dashpots and connectors of Abaqus and CalculiX along axes of their own, against the same along those of nodes.

use quasirigid::reduction;
use quasirigid_io::model::Model;

use super::same::assert_same;
use super::written;

fn deck(text: &str) -> Model {
    let table = "[[deck]]\nname = \"sat\"\nfile = \"sat.inp\"\n[reduction]\nmodes = 8\n";
    written(&[("sat.inp", text.to_owned())], table).unwrap_or_else(|error| panic!("{error}"))
}

fn frequencies(model: &Model) -> Vec<f64> {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    reduction::frequencies(&body).expect("frequencies")
}

/// Two beams that meet in nodes 2 and 4, at one place or not.
fn beams(second: &str) -> String {
    format!(
        "*NODE\n1,0,0,1\n2,1,2,2\n3,3,3,2\n4,{second}\n*ELEMENT, TYPE=B33, ELSET=B\n1,1,2\n2,4,3\n\
        *MATERIAL, NAME=EL\n*ELASTIC\n7e10,.3\n*DENSITY\n2700.\n\
        *BEAM SECTION, ELSET=B, MATERIAL=EL, SECTION=RECT\n.03,.02\n1.,1.,0.\n*ORIENTATION, NAME=O\n.6,.8,0.,-.8,.6,.3\n"
    )
}

const TOGETHER: &str = "1,2,2";
const CONSTANTS: [f64; 6] = [3e5, 7e5, 2e5, 90.0, 40.0, 60.0];

#[test]
fn springs_along_an_orientation_are_those_of_turned_nodes() {
    let springs = |orientation: &str| -> String {
        let spring = |(k, constant): (usize, &f64)| {
            format!(
                "*ELEMENT, TYPE=SPRING2, ELSET=S{k}\n{},2,4\n*SPRING, ELSET=S{k}{orientation}\n{k},{k}\n{constant:e}\n",
                10 + k
            )
        };
        (1..).zip(&CONSTANTS).map(spring).collect()
    };
    let turned = "*NSET, NSET=T\n2,4\n*TRANSFORM, NSET=T\n.6,.8,0.,-.8,.6,.3\n";
    let nodes = deck(&format!("{}{turned}{}", beams(TOGETHER), springs("")));
    assert_same(&deck(&format!("{}{}", beams(TOGETHER), springs(", ORIENTATION=O"))), &nodes, 1e-8);
    let elasticity =
        |(k, constant): (usize, &f64)| format!("*CONNECTOR ELASTICITY, COMPONENT={k}\n{constant:e},\n");
    let laws: String = (1..).zip(&CONSTANTS).map(elasticity).collect();
    for kind in ["BUSHING", "CARTESIAN, CARDAN", "CARTESIAN, ROTATION"] {
        let connector = format!(
            "*ELEMENT, TYPE=CONN3D2, ELSET=C\n11,2,4\n*CONNECTOR SECTION, ELSET=C, BEHAVIOR=K\n{kind}\nO,\n\
            *CONNECTOR BEHAVIOR, NAME=K\n{laws}"
        );
        assert_same(&deck(&format!("{}{connector}", beams(TOGETHER))), &nodes, 1e-8);
    }
}

#[test]
fn a_beam_connector_is_a_rigid_beam_and_a_hinge_turns_about_its_axis() {
    let apart = "1.2,2.1,2.3";
    let connector = |kind: &str, axes: &str| {
        format!("*ELEMENT, TYPE=CONN3D2, ELSET=C\n11,2,4\n*CONNECTOR SECTION, ELSET=C\n{kind}\n{axes}\n")
    };
    let beam = deck(&format!("{}{}", beams(apart), connector("BEAM", "")));
    assert_same(&beam, &deck(&format!("{}*MPC\nBEAM,4,2\n", beams(apart))), 1e-8);
    // A hinge is the limit of stiff springs about the other axes.
    let stiff = |k: usize| {
        format!(
            "*ELEMENT, TYPE=SPRING2, ELSET=S{k}\n{},2,4\n*SPRING, ELSET=S{k}, ORIENTATION=O\n{k},{k}\n1e9\n",
            10 + k
        )
    };
    let soft = "*ELEMENT, TYPE=SPRING2, ELSET=S4\n14,2,4\n*SPRING, ELSET=S4, ORIENTATION=O\n4,4\n30.\n";
    let springs = format!("{}{soft}", [1, 2, 3, 5, 6].map(stiff).concat());
    let hinge = connector("HINGE", "O,").replace("ELSET=C\nHINGE", "ELSET=C, BEHAVIOR=K\nHINGE")
        + "*CONNECTOR BEHAVIOR, NAME=K\n*CONNECTOR ELASTICITY, COMPONENT=4\n30.,\n";
    let (hinge, springs) = (
        frequencies(&deck(&format!("{}{hinge}", beams(TOGETHER)))),
        frequencies(&deck(&format!("{}{springs}", beams(TOGETHER)))),
    );
    for (hinge, springs) in hinge.iter().zip(&springs).take(4) {
        assert!((hinge / springs - 1.0).abs() < 1e-4, "{hinge} {springs}");
    }
}

#[test]
fn what_is_not_carried_of_connectors_is_counted() {
    let text = "*ELEMENT, TYPE=CONN3D2, ELSET=C\n11,2,4\n12,2,4\n13,1\n*CONNECTOR SECTION, ELSET=C, BEHAVIOR=K\nSLOT\n\
        *CONNECTOR BEHAVIOR, NAME=K\n*CONNECTOR ELASTICITY, COMPONENT=1, NONLINEAR\n1.,2.\n*CONNECTOR STOP, COMPONENT=1\n0.,1.\n";
    let note = &deck(&format!("{}*MPC\nBEAM,4,2\n{text}", beams(TOGETHER))).file_notes[0];
    let expected = "sat.inp: left out: 1 *CONNECTOR ELASTICITY of other forms than linear and of one component, \
        1 *CONNECTOR STOP, 2 connectors of type SLOT, 1 springs, dashpots, bushings and connectors to the ground";
    assert_eq!(note, expected);
}

/// A table of forces has the slope that it has at rest; one with a kink there is left out.
#[test]
fn nonlinear_springs_have_their_slope_at_rest() {
    let text = |card: &str| {
        format!(
            "*NODE, NSET=ALL\n1,1.1,1,1\n2,1,-1,-1\n3,-1,1,-1\n4,-1,-1,1\n\
            *ELEMENT, TYPE=MASS, ELSET=M\n1,1\n2,2\n3,3\n4,4\n*MASS, ELSET=M\n2.\n\
            *ELEMENT, TYPE=SPRINGA, ELSET=S\n11,1,2\n12,1,3\n13,1,4\n14,2,3\n15,2,4\n16,3,4\n*SPRING, ELSET=S{card}\n"
        )
    };
    let linear = deck(&text("\n\n50."));
    assert_same(
        &deck(&text(", NONLINEAR\n\n-70.,-2.\n-25.,-.5\n75.,1.5\n80.,3.\n0.,-1.,99.")),
        &linear,
        1e-12,
    );
    for kinked in ["0.,0.\n10.,1.\n100.,2.", "-1.,-1.\n0.,0.\n10.,1.", "1.,1.\n2.,2."] {
        let more =
            format!("*ELEMENT, TYPE=SPRINGA, ELSET=K\n17,1,2\n*SPRING, ELSET=K, NONLINEAR\n\n{kinked}\n");
        let note = &deck(&format!("{}\n{more}", text("\n\n50."))).file_notes[0];
        assert!(
            note.contains("left out: 1 nonlinear springs and dashpots without one slope at rest"),
            "{note}"
        );
    }
}

/// CalculiX keeps the distance of the ends of a beam of solids, as a link does; nodes stay in a plane and on a line.
#[test]
fn constraints_of_calculix_bind_distances_lines_and_planes() {
    let block = |first: usize, x: f64| {
        let corners =
            [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
        let node =
            |(k, [i, j, k2]): (usize, &[i32; 3])| format!("{},{},{j},{k2}\n", first + k, x + f64::from(*i));
        let nodes: String = corners.iter().enumerate().map(node).collect();
        let all: Vec<String> = (first..first + 8).map(|node| node.to_string()).collect();
        format!("*NODE\n{nodes}*ELEMENT, TYPE=C3D8, ELSET=E\n{first},{}\n", all.join(","))
    };
    let rest =
        "*MATERIAL, NAME=EL\n*ELASTIC\n7e10,.3\n*DENSITY\n2700.\n*SOLID SECTION, ELSET=E, MATERIAL=EL\n";
    let blocks = format!("{}{}{rest}", block(1, 0.0), block(11, 1.0));
    let pins = "*MPC\nPIN,11,2\nPIN,14,3\n";
    let of = |lines: &str| deck(&format!("{blocks}{pins}{lines}"));
    assert_same(&of("*MPC\nBEAM,15,5\n"), &of("*MPC\nLINK,15,5\n"), 1e-9);
    // three corners of the other face in one plane, and its fourth in that plane too: the pinned edges and one more
    let plane = of("*MPC\nBEAM,15,5\nPLANE,5,6,7,18,15\n");
    let line = of("*MPC\nBEAM,15,5\nSTRAIGHT,5,6,15\n");
    let free = frequencies(&of("*MPC\nBEAM,15,5\n"));
    for bound in [frequencies(&plane), frequencies(&line)] {
        // Constraints raise every frequency (Rayleigh), and leave the six motions of the whole.
        let rise: Vec<f64> = free.iter().zip(&bound).map(|(free, bound)| bound / free).collect();
        assert!(rise.iter().take(4).all(|rise| *rise > 1.0 - 1e-9) && rise[0] > 1.0001, "{free:?} {bound:?}");
    }
}
