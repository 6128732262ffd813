//! Vibrations of a thick cantilever against Timoshenko's equations, which a transfer matrix solves exactly.

use std::f64::consts::PI;

use nalgebra::Matrix4;

use super::*;

const LENGTH: f64 = 1.7;

fn section() -> Section {
    SectionShape::Rectangle { height: 0.35, width: 0.2 }.section(0.3).unwrap()
}

/// Determinant that vanishes at a frequency of the clamped and free beam: with `v`, `ψ`, the moment and the shear
/// force,
///
/// ```text
/// v′ = ψ + V/GA_s,   ψ′ = M/EI,   M′ = −V − ρI ω² ψ,   V′ = −ρA ω² v
/// ```
fn determinant(omega: f64, second: f64, shear_area: f64) -> f64 {
    let BeamMaterial { young, shear, density } = ALLOY;
    let load = density * omega * omega;
    let mut system = Matrix4::zeros();
    system[(0, 1)] = 1.0;
    system[(0, 3)] = 1.0 / (shear * shear_area);
    system[(1, 2)] = 1.0 / (young * second);
    system[(2, 1)] = -load * second;
    system[(2, 3)] = -1.0;
    system[(3, 0)] = -load * section().area;
    // Forces in a unit that makes the numbers near one.
    let unit = Matrix4::from_diagonal(&[1.0, 1.0, young * second, young * second].into());
    let scaled = unit.try_inverse().unwrap() * system * unit;
    (scaled * LENGTH).exp().fixed_view::<2, 2>(2, 2).determinant()
}

/// The first roots of the frequency equation (rad/s).
fn exact(second: f64, shear_area: f64) -> Vec<f64> {
    let f = |omega: f64| determinant(omega, second, shear_area);
    let step = 20.0;
    let mut roots = Vec::new();
    for i in 0.. {
        let [mut low, mut high] = [f64::from(i) * step, f64::from(i + 1) * step];
        if f(low) * f(high) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
            }
            roots.push(low);
        }
        if roots.len() == 4 {
            break;
        }
    }
    roots
}

/// Frequencies (rad/s) with these coordinates of each node, the beam along the third axis of the body.
fn frequencies(section: Section, count: usize, coordinates: &[usize]) -> Vec<f64> {
    let from = Vector3::new(0.4, 1.1, -0.6);
    let ends = [from.into(), (from + LENGTH * Vector3::z()).into()];
    let chain = Chain::even(ends, [1.0, 0.0, 0.0], section, ALLOY, count);
    let kept: Vec<usize> =
        (1..=count).flat_map(|node| coordinates.iter().map(move |i| 6 * node + i)).collect();
    let (squares, _) = eigen(&part(&chain.sum(Beam::stiffness), &kept), &part(&chain.sum(Beam::mass), &kept));
    squares.into_iter().map(f64::sqrt).collect()
}

#[test]
fn a_thick_cantilever_has_the_frequencies_of_timoshenko() {
    let stiff = Section { shear_y: f64::INFINITY, shear_z: f64::INFINITY, ..section() };
    for (section, last) in [(section(), 2.0), (stiff, 4.0)] {
        for (coordinates, second, area) in
            [([0, 4], section.second_z, section.shear_y), ([1, 3], section.second_y, section.shear_z)]
        {
            let exact = exact(second, area);
            let slender =
                3.5160 / LENGTH.powi(2) * (ALLOY.young * second / (ALLOY.density * section.area)).sqrt();
            assert!((0.9..0.999).contains(&(exact[0] / slender)), "it is thick: {exact:?} {slender}");
            let found = [4, 8, 16, 32].map(|count| frequencies(section, count, &coordinates));
            for mode in 0..3 {
                let errors = [0, 1, 2, 3].map(|i| found[i][mode] / exact[mode] - 1.0);
                assert!(errors.iter().all(|error| *error > 0.0), "from above, as Rayleigh says");
                // The shear of loads inside an element is left out: (kh)²/24 for the wave number k of shear.
                let square = ALLOY.density * section.area / (ALLOY.shear * area) * exact[mode].powi(2);
                let bound = 1.1 * square * (LENGTH / 16.0).powi(2) / 24.0 + 5e-5;
                assert!(errors[2] < bound, "{errors:?} {bound}");
                assert!((orders(&errors)[2] - last).abs() < 0.3, "{mode}: {errors:?} {:?}", orders(&errors));
            }
        }
    }
}

#[test]
fn a_rod_has_the_frequencies_of_its_waves() {
    let section = section();
    let polar = section.second_y + section.second_z;
    let BeamMaterial { young, shear, density } = ALLOY;
    for (coordinate, speed) in
        [(2, (young / density).sqrt()), (5, (shear * section.torsion / (density * polar)).sqrt())]
    {
        for mode in 0..2 {
            let exact = (mode as f64 + 0.5) * PI * speed / LENGTH;
            let errors =
                [8, 16, 32].map(|count| frequencies(section, count, &[coordinate])[mode] / exact - 1.0);
            assert!(orders(&errors).iter().all(|order| (1.9..2.1).contains(order)), "{errors:?}");
            // (kh)²/24 of a consistent mass matrix
            let expected = ((mode as f64 + 0.5) * PI / 32.0).powi(2) / 24.0;
            assert!((errors[2] / expected - 1.0).abs() < 0.02, "{errors:?} {expected}");
        }
    }
}
