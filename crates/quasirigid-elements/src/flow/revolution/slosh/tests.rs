//! Slosh against closed forms of cylinders, the pendulum of spheres and theory's numbers, in units that are not metres.

use std::f64::consts::PI;

use super::{Slosh, Wall, WallPiece};

/// Grid of the tests.
const GRID: [usize; 2] = [8, 2];
/// Length by which every test is scaled (m).
const UNIT: f64 = 0.037;

fn line(from: [f64; 2], to: [f64; 2]) -> WallPiece {
    WallPiece::Line { from: from.map(|value| UNIT * value), to: to.map(|value| UNIT * value) }
}

/// Liquid in a cylinder of radius 1 with its surface at the height 0.
fn cylinder(depth: f64) -> Wall {
    Wall { pieces: vec![line([1.0, -depth], [1.0, 0.0])] }
}

/// Liquid in a sphere of radius 1 about the origin.
fn sphere(depth: f64) -> Wall {
    let whole = WallPiece::Arc { center: 0.0, across: UNIT, along: UNIT, angles: [0.0, PI] };
    Wall { pieces: vec![whole] }.filled(UNIT.powi(3) * PI * depth * depth * (1.0 - depth / 3.0))
}

/// `J_1` and its derivative by their integrals over a period.
fn bessel(x: f64) -> [f64; 2] {
    const STEPS: usize = 96;
    let angle = |step: usize| 2.0 * PI * step as f64 / STEPS as f64;
    let mean = |f: &dyn Fn(f64) -> f64| (0..STEPS).map(|step| f(angle(step))).sum::<f64>() / STEPS as f64;
    [mean(&|t| (t - x * t.sin()).cos()), mean(&|t| t.sin() * (t - x * t.sin()).sin())]
}

/// Zeros of the derivative of `J_1`.
fn zero(number: usize) -> f64 {
    let mut range = [1.0, 3.0].map(|place| place + PI * number as f64);
    let sign = bessel(range[0])[1].signum();
    for _ in 0..80 {
        let middle = 0.5 * (range[0] + range[1]);
        range[usize::from(bessel(middle)[1].signum() != sign)] = middle;
    }
    range[0]
}

fn close(value: f64, exact: f64, tolerance: f64, what: &str) {
    assert!((value / exact - 1.0).abs() < tolerance, "{what}: {value} instead of {exact}");
}

/// (U1), (U3): `ξ tanh ξh`, mass `2 tanh ξh/(hξ(ξ² − 1))`, height `−(2/ξ) tanh ξh/2`, of two modes.
#[test]
fn cylinders_slosh_as_bessel_functions() {
    for depth in [0.05, 0.3, 0.5, 1.0, 2.0, 9.0] {
        let slosh = Slosh::new(&cylinder(depth), 2, GRID).unwrap();
        for (number, mode) in slosh.modes.iter().enumerate() {
            let xi = zero(number);
            let tanh = (xi * depth).tanh();
            let tolerance = [1e-8, 1e-5][number];
            close(mode.wavenumber * UNIT, xi * tanh, tolerance, "wavenumber");
            let share = 2.0 * tanh / (depth * xi * (xi * xi - 1.0));
            close(mode.mass / (PI * depth * UNIT.powi(3)), share, tolerance, "mass");
            close(mode.height / UNIT, -2.0 / xi * (0.5 * xi * depth).tanh(), tolerance, "height");
        }
    }
}

/// (U7): `∮|∇φ|² dS` and `∫|∇φ|² dV` of `J_1(ξr) cosh ξ(z + h) cos θ`.
#[test]
fn walls_of_cylinders_are_rubbed_as_by_bessel_functions() {
    for depth in [0.2, 1.0, 3.0] {
        let slosh = Slosh::new(&cylinder(depth), 2, [12, 2]).unwrap();
        for (number, mode) in slosh.modes.iter().enumerate() {
            let xi = zero(number);
            let (sinh, cosh) = ((xi * depth).sinh(), (xi * depth).cosh());
            let side = (xi * xi + 1.0) * sinh * cosh / (2.0 * xi) + 0.5 * (1.0 - xi * xi) * depth;
            let bottom = 0.5 * (xi * xi - 1.0);
            let energy = 0.5 * (xi * xi - 1.0) / xi * sinh * cosh;
            close(mode.wall * UNIT, (side + bottom) / energy, 1e-6, "wall");
        }
    }
}

/// (U6): `π h (h²/12 − 3/4) + 16π Σ tanh(ξh/2)/(ξ³(ξ² − 1))` about the middle of a cylinder.
#[test]
fn lids_of_cylinders_have_the_moment_of_the_series() {
    for depth in [0.4, 1.0, 2.5] {
        let slosh = Slosh::new(&cylinder(depth), 1, GRID).unwrap();
        let term = |number: usize| {
            let xi = zero(number);
            (0.5 * xi * depth).tanh() / (xi.powi(3) * (xi * xi - 1.0))
        };
        let volume = PI * depth;
        let about_middle =
            volume * (depth * depth / 12.0 - 0.75) + 16.0 * PI * (0..24).map(term).sum::<f64>();
        let about_surface = about_middle + volume * 0.25 * depth * depth;
        close(slosh.lid / UNIT.powi(5), about_surface, 2e-6, "lid");
    }
}

/// Numbers of theory, found by other elements (quadratic triangles); a sphere feels no tilt about its centre, so every pendulum is hinged
/// there.
#[test]
fn spheres_slosh_as_pendulums_at_their_centre() {
    let known = [
        (0.2, 1.07232, 0.93038),
        (0.6, 1.26251, 0.77117),
        (1.0, 1.56016, 0.57969),
        (1.4, 2.1232, 0.3501),
        (1.8, 3.96, 0.0936),
    ];
    for (depth, wavenumber, share) in known {
        let slosh = Slosh::new(&sphere(depth), 3, GRID).unwrap();
        let moments = sphere(depth).moments();
        close(slosh.modes[0].wavenumber * UNIT, wavenumber, 2e-4, "wavenumber");
        close(slosh.modes[0].mass / moments.volume, share, 5e-4, "mass");
        for mode in &slosh.modes {
            close(-mode.height * mode.wavenumber, 1.0, 1e-9, "hinge");
        }
        let [mass, first, second] = slosh.all;
        assert!(mass < moments.volume);
        close(first, moments.first, 1e-9, "first moment of the bobs");
        close(second, slosh.lid, 1e-9, "second moment of the bobs");
    }
}

/// (U5): `Σ m L = ∫_F x² dS`, since a tilted surface is the sum of its modes, and what is left of mass and moments has no negative energy.
#[test]
fn bobs_hold_no_more_than_the_liquid() {
    let cone = |radii: [f64; 2]| Wall { pieces: vec![line([radii[0], -0.7], [radii[1], 0.4])] };
    let kink = Wall { pieces: vec![line([0.0, -0.9], [0.8, -0.3]), line([0.8, -0.3], [0.5, 0.2])] };
    for wall in [cone([0.2, 0.9]), cone([0.9, 0.3]), kink, cylinder(0.8), sphere(0.7)] {
        let slosh = Slosh::new(&wall, 20, [10, 3]).unwrap();
        let moments = wall.moments();
        let [_, [radius, _]] = wall.ends();
        let sum: f64 = slosh.modes.iter().map(|mode| mode.mass / mode.wavenumber).sum();
        close(sum, 0.25 * PI * radius.powi(4), 1e-4, "first moment of a tilted surface");
        let [mass, first, second] = slosh.all;
        let (m, s, j) = (moments.volume - mass, moments.first - first, slosh.lid - second);
        let rounding = 1e-7 * moments.volume * slosh.lid;
        assert!(m > 0.0 && m * j - s * s > -rounding, "{m} {s} {j}");
    }
}

/// Heights are counted from any origin: the bob moves with it, mass and wavenumber stay, and the moment of the lid obeys the theorem of
/// parallel axes.
#[test]
fn another_origin_moves_the_bobs() {
    let away = 2.3 * UNIT;
    let lifted = |wall: &Wall| {
        let piece = |piece: &WallPiece| match *piece {
            WallPiece::Line { from, to } => {
                WallPiece::Line { from: [from[0], from[1] + away], to: [to[0], to[1] + away] }
            }
            WallPiece::Arc { center, across, along, angles } => {
                WallPiece::Arc { center: center + away, across, along, angles }
            }
        };
        Wall { pieces: wall.pieces.iter().map(piece).collect() }
    };
    for wall in [cylinder(0.9), sphere(1.3)] {
        let [here, there] = [wall.clone(), lifted(&wall)].map(|wall| Slosh::new(&wall, 2, GRID).unwrap());
        let moments = wall.moments();
        for (a, b) in here.modes.iter().zip(&there.modes) {
            close(b.wavenumber, a.wavenumber, 1e-11, "wavenumber");
            close(b.mass, a.mass, 1e-10, "mass");
            close(b.height, a.height + away, 1e-9, "height");
        }
        let shifted = here.lid + 2.0 * away * moments.first + away * away * moments.volume;
        close(there.lid, shifted, 1e-10, "lid");
    }
}

/// The level holds the volume: against the closed forms of a cap, and of a frustum upside down.
#[test]
fn levels_hold_their_volume() {
    for depth in [1e-3, 0.4, 1.0, 1.9] {
        let [_, [radius, level]] = sphere(depth).ends();
        close(level + UNIT, depth * UNIT, 1e-12, "level");
        close(radius, UNIT * (depth * (2.0 - depth)).sqrt(), 1e-12, "radius of the surface");
    }
    let cone = Wall { pieces: vec![line([0.0, 0.0], [1.0, 2.0])] };
    let half = cone.filled(0.5 * cone.moments().volume).ends()[1][1];
    close(half, 2.0 * UNIT * 0.5_f64.cbrt(), 1e-13, "half a cone");
    let half = cone.flipped().filled(0.5 * cone.moments().volume).ends()[1][1];
    close(half, -2.0 * UNIT * 0.5_f64.cbrt(), 1e-13, "half a cone upside down");
}

/// The error falls with the degree, also at an overhanging wall.
#[test]
fn degrees_converge() {
    for (depth, most) in [(1.0, 1e-7), (1.6, 1e-4)] {
        let at = |grid| Slosh::new(&sphere(depth), 1, grid).unwrap().modes[0].wavenumber;
        let fine = at([12, 3]);
        let gaps = [[4, 1], [8, 2]].map(|grid| (at(grid) / fine - 1.0).abs());
        assert!(gaps[1] < 0.3 * gaps[0] && gaps[1] < most, "{depth}: {gaps:?}");
    }
}

/// Nearly full, nothing sloshes and the moment is that of the full vessel; nearly empty, all of it is one shallow bob.
#[test]
fn little_sloshes_in_a_full_vessel() {
    let full = Slosh::new(&sphere(1.98), 1, GRID).unwrap();
    let volume = 4.0 / 3.0 * PI * UNIT.powi(3);
    assert!(full.all[0] < 6e-3 * volume && full.lid < 1e-2 * volume * UNIT * UNIT);
    let shallow = Slosh::new(&sphere(0.01), 1, GRID).unwrap();
    let moments = sphere(0.01).moments();
    close(shallow.modes[0].mass, moments.volume, 5e-3, "all of it");
    close(shallow.modes[0].wavenumber * UNIT, 1.0, 5e-3, "as a bead in the sphere");
}

/// (U17): at the wall of a cylinder the mode rises as `sinh ξ(z + h)/sinh ξh`, its inertia is `π(1 − 1/ξ²)/2λ`, and along the surface
/// `∮|∇φ|² dS = ξ²(1 − 1/ξ²)/(ξ tanh ξh (1 − 1/ξ²))` of its energy.
#[test]
fn walls_of_cylinders_rise_as_bessel_functions() {
    for depth in [0.2, 1.0, 3.0] {
        let slosh = Slosh::new(&cylinder(depth), 2, [12, 2]).unwrap();
        for (number, mode) in slosh.modes.iter().enumerate() {
            let xi = zero(number);
            let known = 0.5 * PI * (1.0 - xi.powi(-2)) * UNIT.powi(2) / mode.wavenumber;
            close(mode.inertia, known, 1e-5, "inertia");
            close(mode.surface * UNIT, xi / (xi * depth).tanh(), 1e-5, "surface");
            let side =
                mode.rise.iter().filter(|[r, z, _]| *r > 0.999_999 * UNIT && *z > -0.95 * depth * UNIT);
            assert!(side.clone().count() > 8);
            for [_, z, rise] in side {
                let known = (xi * (z / UNIT + depth)).sinh() / (xi * depth).sinh();
                assert!((rise - known).abs() < 1e-4, "{rise} instead of {known} at {z}");
            }
        }
    }
}
