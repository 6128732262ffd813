//! Corpus: every mesh of a folder, for a comparison with other programs.

use std::path::{Path, PathBuf};

use quasirigid_io::mesh::read_volume;

/// Files below a folder.
fn below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { below(&path, found) } else { found.push(path) }
    }
}

/// A line for each file of the folder `QUASIRIGID_CORPUS`: nodes, cells, weighted sum of the coordinates, volume of the solids; or the
/// refusal.
#[test]
#[ignore = "needs a folder of meshes"]
fn corpus() {
    let folder = std::env::var("QUASIRIGID_CORPUS").unwrap();
    let mut files = Vec::new();
    below(Path::new(&folder), &mut files);
    files.sort();
    for file in files {
        let name = file.strip_prefix(&folder).unwrap().display().to_string();
        match read_volume(&file) {
            Ok(read) => {
                let mesh = read.mesh;
                let sums: Vec<f64> = (0..3)
                    .map(|axis| {
                        let weighted = |(node, label): (&[f64; 3], &u64)| node[axis] * (*label % 1009) as f64;
                        mesh.nodes.iter().zip(&mesh.node_labels).map(weighted).sum()
                    })
                    .collect();
                let volume: f64 = (0..mesh.cells.len()).map(|cell| mesh.volume(&[cell])).sum();
                println!(
                    "{name}\tok\t{}\t{}\t{sums:?}\t{volume:e}\t{}",
                    mesh.nodes.len(),
                    mesh.cells.len(),
                    read.notes.join("; ")
                );
            }
            Err(error) => println!("{name}\trefused\t{}", error.problem),
        }
    }
}
