//! Beams of shells `[@macneal1985]`.

use std::f64::consts::PI;

use super::grid::{Grid, SHAPES, name};
use super::structure::{Structure, section};
use quasirigid_mesh::Shape;

/// Displacement of a beam clamped at its first column along a unit force that is spread over its last.
fn cantilever(mut beam: Structure, counts: [usize; 2], force: [f64; 3]) -> f64 {
    for row in 0..=counts[1] {
        (0..6).for_each(|dof| beam.held[6 * beam.grid.node(0, row) + dof] = true);
        let end = if row == 0 || row == counts[1] { 0.5 } else { 1.0 };
        for axis in 0..3 {
            beam.load[6 * beam.grid.node(counts[0], row) + axis] = force[axis] * end / counts[1] as f64;
        }
    }
    let answer = beam.answer();
    let nodes = (0..=counts[1]).map(|row| beam.grid.node(counts[0], row));
    let along = nodes.map(|node| (0..3).map(|axis| answer[6 * node + axis] * force[axis]).sum::<f64>());
    along.sum::<f64>() / (counts[1] + 1) as f64
}

/// Six rectangles, parallelograms (slant 1) or trapezoids (slant −1) in a row, each divided further.
fn straight(shape: Shape, counts: [usize; 2], slant: f64, force: [f64; 3]) -> f64 {
    let lean = |line: f64| match line as usize {
        0 | 6 => 0.0,
        odd if odd % 2 == 1 => slant,
        _ => slant.abs(),
    };
    let point = |x: f64, y: f64| {
        let (line, share) = ((6.0 * x + 1e-9).floor(), (6.0 * x + 1e-9).fract());
        let lean = (1.0 - share) * lean(line) + share * lean((line + 1.0).min(6.0));
        [6.0 * x + 0.2 * lean * (y - 0.5), 0.2 * y, 0.0]
    };
    let section = section(1e7, 0.3, 0.1);
    cantilever(Structure::new(Grid::new(shape, counts, &point), section, [1.0, 0.0, 0.0]), counts, force)
}

fn curved(shape: Shape, counts: [usize; 2], force: [f64; 3]) -> f64 {
    let point = |x: f64, y: f64| {
        let (angle, radius) = (0.5 * PI * (1.0 - x), 4.12 + 0.2 * y);
        [radius * angle.cos(), -radius * angle.sin(), 0.0]
    };
    let grid = Grid::new(shape, counts, &point);
    cantilever(Structure::new(grid, section(1e7, 0.25, 0.1), [1.0, 0.0, 0.0]), counts, force)
}

fn twisted(shape: Shape, counts: [usize; 2], thickness: f64, force: [f64; 3]) -> f64 {
    let point = |x: f64, y: f64| {
        let (angle, height) = (0.5 * PI * x, 1.1 * (y - 0.5));
        [12.0 * x, height * angle.cos(), height * angle.sin()]
    };
    let grid = Grid::new(shape, counts, &point);
    cantilever(Structure::new(grid, section(29e6, 0.22, thickness), [1.0, 0.0, 0.0]), counts, force)
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const MESHES: [[usize; 2]; 4] = [[6, 1], [12, 2], [24, 4], [48, 8]];

/// Deflections over the published one, printed as a row of a table; the last must be within 2 %.
fn converges(case: &str, shape: Shape, meshes: &[[usize; 2]], deflection: &dyn Fn([usize; 2]) -> f64) {
    let ratios: Vec<f64> = meshes.iter().map(|counts| deflection(*counts)).collect();
    println!("{case:30} {:9} {meshes:?}: {ratios:.4?}", name(shape));
    assert!(ratios.last().is_some_and(|ratio| (ratio - 1.0).abs() < 0.02), "{case}: {ratios:?}");
}

#[test]
fn straight_beams_bend_as_beams() {
    for shape in SHAPES {
        converges("straight, in its plane", shape, &MESHES[..3], &|n| straight(shape, n, 0.0, Y) / 0.1081);
        for (form, slant) in [("rectangles", 0.0), ("parallelograms", 1.0), ("trapezoids", -1.0)] {
            let case = format!("straight, out, {form}");
            converges(&case, shape, &MESHES[..2], &|n| straight(shape, n, slant, Z) / 0.4321);
        }
    }
}

/// In the plane, elements of four nodes that pass the patch test cannot follow bending where opposite sides are not
/// parallel `[@macneal1987]`; divided further they become parallelograms. Long slanted triangles converge slowly.
#[test]
fn slanted_elements_are_stiff_in_the_plane() {
    for shape in SHAPES {
        let allowed = if shape == Shape::Quad4 { 0.02 } else { 0.15 };
        for (form, slant) in [("parallelograms", 1.0), ("trapezoids", -1.0)] {
            let ratios = MESHES.map(|n| straight(shape, n, slant, Y) / 0.1081);
            println!("straight, in, {form:16} {:9} {MESHES:?}: {ratios:.4?}", name(shape));
            assert!((ratios[3] - 1.0).abs() < allowed, "{ratios:?}");
        }
    }
}

/// Out of its plane the beam twists, and is twice as wide as thick: elements without flexibility in transverse
/// shear take its section for thin and are 10 % too stiff, however small.
#[test]
fn curved_beams_bend_as_beams() {
    for shape in SHAPES {
        converges("curved, in its plane", shape, &MESHES, &|n| curved(shape, n, X) / 0.08734);
    }
    converges("curved, out", Shape::Quad4, &MESHES, &|n| curved(Shape::Quad4, n, Z) / 0.5022);
}

/// Thick values of `[@macneal1985]`, thin ones of `[@belytschko1989]`.
#[test]
fn twisted_beams_bend_as_beams() {
    let cases = [(0.32, Z, 5.424e-3), (0.32, Y, 1.754e-3), (0.0032, Z, 5256.0), (0.0032, Y, 1294.0)];
    for shape in SHAPES {
        for (thickness, force, published) in cases {
            let case = format!("twisted {thickness}, {}", if force == Z { "in its plane" } else { "out" });
            let meshes: &[[usize; 2]] = if shape == Shape::Quad4 { &MESHES[1..3] } else { &MESHES[1..] };
            converges(&case, shape, meshes, &|n| twisted(shape, n, thickness, force) / published);
        }
    }
}
