//! Modes from files: a chain of masses, whose modes have a closed form, against the same chain as points and springs.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

use quasirigid_io::model::{Model, ModelError};

use super::same::assert_same;
use super::{CARRIER, located, told, written};

/// Masses in a line, each joined to the one before and the first to the carrier.
const LINKS: usize = 4;
const MASS: f64 = 0.7;
const STIFFNESS: f64 = 250.0;
const START: [f64; 3] = [0.3, -0.2, 0.5];
const STEP: [f64; 3] = [0.4, 0.25, -0.1];

fn place(link: usize) -> [f64; 3] {
    [0, 1, 2].map(|axis| START[axis] + STEP[axis] * link as f64)
}

/// Displacement of a mass, from 1, in a mode, from 1.
fn shape(mode: usize, link: usize) -> f64 {
    ((2 * mode - 1) as f64 * PI * link as f64 / (2 * LINKS + 1) as f64).sin()
}

/// Natural frequency (rad/s).
fn frequency(mode: usize) -> f64 {
    2.0 * (STIFFNESS / MASS).sqrt() * ((2 * mode - 1) as f64 * PI / (4 * LINKS + 2) as f64).sin()
}

/// The chain with damping in proportion to its stiffness, which gives mode `j` the damping ratio `½ τ Ω_j`.
const TIME: f64 = 0.02;

fn chain() -> Model {
    let mut text = CARRIER.to_owned();
    for link in 1..=LINKS {
        let [x, y, z] = place(link);
        writeln!(text, "[[point]]\nname = \"p{link}\"\nmass = {MASS}\nposition = [{x}, {y}, {z}]")
            .expect("text");
        let before = if link == 1 { "carrier".to_owned() } else { format!("p{}", link - 1) };
        writeln!(
            text,
            "[[spring]]\nfrom = \"{before}\"\nto = \"p{link}\"\nstiffness = {STIFFNESS}\ndamping = {}",
            TIME * STIFFNESS
        )
        .expect("text");
    }
    Model::parse(Path::new("chain.toml"), &text).unwrap_or_else(|error| panic!("{error}"))
}

/// Files of a chain in units of length and mass; with or without the nodes before the first mass.
struct Files {
    /// The nodes, from the first one on.
    links: std::ops::RangeInclusive<usize>,
    length: f64,
    mass: f64,
}

impl Files {
    fn nodes(&self) -> String {
        let mut text = "node,x,y,z\n".to_owned();
        for link in self.links.clone() {
            let [x, y, z] = place(link).map(|entry| entry / self.length);
            writeln!(text, "{},{x:e},{y:e},{z:e}", 100 - link).expect("text");
        }
        text
    }

    fn masses(&self) -> String {
        let masses: Vec<f64> =
            self.links.clone().map(|link| if link == 0 { 0.0 } else { MASS / self.mass }).collect();
        array(&[masses])
    }

    /// A column for each mode and axis, of no scale in particular, after those of the interface.
    fn shapes(&self, interface: bool) -> String {
        let axes = 0..3;
        let column = |of: &dyn Fn(usize) -> f64, axis: usize| -> Vec<f64> {
            self.links
                .clone()
                .flat_map(|link| (0..3).map(move |own| (link, own)))
                .map(|(link, own)| if own == axis { of(link) } else { 0.0 })
                .collect()
        };
        let rigid = axes.clone().filter(|_| interface).map(|axis| column(&|_| 1.0, axis));
        let modes = (1..=LINKS).flat_map(|mode| axes.clone().map(move |axis| (mode, axis)));
        let modes = modes.map(|(mode, axis)| column(&|link| scale(mode, axis) * shape(mode, link), axis));
        array(&rigid.chain(modes).collect::<Vec<_>>())
    }
}

fn scale(mode: usize, axis: usize) -> f64 {
    1.0 + 0.3 * mode as f64 - 0.7 * axis as f64
}

/// Columns as a dense Matrix Market file.
fn array(columns: &[Vec<f64>]) -> String {
    let mut text =
        format!("%%MatrixMarket matrix array real general\n{} {}\n", columns[0].len(), columns.len());
    columns.iter().flatten().for_each(|entry| writeln!(text, "{entry:e}").expect("text"));
    text
}

/// A carrier and these lines of a table `[[modes]]`, which start in line 6, beside files.
fn beside(files: &[(&str, String)], lines: &str) -> Result<Model, ModelError> {
    written(files, &format!("{CARRIER}[[modes]]\n{lines}"))
}

fn listed(of: impl Fn(usize) -> String) -> String {
    let each: Vec<String> = (1..=LINKS).flat_map(|mode| std::iter::repeat_n(of(mode), 3)).collect();
    format!("[{}]", each.join(", "))
}

const METRES: Files = Files { links: 1..=LINKS, length: 1.0, mass: 1.0 };

fn files(chain: &Files, interface: bool) -> Vec<(&'static str, String)> {
    vec![("n.csv", chain.nodes()), ("m.mtx", chain.masses()), ("phi.mtx", chain.shapes(interface))]
}

const LINES: &str = "nodes = \"n.csv\"\nmass = \"m.mtx\"\nshapes = \"phi.mtx\"\n";

#[test]
fn all_modes_of_a_chain_are_the_chain() {
    let ratios = listed(|mode| format!("{}", 0.5 * TIME * frequency(mode)));
    let frequencies = listed(|mode| format!("\"{} Hz\"", frequency(mode) / TAU));
    let lines = format!("{LINES}frequencies = {frequencies}\ndamping_ratios = {ratios}\n");
    let model = beside(&files(&METRES, false), &lines).unwrap_or_else(|error| panic!("{error}"));
    assert_same(&model, &chain(), 1e-12);
}

#[test]
fn frequencies_and_ratios_stand_in_files_too() {
    let numbers = |of: &dyn Fn(usize) -> f64| {
        array(&[(1..=LINKS).flat_map(|mode| std::iter::repeat_n(of(mode), 3)).collect::<Vec<f64>>()])
    };
    let mut files = files(&Files { length: 1e-3, mass: 1e3, ..METRES }, false);
    files.push(("f.mtx", numbers(&|mode| 60.0 * frequency(mode) / TAU)));
    files.push(("z.mtx", numbers(&|mode| 0.5 * TIME * frequency(mode))));
    let lines = format!(
        "{LINES}length_unit = \"mm\"\nmass_unit = \"t\"\nfrequencies = {{ file = \"f.mtx\", unit = \"rpm\" }}\ndamping_ratios = {{ file = \"z.mtx\" }}\n"
    );
    let model = beside(&files, &lines).unwrap_or_else(|error| panic!("{error}"));
    assert_same(&model, &chain(), 1e-12);
}

#[test]
fn a_mass_matrix_stands_for_the_masses() {
    let size = 3 * LINKS;
    let column = |row: usize| (0..size).map(|other| if other == row { MASS } else { 0.0 }).collect();
    let mut files = files(&METRES, false);
    files[1] = ("m.mtx", array(&(0..size).map(column).collect::<Vec<Vec<f64>>>()));
    let frequencies = listed(|mode| frequency(mode).to_string());
    let lines = format!("{LINES}frequencies = {frequencies}\n");
    let model = beside(&files, &format!("{lines}rayleigh = {{ stiffness = {TIME} }}\n"));
    assert_same(&model.unwrap_or_else(|error| panic!("{error}")), &chain(), 1e-12);
}

/// Craig and Bampton: the node at the foot of the chain moves it all, and the modes leave it at rest.
#[test]
fn an_interface_is_attached_in_units_of_the_files() {
    let units = Files { links: 0..=LINKS, length: 1e-3, mass: 1e3 };
    let mut files = files(&units, true);
    let count = 3 + 3 * LINKS;
    // Stiffness of a mode: energy in the units of the files, for a displacement of one unit.
    let diagonal = |row: usize| match row.checked_sub(3) {
        None => 0.0,
        Some(number) => {
            let (mode, axis) = (1 + number / 3, number % 3);
            let moved: f64 = (1..=LINKS).map(|link| (scale(mode, axis) * shape(mode, link)).powi(2)).sum();
            MASS / units.mass * moved * frequency(mode).powi(2)
        }
    };
    let column =
        |row: usize| (0..count).map(|other| if other == row { diagonal(row) } else { 0.0 }).collect();
    files.push(("k.mtx", array(&(0..count).map(column).collect::<Vec<Vec<f64>>>())));
    let lines = format!(
        "{LINES}interface = [100]\nattach = 100\nstiffness = \"k.mtx\"\nrayleigh = {{ stiffness = {TIME} }}\nlength_unit = \"mm\"\nmass_unit = \"t\"\n"
    );
    let model = beside(&files, &lines).unwrap_or_else(|error| panic!("{error}"));
    assert_same(&model, &chain(), 1e-12);
}

/// Refusal of these lines, which start in line 6, by their reading or by the laws of mechanics.
fn refusal(files: &[(&str, String)], lines: &str) -> String {
    located(&told(beside(files, lines)))
}

#[test]
fn modes_of_another_size_or_form_are_refused() {
    let all = files(&METRES, false);
    let frequencies = format!("frequencies = {}\n", listed(|mode| frequency(mode).to_string()));
    insta::assert_snapshot!(refusal(&all, LINES), @r#"
    model.toml:5:1: [[modes]] has no `frequencies`
      add a line such as: frequencies = ["0.4 Hz", "1.1 Hz"]
    "#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}frequencies = [1, 2]\n")), @r#"model.toml:9:15: `frequencies` of modes "modes 1": there are 12 shapes and 2 values; give one for each"#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}{frequencies}stiffness = \"m.mtx\"\n")), @r#"
    model.toml:10:13: `frequencies` and `stiffness` are the same quantity
      leave one of them out
    "#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}{frequencies}damping = \"m.mtx\"\n")), @r#"
    model.toml:10:11: `damping` is a matrix beside `stiffness`
      write damping_ratios = 0.01, or `stiffness` in place of `frequencies`
    "#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}{frequencies}interface = [99]\n")), @r#"model.toml:8:10: `shapes` of modes "modes 1": shape 1 moves component 1 of node 99 by 0.4446; the first shapes are unit displacements of the interface, node by node, and the others leave it at rest"#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}{frequencies}attach = 99\n")), @r#"model.toml:10:10: `attach` of modes "modes 1": the shapes of its modes say how "modes 1" node 99 moves; only nodes of the `interface` can be held or carried"#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}frequencies = {{ file = \"m.mtx\", unit = \"kg\" }}\n")), @r#"
    model.toml:9:40: `unit`: "kg" is not a decimal number with a unit
      write for example "2 Hz", or a plain number in rad/s
    "#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}frequencies = {{ file = \"m.mtx\" }}\n")), @r#"
    model.toml:9:15: `frequencies` has 4 rows and 1 columns, and there are 12 modes
      give one number for each mode
    "#);
    insta::assert_snapshot!(refusal(&all, &format!("{LINES}{frequencies}damping_ratios = -0.1\n")), @r#"
    model.toml:10:18: `damping_ratios` is -0.1, but must be zero or positive
      write zero or a positive value
    "#);
    let mut wrong = all.clone();
    wrong[2] = ("phi.mtx", array(&[vec![1.0; 5]]));
    insta::assert_snapshot!(refusal(&wrong, &format!("{LINES}{frequencies}")), @r#"
    model.toml:8:10: the matrix has 5 rows, but 12 degrees of freedom are known
      say what each row is about: dofs = "bracket.dof", with lines node.component; without it the rows are the three or six components of each node in the order of the table
    "#);
    let mut wrong = all.clone();
    wrong[1] = ("m.mtx", array(&[vec![1.0, 2.0, 30.0, 4.0]]));
    insta::assert_snapshot!(refusal(&wrong, &format!("{LINES}{frequencies}")), @r#"model.toml:8:10: `shapes` of modes "modes 1": the mass couples modes 1 and 4 by 0.17 of their own, so they are not modes of this mass; is the mass at the nodes complete, and are the rows in their order?"#);
    insta::assert_snapshot!(refusal(&all[..2], &format!("{LINES}{frequencies}")), @r#"
    model.toml:8:10: `shapes`: phi.mtx: entity not found; is the name right, and is the file readable?
      it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are read, and node tables as CSV, GRID cards or *NODE
    "#);
}
