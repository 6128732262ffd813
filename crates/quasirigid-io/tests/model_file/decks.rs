//! Decks of NASTRAN as models: the same body as tables of this file describe, and sums by hand.
#![allow(non_snake_case)]

use quasirigid::elements::{Coupling, PartKind};
use quasirigid::reduction;
use quasirigid_io::model::Model;

use super::same::assert_same;
use super::{only_part, written};

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
