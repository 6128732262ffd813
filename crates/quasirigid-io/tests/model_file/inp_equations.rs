//! Equations, links and ties of Abaqus and CalculiX: bars of two meshes are the bar of one, and no motion of the whole body strains them.

use std::fmt::Write;

use quasirigid::elements::{Coupling, PartKind};
use quasirigid::reduction;
use quasirigid_io::model::Model;

use super::same::{assert_same, differences};
use super::{only_part, written};

const MODES: &str = "[reduction]\nmodes = 8\n";

fn deck(text: &str) -> Model {
    let table = format!("[[deck]]\nname = \"bar\"\nfile = \"bar.inp\"\n{MODES}");
    written(&[("bar.inp", text.to_owned())], &table).unwrap_or_else(|error| panic!("{error}"))
}

fn frequencies(model: &Model) -> Vec<f64> {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    reduction::frequencies(&body).expect("frequencies")
}

/// Rotation about no axis of the coordinates, and a shift: of a bar that lies along x.
fn aslant([x, y, z]: [f64; 3]) -> [f64; 3] {
    [0.6 * x - 0.8 * y + 7.0, 0.48 * x + 0.36 * y - 0.8 * z - 2.0, 0.64 * x + 0.48 * y + 0.6 * z]
}

/// Nodes and linear hexahedra between two corners, numbered from `first` on, in a set of the name; S4 and S6 are its faces across x.
fn block(name: &str, first: usize, low: [f64; 3], high: [f64; 3], counts: [usize; 3]) -> String {
    let [across, deep, tall] = counts.map(|count| count + 1);
    let mut text = format!("*NODE, NSET=N{name}\n");
    for index in 0..across * deep * tall {
        let steps = [index % across, index / across % deep, index / across / deep];
        let place: [f64; 3] = std::array::from_fn(|axis| {
            low[axis] + (high[axis] - low[axis]) * steps[axis] as f64 / counts[axis] as f64
        });
        let [x, y, z] = aslant(place);
        writeln!(text, "{},{x:.15},{y:.15},{z:.15}", first + index).unwrap();
    }
    writeln!(text, "*ELEMENT, TYPE=C3D8, ELSET={name}").unwrap();
    for index in 0..counts.iter().product() {
        let [i, j, k] = [index % counts[0], index / counts[0] % counts[1], index / counts[0] / counts[1]];
        let at = |i: usize, j: usize, k: usize| first + (k * deep + j) * across + i;
        let lower = [at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)];
        let upper = lower.map(|node| node + across * deep);
        let nodes: Vec<String> = lower.into_iter().chain(upper).map(|node| node.to_string()).collect();
        writeln!(text, "{},{}", first + index, nodes.join(",")).unwrap();
    }
    let ends = |i: usize| -> Vec<String> {
        (0..counts[1] * counts[2]).map(|row| (first + row * counts[0] + i).to_string()).collect()
    };
    let (low, high) = (ends(0).join(","), ends(counts[0] - 1).join(","));
    write!(text, "*ELSET, ELSET={name}LOW\n{low}\n*ELSET, ELSET={name}HIGH\n{high}\n").unwrap();
    text
}

const MATERIAL: &str = "*MATERIAL, NAME=EL\n*ELASTIC\n7e10,.3\n*DENSITY\n2700.\n";

fn sections(names: &[&str]) -> String {
    let of = |name: &&str| format!("*SOLID SECTION, ELSET={name}, MATERIAL=EL\n");
    MATERIAL.to_owned() + &names.iter().map(of).collect::<String>()
}

/// A bar of four elements, and one of two and two that share no node; nodes 1+2, 4+2, 7+2, 10+2 are at the places of 101, 104, 107, 110.
fn bars() -> (String, String) {
    let whole = block("A", 1, [0.0; 3], [4.0, 0.5, 0.3], [4, 1, 1]) + &sections(&["A"]);
    let left = block("A", 1, [0.0; 3], [2.0, 0.5, 0.3], [2, 1, 1]);
    let right = block("B", 101, [2.0, 0.0, 0.0], [4.0, 0.5, 0.3], [2, 1, 1]);
    (whole, left + &right + &sections(&["A", "B"]))
}

#[test]
fn a_bar_of_two_meshes_is_the_bar_of_one() {
    let (whole, halves) = bars();
    let whole = deck(&whole);
    let pairs = [(101, 3), (104, 6), (107, 9), (110, 12)];
    let turned = "*NSET, NSET=ENDS\n3,6,9,12,101,104,107,110\n*TRANSFORM, NSET=ENDS\n.6,.8,0.,-.8,.6,0.\n";
    let mut equations = String::from("*EQUATION\n");
    for (slave, master) in pairs {
        // the first node of an equation is one or the other, and one factor is neither
        writeln!(equations, "2\n{slave},1,1.,{master},1,-1.\n2\n{master},2,-3.,{slave},2,3.").unwrap();
        writeln!(equations, "3\n{slave},3,1.,{slave},1,.5,{master},3,-1.\n2\n{slave},1,2.,{master},1,-2.")
            .unwrap();
    }
    let skew = equations.replace(",.5,", ",0.,");
    let sets = "*NSET, NSET=SLAVES\n101,104,107,110\n*NSET, NSET=MASTERS\n3,6,9,12\n";
    let ties = "*SURFACE, NAME=S\nBLOW, S6\n*SURFACE, NAME=M\nAHIGH, S4\n*TIE, NAME=T\nS, M\n";
    let by_sets = "*EQUATION\n2\nSLAVES,1,1.,MASTERS,1,-1.\n2\nSLAVES,2,1.,MASTERS,2,-1.\n2\nSLAVES,3,1.,MASTERS,3,-1.\n";
    let pins = "*MPC\nPIN,SLAVES,MASTERS\n";
    let roads = [
        format!("{turned}{skew}"),
        format!("{sets}{turned}{by_sets}"),
        format!("{sets}{pins}"),
        ties.to_owned(),
    ];
    for road in roads {
        assert_same(&deck(&format!("{halves}{road}")), &whole, 1e-7);
    }
    // a third term between components of one node would bind the bar to the ground
    let note = &deck(&format!("{halves}{turned}{equations}{sets}{pins}")).file_notes[0];
    assert!(note.contains("left out: 4 equations that a motion of the whole body breaks"), "{note}");
}

/// The nodes of the finer mesh between those of the coarser are tied, or follow the means of edges and of the face by equations.
#[test]
fn nodes_between_those_of_a_coarser_face_are_means() {
    let left = block("A", 1, [0.0; 3], [2.0, 0.5, 0.3], [2, 1, 1]);
    let right = block("B", 101, [2.0, 0.0, 0.0], [4.0, 0.5, 0.3], [3, 2, 2]);
    let bar = format!("{left}{right}{}", sections(&["A", "B"]));
    // rows of the slave face: nodes 101 + 4 j + 12 k
    let mut equations = String::from("*EQUATION\n");
    let corners = [[3, 6], [9, 12]];
    for (j, k) in (0..9).map(|at| (at % 3, at / 3)) {
        for component in 1..=3 {
            let mut terms = vec![format!("{},{component},4.", 101 + 4 * j + 12 * k)];
            for (up, row) in corners.iter().enumerate() {
                for (side, master) in row.iter().enumerate() {
                    let share = |step: usize, at: usize| if at == 1 { step } else { 2 - step };
                    let weight = share(j, side) * share(k, up);
                    terms.push(format!("{master},{component},-{weight}."));
                }
            }
            writeln!(equations, "5\n{}\n{}", terms[..4].join(","), terms[4..].join(",")).unwrap();
        }
    }
    let ties = "*SURFACE, NAME=S\nBLOW, S6\n*SURFACE, NAME=M\nAHIGH, S4\n*TIE, NAME=T\nS, M\n";
    let (tied, bound) = (deck(&format!("{bar}{ties}")), deck(&format!("{bar}{equations}")));
    assert_same(&tied, &bound, 1e-7);
    assert_eq!(tied.file_notes[0], "bar.inp: nodes of *TIE follow the nearest points of faces (9)");
    // Shapes of one mesh: the bar is stiffer where it is bound, by little.
    let fine = deck(&(block("A", 1, [0.0; 3], [4.0, 0.5, 0.3], [6, 2, 2]) + &sections(&["A"])));
    let (found, fine) = (frequencies(&tied), frequencies(&fine));
    assert!((found[0] / fine[0] - 1.0).abs() < 0.05, "{found:?} {fine:?}");
}

/// Nodes beside a warped face, off its plane and off its edge, move with it when it moves as a whole.
#[test]
fn ties_across_gaps_follow_every_rigid_motion() {
    let left = block("A", 1, [0.0; 3], [2.0, 0.5, 0.3], [2, 1, 1]);
    let warped = left.lines().map(|line| match line.strip_prefix("12,") {
        Some(_) => {
            let [x, y, z] = aslant([2.15, 0.55, 0.33]);
            format!("12,{x},{y},{z}\n")
        }
        None => format!("{line}\n"),
    });
    let right = block("B", 101, [2.1, -0.04, 0.02], [4.0, 0.47, 0.31], [3, 2, 2]);
    let ties = "*SURFACE, NAME=S\nBLOW, S6\n*SURFACE, NAME=M\nAHIGH, S4\n*TIE, NAME=T, POSITION TOLERANCE=.2\nS, M\n";
    let text = format!("{}{right}{}{ties}", warped.collect::<String>(), sections(&["A", "B"]));
    let model = deck(&text);
    let notes = model.file_notes.join("\n");
    assert!(notes.contains("follow the nearest points of faces (9)"), "{notes}");
    let PartKind::Mixed(mixed) = &only_part(&model.assembly).kind else { panic!("a deck") };
    let moved = |at: [f64; 3], component: usize| {
        let (shift, [a, b, c]) = ([0.3, -1.1, 0.7], [-0.4, 0.9, 0.2]);
        let [x, y, z] = at;
        shift[component] + [b * z - c * y, c * x - a * z, a * y - b * x][component]
    };
    let mut count = 0;
    for coupling in &mixed.couplings {
        let Coupling::Linear { node, rows } = coupling else { panic!("{coupling:?}") };
        for (component, terms) in rows {
            let of = |node: usize, component: usize| moved(mixed.mesh.nodes[node], component);
            let sum: f64 = terms.iter().map(|term| term.share * of(term.node, term.component)).sum();
            assert!((sum - of(*node, *component)).abs() < 1e-12 * 10.0, "{sum} {}", of(*node, *component));
            count += 1;
        }
    }
    assert_eq!(count, 27);
    assert!(frequencies(&model)[0] > 100.0);
    let apart = deck(&text.replace("TOLERANCE=.2", "TOLERANCE=.02"));
    let refusal = apart.assembly.body().map(|_| ()).expect_err("two bodies");
    assert!(apart.diagnose(&refusal).to_string().contains("mechanism"));
    assert!(
        apart.file_notes[0].contains("left out: 9 nodes of *TIE beyond its tolerance"),
        "{:?}",
        apart.file_notes
    );
}

/// Four masses in a tetrahedron: a link is the limit of a stiff spring.
#[test]
fn a_link_is_a_stiff_spring() {
    let masses = "*NODE, NSET=ALL\n1,1.1,1,1\n2,1,-1,-1\n3,-1,1,-1\n4,-1,-1,1\n\
        *ELEMENT, TYPE=MASS, ELSET=M\n1,1\n2,2\n3,3\n4,4\n*MASS, ELSET=M\n2.\n";
    let springs =
        "*ELEMENT, TYPE=SPRINGA, ELSET=S\n11,1,2\n12,1,3\n13,1,4\n14,2,3\n15,2,4\n*SPRING, ELSET=S\n\n50.\n";
    let stiff = "*ELEMENT, TYPE=SPRINGA, ELSET=H\n16,3,4\n*SPRING, ELSET=H\n\n5e8\n";
    let linked = frequencies(&deck(&format!("{masses}{springs}*MPC\nLINK,3,4\n")));
    let sprung = frequencies(&deck(&format!("{masses}{springs}{stiff}")));
    assert_eq!((linked.len(), sprung.len()), (5, 6));
    for (linked, sprung) in linked.iter().zip(&sprung) {
        assert!((linked / sprung - 1.0).abs() < 1e-6, "{linked} {sprung}");
    }
}

/// Two beams that meet in two nodes, bound in all six components along turned axes, are one beam.
#[test]
fn equations_bind_rotations() {
    let beam = "*MATERIAL, NAME=EL\n*ELASTIC\n7e10,.3\n*DENSITY\n2700.\n\
        *BEAM SECTION, ELSET=B, MATERIAL=EL, SECTION=RECT\n.03,.02\n1.,1.,0.\n";
    let whole =
        format!("*NODE\n1,0,0,1\n2,1,2,2\n3,3,3,2\n*ELEMENT, TYPE=B33, ELSET=B\n1,1,2\n2,2,3\n{beam}");
    let mut equations =
        String::from("*NSET, NSET=T\n2,4\n*TRANSFORM, NSET=T\n.6,.8,0.,-.8,.6,.3\n*EQUATION\n");
    for component in 1..=6 {
        writeln!(equations, "2\n4,{component},1.,2,{component},-1.").unwrap();
    }
    let halves = format!(
        "*NODE\n1,0,0,1\n2,1,2,2\n3,3,3,2\n4,1,2,2\n*ELEMENT, TYPE=B33, ELSET=B\n1,1,2\n2,4,3\n{beam}{equations}"
    );
    for unit in ["", "length_unit = \"cm\"\n"] {
        let of = |text: &str| {
            let table = format!("[[deck]]\nname = \"bar\"\nfile = \"bar.inp\"\n{unit}");
            written(&[("bar.inp", text.to_owned())], &table).unwrap_or_else(|error| panic!("{error}"))
        };
        assert_same(&of(&halves), &of(&whole), 1e-7);
    }
}

/// An equation that a motion of the whole body breaks is a support: it is told, and changes nothing.
#[test]
fn equations_that_hold_the_whole_body_are_told() {
    let (whole, _) = bars();
    let plain = deck(&whole);
    for equation in ["1\n5,1,1.", "2\n5,1,1.,1,1,-1.", "2\n5,1,1.,1,2,-1.", "3\n5,1,1.,1,1,-.5,3,1,-.4"] {
        let bound = deck(&format!("{whole}*EQUATION\n{equation}\n"));
        let told = "left out: 1 equations that a motion of the whole body breaks, which act as supports";
        assert!(bound.file_notes[0].contains(told), "{:?}", bound.file_notes);
        assert!(differences(&bound, &plain).iter().all(|(_, difference)| *difference == 0.0));
    }
}
