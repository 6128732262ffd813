//! Decks of NASTRAN as models: the same body as tables of this file describe, and sums by hand.
#![allow(non_snake_case)]

use quasirigid::elements::{Coupling, PartKind};
use quasirigid::reduction;
use quasirigid_io::model::Model;

use super::same::assert_same;
use super::{only_part, read_with, written};
use crate::files::op2::{Tape, Word, words};

/// A deck in this folder and a table with these further lines; no carrier.
fn deck(text: &str, lines: &str) -> Model {
    let table = format!("[[deck]]\nname = \"sat\"\nfile = \"sat.bdf\"\n{lines}");
    written(&[("sat.bdf", text.to_owned())], &table).unwrap_or_else(|error| panic!("{error}"))
}

/// Mass, centre and inertia about it of a body, summed from points and small bodies here.
struct Sum {
    mass: f64,
    first: [f64; 3],
    second: [[f64; 3]; 3],
}

impl Sum {
    fn new() -> Self {
        Self { mass: 0.0, first: [0.0; 3], second: [[0.0; 3]; 3] }
    }

    /// Adds a mass at a place, with its own second moments `∫ r rᵀ dm`.
    fn add(&mut self, mass: f64, place: [f64; 3], own: [[f64; 3]; 3]) {
        self.mass += mass;
        for i in 0..3 {
            self.first[i] += mass * place[i];
            for j in 0..3 {
                self.second[i][j] += mass * place[i] * place[j] + own[i][j];
            }
        }
    }

    /// Inertia about the centre of mass: `tr(S) 1 − S`.
    fn inertia(&self) -> [[f64; 3]; 3] {
        let S: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| self.second[i][j] - self.first[i] * self.first[j] / self.mass)
        });
        let trace = S[0][0] + S[1][1] + S[2][2];
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { trace - S[i][j] } else { -S[i][j] }))
    }
}

fn assert_is(model: &Model, sum: &Sum) {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let invariants = body.invariants();
    assert!((invariants.mass / sum.mass - 1.0).abs() < 1e-12, "{} and not {}", invariants.mass, sum.mass);
    let (found, expected) = (body.inertia(), sum.inertia());
    let scale = (0..3).map(|i| expected[i][i]).fold(0.0, f64::max);
    for i in 0..3 {
        for j in 0..3 {
            assert!((found[i][j] - expected[i][j]).abs() < 1e-11 * scale, "{found:?} and not {expected:?}");
        }
    }
}

/// Solid bricks, a plate on top with extra mass, a mast of beams with an offset, a truss, bodies with products of inertia in a turned system,
/// in millimetres and tonnes: every mass is found, and nothing is counted twice.
#[test]
fn a_mixed_deck_has_the_mass_and_inertia_of_its_sum() {
    let text = "CEND\nBEGIN BULK\nPARAM,WTMASS,0.5\n\
        GRID,1,,0.,0.,0.\nGRID,2,,1000.,0.,0.\nGRID,3,,1000.,800.,0.\nGRID,4,,0.,800.,0.\n\
        GRID,5,,0.,0.,500.\nGRID,6,,1000.,0.,500.\nGRID,7,,1000.,800.,500.\nGRID,8,,0.,800.,500.\n\
        GRID,9,,500.,400.,1500.\nGRID,10,,500.,400.,900.\nGRID,11,,-300.,-200.,900.\nGRID,99,,1.,1.,1.\n\
        CHEXA,1,10,1,2,3,4,5,6,+\n+,7,8\nPSOLID,10,1\nCQUAD4,2,20,5,6,7,8\nPSHELL,20,2,4.,2,,2,,1.-8\n\
        CBAR,3,30,10,9,1.,0.,0.\n,,,0.,30.,0.,0.,30.,0.\nPBAR,30,2,600.,2.+5,3.+5,4.+5,2.-6\n\
        RBE2,4,10,123456,5,6,7,8\nCROD,5,50,9,11\nPROD,50,2,80.\nCROD,6,50,5,11\nCROD,7,50,6,11\nCROD,8,50,8,11\n\
        CORD2R,7,,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\nCONM2,60,9,7,0.02,10.,20.,30.,,+\n+,500.,50.,600.,-40.,30.,700.\n\
        CONM2,61,11,,0.003\nMAT1,1,70000.,,.3,2.7-9\nMAT1,2,210000.,,.3,7.8-9\nSPC1,1,123,1\nENDDATA\n";
    let model = deck(text, "length_unit = \"mm\"\nmass_unit = \"t\"\nattach = []\n");
    let mut sum = Sum::new();
    let weight = 0.5 * 1e3; // WTMASS, kg in a tonne
    let mm = 1e-3;
    let diagonal = |mass: f64, [a, b, c]: [f64; 3]| {
        let part = |x: f64| mass * (x * mm).powi(2) / 12.0;
        [[part(a), 0.0, 0.0], [0.0, part(b), 0.0], [0.0, 0.0, part(c)]]
    };
    let at = |place: [f64; 3]| place.map(|x| x * mm);
    let brick = weight * 2.7e-9 * 1000.0 * 800.0 * 500.0;
    sum.add(brick, at([500.0, 400.0, 250.0]), diagonal(brick, [1000.0, 800.0, 500.0]));
    let plate = weight * (7.8e-9 * 4.0 + 1e-8) * 1000.0 * 800.0;
    sum.add(plate, at([500.0, 400.0, 500.0]), diagonal(plate, [1000.0, 800.0, 4.0]));
    // the bar along z, its y along x: moments 2e5 (∫ y² dA, along x) and 3e5 (along y)
    let bar = weight * (7.8e-9 * 600.0 + 2e-6) * 600.0;
    let mut own = diagonal(bar, [0.0, 0.0, 600.0]);
    own[0][0] = bar / 600.0 * 2e5 * mm * mm;
    own[1][1] = bar / 600.0 * 3e5 * mm * mm;
    sum.add(bar, at([500.0, 430.0, 1200.0]), own);
    let nine = [500.0, 400.0, 1500.0];
    for other in [nine, [0.0, 0.0, 500.0], [1000.0, 0.0, 500.0], [0.0, 800.0, 500.0]] {
        let eleven = [-300.0, -200.0, 900.0];
        let along: [f64; 3] = std::array::from_fn(|k| other[k] - eleven[k]);
        let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mass = weight * 7.8e-9 * 80.0 * length;
        let own =
            std::array::from_fn(|i| std::array::from_fn(|j| mass / 12.0 * along[i] * along[j] * mm * mm));
        sum.add(mass, at(std::array::from_fn(|k| 0.5 * (other[k] + eleven[k]))), own);
    }
    // system 7: z along x, x along y, y along z; products of inertia with the sign of the tensor turned
    let mass = weight * 0.02;
    let J = [[500.0, -50.0, 40.0], [-50.0, 600.0, -30.0], [40.0, -30.0, 700.0]];
    let half = 0.5 * (J[0][0] + J[1][1] + J[2][2]);
    let axis = [1, 2, 0]; // basic axis of each axis of the system
    let mut own = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            own[axis[i]][axis[j]] = weight * mm * mm * (if i == j { half } else { 0.0 } - J[i][j]);
        }
    }
    sum.add(mass, at([500.0 + 30.0, 400.0 + 10.0, 1500.0 + 20.0]), own);
    sum.add(weight * 0.003, at([-300.0, -200.0, 900.0]), [[0.0; 3]; 3]);
    assert_is(&model, &sum);
    assert_eq!(
        model.file_notes,
        [
            "sat.bdf: left out: 1 SPC1",
            "sat.bdf: grid points that belong to no element are kept aside (1)",
            "sat.bdf: masses are multiplied by PARAM,WTMASS = 0.5",
        ]
    );
}

/// The lowest frequencies (rad/s) of a body that floats.
fn frequencies(model: &Model) -> Vec<f64> {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    reduction::frequencies(&body).expect("frequencies")
}

const MODES: &str = "[reduction]\nmodes = 8\n";

/// A bar with bodies at its ends is the `[[beam]]` of the same section.
#[test]
fn a_deck_of_bars_is_the_beam_of_this_file() {
    let table = "[material.m]\ndensity = 1600\nyoung = 9e10\npoisson = 0.3\n[section.s]\nshape = \"general\"\narea = 6e-4\n\
        second_y = 7e-7\nsecond_z = 5e-7\ntorsion = 1.2e-6\n[[beam]]\nname = \"sat\"\nnodes = { a = [-3, 0, 0], b = [3, 0, 0] }\n\
        lines = [[\"a\", \"b\"]]\nelements = 4\nup = [0, 1, 0]\nsection = \"s\"\nmaterial = \"m\"\n\
        masses = [{ node = \"a\", mass = 40, inertia = [2, 3, 4] }, { node = \"b\", mass = 50, inertia = [2, 3, 4] }]\n";
    let beam = written(&[], &format!("{table}{MODES}")).unwrap_or_else(|error| panic!("{error}"));
    let mut text = String::from("CEND\nBEGIN BULK\nMAT1,1,9.+10,,.3,1600.\nPBAR,1,1,6.-4,5.-7,7.-7,1.2-6\n");
    for (node, x) in (1..).zip([-3.0, -1.5, 0.0, 1.5, 3.0]) {
        text += &format!("GRID,{node},,{x:?},0.,0.\n");
    }
    for bar in 1..5 {
        text += &format!("CBAR,{bar},1,{bar},{},0.,1.,0.\n", bar + 1);
    }
    text += "CONM2,11,1,,40.,,,,,+\n+,2.,,3.,,,4.\nCONM2,12,5,,50.,,,,,+\n+,2.,,3.,,,4.\nENDDATA\n";
    let bars = deck(&text, MODES);
    assert_same(&bars, &beam, 1e-8);
    // both twist at √(GJ/L (1/I₁ + 1/I₂)): the bar's own inertia is below 1e-4 of those of the bodies
    let twist = f64::sqrt(9e10 / 2.6 * 1.2e-6 / 6.0);
    assert!(
        frequencies(&bars).iter().any(|found| (found / twist - 1.0).abs() < 1e-3),
        "{:?}",
        frequencies(&bars)
    );
}

/// Two bodies that a spring and bushings join vibrate at `√(k (1/m₁ + 1/m₂))`; the bushing turns them against each other too.
#[test]
fn springs_and_bushings_join_bodies() {
    let text = "BEGIN BULK\nCORD2R,5,,0.,0.,0.,0.,0.,1.,+\n+,0.,1.,0.\nGRID,1,,0.,0.,0.\nGRID,2,,0.,0.,0.,5\n\
        CONM2,1,1,,2.,,,,,+\n+,1.,,1.,,,1.\nCONM2,2,2,,3.,,,,,+\n+,2.,,2.,,,2.\n\
        CBUSH,3,7,1,2,,,,0\nPBUSH,7,K,100.,200.,300.,40.,50.,60.\nCELAS2,4,24.,1,1,2,2\nENDDATA\n";
    // The second axis of system 5 is −x: the strain of the spring is x₁ + x₂, so that it would hold the body to the ground, and is left out.
    let model = deck(text, MODES);
    assert!(
        model.file_notes[0].contains("springs that a motion of the whole body strains"),
        "{:?}",
        model.file_notes
    );
    let along = 1.0 / 2.0 + 1.0 / 3.0;
    let about = 1.0 / 1.0 + 1.0 / 2.0;
    let mut expected: Vec<f64> = [100.0, 200.0, 300.0].map(|k: f64| (k * along).sqrt()).to_vec();
    expected.extend([40.0, 50.0, 60.0].map(|k: f64| (k * about).sqrt()));
    expected.sort_by(f64::total_cmp);
    let found = frequencies(&model);
    assert_eq!(found.len(), 6, "{found:?}");
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 1e-8, "{found} and not {expected}");
    }
}

/// Springs, dashpots and bushings with one end at the ground are left out alike in every format, and the body is that without them.
#[test]
fn what_the_ground_would_hold_is_left_out_alike() {
    let told =
        |count: usize| format!("left out: {count} springs, dashpots, bushings and connectors to the ground");
    let text = "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCONM2,1,1,,2.,,,,,+\n+,1.,,1.,,,1.\nCONM2,2,2,,3.,,,,,+\n+,2.,,2.,,,2.\nCBUSH,3,7,1,2,,,,0\n\
        PBUSH,7,K,100.,200.,300.,40.,50.,60.\n";
    let held = "CELAS2,4,24.,1,1\nCELAS2,5,24.,,,2,3\nCDAMP2,6,1.,2,2\nCELAS1,8,9,1,2\nPELAS,9,5.\nCBUSH,10,7,2,,,,,0\n";
    let model = deck(&format!("{text}{held}"), "");
    assert!(model.file_notes[0].ends_with(&told(5)), "{:?}", model.file_notes);
    assert_same(&model, &deck(text, ""), 1e-13);
    let inp = |held: &str| {
        let text = format!(
            "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n*ELEMENT,TYPE=MASS,ELSET=M\n1,1\n2,2\n3,3\n*MASS,ELSET=M\n2.\n*ELEMENT,TYPE=SPRINGA,ELSET=S\n\
            7,1,2\n8,2,3\n9,3,1\n*SPRING,ELSET=S\n\n100.\n{held}"
        );
        let table = "[[deck]]\nname = \"sat\"\nfile = \"sat.inp\"\n";
        written(&[("sat.inp", text)], table).unwrap_or_else(|error| panic!("{error}"))
    };
    let held = inp(
        "*ELEMENT,TYPE=SPRING1,ELSET=G\n4,1\n5,2\n*SPRING,ELSET=G\n2\n9.\n*ELEMENT,TYPE=DASHPOT1,ELSET=D\n6,1\n\
        *DASHPOT,ELSET=D\n1\n9.\n",
    );
    assert!(held.file_notes[0].ends_with(&told(3)), "{:?}", held.file_notes);
    assert_same(&held, &inp(""), 1e-13);
}

/// The reference point of an RBE3 moves with the mean of its points: a mass there is spread on them by lever arms.
#[test]
fn a_mean_carries_a_mass_as_its_points_do() {
    let text = "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\nGRID,5,,0.,0.,1.\n\
        GRID,6,,2.,0.,1.\nGRID,7,,2.,2.,1.\nGRID,8,,0.,2.,1.\nGRID,9,,1.,1.,3.\nCHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\nPSOLID,1,1\n\
        MAT1,1,1.+9,,.25,1000.\nRBE3,2,,9,123456,1.,123,5,6,+\n+,7,8\nCONM2,3,9,,500.\nENDDATA\n";
    let model = deck(text, "");
    let mut sum = Sum::new();
    sum.add(
        4000.0,
        [1.0, 1.0, 0.5],
        [[4000.0 / 3.0, 0.0, 0.0], [0.0, 4000.0 / 3.0, 0.0], [0.0, 0.0, 1000.0 / 3.0]],
    );
    sum.add(500.0, [1.0, 1.0, 3.0], [[0.0; 3]; 3]);
    assert_is(&model, &sum);
    let PartKind::Mixed(mixed) = &only_part(&model.assembly).kind else { panic!("a deck") };
    assert!(matches!(&mixed.couplings[..], [Coupling::Mean { others, .. }] if others.len() == 4));
}

/// What cannot be right is refused: a property that is not there, a deck without mass.
#[test]
fn decks_without_a_property_are_refused() {
    let text = "BEGIN BULK\nGRID,1\nGRID,2,,1.\nGRID,3,,,1.\nGRID,4,,,,1.\nCTETRA,1,7,1,2,3,4\nENDDATA\n";
    let table = "[[deck]]\nname = \"sat\"\nfile = \"sat.bdf\"\n";
    let error = written(&[("sat.bdf", text.to_owned())], table).expect_err("no property");
    insta::assert_snapshot!(super::located(&error), @"
    model.toml:3:8: `file`: sat.bdf: no card that is read has the property 7; is an included file missing, or is it of another kind?
      it is looked for beside the model
    ");
}

/// A mast of beams whose extra mass falls from end to end has the mass and the centre of mass that NASTRAN printed of it (pyNastran,
/// `models/sol200/model_200.f06`, grid point weight generator: six digits), and the inertia of lines. NASTRAN's own is that of mass at the
/// ends of each beam, 10 % more.
#[test]
fn a_tapered_mast_is_that_of_nastran() {
    let places = [
        [0.093728, 0.0, 0.0],
        [0.5351075, 1.2275, 0.0643305],
        [0.8927557, 2.2275, 0.1167383],
        [1.253594, 3.2275, 0.1691461],
        [1.61353, 4.24, 0.222209],
    ];
    let extra = [0.7993671, 0.7486528, 0.7073376, 0.6660225, 0.6241909];
    let mut text = String::from("BEGIN BULK\nMAT1,1,1.,1.\nCONM2,10,5,,.0666,.8763962,.1567351,.8888889\n");
    let mut sum = Sum::new();
    for (label, [x, y, z]) in (1..).zip(places) {
        text += &format!("GRID,{label},,{x:?},{y:?},{z:?}\n");
    }
    for beam in 0..4 {
        let (label, [a, b]) = (beam + 1, [extra[beam], extra[beam + 1]]);
        text += &format!(
            "CBEAM,{label},{label},{label},{},0.,0.,1.\nPBEAM,{label},1,1.+4,1.-2,1.-2,,1.-2,{a:?}\n,NO,1.,5.+3,,,,,{b:?}\n",
            label + 1
        );
        let side: [f64; 3] = std::array::from_fn(|k| places[beam + 1][k] - places[beam][k]);
        let length = side.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Gauss's three points: exact for the cubic
        for (share, weight) in [(-0.6f64.sqrt(), 5.0), (0.0, 8.0), (0.6f64.sqrt(), 5.0)] {
            let s = 0.5 + 0.5 * share;
            let place = std::array::from_fn(|k| places[beam][k] + s * side[k]);
            sum.add(weight / 18.0 * length * (a + s * (b - a)), place, [[0.0; 3]; 3]);
        }
    }
    let tip = [0.8763962, 0.1567351, 0.8888889];
    sum.add(0.0666, std::array::from_fn(|k| places[4][k] + tip[k]), [[0.0; 3]; 3]);
    let model = deck(&text, "attach = []\n");
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    assert!((body.invariants().mass / 3.276537 - 1.0).abs() < 1e-6, "{}", body.invariants().mass);
    let centre = sum.first.map(|first| first / sum.mass);
    for (found, printed) in centre.iter().zip([0.8573885, 2.080729, 0.1269472]) {
        assert!((found / printed - 1.0).abs() < 1e-6, "{centre:?}");
    }
    let (found, expected) = (body.inertia(), sum.inertia());
    for i in 0..3 {
        for j in 0..3 {
            // the moments of the sections are 1e-6 of their area
            assert!((found[i][j] - expected[i][j]).abs() < 3e-6 * expected[2][2], "{found:?} {expected:?}");
        }
    }
    assert!(model.file_notes.iter().any(|note| note.contains("pieces of one section each (4)")));
}

/// A tapered mast clamped to a heavy body vibrates as many short uniform beams do: given by PBEAM at four places and by the sizes of its ends,
/// between which the constants of the section, not its sizes, change linearly.
#[test]
fn a_tapered_beam_vibrates_as_its_slices_do() {
    let head =
        "BEGIN BULK\nMAT1,1,7.+10,,.3,2700.\nGRID,1,,0.,0.,0.\nCONM2,9,1,,1.+6,,,,,+\n+,1.+6,,1.+6,,,1.+6\n";
    let bar = |height: f64| {
        let (b, h) = (0.02_f64, height);
        let torsion = h * b.powi(3) * (1.0 / 3.0 - 0.21 * b / h * (1.0 - (b / h).powi(4) / 12.0));
        [b * h, b * h.powi(3) / 12.0, h * b.powi(3) / 12.0, torsion]
    };
    let fields =
        |[area, first, second, torsion]: [f64; 4]| format!("{area:e},{first:e},{second:e},0.,{torsion:e},0.");
    let height = |share: f64| 0.1 - 0.06 * share;
    let on_the_line = |share: f64| {
        let [from, to] = [0.1, 0.04].map(bar);
        [0, 1, 2, 3].map(|k| (1.0 - share) * from[k] + share * to[k])
    };
    let count = 24;
    let sliced = |section: &dyn Fn(f64) -> [f64; 4]| {
        let mut text = String::from(head);
        for slice in 0..count {
            let (label, at) = (slice + 2, 2.0 * f64::from(slice + 1) / f64::from(count));
            let section = fields(section((f64::from(slice) + 0.5) / f64::from(count)));
            text += &format!(
                "GRID,{label},,{at:?},0.,0.\nCBEAM,{label},{label},{},{label},0.,1.,0.\nPBEAM,{label},1,{section}\n",
                label - 1
            );
        }
        text
    };
    let beam = format!("{head}GRID,2,,2.,0.,0.\nCBEAM,1,1,1,2,0.,1.,0.\n");
    let stations =
        (1..5).map(|k| f64::from(k) / 4.0).map(|at| format!("\n,NO,{at:?},{}", fields(bar(height(at)))));
    let places = format!("{beam}PBEAM,1,1,{}\n,,,,,,,,{}\n", fields(bar(0.1)), stations.collect::<String>());
    let sized = format!("{beam}PBEAML,1,1,,BAR\n,.02,.1,,NO,1.,.02,.04\n");
    let slow = |text: &str| frequencies(&deck(text, "[reduction]\nmodes = 6\n"));
    let by_height = |share: f64| bar(height(share));
    let expected = [sliced(&by_height), sliced(&on_the_line)];
    for (text, slices) in [places, sized].iter().zip(&expected) {
        for (found, expected) in slow(text).iter().zip(&slow(slices)).take(3) {
            assert!((found / expected - 1.0).abs() < 0.02, "{found} and not {expected}");
        }
    }
}

/// Two beams whose meeting points MPC bind in all six components along the axes of a system, in a set of sets that the case control chooses,
/// are one beam; a constraint that holds the whole body, one of another set and one of a scalar point are told and change nothing.
#[test]
fn multi_point_constraints_bind_as_equations() {
    let head = "MAT1,1,7.+10,,.3,2700.\nPBAR,1,1,6.-4,5.-8,2.-8,6.-8\nGRID,1,,0.,0.,1.\nGRID,3,,3.,3.,2.\n\
        CORD2R,5,,0.,0.,0.,.6,.8,1.,+\n+,1.,0.,0.\nCBAR,1,1,1,2,0.,0.,1.\n";
    let whole = format!("BEGIN BULK\n{head}GRID,2,,1.,2.,2.\nCBAR,2,1,2,3,0.,0.,1.\n");
    let mut halves = format!(
        "CEND\nMPC = 9 $ 8\nBEGIN BULK\n{head}GRID,2,,1.,2.,2.,5\nGRID,4,,1.,2.,2.,5\nCBAR,2,1,4,3,0.,0.,1.,BGG\n"
    );
    halves = halves.replace("2,0.,0.,1.\n", "2,0.,0.,1.,BGG\n");
    for component in 1..=6 {
        halves += &format!("MPC,{},4,{component},1.,2,{component},-1.\n", component % 2 + 1);
    }
    halves += "MPCADD,9,1,2\nMPC,1,3,1,1.\nMPC,2,99,0,1.,3,1,1.\nMPC,8,3,1,1.,4,1,-1.\n";
    let bound = deck(&halves, "");
    assert_same(&bound, &deck(&whole, ""), 1e-7);
    let told = "left out: 1 MPC of scalar points, 1 MPC of sets that no case control chooses, 1 equations that a motion of the whole body \
        breaks, which act as supports";
    assert!(bound.file_notes[0].contains(told), "{:?}", bound.file_notes);
}

/// A mast of three bars has eighteen coordinates, of which four modes are asked for: they are those of the beam by its closed form,
/// `(1.8751/L)² √(EI/μ)` and the second within what three elements give.
#[test]
fn few_coordinates_have_their_modes() {
    let mut text =
        String::from("BEGIN BULK\nMAT1,1,7.+10,,.3,2700.\nPBAR,1,1,6.-4,5.-8,2.-8,6.-8\nGRID,1,,0.,0.,0.\n");
    for bar in 1..4 {
        text += &format!("GRID,{},,0.,0.,{bar}.\nCBAR,{bar},1,{bar},{},1.,0.,0.\n", bar + 1, bar + 1);
    }
    let table = "[carrier]\nmass = 1e8\ncenter_of_mass = [0, 0, 0]\ninertia = [1e9, 1e9, 1e9]\n[[deck]]\nname = \"mast\"\nfile = \"mast.bdf\"\nattach = [1]\n\
        [reduction]\nmodes = 4\n";
    let model = written(&[("mast.bdf", text)], table).unwrap_or_else(|error| panic!("{error}"));
    let found = frequencies(&model);
    let of = |root: f64, moment: f64| (root / 3.0).powi(2) * (7e10 * moment / (2700.0 * 6e-4)).sqrt();
    let mut expected = [of(1.875_104, 2e-8), of(1.875_104, 5e-8), of(4.694_091, 2e-8), of(4.694_091, 5e-8)];
    expected.sort_by(f64::total_cmp);
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 5e-3, "{found} and not {expected}");
    }
}

/// The text of a deck, and the records of the tables that NASTRAN writes of it, by hand.
const TEXT: &str = "CEND\nMPC = 7 $ both ends\nBEGIN BULK\nPARAM,WTMASS,0.5\n\
    CORD2C,4,,100.,20.,-30.,100.,20.,0.,+\n+,200.,120.,-30.\n\
    GRID,1,,0.,0.,0.\nGRID,2,,1000.,0.,0.\nGRID,3,,1000.,800.,0.\nGRID,4,,0.,800.,0.\n\
    GRID,5,,0.,0.,500.\nGRID,6,,1000.,0.,500.\nGRID,7,,1000.,800.,500.\nGRID,8,,0.,800.,500.\n\
    GRID,9,4,500.,40.,1500.,4\nGRID,10,,500.,400.,900.\nGRID,11,,-300.,-200.,900.\n\
    CHEXA,1,10,1,2,3,4,5,6,+\n+,7,8\nPSOLID,10,1\nCQUAD4,2,20,5,6,7,8\nPSHELL,20,2,4.,2,,2,,1.-8\n\
    CQUAD4,22,21,5,6,7,8,30.,1.5\nPCOMP,21,-1.,,,,,,SYM\n,3,0.25,45.,,3,0.25,0.\n\
    CBAR,3,30,10,9,1.,0.,0.,BGG\n,,,0.,30.,0.,0.,30.,0.\nPBAR,30,2,600.,2.+5,3.+5,4.+5,2.-6,,+\n+,,,,,,,,,+\n+,0.8,0.9,1.+4\n\
    CBEAM,33,31,11,1,9\nPBEAM,31,2,700.,2.+5,3.+5,0.,5.+5,2.-6,+\n+,,,,,,,,,+\n\
    +,NO,0.4,600.,1.5+5,2.+5,0.,4.+5,0.,+\n+,NO,1.,500.,1.+5,1.+5,0.,2.+5,1.-6\n\
    RBE2,4,10,123456,5,6,7,8\nRBE3,40,,11,123456,1.,123,5,8,+\n+,2.,123,6\nCROD,5,50,9,11\nPROD,50,2,80.\nCONROD,6,5,11,2,70.\n\
    CELAS2,70,300.,1,1,11,2\nCELAS1,71,72,2,3,11,1\nPELAS,72,400.\n\
    CBUSH,80,81,9,10,,,,4\nPBUSH,81,K,1.+3,2.+3,3.+3,4.+5,5.+5,6.+5,+\n+,,B,7.,8.,9.,1.,2.,3.\n\
    CONM2,60,9,4,0.02,10.,20.,30.,,+\n+,500.,50.,600.,-40.,30.,700.\n\
    MPC,5,1,1,1.,2,1,-1.,,+\n+,,3,1,1.,4,1,-1.\nMPC,6,1,2,1.,4,2,-1.\nMPCADD,7,5\n\
    MAT1,1,70000.,,.3,2.7-9\nMAT1,2,210000.,,.3,7.8-9\nMAT8,3,1.4+5,9000.,.3,5000.,4000.,3000.,1.6-9\nSPC1,1,123,1\nENDDATA\n";

fn geometry(tape: Tape) -> Vec<u8> {
    tables(tape).end()
}

fn tables(mut tape: Tape) -> Tape {
    let grid =
        |label: i64, system: i64, [x, y, z]: [f64; 3], axes: i64| words![label, system, x, y, z, axes, 0, 0];
    let places = [
        [0.0, 0.0, 0.0],
        [1000.0, 0.0, 0.0],
        [1000.0, 800.0, 0.0],
        [0.0, 800.0, 0.0],
        [0.0, 0.0, 500.0],
        [1000.0, 0.0, 500.0],
        [1000.0, 800.0, 500.0],
        [0.0, 800.0, 500.0],
    ];
    let mut grids = words![4501, 45, 1];
    (1..).zip(places).for_each(|(label, place)| grids.extend(grid(label, 0, place, 0)));
    grids.extend(grid(9, 4, [500.0, 40.0, 1500.0], 4));
    grids.extend(grid(10, 0, [500.0, 400.0, 900.0], 0));
    grids.extend(grid(11, 0, [-300.0, -200.0, 900.0], 0));
    let system = words![2001, 20, 9, 4, 2, 2, 0, 100.0, 20.0, -30.0, 100.0, 20.0, 0.0, 200.0, 120.0, -30.0];
    tape.table("PVT0    ", &[words!["POST    ", 1, -1, "WTMASS  ", 2, 0.5]]);
    tape.table("GEOM1   ", &[system, grids]);
    tape.table("CASECC  ", &[words![1, 7, 1, 0]]);
    let blank = -1.0; // thickness of a corner
    let none = 1.736_799_906e-18; // a blank real number of the solver
    let mut hexa = words![7308, 73, 253, 1, 10, 1, 2, 3, 4, 5, 6, 7, 8];
    hexa.extend(vec![Word::Integer(0); 12]);
    let quads = words![
        2958, 51, 177, 2, 20, 5, 6, 7, 8, 0.0, 0.0, 0, 0, blank, blank, blank, blank, 22, 21, 5, 6, 7, 8,
        30.0, 1.5, 0, 0, blank, blank, blank, blank,
    ];
    let bar = words![2408, 24, 180, 3, 30, 10, 9, 1.0, 0.0, 0.0, 64, 0, 0, 0.0, 30.0, 0.0, 0.0, 30.0, 0.0];
    let beam = words![5408, 54, 261, 33, 31, 11, 1, 0, 0, 9, 0, 0, 2, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let bush = words![2608, 26, 60, 80, 81, 9, 10, 0, 0, 0, -1, 4, 0.5, -1, 0.0, 0.0, 0.0];
    let conm2 =
        words![1501, 15, 64, 60, 9, 4, 0.02, 10.0, 20.0, 30.0, 500.0, 50.0, 600.0, -40.0, 30.0, 700.0,];
    tape.table(
        "GEOM2   ",
        &[
            bar,
            beam,
            bush,
            words![601, 6, 73, 71, 72, 2, 11, 3, 1],
            words![701, 7, 74, 70, 300.0, 1, 11, 1, 2, 0.0, 0.0],
            conm2,
            words![1601, 16, 47, 6, 5, 11, 2, 70.0, 0.0, 0.0, 0.0],
            quads,
            words![3001, 30, 48, 5, 50, 9, 11],
            hexa,
        ],
    );
    let mut pbeam = words![5402, 54, 262, 31, 2, 1, 1, 0.0];
    for place in 0..11 {
        let (share, section) = match place {
            0 => (0.0, [700.0, 2e5, 3e5, 0.0, 5e5, 2e-6]),
            4 => (0.4, [600.0, 1.5e5, 2e5, 0.0, 4e5, 0.0]),
            10 => (1.0, [500.0, 1e5, 1e5, 0.0, 2e5, 1e-6]),
            _ => (0.0, [0.0; 6]),
        };
        pbeam.extend(words![1.0, share]);
        pbeam.extend(section.map(Word::Real));
        pbeam.extend([0.0; 8].map(Word::Real));
    }
    pbeam.extend(words![1.0, 1.0]);
    pbeam.extend([0.0; 14].map(Word::Real));
    let mut pbar = words![52, 20, 181, 30, 2, 600.0, 2e5, 3e5, 4e5, 2e-6, 0.0];
    pbar.extend([0.0; 8].map(Word::Real));
    pbar.extend(words![0.8, 0.9, 1e4]);
    let mut pbush = words![1402, 14, 37, 81, 1e3, 2e3, 3e3, 4e5, 5e5, 6e5, 7.0, 8.0, 9.0, 1.0, 2.0, 3.0,];
    pbush.extend([none; 10].map(Word::Real));
    tape.table(
        "EPT     ",
        &[
            pbar,
            pbeam,
            pbush,
            words![2706, 27, 287, 21, -2, -1.0, 0.0, 0.0, 0, 0.0, 0.0, 3, 0.25, 45.0, 1, 3, 0.25, 0.0, 1],
            words![302, 3, 46, 72, 400.0, 0.0, 0.0],
            words![902, 9, 29, 50, 2, 80.0, 0.0, 0.0, 0.0],
            // the equivalent plate that NASTRAN makes of the layers stands beside them
            words![
                2302,
                23,
                283,
                20,
                2,
                4.0,
                2,
                1.0,
                2,
                0.833,
                1e-8,
                0.0,
                0.0,
                0,
                21,
                100_000_021,
                1.0,
                200_000_021,
                1.0,
                0,
                1.0,
                0.0,
                0.0,
                0.0,
                0,
            ],
            words![2402, 24, 281, 10, 1, 0, 0, 0, 1, "SMEC"],
        ],
    );
    let mut steel = words![103, 1, 77, 1, 7e4, 0.0, 0.3, 2.7e-9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0];
    steel.extend(words![2, 2.1e5, 0.0, 0.3, 7.8e-9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0]);
    let mut mat8 = words![2503, 25, 288, 3, 1.4e5, 9e3, 0.3, 5e3, 4e3, 3e3, 1.6e-9];
    mat8.extend([0.0; 11].map(Word::Real));
    let mut made = words![203, 2, 78, 100_000_021];
    made.extend([1.0; 16].map(Word::Real));
    tape.table("MPT     ", &[steel, made, mat8]);
    tape.table(
        "GEOM4   ",
        &[
            words![5481, 58, 12, 1, 123, 0, 1, -1],
            words![
                4901, 49, 17, 5, 1, 1, 1.0, 2, 1, -1.0, 3, 1, 1.0, 4, 1, -1.0, -1, -1, -1, 6, 1, 2, 1.0, 4,
                2, -1.0, -1, -1, -1,
            ],
            words![4891, 60, 83, 7, 5, -1],
            words![6901, 69, 295, 4, 10, 123_456, 5, 6, 7, 8, -1, 0.0],
            words![7101, 71, 187, 40, 11, 123_456, 1.0, 123, 5, 8, -1, 2.0, 123, 6, -1, -2, -3, 0.0],
        ],
    );
    tape.table("GEOM3   ", &[words![4201, 42, 18, 1, 2, 0, 3.0, 1.0, 0.0, 0.0]]);
    tape
}

/// Layers of solids in the tables of NASTRAN are those of the deck, with the axes of a system.
#[test]
fn layers_of_solids_in_op2_are_those_of_the_deck() {
    let text = "BEGIN BULK\nCORD2R,4,,0.,0.,0.,.6,0.,.8,+\n+,1.,0.,0.\nGRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\nGRID,3,,3.,2.,0.\n\
        GRID,4,,0.,2.,0.\nGRID,5,,0.,0.,1.\nGRID,6,,3.,0.,1.\nGRID,7,,3.,2.,1.\nGRID,8,,0.,2.,1.\nCHEXA,1,5,1,2,3,4,5,6,+\n+,7,8\n\
        MAT1,2,7.+10,,.3,2700.\nMAT1,3,2.+11,,.3,7800.\nPCOMPS,5,4,13\n,1,2,.25\n,2,3,.5,30.\n,4,2,.25\n";
    let deck = deck(text, "");
    let places = [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]];
    for mut tape in Tape::each() {
        let mut grids = words![4501, 45, 1];
        for (label, at) in (1..=8).zip([0.0, 1.0].into_iter().flat_map(|z| places.map(|[x, y]| [x, y, z]))) {
            grids.extend(words![label, 0, at[0], at[1], at[2], 0, 0, 0]);
        }
        let mut hexa = words![7308, 73, 253, 1, 5, 1, 2, 3, 4, 5, 6, 7, 8];
        hexa.extend(vec![Word::Integer(0); 12]);
        let system = words![2101, 21, 8, 4, 1, 2, 0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.8, 1.0, 0.0, 0.0];
        let mut layers = words![16006, 160, 903, 5, 4, 13, 0.0, 0.0, 0.0, 0.0, 0];
        for (layer, material, thickness, angle) in [(1, 2, 0.25, 0.0), (2, 3, 0.5, 30.0), (4, 2, 0.25, 0.0)] {
            layers.extend(words![layer, material, thickness, angle, 0, 0, 0, 0]);
        }
        layers.extend(vec![Word::Integer(-1); 8]);
        let mut steel = words![103, 1, 77, 2, 7e10, 0.0, 0.3, 2700.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0];
        steel.extend(words![3, 2e11, 0.0, 0.3, 7800.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0]);
        tape.table("GEOM1   ", &[system, grids]);
        tape.table("GEOM2   ", &[hexa]);
        tape.table("EPT     ", &[layers]);
        tape.table("MPT     ", &[steel]);
        let bytes = tape.end();
        let table = "[[deck]]\nname = \"sat\"\nfile = \"sat.op2\"\n";
        let model = read_with(&[("sat.op2", &bytes)], table).unwrap_or_else(|error| panic!("{error}"));
        assert_same(&model, &deck, 1e-6); // numbers of 32 bits
    }
}

/// Frequencies of the solver are told, and other models in the same file counted.
#[test]
fn what_else_op2_has_is_said() {
    let mut tape = tables(Tape::new(false, false));
    tape.table("GEOM1   ", &[words![4501, 45, 1, 1, 0, 9.0, 9.0, 9.0, 0, 0, 0]]);
    let mut about = words![20, 6, 0, 1];
    about.extend(vec![Word::Integer(0); 142]);
    let tau = std::f64::consts::TAU;
    tape.table(
        "LAMA    ",
        &[about, words![1, 1, 9.0, 1.5 * tau, 1.5, 1.0, 9.0, 2, 2, 9.0, 2.25 * tau, 2.25, 1.0, 9.0]],
    );
    let bytes = tape.end();
    let table = "[[deck]]\nname = \"sat\"\nfile = \"sat.op2\"\nlength_unit = \"mm\"\nmass_unit = \"t\"\nattach = []\n";
    let model = read_with(&[("sat.op2", &bytes)], table).unwrap_or_else(|error| panic!("{error}"));
    let notes = model.file_notes;
    assert!(
        notes.contains(&"sat.op2: NASTRAN found 2 modes, under its supports: 1.5000, 2.2500 Hz".to_owned()),
        "{notes:?}"
    );
    assert!(notes.iter().any(|note| note.contains("1 GEOM1,")), "{notes:?}");
}

/// The tables of NASTRAN, in words of 32 and 64 bits and both byte orders, are the body of the deck and say the same of it.
#[test]
fn the_geometry_of_op2_is_the_deck() {
    let units = "length_unit = \"mm\"\nmass_unit = \"t\"\nattach = []\n";
    let deck = deck(TEXT, units);
    let table = format!("[[deck]]\nname = \"sat\"\nfile = \"sat.op2\"\n{units}");
    for tape in Tape::each() {
        let bytes = geometry(tape);
        let model = read_with(&[("sat.op2", &bytes)], &table).unwrap_or_else(|error| panic!("{error}"));
        // cosines of places in the cylinder agree to rounding
        assert_same(&model, &deck, 1e-10);
        let notes: Vec<String> =
            deck.file_notes.iter().map(|note| note.replace("sat.bdf", "sat.op2")).collect();
        assert_eq!(model.file_notes, notes);
    }
}
