//! Decks of Abaqus and CalculiX as models: the same bodies as decks of NASTRAN, as tables of this file and as formulas describe.

use quasirigid::elements::{Coupling, PartKind};
use quasirigid::reduction;
use quasirigid_io::model::Model;

use super::same::assert_same;
use super::{only_part, written};

fn deck(name: &str, text: &str, lines: &str) -> Model {
    let table = format!("[[deck]]\nname = \"sat\"\nfile = \"{name}\"\n{lines}");
    written(&[(name, text.to_owned())], &table).unwrap_or_else(|error| panic!("{error}"))
}

fn frequencies(model: &Model) -> Vec<f64> {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    reduction::frequencies(&body).expect("frequencies")
}

const MODES: &str = "[reduction]\nmodes = 8\n";
const MILLIMETRES: &str = "length_unit = \"mm\"\nmass_unit = \"t\"\n";

/// A brick, a plate on it, a mast of beams that a coupling joins to the plate, rods, a body with products of inertia on top.
#[test]
fn a_mixed_deck_is_that_of_nastran() {
    let bulk = "CEND\nBEGIN BULK\n\
        GRID,1,,0.,0.,0.\nGRID,2,,1000.,0.,0.\nGRID,3,,1000.,800.,0.\nGRID,4,,0.,800.,0.\n\
        GRID,5,,0.,0.,500.\nGRID,6,,1000.,0.,500.\nGRID,7,,1000.,800.,500.\nGRID,8,,0.,800.,500.\n\
        GRID,9,,500.,400.,1500.\nGRID,10,,500.,400.,900.\nGRID,11,,-300.,-200.,900.\n\
        CHEXA,1,10,1,2,3,4,5,6,+\n+,7,8\nPSOLID,10,1\nCQUAD4,2,20,5,6,7,8\nPSHELL,20,2,4.,2,,2\n\
        CBAR,3,30,10,9,1.,0.,0.\nPBAR,30,2,600.,45000.,20000.,46982.570130294\n\
        RBE2,4,10,123456,5,6,7,8\nCROD,5,50,9,11\nPROD,50,2,80.\nCROD,6,50,5,11\nCROD,7,50,6,11\nCROD,8,50,8,11\n\
        CONM2,60,9,,0.02,,,,,+\n+,500.,50.,600.,-40.,30.,700.\n\
        MAT1,1,70000.,,.3,2.7-9\nMAT1,2,210000.,,.3,7.8-9\nENDDATA\n";
    let flat = "*NODE\n1,0,0,0\n2,1000,0,0\n3,1000,800,0\n4,0,800,0\n\
        5,0,0,500\n6,1000,0,500\n7,1000,800,500\n8,0,800,500\n9,500,400,1500\n10,500,400,900\n11,-300,-200,900\n\
        *ELEMENT, TYPE=C3D8, ELSET=BRICK\n1,1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=S4, ELSET=LID\n2,5,6,7,8\n\
        *ELEMENT, TYPE=B33, ELSET=BEAM\n3,10,9\n*ELEMENT, TYPE=T3D2, ELSET=STRUTS\n5,9,11\n6,5,11\n7,6,11\n8,8,11\n\
        *ELEMENT, TYPE=MASS, ELSET=HEAD\n60,9\n*ELEMENT, TYPE=ROTARYI, ELSET=TURN\n61,9\n*MASS, ELSET=HEAD\n0.02\n\
        *ROTARY INERTIA, ELSET=TURN\n500.,600.,700.,-50.,40.,-30.\n\
        *MATERIAL, NAME=Alu\n*ELASTIC\n70000.,.3\n*DENSITY\n2.7e-9\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210000.,.3\n*DENSITY\n7.8D-9\n\
        *SOLID SECTION, ELSET=BRICK, MATERIAL=ALU\n*SHELL SECTION, ELSET=LID, MATERIAL=STEEL\n4.,5\n\
        *SOLID SECTION, ELSET=STRUTS, MATERIAL=STEEL\n80.\n\
        *BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n30.,20.\n1.,0.,0.\n\
        *SURFACE, NAME=TOP\nLID, SPOS\n*COUPLING, CONSTRAINT NAME=C, REF NODE=10, SURFACE=TOP\n*KINEMATIC\n\
        *BOUNDARY\n1,1,3\n*STEP\n*FREQUENCY\n5\n*CLOAD\n9,1,1.\n*END STEP\n";
    let lines = format!("{MILLIMETRES}{MODES}");
    let (ours, theirs) = (deck("sat.inp", flat, &lines), deck("sat.bdf", bulk, &lines));
    assert_eq!(ours.file_notes, ["sat.inp: left out: 1 *BOUNDARY, 1 *CLOAD"]);
    assert_same(&ours, &theirs, 1e-7);
}

/// Parts in their places, one of them turned with the axis of its beam and its products of inertia, are the deck without parts.
#[test]
fn parts_stand_where_their_instances_are() {
    let materials = "*MATERIAL, NAME=ALU\n*ELASTIC\n70000.,.3\n*DENSITY\n2.7e-9\n";
    let flat = "*NODE\n1,0,0,0\n2,1000,0,0\n3,1000,800,0\n4,0,800,0\n5,0,0,500\n6,1000,0,500\n7,1000,800,500\n8,0,800,500\n\
        9,500,400,1500\n10,500,400,900\n*ELEMENT, TYPE=C3D8, ELSET=BRICK\n1,1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=B31, ELSET=BEAM\n3,10,9\n\
        *ELEMENT, TYPE=MASS, ELSET=HEAD\n60,9\n*ELEMENT, TYPE=ROTARYI, ELSET=TURN\n61,9\n*MASS, ELSET=HEAD\n0.02\n\
        *ROTARY INERTIA, ELSET=TURN\n500.,600.,700.,-50.,40.,-30.\n*SOLID SECTION, ELSET=BRICK, MATERIAL=ALU\n\
        *BEAM SECTION, ELSET=BEAM, MATERIAL=ALU, SECTION=BOX\n30.,20.,2.,2.,2.,2.\n1.,0.,0.\n\
        *SURFACE, NAME=TOP\nBRICK, S2\n*COUPLING, CONSTRAINT NAME=C, REF NODE=10, SURFACE=TOP\n*DISTRIBUTING\n1,6\n";
    let parts = "*PART, NAME=BOX\n*NODE\n1,0,0,0\n2,1000,0,0\n3,1000,800,0\n4,0,800,0\n\
        5,0,0,500\n6,1000,0,500\n7,1000,800,500\n8,0,800,500\n*ELEMENT, TYPE=C3D8, ELSET=BRICK\n1,1,2,3,4,5,6,7,8\n\
        *SOLID SECTION, ELSET=BRICK, MATERIAL=ALU\n*SURFACE, NAME=TOP\nBRICK, S2\n*END PART\n\
        *PART, NAME=MAST\n*NODE, NSET=FOOT\n1,300,-700,0\n*NODE\n2,300,-700,600\n*ELEMENT, TYPE=B31, ELSET=BEAM\n1,1,2\n\
        *BEAM SECTION, ELSET=BEAM, MATERIAL=ALU, SECTION=BOX\n30.,20.,2.,2.,2.,2.\n0.,-1.,0.\n\
        *ELEMENT, TYPE=MASS, ELSET=HEAD\n2,2\n*ELEMENT, TYPE=ROTARYI, ELSET=TURN\n3,2\n*MASS, ELSET=HEAD\n0.02\n\
        *ROTARY INERTIA, ELSET=TURN\n600.,500.,700.,50.,-30.,-40.\n*END PART\n*ASSEMBLY, NAME=A\n\
        *INSTANCE, NAME=BOX-1, PART=BOX\n*END INSTANCE\n*INSTANCE, NAME=MAST-1, PART=MAST\n100.,200.,900.\n\
        0.,0.,0.,0.,0.,1.,90.\n*END INSTANCE\n\
        *COUPLING, CONSTRAINT NAME=C, REF NODE=MAST-1.FOOT, SURFACE=BOX-1.TOP\n*DISTRIBUTING\n1,6\n*END ASSEMBLY\n";
    let lines = format!("{MILLIMETRES}{MODES}");
    let of = |text: &str| deck("sat.inp", &format!("{text}{materials}"), &lines);
    assert_same(&of(parts), &of(flat), 1e-8);
}

/// Four equal masses that springs join into a regular tetrahedron: ω² is k/m twice, 2k/m thrice and 4k/m once.
#[test]
fn springs_along_their_lines_make_a_tetrahedron() {
    let text = "*NODE, NSET=ALL\n1,1,1,1\n2,1,-1,-1\n3,-1,1,-1\n4,-1,-1,1\n\
        *ELEMENT, TYPE=MASS, ELSET=M\n1,1\n2,2\n3,3\n4,4\n*MASS, ELSET=M\n2.\n\
        *ELEMENT, TYPE=SPRINGA, ELSET=S\n11,1,2\n12,1,3\n13,1,4\n14,2,3\n15,2,4\n16,3,4\n*SPRING, ELSET=S\n\n50.\n";
    let found = frequencies(&deck("sat.inp", text, MODES));
    let unit: f64 = 50.0 / 2.0;
    let expected = [unit, unit, 2.0 * unit, 2.0 * unit, 2.0 * unit, 4.0 * unit];
    assert_eq!(found.len(), 6, "{found:?}");
    for (found, square) in found.iter().zip(expected) {
        assert!((found / square.sqrt() - 1.0).abs() < 1e-8, "{found} and not {}", square.sqrt());
    }
}

/// Constants of an orthotropic material in two forms, in turned axes, and the same in a table of this file.
#[test]
fn orthotropic_constants_stand_in_their_orientation() {
    let mesh = "*NODE\n1,0,0,0\n2,2,0,0\n3,2,1,0\n4,0,1,0\n5,0,0,3\n6,2,0,3\n7,2,1,3\n8,0,1,3\n\
        *ELEMENT, TYPE=C3D8, ELSET=E\n1,1,2,3,4,5,6,7,8\n";
    let rest = "*DENSITY\n900.\n*ORIENTATION, NAME=O\n0.6,0.8,0.,-1.,0.,0.\n3,90.\n\
        *SOLID SECTION, ELSET=E, MATERIAL=WOOD, ORIENTATION=O\n";
    let constants = "*MATERIAL, NAME=WOOD\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n\
        11.e9,0.9e9,0.5e9,.4,.35,.3,0.7e9,0.6e9\n0.05e9\n";
    let ours = deck("sat.inp", &format!("{mesh}{constants}{rest}"), MODES);
    // axis 1 of the orientation is (0.6, 0.8, 0), turned by a right angle about axis 3: (−0.8, 0.6, 0)
    let table = "[material.wood]\ndensity = 900\nyoung = [11e9, 0.9e9, 0.5e9]\npoisson = [0.4, 0.35, 0.3]\nshear = [0.7e9, 0.6e9, 0.05e9]\n\
        [[solid]]\nname = \"sat\"\nfile = \"a.inp\"\nmaterial = \"wood\"\naxes = [[-0.8, 0.6, 0], [-0.6, -0.8, 0]]\n";
    let theirs = written(&[("a.inp", mesh.to_owned())], &format!("{table}{MODES}"));
    let theirs = theirs.unwrap_or_else(|error| panic!("{error}"));
    assert_same(&ours, &theirs, 1e-8);
    // the stiffness of the same constants, inverted here from the compliance
    let s = [
        [1.0 / 11e9, -0.4 / 11e9, -0.35 / 11e9],
        [-0.4 / 11e9, 1.0 / 0.9e9, -0.3 / 0.9e9],
        [-0.35 / 11e9, -0.3 / 0.9e9, 1.0 / 0.5e9],
    ];
    let minor = |i: usize, j: usize| {
        let [a, b, c, d] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
        s[a][c] * s[b][d] - s[a][d] * s[b][c]
    };
    let determinant: f64 = (0..3).map(|j| s[0][j] * minor(0, j)).sum();
    let d = |i: usize, j: usize| minor(j, i) / determinant;
    let stiffness = format!(
        "*MATERIAL, NAME=WOOD\n*ELASTIC, TYPE=ORTHO\n{:e},{:e},{:e},{:e},{:e},{:e},0.7e9,0.6e9\n0.05e9\n",
        d(0, 0),
        d(0, 1),
        d(1, 1),
        d(0, 2),
        d(1, 2),
        d(2, 2)
    );
    assert_same(&deck("sat.inp", &format!("{mesh}{stiffness}{rest}"), MODES), &theirs, 1e-8);
}

/// A fine block tied to a coarse one floats as one body: six motions without strain, and the mass of both.
#[test]
fn tied_surfaces_strain_nothing_as_a_whole() {
    let text = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n\
        11,.2,.3,1\n12,.7,.3,1\n13,.7,.9,1\n14,.2,.9,1\n15,.2,.3,2\n16,.7,.3,2\n17,.7,.9,2\n18,.2,.9,2\n\
        *ELEMENT, TYPE=C3D8, ELSET=LOW\n1,1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=C3D8, ELSET=HIGH\n2,11,12,13,14,15,16,17,18\n\
        *ELSET, ELSET=BOTH\nLOW,HIGH\n*MATERIAL, NAME=EL\n*ELASTIC\n7e10,.3\n*DENSITY\n2700.\n*SOLID SECTION, ELSET=BOTH, MATERIAL=EL\n\
        *SURFACE, NAME=MASTER\nLOW, S2\n*SURFACE, NAME=SLAVE\nHIGH, S1\n*TIE, NAME=T\nSLAVE, MASTER\n";
    let model = deck("sat.inp", text, MODES);
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let mass = 2700.0 * (1.0 + 0.5 * 0.6);
    assert!((body.invariants().mass / mass - 1.0).abs() < 1e-12);
    let PartKind::Mixed(mixed) = &only_part(&model.assembly).kind else { panic!("a deck") };
    assert_eq!(mixed.couplings.len(), 4);
    assert!(mixed.couplings.iter().all(|coupling| matches!(coupling, Coupling::Linear { .. })));
    // a block on springs would be slower by orders of magnitude than one that is tied in all directions
    let found = frequencies(&model);
    assert!(found[0] > 1e3, "{found:?}");
    let apart = deck_refused(&text.replace("SLAVE, MASTER\n", ""));
    assert!(apart.contains("mechanism"), "{apart}");
}

fn deck_refused(text: &str) -> String {
    let model = deck("sat.inp", text, "");
    match model.assembly.body() {
        Ok(_) => String::new(),
        Err(error) => model.diagnose(&error).to_string(),
    }
}

/// What cannot be right is refused with file and line.
#[test]
fn decks_without_material_or_set_are_refused() {
    let text = "*NODE\n1,0\n2,1\n3,0,1\n4,0,0,1\n*ELEMENT, TYPE=C3D4, ELSET=E\n1,1,2,3,4\n\
        *MATERIAL, NAME=RUBBER\n*HYPERELASTIC\n1,2\n*SOLID SECTION, ELSET=E, MATERIAL=RUBBER\n";
    let refused = |text: &str| {
        let table = "[[deck]]\nname = \"sat\"\nfile = \"sat.inp\"\n";
        super::located(&written(&[("sat.inp", text.to_owned())], table).expect_err("a refusal"))
    };
    insta::assert_snapshot!(refused(text), @r#"
    model.toml:3:8: `file`: sat.inp:11: the material "RUBBER" has no *ELASTIC that is read; give ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC or LAMINA constants
      it is looked for beside the model
    "#);
    insta::assert_snapshot!(refused(&text.replace("ELSET=E, MAT", "ELSET=F, MAT")), @r#"
    model.toml:3:8: `file`: sat.inp:11: no element set "F" is defined; is the name right, and is no included file missing?
      it is looked for beside the model
    "#);
}
