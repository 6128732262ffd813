//! Targets: every reader of what a user writes, in one table that all runners use.

mod attitude;
mod change;
mod disk;
mod formula;
mod history;
mod light_curve;
mod matrix;
mod model;
mod quantity;
mod record;
mod study;
mod surface;
mod table;
mod volume;

use arbitrary::Unstructured;

use crate::{grammar, laws};

/// A target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name, also that of its folders of inputs.
    pub name: &'static str,
    /// Reader of an input, or of the text that it stands for; panics where a promise is broken.
    read: fn(&[u8]),
    /// Words of the format.
    pub words: &'static [&'static str],
    /// Folders of the repository with files of the format, each with their ending.
    pub seeds: &'static [(&'static str, &'static str)],
    /// Memory that one execution may use (bytes).
    pub memory: usize,
    /// Text that the bytes stand for, of a target whose bytes are choices of a grammar.
    text: Option<Drawn>,
}

/// A text drawn by bytes, and the target that reads such texts.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    target: &'static str,
    text: fn(&mut Unstructured<'_>) -> String,
}

/// Memory for files: a small multiple of their size, a thousand times as much where they are compressed.
const FILE: usize = 256 * 1024 * 1024;
/// Memory for bodies; `quasirigid_math::memory` refuses larger ones in words.
const BODY: usize = 1024 * 1024 * 1024;
/// Folders of seeds.
const VOLUMES: &str = "crates/quasirigid-io/tests/data/volume";
const BODIES: &str = "crates/quasirigid-io/tests/data/bodies";
const MATRICES: &str = "crates/quasirigid-io/tests/data/matrix";

impl Target {
    const fn of_file(name: &'static str, read: fn(&[u8]), words: &'static [&'static str]) -> Self {
        Self { name, read, words, seeds: &[], memory: FILE, text: None }
    }

    const fn of_body(name: &'static str, read: fn(&[u8]), words: &'static [&'static str]) -> Self {
        Self { name, read, words, seeds: &[], memory: BODY, text: None }
    }

    const fn drawn(self, target: &'static str, text: fn(&mut Unstructured<'_>) -> String) -> Self {
        Self { text: Some(Drawn { target, text }), ..self }
    }

    const fn seeded(self, seeds: &'static [(&'static str, &'static str)]) -> Self {
        Self { seeds, ..self }
    }

    /// Executes the target; panics where a promise is broken.
    pub fn run(&self, input: &[u8]) {
        match self.text {
            Some(Drawn { text, .. }) => (self.read)(text(&mut Unstructured::new(input)).as_bytes()),
            None => (self.read)(input),
        }
    }

    /// The target and the input under which a failing input is kept.
    #[must_use]
    pub fn shown(&self, input: &[u8]) -> (&'static str, Vec<u8>) {
        match self.text {
            Some(Drawn { target, text }) => (target, text(&mut Unstructured::new(input)).into_bytes()),
            None => (self.name, input.to_vec()),
        }
    }
}

/// Every target.
pub const TARGETS: [Target; 57] = [
    Target::of_body("model_text", model::text, model::WORDS)
        .seeded(&[("examples", "toml"), ("data/published", "toml")]),
    Target::of_body("model_tables", model::text, &[]).drawn("model_text", grammar::model::model),
    Target::of_body("body_laws", |bytes| laws::transform::check(&mut Unstructured::new(bytes)), &[]),
    Target::of_file("model_change", change::change, model::WORDS),
    Target::of_file("study_text", study::text, study::WORDS).seeded(&[("examples/damper-study", "toml")]),
    Target::of_file("study_tables", study::text, &[]).drawn("study_text", grammar::study::study),
    Target::of_file("formula_text", formula::text, formula::WORDS),
    Target::of_file("formula_tree", formula::text, &[]).drawn("formula_text", grammar::formula::formula),
    Target::of_file("quantity_text", quantity::text, quantity::WORDS),
    Target::of_file("quantity_unit", quantity::text, &[]).drawn("quantity_text", grammar::unit::quantity),
    Target::of_file("surface_obj", |bytes| surface::read("a.obj", bytes), &["v ", "f ", "//", "vn ", "\\\n"]),
    Target::of_file(
        "surface_stl",
        |bytes| surface::read("a.stl", bytes),
        &["solid ", "facet normal ", "outer loop", "vertex ", "endfacet", "endsolid"],
    ),
    Target::of_file("surface_ply", |bytes| surface::read("a.ply", bytes), surface::PLY),
    Target::of_file("surface_plates", |bytes| surface::read("a.tab", bytes), &[]),
    Target::of_file(
        "surface_off",
        |bytes| surface::read("a.off", bytes),
        &["OFF\n", "COFF ", "NOFF\n", "3 "],
    ),
    Target::of_file("surface_vrml", |bytes| surface::read("a.wrl", bytes), surface::VRML),
    Target::of_file("surface_gltf", |bytes| surface::read("a.gltf", bytes), surface::GLTF),
    Target::of_file("surface_vtk", |bytes| surface::read("a.vtp", bytes), surface::VTP),
    Target::of_file("volume_gmsh", |bytes| volume::read("a.msh", bytes), volume::GMSH)
        .seeded(&[(VOLUMES, "msh"), (BODIES, "msh")]),
    Target::of_file("volume_vtk", |bytes| volume::read("a.vtu", bytes), volume::VTK)
        .seeded(&[(VOLUMES, "vtk"), (VOLUMES, "vtu")]),
    Target::of_file("volume_abaqus", |bytes| volume::read("nowhere/a.inp", bytes), volume::ABAQUS)
        .seeded(&[(VOLUMES, "inp"), (BODIES, "inp")]),
    Target::of_file("volume_voxels", |bytes| volume::read("nowhere/a.nrrd", bytes), volume::NRRD),
    Target::of_file("deck_abaqus", volume::deck, volume::DECK).seeded(&[(VOLUMES, "inp"), (BODIES, "inp")]),
    Target::of_file("volume_nastran", |bytes| volume::read("nowhere/a.bdf", bytes), volume::NASTRAN)
        .seeded(&[(VOLUMES, "bdf"), (MATRICES, "bdf")]),
    Target::of_file("volume_op2", |bytes| volume::read("a.op2", bytes), &[]),
    Target::of_file("volume_exodus", |bytes| volume::read("a.exo", bytes), volume::EXODUS)
        .seeded(&[(VOLUMES, "exo")]),
    Target::of_file("volume_med", |bytes| volume::read("a.med", bytes), volume::MED)
        .seeded(&[(VOLUMES, "med")]),
    Target::of_file("matrix_op2", |bytes| matrix::read("a.op2", bytes, Some("SHAPES")), &[]),
    Target::of_file("matrix_printed", |bytes| matrix::read("a.f06", bytes, Some("SHAPES")), matrix::PRINTED),
    Target::of_file("matrix_harwell", |bytes| matrix::read("a.hb", bytes, None), matrix::HARWELL),
    Target::of_file(
        "matrix_coordinates",
        |bytes| matrix::read("a.mtx", bytes, None),
        &["1 1 ", ", 2, ", "1.0D+3\n", "**\n"],
    )
    .seeded(&[(BODIES, "sti")]),
    Target::of_file("matrix_market", |bytes| matrix::read("a.mtx", bytes, None), matrix::MARKET)
        .seeded(&[(MATRICES, "mtx")]),
    Target::of_file("matrix_numpy", |bytes| matrix::read("a.npz", bytes, Some("K")), matrix::NUMPY)
        .seeded(&[(MATRICES, "npy"), (MATRICES, "npz")]),
    Target::of_file("matrix_mat", |bytes| matrix::read("a.mat", bytes, Some("K")), &[])
        .seeded(&[(MATRICES, "mat")]),
    Target::of_file("matrix_calculix", |bytes| matrix::read("a.sti", bytes, None), &[])
        .seeded(&[(MATRICES, "sti"), (BODIES, "mas")]),
    Target::of_file("matrix_dmig", |bytes| matrix::read("a.bdf", bytes, Some("kaax")), matrix::DMIG)
        .seeded(&[(MATRICES, "bdf")]),
    Target::of_file(
        "matrix_op4",
        |bytes| matrix::read("a.op4", bytes, Some("kaa")),
        &["1P,3E23.16", "1P,5E16.9", "KAA     ", "BIGMAT"],
    )
    .seeded(&[(MATRICES, "op4")]),
    Target::of_file("nodes", matrix::nodes, matrix::NODES),
    Target::of_file("dofs", matrix::dofs, &[".1", ".6", "#"]).seeded(&[(MATRICES, "dof"), (BODIES, "dof")]),
    Target::of_file("record_json", |bytes| record::read("record.json", bytes), record::JSON),
    Target::of_file("record_scene", |bytes| record::read("scene.json", bytes), record::JSON),
    Target::of_file(
        "record_csv",
        |bytes| record::read("history-reduced.csv", bytes),
        &["t,", "NaN", "inf", "\"", "\r\n"],
    ),
    Target::of_file("record_npz", |bytes| record::read("history-reduced.npz", bytes), matrix::NUMPY),
    Target::of_file(
        "record_parquet",
        |bytes| record::read("history-reduced.parquet", bytes),
        &["PAR1", "quasirigid.units"],
    ),
    Target::of_file("record_rows", |bytes| record::read("history-reduced.rows", bytes), &[]),
    Target::of_file("attitude_aem", |bytes| attitude::read("a.aem", bytes), attitude::AEM),
    Target::of_file("attitude_stk", |bytes| attitude::read("a.a", bytes), attitude::STK),
    Target::of_file("history_csv", |bytes| history::read("spin.csv", bytes), history::TEXT),
    Target::of_file("history_npz", |bytes| history::read("spin.npz", bytes), matrix::NUMPY),
    Target::of_file("light_curve", light_curve::read, light_curve::TEXT),
    Target::of_file("bodies_csv", |bytes| table::bodies("bodies.csv", bytes), &["\"", "\r\n", ",", "NaN"]),
    Target::of_file(
        "bodies_text",
        |bytes| table::bodies("bodies.txt", bytes),
        &["\t", ";", "|", "-----", "[h]", "#", "  ", "8,5"],
    ),
    Target::of_file(
        "bodies_votable",
        |bytes| table::bodies("bodies.vot", bytes),
        &["<TR>", "<TD/>", "<FIELD name=\"a\" unit=\"h\"/>", "<TABLEDATA>", "</TABLE>"],
    ),
    Target::of_file("bodies_workbook", |bytes| table::bodies("bodies.xlsx", bytes), &["PK", "<c r=\"B2\">"]),
    Target::of_file("bodies_parquet", |bytes| table::bodies("bodies.parquet", bytes), &["PAR1"]),
    Target::of_file("cells_parquet", table::cells_parquet, &["PAR1", "quasirigid.units"]),
    Target::of_file("sweep_results", table::sweep_results, record::JSON),
];
