//! Solids, from meshes beside the model.

use std::path::Path;

use insta::assert_snapshot;
use quasirigid::elements::{ElasticMaterial, Part, PartKind, Region, Solid};
use quasirigid_io::model::{Model, ModelError};

use super::{ALUMINIUM, CARRIER, located, only_part, written};

/// Two cubes side by side along x from (4, −½, 3), sets `left` and `right`; the face at their end is `tip_face`.
const BLOCK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/volume/model.toml");
const FOAM: &str = "[material.foam]\ndensity = 50\nyoung = \"30 MPa\"\npoisson = 0.1\n";
/// Two tetrahedra on a face, with a set for each.
const PAIR: &str = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 0, 0, -1\n\
                    *ELEMENT, TYPE=C3D4, ELSET=UPPER\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=LOWER\n2, 1, 3, 2, 5\n\
                    *NSET, NSET=FACE\n1, 2, 3\n";

/// A solid with these lines, which start in line 14.
fn model(lines: &str) -> String {
    format!("{CARRIER}{ALUMINIUM}{FOAM}[[solid]]\n{lines}")
}

fn block(lines: &str) -> Result<Model, ModelError> {
    Model::parse(Path::new(BLOCK), &model(&format!("file = \"block.inp\"\n{lines}")))
}

/// A solid from a mesh `pair.inp` beside the model; the lines start in line 15.
fn pair(mesh: &str, lines: &str) -> Result<Model, ModelError> {
    let text = model(&format!("file = \"pair.inp\"\n{lines}"));
    written(&[("pair.inp", mesh.to_owned())], &text)
}

fn solid(part: &Part) -> &Solid {
    let PartKind::Solid(solid) = &part.kind else { panic!("a solid") };
    solid
}

fn young(region: &Region) -> f64 {
    match &region.material {
        ElasticMaterial::Isotropic(material) => material.young,
        ElasticMaterial::Orthotropic(material) => material.young[0],
    }
}

#[test]
fn a_solid_is_read_from_its_mesh() {
    let model =
        block("material = \"aluminium\"\nunit = \"cm\"\nposition = [0, 0, 1]\nattach = \"tip_face\"\n");
    let model = model.unwrap_or_else(|error| panic!("{error}"));
    let part = only_part(&model.assembly);
    assert_eq!((part.name.as_str(), part.rayleigh), ("solid 1", [0.0; 2]));
    let Solid { mesh, regions } = solid(part);
    // node 9 of the file is at (6, −½, 4) cm
    assert_eq!((mesh.nodes[8], mesh.node_labels[8]), ([0.06, -0.005, 1.04], 9));
    assert_eq!(part.attached.len(), 13);
    assert!(part.attached.iter().all(|node| mesh.nodes[*node][0] == 0.06));
    let [Region { cells, axes, .. }] = &regions[..] else { panic!("one region") };
    assert_eq!((cells.len(), *axes), (48, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]));
    assert_eq!(model.assembly.check(), []);
    let mass = model.assembly.body().expect("a body").invariants().mass;
    assert!((mass / (40.0 + 2700.0 * 2e-6) - 1.0).abs() < 1e-12, "{mass}"); // two cubes of 1 cm
}

/// The cubes are 1 m³ each, so each adds its density, at its own centre.
#[test]
fn each_region_has_its_material() {
    let lines = "materials = { right = \"foam\", left = \"aluminium\" }\nattach = \"tip_face\"\n";
    let model = block(lines).unwrap_or_else(|error| panic!("{error}"));
    let Solid { mesh, regions } = solid(only_part(&model.assembly));
    for region in regions {
        let (left, volume) = (young(region) == 70e9, mesh.volume(&region.cells));
        assert!((volume - 1.0).abs() < 1e-12 && region.cells.len() == 24, "{volume}");
        let middle =
            |cell: usize| mesh.cells[cell].nodes.iter().map(|node| mesh.nodes[*node][0] - 5.0).sum::<f64>();
        assert!(region.cells.iter().all(|cell| (middle(*cell) < 0.0) == left));
    }
    let body = model.assembly.body().expect("a body");
    let expected = (40.0 * 0.0 + 2700.0 * 4.5 + 50.0 * 5.5) / 2790.0;
    assert!((body.center_of_mass()[0] / expected - 1.0).abs() < 1e-12, "{:?}", body.center_of_mass());
}

/// The part of the second direction across the first counts; the third completes a right-handed system.
#[test]
fn axes_of_a_material_are_made_orthogonal() {
    let model = pair(PAIR, "material = \"foam\"\naxes = [[0, 2, 0], [3, 3, 0]]\nattach = \"FACE\"\n");
    let model = model.unwrap_or_else(|error| panic!("{error}"));
    let axes = solid(only_part(&model.assembly)).regions[0].axes;
    assert_eq!(axes, [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]);
    assert_eq!(model.assembly.check(), []);
}

#[test]
fn a_solid_is_placed_by_its_attitude() {
    // a half turn about y
    let turned = "attitude = [0, 0, 1, 0]\nposition = [\"10 cm\", 0, 0]\n";
    let model = pair(PAIR, &format!("material = \"foam\"\n{turned}attach = [1, 2, 3]\n"));
    let model = model.unwrap_or_else(|error| panic!("{error}"));
    let nodes = &solid(only_part(&model.assembly)).mesh.nodes;
    assert_eq!(nodes[1..4], [[-0.9, 0.0, 0.0], [0.1, 1.0, 0.0], [0.1, 0.0, -1.0]]);
}

#[test]
fn ranges_of_regions_go_to_their_materials() {
    let soft = FOAM.replace("foam", "soft");
    let range = "rheology = { kind = \"quality-factor\", Q = 100, range = [30, 300] }\n";
    let text = model(
        "file = \"block.inp\"\nmaterials = { right = \"foam\", left = \"soft\" }\nattach = \"tip_face\"\n",
    );
    let model = Model::parse(Path::new(BLOCK), &format!("{soft}{range}{text}"))
        .unwrap_or_else(|error| panic!("{error}"));
    let [least, _] = &**model.extremes.as_ref().expect("ranges");
    let of = |part: &Part| -> Vec<String> {
        let regions = &solid(part).regions;
        let mut all: Vec<String> = regions
            .iter()
            .map(|region| format!("{} {:?}", region.cells[0] < 20, region.material.rheology()))
            .collect();
        all.sort();
        all
    };
    assert_eq!(of(only_part(least)), ["false Elastic", "true QualityFactor { factor: 30.0 }"]);
    assert_eq!(of(only_part(&model.assembly)), ["false Elastic", "true QualityFactor { factor: 100.0 }"]);
}

#[test]
fn a_wrong_solid_is_refused() {
    let refused = |lines: &str| located(&pair(PAIR, lines).expect_err("a refusal"));
    assert_snapshot!(refused("materal = \"foam\"\n"), @r#"
    model.toml:15:1: unknown key "materal" in [[solid]]
      did you mean `material`? the keys are name, file, unit, voxel, threshold, least_voxels, densities, stiffness_exponent, position, attitude, material, materials, axes, masses, attach, rayleigh
    "#);
    assert_snapshot!(refused("unit = \"kg\"\n"), @r#"
    model.toml:15:8: `unit`: "kg" is not a decimal number with a unit
      write for example "22 in", or a plain number in m
    "#);
    assert_snapshot!(refused("material = \"foam\"\naxes = [[1, 0, 0], [2, 0, 0]]\n"), @"
    model.toml:16:8: `axes` are parallel, or one has no length
      write two directions, those of axes 1 and 2 of the material
    ");
    assert_snapshot!(refused("material = \"foam\"\nattach = \"FACES\"\n"), @r#"
    model.toml:16:10: this part has no node or set "FACES"
      did you mean "FACE"? there are FACE, LOWER, UPPER
    "#);
    assert_snapshot!(refused("material = \"foam\"\nattach = [1, 9]\n"), @"
    model.toml:16:14: there is no node 9 in this part
      its 5 nodes are named by their numbers in the file
    ");
    assert_snapshot!(refused("material = \"foam\"\nmaterials = { UPPER = \"foam\" }\n"), @"
    model.toml:15:12: the material is given twice
      leave out one of `material` and `materials`
    ");
    assert_snapshot!(refused("materials = \"foam\"\n"), @r#"
    model.toml:15:13: `materials`: found a text, expected a table
      write { SET = "aluminium" }, for each set of cells in the mesh
    "#);
    assert_snapshot!(refused("materials = { UPPER = \"foam\", UNDER = \"foam\" }\n"), @r#"
    model.toml:15:39: the mesh has no solid cells in a set "UNDER"
      the sets of solid cells are UPPER, LOWER
    "#);
    assert_snapshot!(refused("materials = { UPPER = \"foam\", LOWER = \"steel\" }\n"), @r#"
    model.toml:15:39: there is no material "steel"
      there are aluminium, foam
    "#);
    assert_snapshot!(refused("materials = { UPPER = \"foam\", FACE = \"foam\" }\n"), @r#"
    model.toml:15:38: the mesh has no solid cells in a set "FACE"
      the sets of solid cells are UPPER, LOWER
    "#);
}

#[test]
fn a_cell_is_in_one_region() {
    let refused = |mesh: &str, lines: &str| located(&pair(mesh, lines).expect_err("a refusal"));
    assert_snapshot!(refused(PAIR, "materials = { UPPER = \"foam\" }\n"), @"
    model.toml:15:13: cell 2 is in none of these sets
      every solid cell needs one material
    ");
    let both = format!("{PAIR}*ELSET, ELSET=ALL\n1, 2\n");
    assert_snapshot!(refused(&both, "materials = { ALL = \"foam\", LOWER = \"foam\" }\n"), @"
    model.toml:15:13: cell 2 is in more than one of these sets
      every solid cell needs one material
    ");
    let nameless = PAIR.replace(", ELSET=UPPER", "").replace(", ELSET=LOWER", "");
    assert_snapshot!(refused(&nameless, "materials = { UPPER = \"foam\" }\n"), @r#"
    model.toml:15:23: the mesh has no solid cells in a set "UPPER"
      the mesh has no set of solid cells; give one `material`
    "#);
}

#[test]
fn a_mesh_that_cannot_be_read_is_refused_at_its_file() {
    let refused = |mesh: &str| located(&pair(mesh, "material = \"foam\"\n").expect_err("a refusal"));
    assert_snapshot!(refused(&PAIR.replace("C3D4, ELSET=LOWER", "C3D7")), @"
    model.toml:14:8: `file`: pair.inp:9: cells of type C3D7 are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of first or second order are, but no wedges of 18 nodes
      it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read
    ");
    assert_snapshot!(refused(&PAIR.replace("2, 1, 3, 2, 5", "2, 1, 3, 2, 6")), @"
    model.toml:14:8: `file`: pair.inp:10: cell 2 names node 6, which is not among the nodes before it; was the node left out?
      it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read
    ");
    let whole = include_str!("../data/volume/block-text.msh");
    let half: Vec<&str> = whole.lines().take(100).collect();
    assert_snapshot!(refused(&half.join("\n")), @"
    model.toml:14:8: `file`: pair.inp:100: the file ends after 89 of 113 nodes; was it cut off, or is the number wrong?
      it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read
    ");
    let other = model("file = \"none.msh\"\nmaterial = \"foam\"\n");
    assert_snapshot!(located(&Model::parse(Path::new(BLOCK), &other).expect_err("a refusal")), @"
    model.toml:14:8: `file`: none.msh: entity not found; is the name right, and is the file readable?
      it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read
    ");
}

#[test]
fn what_mechanics_says_of_a_solid_is_located() {
    let verdict = |mesh: &str| {
        let model =
            pair(mesh, "material = \"foam\"\nattach = \"FACE\"\n").unwrap_or_else(|error| panic!("{error}"));
        located(&model.diagnose_all(&model.assembly.check()))
    };
    assert_snapshot!(verdict(&PAIR.replace("4, 0, 0, 1\n", "4, 1, 1, 0\n")), @r#"model.toml:14:8: `file` of solid "solid 1": cell 1 (tetrahedron of 4 nodes) is flat near (0.0000e0, 0.0000e0, 0.0000e0): 0.0e0 times as thick as it is long; move its nodes apart or leave it out"#);
    let apart =
        PAIR.replace("5, 0, 0, -1\n", "5, 0, 0, -1\n6, 0, 0, 0\n").replace("2, 1, 3, 2, 5", "2, 6, 3, 2, 5");
    assert_snapshot!(verdict(&apart), @r#"
    model.toml:14:8: `file` of solid "solid 1": nodes 1 and 6 are at the same place; merge them unless the parts may move apart
      cells hang together by the nodes they share; for parts that turn, write two tables and a [[connection]]
    "#);
    let face =
        "*ELEMENT, TYPE=C3D4, ELSET=UPPER\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=LOWER\n2, 1, 3, 2, 5\n";
    let faces = PAIR.replace(face, "*ELEMENT, TYPE=S3, ELSET=UPPER\n1, 1, 2, 3\n");
    assert_snapshot!(verdict(&faces), @r#"
    model.toml:14:8: `file` of solid "solid 1": the mesh has no tetrahedra, wedges or hexahedra
      a [[solid]] is made of cells of its volume, a [[panel]] of those of a surface
    "#);
}

/// Nodes of no solid leave with the faces that name them, cells inside out are turned, and both are told; a name of such a node says so.
#[test]
fn loose_nodes_are_kept_aside_and_cells_turned() {
    let mesh =
        PAIR.replace("5, 0, 0, -1\n", "5, 0, 0, -1\n6, 1, 1, 3\n").replace("2, 1, 3, 2, 5", "2, 1, 2, 3, 5")
            + "*ELEMENT, TYPE=S3, ELSET=SKIN\n9, 2, 3, 6\n*NSET, NSET=LOOSE\n6\n";
    let read = |attach: &str| pair(&mesh, &format!("material = \"foam\"\nattach = {attach}\n"));
    let model = read("\"FACE\"").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(model.assembly.check(), []);
    let expected = [
        "pair.inp: cells inside out are turned, their nodes in the order of their shape (1)",
        "pair.inp: nodes that belong to no cell of the part are kept aside (1): 6",
    ];
    assert_eq!(model.file_notes, expected);
    assert_eq!(&model.notes[..2], expected);
    // two tetrahedra of 1/6 m³ each
    let mass = model.assembly.body().expect("a body").invariants().mass;
    assert!((mass / (40.0 + 50.0 / 3.0) - 1.0).abs() < 1e-12, "{mass}");
    assert_snapshot!(located(&read("6").expect_err("a loose node")), @"
    model.toml:16:10: node 6 belongs to no cell of this part, so that nothing holds it
      name a node of a cell; a [[connection]] of the nodes around it makes them one rigid piece
    ");
    assert_snapshot!(located(&read("\"LOOSE\"").expect_err("an empty set")), @r#"
    model.toml:16:10: the set "LOOSE" has no node of a cell of this part
      name nodes of cells
    "#);
}

/// One attached node fixes a point, two fix an axis: a solid needs three.
#[test]
fn a_solid_that_still_turns_is_a_mechanism() {
    for held in ["1", "[1, 2]"] {
        let model = pair(PAIR, &format!("material = \"foam\"\nattach = {held}\n")).expect("a model");
        let error = model.assembly.body().expect_err("a mechanism");
        let message = model.diagnose(&error).to_string();
        assert!(message.starts_with(&model.source.file.display().to_string()), "{message}");
        assert!(
            message.contains(":16:10: a mechanism: no spring resists some motion of \"solid 1\" node "),
            "{message}"
        );
        assert!(message.contains("three or more of a solid"), "{message}");
    }
}

/// Constants of a material are judged where the solid names it, in one region or in several.
#[test]
fn constants_of_no_material_are_refused_at_the_solid() {
    let wood = "[material.wood]\ndensity = 500\nyoung = [1e10, 1e9, 1e9]\npoisson = [0.3, 0.3, 1.1]\nshear = [1e9, 1e9, 1e9]\n";
    let verdict = |lines: &str| {
        let text = model(&format!("file = \"block.inp\"\n{lines}attach = \"tip_face\"\n"));
        let model = Model::parse(Path::new(BLOCK), &format!("{wood}{text}"))
            .unwrap_or_else(|error| panic!("{error}"));
        located(&model.diagnose_all(&model.assembly.check()))
    };
    assert_snapshot!(verdict("material = \"wood\"\n"), @r#"model.toml:20:12: `material` of solid "solid 1": nu23 = 1.1, but it must be below sqrt(E2/E3) = 1.0000 in size; are the indices swapped?"#);
    assert_snapshot!(verdict("materials = { left = \"foam\", right = \"wood\" }\n"), @r#"model.toml:20:13: `material` of solid "solid 1": nu23 = 1.1, but it must be below sqrt(E2/E3) = 1.0000 in size; are the indices swapped?"#);
}
