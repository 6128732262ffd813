//! Files of matrices that describe no body.

use insta::assert_snapshot;

use super::matrices::{beside, market};
use super::{located, told, written};

/// Two nodes on springs, of three displacements each.
fn files() -> Vec<(&'static str, String)> {
    let spring = |i: usize, j: usize| if i == j { 9.0 } else { 0.5 };
    let lumped = |i: usize, j: usize| if i == j { 2.0 } else { 0.0 };
    let of = |entry: &dyn Fn(usize, usize) -> f64| {
        market(&(0..6).map(|i| (0..6).map(|j| entry(i, j)).collect()).collect::<Vec<_>>())
    };
    vec![
        ("nodes.txt", "3 0 0 0\n7 1 0 0.5\n".to_owned()),
        ("K.mtx", of(&spring)),
        ("M.mtx", of(&lumped)),
        ("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n7.3\n".to_owned()),
    ]
}

const KEYS: &str = "nodes = \"nodes.txt\"\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\n";

/// Refusal of these lines, which start in line 6, beside files of which one is replaced; by reading or by the
/// laws of mechanics.
fn with(replaced: (&'static str, &str), lines: &str) -> String {
    let mut files = files();
    files.retain(|(name, _)| *name != replaced.0);
    files.push((replaced.0, replaced.1.to_owned()));
    located(&told(beside(&files, lines)))
}

fn refused(lines: &str) -> String {
    with(("other.txt", ""), lines)
}

/// A matrix with a number on its diagonal but for some entries, by their rows and columns from 1.
fn diagonal(size: usize, value: f64, others: &[(usize, usize, f64)]) -> String {
    let entry = |i: usize, j: usize| {
        let other = others.iter().find(|other| (other.0, other.1) == (i + 1, j + 1));
        other.map_or(if i == j { value } else { 0.0 }, |(.., other)| *other)
    };
    market(&(0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect::<Vec<_>>())
}

#[test]
fn a_table_that_lacks_a_file_is_refused() {
    assert_snapshot!(refused("nodes = \"nodes.txt\"\n"), @r#"
    model.toml:5:1: [[matrices]] has no `stiffness`
      add a line such as: stiffness = "bracket.sti"
    model.toml:5:1: [[matrices]] has no `mass`
      add a line such as: mass = "bracket.mas"
    "#);
    assert_snapshot!(refused(&KEYS.replace("K.mtx", "K.sti")), @"
    model.toml:7:13: `stiffness`: K.sti: entity not found; is the name right, and is the file readable?
      it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are read, and node tables as CSV, GRID cards or *NODE
    ");
    assert_snapshot!(refused(&format!("{KEYS}dofs = \"M.mtx\"\n")), @"
    model.toml:9:8: `dofs`: M.mtx:1: 5 values; a degree of freedom is written node.component or node component
      it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are read, and node tables as CSV, GRID cards or *NODE
    ");
    assert_snapshot!(refused(&format!("{KEYS}freedoms = \"rows.dof\"\n")), @r#"
    model.toml:9:1: unknown key "freedoms" in [[matrices]]
      did you mean `dofs`? the keys are name, nodes, dofs, mass, stiffness, damping, length_unit, mass_unit, rheology, masses, attach, rayleigh
    "#);
    assert_snapshot!(refused(&format!("{KEYS}damping = {{ name = \"B\" }}\n")), @r#"
    model.toml:9:11: the matrix has no `file`
      add a line such as: file = "model.op4"
    "#);
    assert_snapshot!(refused(&KEYS.replace("\"K.mtx\"", "{ file = \"K.mtx\", name = \"K\" }")), @r#"
    model.toml:7:22: `file`: K.mtx: this format has one matrix without a name; leave out the name "K"
      it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are read, and node tables as CSV, GRID cards or *NODE
    "#);
    assert_snapshot!(refused(&format!("{KEYS}length_unit = \"kg\"\nmass_unit = \"mm\"\n")), @r#"
    model.toml:9:15: `length_unit`: "kg" is not a decimal number with a unit
      write for example "22 in", or a plain number in m
    model.toml:10:13: `mass_unit`: "mm" is not a decimal number with a unit
      write for example "12 lb", or a plain number in kg
    "#);
    assert_snapshot!(refused(&format!("{KEYS}unit = \"mm\"\n")), @r#"
    model.toml:9:1: unknown key "unit" in [[matrices]]
      the keys are name, nodes, dofs, mass, stiffness, damping, length_unit, mass_unit, rheology, masses, attach, rayleigh
    "#);
    assert_snapshot!(with(("nodes.txt", "3 0 0 0\n7 1 0 0.5\n3 1 1 1\n"), KEYS), @"
    model.toml:6:9: `nodes`: nodes.txt:3: node 3 appears twice; give each node one place
      it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are read, and node tables as CSV, GRID cards or *NODE
    ");
    assert_snapshot!(refused(&format!("{KEYS}attach = [3, 4]\n")), @"
    model.toml:9:14: there is no node 4 in this part
      its 2 nodes are named by their numbers in the file
    ");
}

#[test]
fn rows_that_are_about_nothing_are_refused() {
    let wide = "%%MatrixMarket matrix coordinate real general\n6 5 1\n1 1 2.0\n";
    assert_snapshot!(with(("K.mtx", wide), KEYS), @"
    model.toml:7:13: the matrix has 6 rows and 5 columns
      mass, damping and stiffness are square
    ");
    assert_snapshot!(with(("M.mtx", &diagonal(5, 2.0, &[])), KEYS), @r#"
    model.toml:8:8: the matrix has 5 rows, but 6 degrees of freedom are known
      say what each row is about: dofs = "bracket.dof", with lines node.component; without it the rows are the three or six components of each node in the order of the table
    "#);
    let listed = format!("{KEYS}dofs = \"rows.dof\"\n");
    assert_snapshot!(with(("M.mtx", &diagonal(7, 2.0, &[])), &listed), @r#"
    model.toml:8:8: the matrix has 7 rows, but 6 degrees of freedom are known
      say what each row is about: dofs = "bracket.dof", with lines node.component; without it the rows are the three or six components of each node in the order of the table
    "#);
    assert_snapshot!(with(("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n8.3\n"), &listed), @"
    model.toml:7:13: there is no degree of freedom 8.3 of a node in the table `nodes`
      every row is about a displacement (1 to 3) or rotation (4 to 6) of a node in the table
    ");
    assert_snapshot!(with(("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n7.2\n"), &listed), @"
    model.toml:9:8: `dofs`: rows.dof:6: 7.2 appears twice; a matrix has one row for each degree of freedom
      it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are read, and node tables as CSV, GRID cards or *NODE
    ");
    let point = "DMIG,M,0,6,2,0\nDMIG,M,3,1,,3,1,2.\nDMIG,M,9,0,,9,0,2.\n";
    assert_snapshot!(with(("M.bdf", point), &KEYS.replace("M.mtx", "M.bdf")), @"
    model.toml:8:8: there is no degree of freedom 9.0 of a node in the table `nodes`
      every row is about a displacement (1 to 3) or rotation (4 to 6) of a node in the table
    ");
}

#[test]
fn matrices_of_no_body_are_refused() {
    let attached = format!("{KEYS}attach = 3\n");
    assert_snapshot!(with(("K.mtx", &diagonal(6, 9.0, &[(5, 2, 1.0)])), &attached), @r#"
    model.toml:7:13: `stiffness` of matrices "matrices 1": the matrix is not symmetric: it has 1 at row 7.2, column 3.2, and 0 at row 3.2, column 7.2
      a mass, damping or stiffness is symmetric; was one triangle written, or the matrix of another step?
    "#);
    assert_snapshot!(with(("M.mtx", &diagonal(6, 2.0, &[(4, 4, -2.0)])), &attached), @r#"
    model.toml:8:8: `mass` of matrices "matrices 1": the matrix has -2 on its diagonal at 7.1; no motion has less than no energy
      check the sign, and that this is the matrix it should be
    "#);
    assert_snapshot!(with(("M.mtx", &diagonal(6, 0.0, &[])), &attached), @r#"
    model.toml:8:8: `mass` of matrices "matrices 1": 0 kg is not a mass; it must be positive
      write a positive mass, or leave the element out
    "#);
    assert_snapshot!(with(("K.mtx", &diagonal(6, 9.0, &[(6, 6, 0.0)])), &attached), @r#"
    model.toml:9:10: a mechanism: no spring resists some motion of "matrices 1" node 7 z
      attach or connect more of its nodes, three or more of a solid; or add a spring that resists it
    "#);
}

#[test]
fn matrices_that_nothing_holds_are_refused() {
    // nodes on springs to the ground stand; with springs between them alone they do not
    let between = [(3, 0), (0, 3), (4, 1), (1, 4), (5, 2), (2, 5)].map(|(i, j)| (i, j, -9.0));
    assert_snapshot!(with(("K.mtx", &diagonal(6, 9.0, &between)), KEYS), @r#"
    model.toml:5:1: matrices "matrices 1": nothing joins this part to the carrier; attach some of its nodes, or connect it
      write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part
    "#);
    // and the other way round: matrices with ground springs and nothing that carries them
    let text = format!("[[matrices]]\n{KEYS}dofs = \"rows.dof\"\n");
    let mut files = files();
    for (name, text) in &mut files {
        match *name {
            "rows.dof" => *text = "3.1\n3.2\n3.3\n7.1\n7.2\n".to_owned(),
            "K.mtx" | "M.mtx" => *text = diagonal(5, 2.0, &[]),
            _ => {}
        }
    }
    assert_snapshot!(located(&told(written(&files, &text))), @r#"
    model.toml:3:13: `stiffness` of matrices "matrices 1": node 7 has not all its rows, so it is held, and this body has no carrier to hold it
      add a [carrier], or export the matrices of the body that nothing holds
    "#);
}
