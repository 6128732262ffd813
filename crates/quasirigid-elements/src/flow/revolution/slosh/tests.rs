use std::f64::consts::PI;

use super::{Slosh, Wall, WallPiece};

/// First zero of the derivative of the Bessel function `J_1`.
const XI: f64 = 1.841_183_781_340_659_3;

fn sphere(radius: f64) -> Wall {
    Wall { pieces: vec![WallPiece::Arc { center: 0.0, across: radius, along: radius, angles: [0.0, PI] }] }
}

fn sphere_to(radius: f64, depth: f64) -> Wall {
    sphere(radius).filled(PI * depth * depth * (radius - depth / 3.0))
}

#[test]
fn probe() {
    for (degree, layers) in [(6, 1), (6, 2), (8, 2), (8, 3), (10, 3)] {
        let start = std::time::Instant::now();
        for depth in [0.02, 0.2, 0.6, 1.0, 1.4, 1.8, 1.95] {
            let slosh = Slosh::new(&sphere_to(1.0, depth), 2, [degree, layers]);
            let Some(slosh) = slosh else { println!("{degree} {layers} {depth}: none"); continue };
            let mode = slosh.modes[0];
            let volume = PI * depth * depth * (1.0 - depth / 3.0);
            println!(
                "{degree} {layers} {depth}: {:.10} {:.10} hinge {:.2e} wall {} {}",
                mode.wavenumber,
                mode.mass / volume,
                mode.height + 1.0 / mode.wavenumber,
                mode.wall, slosh.modes[1].wall,
            );
        }
        println!("{:?}", start.elapsed() / 7);
    }
    for height in [0.05, 0.5, 1.0, 2.0, 10.0] {
        let wall = Wall { pieces: vec![WallPiece::Line { from: [1.0, -height], to: [1.0, 0.0] }] };
        let mode = Slosh::new(&wall, 2, [8, 2]).unwrap().modes[0];
        let tanh = (XI * height).tanh();
        println!(
            "{height} {:.2e} {:.2e} {:.2e}",
            mode.wavenumber / (XI * tanh) - 1.0,
            mode.mass / (PI * height) / (2.0 * tanh / (height * XI * (XI * XI - 1.0))) - 1.0,
            mode.height / (-2.0 / XI * (0.5 * XI * height).tanh()) - 1.0
        );
    }
}
