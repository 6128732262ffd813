//! Connections that cannot be, and places on parts that there are not.

use insta::assert_snapshot;

use super::{ALUMINIUM, BOOM, CARRIER, TUBE};

const ARRAY: &str = "[[panel]]\nname = \"array\"\nrectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [2, 1] }\n\
                     position = [3, 0, 0]\nlayers = [{ material = \"aluminium\", thickness = \"2 mm\" }]\n";
const TIP: &str = "from = { part = \"boom\", node = \"tip\" }\n";
const EDGE: &str = "to = { part = \"array\", set = \"left\" }\n";

/// Refusal of these lines after a boom on the carrier and a panel; they start in line 25.
fn refused(lines: &str) -> String {
    super::verdict(&format!("{CARRIER}{ALUMINIUM}{TUBE}{BOOM}attach = \"root\"\n{ARRAY}{lines}"))
}

/// Refusal of a connection with these lines, which start in line 26.
fn connection(lines: &str) -> String {
    refused(&format!("[[connection]]\n{lines}"))
}

#[test]
fn a_connection_with_a_key_wrong_or_missing_is_refused() {
    assert_snapshot!(connection("form = \"carrier\"\n"), @r#"
    model.toml:25:1: [[connection]] has no `to`
      add a line such as: to = { part = "boom", node = "root" }
    model.toml:26:1: unknown key "form" in [[connection]]
      did you mean `from`? the keys are from, to, hinge, ball, stiffness, damping, rheology
    "#);
    assert_snapshot!(connection(&format!("{TIP}{EDGE}ball = 1\n")), @"
    model.toml:28:8: `ball`: found an integer, expected true or false
      write true or false, without quotes
    ");
    assert_snapshot!(connection(&format!("{TIP}{EDGE}ball = true\nhinge = [1, 0, 0]\n")), @"
    model.toml:29:9: a ball joint turns about every axis
      leave out one of `hinge` and `ball`
    ");
    assert_snapshot!(connection(&format!("{TIP}{EDGE}hinge = 3\nstiffness = -1\n")), @"
    model.toml:28:9: `hinge`: found an integer, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    ");
    assert_snapshot!(connection(&format!("{TIP}{EDGE}hinge = [0, 1, 0]\nstiffness = \"3 N/m\"\ndamping = [1, -1]\n")), @r#"
    model.toml:29:13: `stiffness`: "3 N/m" is a stiffness, but a rotational stiffness is needed
      write for example "0.565 N m/rad", or a plain number in N m/rad
    model.toml:30:15: `damping` is -1 N m s/rad, but must be zero or positive
      write zero or a positive value
    "#);
}

#[test]
fn a_place_that_is_none_on_a_part_is_refused() {
    let to = |to: &str| connection(&format!("{TIP}to = {to}\n"));
    assert_snapshot!(to("\"array\""), @r#"
    model.toml:27:6: `to`: found a text, expected the carrier, or nodes of a part
      write "carrier", { part = "boom", node = "root" } or { part = "array", set = "left" }
    "#);
    assert_snapshot!(to("{ part = \"aray\", set = \"left\" }"), @r#"
    model.toml:27:15: there is no part "aray" with nodes
      did you mean "array"? there are boom, array
    "#);
    assert_snapshot!(to("{ part = \"array\" }"), @r#"
    model.toml:27:6: a place on a part needs either a node or a set of them
      write { part = "boom", node = "tip" }
    "#);
    assert_snapshot!(to("{ part = \"array\", set = \"left\", node = 1 }"), @r#"
    model.toml:27:6: a place on a part needs either a node or a set of them
      write { part = "boom", node = "tip" }
    "#);
    assert_snapshot!(to("{ part = \"array\", node = \"left\" }"), @"
    model.toml:27:31: `node` names 2 nodes, but one is needed
      name one node, by its name or its number
    ");
    assert_snapshot!(to("{ part = \"array\", set = \"lift\", nod = 1 }"), @r#"
    model.toml:27:30: this part has no node or set "lift"
      did you mean "left"? there are bottom, left, left bottom, left top, right, right bottom, right top, top
    model.toml:27:38: unknown key "nod" in the place on a part
      did you mean `node`? the keys are part, node, set
    "#);
    assert_snapshot!(to("{ part = \"array\", node = 7 }"), @"
    model.toml:27:31: there is no node 7 in this part
      its 6 nodes are named by their numbers in the file
    ");
    assert_snapshot!(to("{ part = \"boom\", node = 1 }"), @"
    model.toml:27:30: there is no node 1 in this part
      its nodes are root, tip
    ");
    assert_snapshot!(to("{ part = \"boom\", set = [] }"), @"
    model.toml:27:6: `to` of connection 1: no nodes are named here
      name a node, or a set of nodes
    ");
}

#[test]
fn springs_and_forces_name_one_node() {
    let spring = |to: &str| refused(&format!("[[spring]]\nfrom = \"carrier\"\nto = {to}\nstiffness = 1\n"));
    assert_snapshot!(spring("\"boom\""), @r#"
    model.toml:27:6: "boom" has many nodes; a spring joins points, nodes of parts, places on appendages and the carrier
      write { part = "boom", node = ... }
    "#);
    assert_snapshot!(spring("{ part = \"array\", set = \"left\" }"), @"
    model.toml:27:6: 2 nodes are named here, but one is needed
      name one node
    ");
    assert_snapshot!(spring("{ part = \"mast\", node = \"tip\" }"), @r#"
    model.toml:27:15: there is no part "mast" with nodes
      there are boom, array
    "#);
    let force = "[[force]]\nkind = \"thrust\"\non = { part = \"boom\", node = \"tip\" }\nat = [0, 0, 1]\nforce = [0, 0, 1]\n";
    assert_snapshot!(refused(&format!("[[connection]]\n{TIP}{EDGE}{force}")), @r#"
    model.toml:31:6: `at` of force "force 1": a force on a point acts at the point itself
      leave it out, or write on = "carrier"
    "#);
}

#[test]
fn a_part_that_nothing_joins_to_the_carrier_is_refused() {
    assert_snapshot!(refused(""), @r#"
    model.toml:20:1: panel "array": nothing joins this part to the carrier; attach some of its nodes, or connect it
      write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part
    "#);
    // neither a spring nor a weld to a part that is not attached itself attaches the panel
    let spring = "[[spring]]\nfrom = \"carrier\"\nto = { part = \"array\", node = 1 }\nstiffness = 1\n";
    assert_snapshot!(refused(spring), @r#"
    model.toml:20:1: panel "array": nothing joins this part to the carrier; attach some of its nodes, or connect it
      write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part
    "#);
    let other = ARRAY.replace("\"array\"", "\"other\"").replace("[3,", "[5,");
    let weld = "[[connection]]\nfrom = { part = \"array\", set = \"right\" }\nto = { part = \"other\", set = \"left\" }\n";
    assert_snapshot!(refused(&format!("{other}{weld}")), @r#"
    model.toml:20:1: panel "array": nothing joins this part to the carrier; attach some of its nodes, or connect it
      write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part
    "#);
}

/// A chain of parts hangs on the carrier at its end, in whatever order the file lists its connections.
#[test]
fn parts_hang_on_the_carrier_through_others() {
    let other = ARRAY.replace("\"array\"", "\"other\"").replace("[3,", "[5,");
    let far = "[[connection]]\nfrom = { part = \"array\", set = \"right\" }\nto = { part = \"other\", set = \"left\" }\n";
    let near = format!("[[connection]]\n{TIP}{EDGE}");
    let text = format!("{CARRIER}{ALUMINIUM}{TUBE}{BOOM}attach = \"root\"\n{ARRAY}{other}{far}{near}");
    assert_eq!(super::read(&text).assembly.check(), []);
}

#[test]
fn a_node_is_held_once() {
    let weld = format!("[[connection]]\n{TIP}{EDGE}");
    let again = "[[connection]]\nfrom = \"carrier\"\nto = { part = \"array\", set = \"left\" }\n";
    assert_snapshot!(refused(&format!("{weld}{again}")), @r#"
    model.toml:30:6: `to` of connection 2: "array" node 1 is held already, by a connection or the carrier; a node can be held once
      leave out one of the two, or put a stiff spring in its place
    "#);
    let root = "[[connection]]\nfrom = \"carrier\"\nto = { part = \"boom\", node = \"root\" }\nhinge = [0, 0, 1]\nstiffness = 1\n";
    assert_snapshot!(refused(&format!("{weld}{root}")), @r#"
    model.toml:30:6: `to` of connection 2: "boom" root is held already, by a connection or the carrier; a node can be held once
      leave out one of the two, or put a stiff spring in its place
    "#);
}

#[test]
fn connections_in_a_circle_are_refused() {
    let one =
        "from = { part = \"boom\", node = \"tip\" }\nto = { part = \"array\", node = \"left bottom\" }\n";
    let back = "[[connection]]\nfrom = { part = \"array\", node = \"left bottom\" }\nto = { part = \"boom\", node = \"tip\" }\n";
    assert_snapshot!(connection(&format!("{one}{back}")), @r#"model.toml:19:10: beam "boom": the connections at "boom" tip run in a circle; replace one of them by a stiff spring"#);
    assert_snapshot!(connection(&format!("{TIP}to = {{ part = \"boom\", node = \"tip\" }}\n[[connection]]\n{TIP}{EDGE}")), @r#"model.toml:19:10: beam "boom": the connections at "boom" tip run in a circle; replace one of them by a stiff spring"#);
    assert_snapshot!(connection(&format!("from = \"carrier\"\nto = \"carrier\"\n[[connection]]\n{TIP}{EDGE}")), @"
    model.toml:27:6: `to` of connection 1: both ends are the same
      a connection joins a part to the carrier, or to another part
    ");
}

#[test]
fn a_hinge_has_values_for_its_axes() {
    let hinge = |lines: &str| connection(&format!("{TIP}{EDGE}hinge = {lines}"));
    assert_snapshot!(hinge("[0, 1, 0]\nstiffness = [1, 2]\n"), @"
    model.toml:29:13: `stiffness` of connection 1: 1 axis, but 2 values
      write one number for all axes, or one per axis
    ");
    assert_snapshot!(hinge("[0, 0, 0]\nstiffness = 1\n"), @"
    model.toml:28:9: `hinge` of connection 1: a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    ");
    assert_snapshot!(hinge("[[0, 1, 0], [1, 0, 0], [0, 0, 1], [1, 1, 1]]\nstiffness = 1\n"), @"
    model.toml:28:9: `hinge` of connection 1: a hinge has one, two or three axes, not 4
      write one to three axes, for example hinge = [[0, 1, 0], [0, 0, 1]]
    ");
}

/// Without a stiffness a hinge turns freely; the message names the hinge, not every coordinate that moves with it.
#[test]
fn a_hinge_without_stiffness_is_named() {
    assert_snapshot!(connection(&format!("{TIP}{EDGE}hinge = [0, 1, 0]\n")), @"
    model.toml:25:1: a mechanism: no spring resists some motion of connection 1 about its axis 1
      give it a `stiffness`, or leave this axis out
    ");
    assert_snapshot!(connection(&format!("{TIP}{EDGE}hinge = [[0, 1, 0], [1, 0, 0]]\nstiffness = [1, 0]\n")), @"
    model.toml:29:13: a mechanism: no spring resists some motion of connection 1 about its axis 2
      give it a `stiffness`, or leave this axis out
    ");
}

#[test]
fn sets_are_welded_node_by_node() {
    let other = ARRAY.replace("\"array\"", "\"other\"").replace("[3, 0, 0]", "[5, 0.1, 0]");
    let sets = "[[connection]]\nfrom = { part = \"array\", set = \"right\" }\nto = { part = \"other\", set = \"left\" }\n";
    assert_snapshot!(refused(&format!("{other}{sets}[[connection]]\n{TIP}{EDGE}")), @r#"
    model.toml:32:6: `to` of connection 1: "other" node 1 has no partner at its place on the other side; the nearest is 0.1 m away
      sets are joined node by node; name one node on one side to make the set of the other side rigid
    "#);
}
