//! Panels: rectangles, and meshes of a surface.

use std::f64::consts::FRAC_PI_2;

use insta::assert_snapshot;
use quasirigid::elements::{Assembly, Layer, Panel, Part, PartKind};
use quasirigid_io::model::{Model, ModelError};

use super::{ALUMINIUM, CARRIER, only_part, read, refusal, written};

const LAYERS: &str = "layers = [{ material = \"aluminium\", thickness = \"2 mm\" }]\n";
/// Six nodes and two cells, the second a triangle; the sets are of a node, and of a cell.
const PLATES: &str = "*NODE\n11, 0, 0, 0\n12, 20, 0, 0\n13, 20, 10, 0\n14, 0, 10, 1\n15, 30, 5, 0\n\
                      *ELEMENT, TYPE=S4, ELSET=WING\n1, 11, 12, 13, 14\n*ELEMENT, TYPE=S3, ELSET=NOSE\n2, 12, 15, 13\n\
                      *NSET, NSET=ROOT\n11, 14\n";

/// A panel with these lines, which start in line 11.
fn model(lines: &str) -> String {
    format!("{CARRIER}{ALUMINIUM}[[panel]]\nname = \"wing\"\n{lines}")
}

fn panel(part: &Part) -> &Panel {
    let PartKind::Panel(panel) = &part.kind else { panic!("a panel") };
    panel
}

fn rectangle(lines: &str) -> Assembly {
    let sides = "rectangle = { sides = [[\"300 cm\", 0, 0], [0.5, 2, 0]], cells = [3, 2] }\n";
    read(&model(&format!("{sides}{LAYERS}{lines}"))).assembly
}

/// A panel from a file `plates.inp` beside the model.
fn from_file(plates: &str, lines: &str) -> Result<Model, ModelError> {
    let text = model(&format!("file = \"plates.inp\"\n{LAYERS}{lines}"));
    written(&[("plates.inp", plates.to_owned())], &text)
}

fn close(found: &[[f64; 3]], expected: &[[f64; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        // tolerance: some sums of products of numbers of size 5
        let off = (0..3).map(|axis| (found[axis] - expected[axis]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-14, "{found:?} {expected:?}");
    }
}

#[test]
fn a_rectangle_has_its_nodes_row_by_row_from_its_corner() {
    let assembly = rectangle("");
    let mesh = &panel(only_part(&assembly)).mesh;
    let row = |x: f64, y: f64| [[x, y, 0.0], [x + 1.0, y, 0.0], [x + 2.0, y, 0.0], [x + 3.0, y, 0.0]];
    close(&mesh.nodes, &[row(0.0, 0.0), row(0.25, 1.0), row(0.5, 2.0)].concat());
    assert_eq!(mesh.node_labels, (1..=12).collect::<Vec<_>>());
    let nodes: Vec<&[usize]> = mesh.cells.iter().map(|cell| &*cell.nodes).collect();
    assert_eq!(nodes[..2], [[0, 1, 5, 4], [1, 2, 6, 5]]);
    assert_eq!((nodes.len(), nodes[5], mesh.cells[5].label), (6, &[6, 7, 11, 10][..], 6));
    assert_eq!(mesh.check(), Ok(()));
}

/// Sets follow from the places of the nodes, not from the order in which they are made.
#[test]
fn edges_and_corners_of_a_rectangle_have_names() {
    let held = |name: &str| {
        let assembly = rectangle(&format!("attach = {name}\n"));
        let part = only_part(&assembly);
        part.attached.iter().map(|node| panel(part).mesh.nodes[*node]).collect::<Vec<_>>()
    };
    close(&held("\"left\""), &[[0.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.5, 2.0, 0.0]]);
    close(&held("\"right\""), &[[3.0, 0.0, 0.0], [3.25, 1.0, 0.0], [3.5, 2.0, 0.0]]);
    close(&held("\"bottom\""), &[0.0, 1.0, 2.0, 3.0].map(|x| [x, 0.0, 0.0]));
    close(&held("\"top\""), &[0.5, 1.5, 2.5, 3.5].map(|x| [x, 2.0, 0.0]));
    let corners = [
        ("left bottom", 0.0, 0.0),
        ("right bottom", 3.0, 0.0),
        ("left top", 0.5, 2.0),
        ("right top", 3.5, 2.0),
    ];
    for (name, x, y) in corners {
        close(&held(&format!("\"{name}\"")), &[[x, y, 0.0]]);
    }
    close(
        &held("[7, \"left bottom\", \"left\", 1]"),
        &[[0.0, 0.0, 0.0], [0.25, 1.0, 0.0], [2.25, 1.0, 0.0], [0.5, 2.0, 0.0]],
    );
}

/// A quarter turn about x takes y to z; the reference direction follows.
#[test]
fn a_panel_is_placed_and_its_layers_stand_in_order() {
    let turned = "position = [\"1 m\", 2, 3]\nattitude = [0.7071067811865476, 0.7071067811865476, 0, 0]\n";
    let layers = "layers = [{ material = \"aluminium\", thickness = \"2 mm\", angle = \"90 deg\" }, \
                  { material = \"aluminium\", thickness = 0.001 }]\noffset = \"-5 mm\"\n";
    let sides = "rectangle = { sides = [[0, 2, 0], [0.5, 0, 0]], cells = [1, 1] }\n";
    let assembly = read(&model(&format!("{sides}{turned}{layers}attach = \"left\"\n"))).assembly;
    let panel = panel(only_part(&assembly));
    close(&panel.mesh.nodes, &[[1.0, 2.0, 3.0], [1.0, 2.0, 5.0], [1.5, 2.0, 3.0], [1.5, 2.0, 5.0]]);
    close(&[panel.reference], &[[0.0, 0.0, 2.0]]);
    assert_eq!(panel.offset, -0.005);
    let layers: Vec<[f64; 2]> =
        panel.layers.iter().map(|Layer { thickness, angle, .. }| [*thickness, *angle]).collect();
    assert_eq!(layers, [[0.002, FRAC_PI_2], [0.001, 0.0]]);
    assert_eq!(assembly.check(), []);
    let mass = assembly.body().expect("a body").invariants().mass;
    assert!((mass / (40.0 + 2700.0 * 0.003) - 1.0).abs() < 1e-12, "{mass}"); // an area of 1 m²
    let chosen = rectangle("reference = [0, 3, 0]\n");
    assert_eq!(self::panel(only_part(&chosen)).reference, [0.0, 3.0, 0.0]);
}

#[test]
fn a_panel_is_read_from_a_mesh_in_its_unit() {
    let model =
        from_file(PLATES, "unit = \"cm\"\nposition = [0, 0, 1]\nattach = [\"ROOT\", 12]\n").expect("a model");
    let part = only_part(&model.assembly);
    assert_eq!(part.attached, [0, 1, 3]);
    let mesh = &panel(part).mesh;
    close(
        &mesh.nodes,
        &[[0.0, 0.0, 1.0], [0.2, 0.0, 1.0], [0.2, 0.1, 1.0], [0.0, 0.1, 1.01], [0.3, 0.05, 1.0]],
    );
    close(&[panel(part).reference], &[[0.2, 0.0, 0.0]]);
    assert_eq!(model.assembly.check(), []);
    // a set of cells stands for their nodes
    let nose = from_file(PLATES, "attach = \"NOSE\"\n").expect("a model");
    assert_eq!(only_part(&nose.assembly).attached, [1, 2, 4]);
}

#[test]
fn a_wrong_panel_is_refused() {
    let refused = |lines: &str| refusal(&model(lines));
    let sides = "rectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [8, 4] }\n";
    assert_snapshot!(refused("layer = []\n"), @r#"
    model.toml:9:1: [[panel]] has no `file`
      add a line such as: rectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [8, 4] }, or file = "wing.msh"
    model.toml:11:1: unknown key "layer" in [[panel]]
      did you mean `layers`? the keys are name, file, unit, rectangle, position, attitude, layers, reference, offset, masses, attach, rayleigh
    "#);
    assert_snapshot!(refused("rectangle = [2, 1]\nlayers = 3\n"), @"
    model.toml:11:13: `rectangle`: found an array of 2 values, expected a table
      write { sides = [[2, 0, 0], [0, 1, 0]], cells = [8, 4] }
    model.toml:12:10: `layers`: found an integer, expected an array of layers
      write an array of layers
    ");
    assert_snapshot!(refused(&format!("rectangle = {{ sides = [[2, 0, 0]], cells = [8, 0], cell = 1 }}\n{LAYERS}")), @r#"
    model.toml:11:23: `sides`: found an array of 1 value, expected an array of 2 sides
      write 2 sides in brackets, with commas between them
    model.toml:11:48: `cells` is 0, but must be an integer from 1 to 1000
      write an integer from 1 to 1000
    model.toml:11:52: unknown key "cell" in `rectangle`
      did you mean `cells`? the keys are sides, cells
    "#);
    assert_snapshot!(refused(&format!("rectangle = {{ sides = [[2, 1, 0], [4, 2, 0]], cells = [8, 2] }}\n{LAYERS}")), @"
    model.toml:11:23: the sides are parallel, or one has no length
      write two sides at an angle, such as sides = [[2, 0, 0], [0, 1, 0]]
    ");
    assert_snapshot!(refused(&format!("{sides}layers = [{{ material = \"steel\", thickness = 0 }}, 3, {{ angle = \"3 m\" }}]\n")), @r#"
    model.toml:12:24: there is no material "steel"
      there are aluminium
    model.toml:12:45: `thickness` is 0 m, but must be positive
      write a number in m, or a text with its unit such as "22 in"
    model.toml:12:50: `layers`: found an integer, expected a table
      write { material = "aluminium", thickness = "2 mm" }
    model.toml:12:53: the layer has no `material`
      add a line such as: material = "aluminium"
    model.toml:12:53: the layer has no `thickness`
      add a line such as: thickness = "2 mm"
    model.toml:12:63: `angle`: "3 m" is a length, but an angle is needed
      write for example "30 deg", or a plain number in rad
    "#);
    assert_snapshot!(refused(&format!("{sides}{LAYERS}attach = [\"lift\", 46, 45]\n")), @r#"
    model.toml:13:11: this part has no node or set "lift"
      did you mean "left"? there are bottom, left, left bottom, left top, right, right bottom, right top, top
    "#);
    assert_snapshot!(refused(&format!("{sides}{LAYERS}attitude = [1, 1, 0, 0]\n")), @"
    model.toml:13:12: `attitude` has the norm 1.4142135623730951, but an attitude is a unit quaternion
      write four numbers, scalar first, whose squares add up to 1
    ");
}

#[test]
fn what_mechanics_says_of_a_panel_is_located() {
    let verdict = |lines: &str| super::verdict(&model(lines));
    let sides = "rectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [2, 1] }\nattach = \"left\"\n";
    assert_snapshot!(verdict(&format!("{sides}layers = []\n")), @r#"
    model.toml:13:10: `layers` of panel "wing": this has no mass
      write a layer: { material = "aluminium", thickness = "2 mm" }
    "#);
    assert_snapshot!(verdict(&format!("{sides}{LAYERS}reference = [0, 0, 1]\n")), @r#"model.toml:14:13: `reference` of panel "wing": cell 1: only 0 of the reference direction is in the plane of the element; choose one along the surface"#);
    assert_snapshot!(verdict(&format!("{sides}{LAYERS}reference = [0, 0, 0]\n")), @r#"
    model.toml:14:13: `reference` of panel "wing": a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
    let of_file = |plates: &str| {
        let model = from_file(plates, "attach = \"ROOT\"\n").expect("a model");
        super::located(&model.diagnose_all(&model.assembly.check()))
    };
    assert_snapshot!(of_file(&PLATES.replace("1, 11, 12, 13, 14", "1, 11, 13, 12, 14")), @r#"model.toml:11:8: `file` of panel "wing": cell 1 (quadrilateral of 4 nodes) is flat near (2.0000e1, 1.0000e1, 0.0000e0): 0.0e0 times as thick as it is long; move its nodes apart or leave it out"#);
    let twin =
        PLATES.replace("15, 30, 5, 0", "15, 30, 5, 0\n16, 20, 10, 0").replace("12, 15, 13", "12, 15, 16");
    assert_snapshot!(of_file(&twin), @r#"
    model.toml:11:8: `file` of panel "wing": nodes 13 and 16 are at the same place; merge them unless the parts may move apart
      cells hang together by the nodes they share; for parts that turn, write two tables and a [[connection]]
    "#);
    let beams = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n*ELEMENT, TYPE=B31, ELSET=ROOT\n1, 1, 2\n";
    assert_snapshot!(of_file(beams), @r#"
    model.toml:11:8: `file` of panel "wing": the mesh has no triangles or quadrilaterals
      a [[solid]] is made of cells of its volume, a [[panel]] of those of a surface
    "#);
    let curved = "*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 0, 2, 0\n4, 1, 0, 0\n5, 1, 1, 0\n6, 0, 1, 0\n\
                  *ELEMENT, TYPE=STRI65, ELSET=ROOT\n1, 1, 2, 3, 4, 5, 6\n";
    assert_snapshot!(of_file(curved), @r#"model.toml:11:8: `file` of panel "wing": cell 1: a shell is a triangle of 3 or a quadrilateral of 4 nodes, not a triangle of 6 nodes; refine or split the cell"#);
}
