//! Parts that cannot be attached, and joints of solids, whose nodes have no rotations.

use std::fs;

use insta::assert_snapshot;
use quasirigid_io::model::Model;
use tempfile::TempDir;

use super::{ALUMINIUM, BOOM, CARRIER, TUBE, located, verdict};

/// A boom with these further lines, which start in line 19, on a carrier.
fn boom(lines: &str) -> String {
    verdict(&format!("{CARRIER}{ALUMINIUM}{TUBE}{BOOM}{lines}"))
}

#[test]
fn a_part_without_a_carrier_is_attached_to_nothing() {
    assert_snapshot!(verdict(&format!("{ALUMINIUM}{TUBE}{BOOM}attach = \"root\"\n")), @r#"
    model.toml:15:10: `attach` of beam "boom": this body has no carrier
      add a [carrier], or leave this out: a body without one hangs on nothing
    "#);
    let connection = "[[connection]]\nfrom = \"carrier\"\nto = { part = \"boom\", node = \"root\" }\n";
    assert_snapshot!(verdict(&format!("{ALUMINIUM}{TUBE}{BOOM}{connection}")), @"
    model.toml:16:8: `from` of connection 1: this body has no carrier
      add a [carrier], or leave this out: a body without one hangs on nothing
    ");
    let support = "[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n";
    assert_snapshot!(verdict(&format!("{ALUMINIUM}{TUBE}{BOOM}{support}")), @"
    model.toml:17:9: `point` of the support: a body that is elastic throughout moves freely; no point of it can be held
      leave [support] out
    ");
}

#[test]
fn a_beam_that_cannot_be_is_refused() {
    assert_snapshot!(boom("attach = \"root\"\nup = [1, 0, 0]\n"), @r#"model.toml:20:6: `up` of beam "boom": the direction (1, 0, 0) of a beam's section is not across the beam, which runs along (1, 0, 0); give one that is"#);
    let short = BOOM.replace("[3, 0, 0]", "[1, 0, 0]");
    assert_snapshot!(verdict(&format!("{CARRIER}{ALUMINIUM}{TUBE}{short}attach = \"root\"\n")), @r#"model.toml:16:9: `lines` of beam "boom": the ends (1, 0, 0) and (1, 0, 0) of a beam are not a finite distance apart"#);
    assert_snapshot!(boom("attach = \"root\"\nmasses = [{ node = \"tip\", mass = 1, inertia = [1, 1, 3] }]\n"), @r#"
    model.toml:20:10: `masses` of beam "boom": no body has the principal moments of inertia [1.0, 1.0, 3.0] kg m^2: none may be negative, or exceed the sum of the other two
      check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass
    "#);
}

#[test]
fn a_node_that_no_beam_holds_is_named() {
    let spare = BOOM.replace("tip =", "spare = [0, 1, 0], tip =");
    assert_snapshot!(verdict(&format!("{CARRIER}{ALUMINIUM}{TUBE}{spare}attach = \"root\"\n")), @r#"
    model.toml:19:10: a mechanism: no spring resists some motion of "boom" spare x, "boom" spare y, "boom" spare z, "boom" spare about x, "boom" spare about y, "boom" spare about z
      attach or connect more of its nodes, three or more of a solid; or add a spring that resists it
    "#);
}

#[test]
fn parts_have_names_of_their_own() {
    assert_snapshot!(boom(&format!("attach = \"root\"\n{BOOM}attach = \"root\"\n")), @r#"
    model.toml:21:8: the name "boom" is used twice; it stands first in line 14
      give each element its own name
    "#);
    assert_snapshot!(verdict(&format!("{CARRIER}{ALUMINIUM}{TUBE}{}", BOOM.replace("\"boom\"", "\"carrier\""))), @r#"
    model.toml:14:8: the name "carrier" is that of the carrier
      choose another name
    "#);
}

/// A block beside the tip of the boom, of one hexahedron, with these lines, which start in line 28.
fn block(lines: &str) -> String {
    let mesh = "*NODE\n1, 3, 0, 0\n2, 4, 0, 0\n3, 4, 1, 0\n4, 3, 1, 0\n5, 3, 0, 1\n6, 4, 0, 1\n7, 4, 1, 1\n8, 3, 1, 1\n\
                *ELEMENT, TYPE=C3D8, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*NSET, NSET=FACE\n1, 4, 8, 5\n";
    let solid = "[[solid]]\nname = \"block\"\nfile = \"block.inp\"\nmaterial = \"aluminium\"\n";
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("block.inp"), mesh).expect("a file");
    let text = format!("{CARRIER}{ALUMINIUM}{TUBE}{BOOM}attach = \"root\"\n{solid}[[connection]]\n{lines}");
    fs::write(folder.path().join("model.toml"), text).expect("a file");
    let model = Model::read(&folder.path().join("model.toml")).unwrap_or_else(|error| panic!("{error}"));
    match model.assembly.body() {
        Ok(_) => "a body".to_owned(),
        Err(error) => located(&model.diagnose(&error)),
    }
}

#[test]
fn a_node_of_a_solid_carries_no_hinge_and_no_arm() {
    let tip = "from = { part = \"boom\", node = \"tip\" }\n";
    assert_snapshot!(block(&format!("{tip}to = {{ part = \"block\", node = 1 }}\nhinge = [0, 0, 1]\nstiffness = 1\n")), @r#"model.toml:26:6: `to` of connection 1: "block" node 1 has no rotations, so no moment acts there; name a face, or three nodes or more"#);
    let other = BOOM
        .replace("\"boom\"", "\"other\"")
        .replace("[1, 0, 0]", "[5, 0, 0]")
        .replace("[3, 0, 0]", "[4.5, 0, 0]");
    let on_it = format!(
        "{tip}to = {{ part = \"block\", set = \"FACE\" }}\n{other}[[connection]]\n\
         from = {{ part = \"block\", node = 2 }}\nto = {{ part = \"other\", node = \"tip\" }}\n"
    );
    assert_snapshot!(block(&on_it), @r#"model.toml:35:6: `to` of connection 2: "block" node 2 has no rotations to carry "other" tip, 0.5 m away; join nodes at the same place, or a whole face"#);
    assert_eq!(
        block(&format!(
            "{tip}to = {{ part = \"block\", set = \"FACE\" }}\nhinge = [0, 0, 1]\nstiffness = 1\n"
        )),
        "a body"
    );
}
