//! Targets: every reader of what a user writes, in one table that all runners use.

mod change;
mod disk;
mod formula;
mod laws;
mod matrix;
mod model;
mod quantity;
mod record;
mod study;
mod surface;
mod table;
mod volume;

/// A target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name, also that of its folders of inputs.
    pub name: &'static str,
    /// Execution; panics where a promise is broken.
    pub run: fn(&[u8]),
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
    text: fn(&[u8]) -> String,
}

/// Memory for files: a small multiple of their size, a thousand times as much where they are compressed.
const FILE: usize = 256 * 1024 * 1024;
/// Memory for bodies; `quasirigid_math::memory` refuses larger ones in words.
const BODY: usize = 1024 * 1024 * 1024;

impl Target {
    const fn of_file(name: &'static str, run: fn(&[u8]), words: &'static [&'static str]) -> Self {
        Self { name, run, words, seeds: &[], memory: FILE, text: None }
    }

    const fn of_body(name: &'static str, run: fn(&[u8]), words: &'static [&'static str]) -> Self {
        Self { name, run, words, seeds: &[], memory: BODY, text: None }
    }

    const fn drawn(self, target: &'static str, text: fn(&[u8]) -> String) -> Self {
        Self { text: Some(Drawn { target, text }), ..self }
    }

    const fn seeded(self, seeds: &'static [(&'static str, &'static str)]) -> Self {
        Self { seeds, ..self }
    }

    /// The target and the input under which a failing input is kept.
    #[must_use]
    pub fn shown(&self, input: &[u8]) -> (&'static str, Vec<u8>) {
        match self.text {
            Some(Drawn { target, text }) => (target, text(input).into_bytes()),
            None => (self.name, input.to_vec()),
        }
    }
}

/// Every target.
pub const TARGETS: [Target; 34] = [
    Target::of_body("model_text", model::text, model::WORDS)
        .seeded(&[("examples", "toml"), ("data/published", "toml")]),
    Target::of_body("model_tables", model::tables, &[]).drawn("model_text", model::drawn),
    Target::of_body("body_laws", laws::laws, &[]),
    Target::of_file("model_change", change::change, model::WORDS),
    Target::of_file("study_text", study::text, study::WORDS).seeded(&[("examples/damper-study", "toml")]),
    Target::of_file("study_tables", study::tables, &[]).drawn("study_text", study::drawn),
    Target::of_file("formula_text", formula::text, formula::WORDS),
    Target::of_file("formula_tree", formula::tree, &[]).drawn("formula_text", formula::drawn),
    Target::of_file("quantity_text", quantity::text, quantity::WORDS),
    Target::of_file("quantity_unit", quantity::unit, &[]).drawn("quantity_text", quantity::drawn),
    Target::of_file("surface_obj", surface::obj, &["v ", "f ", "//", "vn ", "\\\n"]),
    Target::of_file(
        "surface_stl",
        surface::stl,
        &["solid ", "facet normal ", "outer loop", "vertex ", "endfacet", "endsolid"],
    ),
    Target::of_file("surface_ply", surface::ply, surface::PLY),
    Target::of_file("surface_plates", surface::plates, &[]),
    Target::of_file("volume_gmsh", volume::gmsh, volume::GMSH).seeded(&[
        ("crates/quasirigid-io/tests/data/volume", "msh"),
        ("crates/quasirigid-io/tests/data/bodies", "msh"),
    ]),
    Target::of_file("volume_vtk", volume::vtk, volume::VTK).seeded(&[
        ("crates/quasirigid-io/tests/data/volume", "vtk"),
        ("crates/quasirigid-io/tests/data/volume", "vtu"),
    ]),
    Target::of_file("volume_abaqus", volume::abaqus, volume::ABAQUS).seeded(&[
        ("crates/quasirigid-io/tests/data/volume", "inp"),
        ("crates/quasirigid-io/tests/data/bodies", "inp"),
    ]),
    Target::of_file("matrix_market", matrix::market, matrix::MARKET)
        .seeded(&[("crates/quasirigid-io/tests/data/matrix", "mtx")]),
    Target::of_file("matrix_numpy", matrix::numpy, matrix::NUMPY).seeded(&[
        ("crates/quasirigid-io/tests/data/matrix", "npy"),
        ("crates/quasirigid-io/tests/data/matrix", "npz"),
    ]),
    Target::of_file("matrix_calculix", matrix::calculix, &[]).seeded(&[
        ("crates/quasirigid-io/tests/data/matrix", "sti"),
        ("crates/quasirigid-io/tests/data/bodies", "mas"),
    ]),
    Target::of_file("matrix_dmig", matrix::dmig, matrix::DMIG)
        .seeded(&[("crates/quasirigid-io/tests/data/matrix", "bdf")]),
    Target::of_file("matrix_op4", matrix::op4, &["1P,3E23.16", "1P,5E16.9", "KAA     ", "BIGMAT"])
        .seeded(&[("crates/quasirigid-io/tests/data/matrix", "op4")]),
    Target::of_file("nodes", matrix::nodes, matrix::NODES),
    Target::of_file("dofs", matrix::dofs, &[".1", ".6", "#"]).seeded(&[
        ("crates/quasirigid-io/tests/data/matrix", "dof"),
        ("crates/quasirigid-io/tests/data/bodies", "dof"),
    ]),
    Target::of_file("record_json", record::json, record::JSON),
    Target::of_file("record_scene", record::scene, record::JSON),
    Target::of_file("record_csv", record::csv, &["t,", "NaN", "inf", "\"", "\r\n"]),
    Target::of_file("record_npz", record::npz, matrix::NUMPY),
    Target::of_file("record_parquet", record::parquet, &["PAR1", "quasirigid.units"]),
    Target::of_file("record_rows", record::rows, &[]),
    Target::of_file("bodies_csv", table::bodies_csv, &["\"", "\r\n", ",", "NaN"]),
    Target::of_file("bodies_parquet", table::bodies_parquet, &["PAR1"]),
    Target::of_file("cells_parquet", table::cells_parquet, &["PAR1", "quasirigid.units"]),
    Target::of_file("sweep_results", table::sweep_results, record::JSON),
];
